import numpy as np

from benches.learning.running.ppo_run import strength


def test_the_curve_of_self_play_is_that_of_the_ladder_or_of_matches_against_ou() -> None:
    progress = {"episodes": np.array([4.0, 2.0]), "episode/goal_score": np.array([0.0, 0.1])}
    assert strength(progress, "goal_score")[0].tolist() == [0.0, 0.1]
    progress["episode_ou/goal_score"] = np.array([np.nan, 0.5])
    assert strength(progress, "goal_score")[0][1] == 0.5
    progress["ladder_ou_goal_score"] = np.array([np.nan, 0.7])
    values, weights = strength(progress, "goal_score")
    assert values[1] == 0.7
    assert weights.tolist() == [1.0, 1.0]

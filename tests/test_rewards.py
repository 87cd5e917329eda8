import numpy as np
import pytest

from rsoccer import list_tasks, make_task, rewards
from rsoccer._core import Potential, mean_action_magnitude, nearest_to_ball
from rsoccer.arrays import Floats
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT
from rsoccer.matches import Matches
from rsoccer.rules import Crossings
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests import rewards_reference
from tests.helpers import pushing

TASK = VssSelfPlay()
FIELD = TASK.config.field


def initial_play(n: int = 2, task: VssSelfPlay = TASK) -> Play:
    matches = Matches(task, n, seed=3)
    matches.reset()
    return matches.play


def accumulate(term: str, steps: int = 60) -> tuple[Floats, Play, Play]:
    """Sum of a term over some steps, with the first and the last state."""
    matches = Matches(TASK, 5, seed=4, autoreset="disabled")
    matches.reset()
    first = matches.play.take(np.arange(5))
    total = np.zeros((5, 6), np.float32)
    rng = np.random.default_rng(0)
    for _ in range(steps):
        matches.step(pushing(rng, matches))
        play = matches.play
        total += (
            rewards.approach_behind_ball(play, FIELD)
            if term == "approach"
            else rewards.ball_to_goal(play, FIELD)
        )
    return total, first, matches.play


def test_a_goal_has_the_sign_of_the_observers_team() -> None:
    play = initial_play(3)
    assert not rewards.goal(play).any()
    play.frame.ball.crossed[:] = [GOAL_RIGHT, GOAL_LEFT, 0]
    Crossings().judge(play)
    assert rewards.goal(play).tolist() == [[1] * 3 + [-1] * 3, [-1] * 3 + [1] * 3, [0] * 6]
    assert rewards.scored(play).tolist() == [True, True, False]
    assert rewards.goal_score(play).tolist() == [1.0, -1.0, 0.0]


def test_shaping_terms_are_zero_after_a_reset() -> None:
    play = initial_play()
    assert not rewards.ball_to_goal(play, FIELD).any()
    assert not rewards.approach_behind_ball(play, FIELD).any()


def test_ball_to_goal_is_in_meters() -> None:
    play = initial_play(1)
    play.last_frame.ball.position[:] = [0.0, 0.0]
    play.frame.ball.position[:] = [0.2, 0.0]
    assert rewards.ball_to_goal(play, FIELD)[0] == pytest.approx([0.2] * 3 + [-0.2] * 3, abs=1e-6)


def test_ball_to_goal_is_zero_sum() -> None:
    total, _, play = accumulate("ball_to_goal")
    term = rewards.ball_to_goal(play, FIELD)
    assert term.any()
    assert (term[:, :3] == -term[:, 3:]).all()
    assert np.abs(total).max() > 0.01


def test_ball_to_goal_depends_on_the_end_points_only() -> None:
    total, first, last = accumulate("ball_to_goal")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    assert total == pytest.approx(rewards.ball_to_goal(first, FIELD), abs=1e-5)


def test_approach_rewards_each_robots_own_motion() -> None:
    play = initial_play(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    # The point behind the ball is 8 cm from the ball, on the side of the own goal.
    positions = np.array([[0.3, 0], [0.2, 0], [-0.5, 0], [-0.1, 0], [-0.4, 0], [0.5, 0]])
    play.last_frame.robots.position[:] = positions
    play.frame.robots.position[:] = positions - [0.05, 0.0]
    expected = [0.05, 0.05, -0.05, -0.05, -0.05, 0.05]
    assert rewards.approach_behind_ball(play, FIELD)[0] == pytest.approx(expected, abs=1e-6)


def test_approach_depends_on_the_end_points_only() -> None:
    total, first, last = accumulate("approach")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    assert total == pytest.approx(rewards.approach_behind_ball(first, FIELD), abs=1e-5)
    assert np.abs(total).max() > 0.05


def test_a_robot_in_front_of_the_ball_is_rewarded_for_driving_around_it() -> None:
    """Driving at the ball from the front earns less than the same distance past the ball."""
    play = initial_play(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    play.last_frame.robots.position[0, :2] = [0.06, 0.0], [0.06, 0.0]
    play.frame.robots.position[0, :2] = [0.06, 0.0], [0.0, 0.06]
    straight, around = rewards.approach_behind_ball(play, FIELD)[0, :2]
    assert around > straight + 0.03


def test_one_robot_of_each_team_is_nearest() -> None:
    play = initial_play(1)
    play.last_frame.ball.position[:] = 0.0
    positions = np.array([[0.3, 0], [0.2, 0], [0.5, 0], [-0.1, 0], [-0.4, 0], [-0.5, 0]])
    play.last_frame.robots.position[:] = positions
    assert rewards.nearest_to_ball(play)[0].tolist() == [False, True, False, True, False, False]


def test_one_robot_is_nearest_without_opponents() -> None:
    play = initial_play(20, VssSelfPlay(n_yellow=0))
    assert rewards.nearest_to_ball(play).sum(axis=1).tolist() == [1] * 20


def test_energy_is_the_mean_action_magnitude() -> None:
    play = initial_play(1)
    play.actions[0, 0] = [1.0, -1.0]
    play.actions[0, 1] = [0.0, 0.5]
    play.actions[0, 5] = [-1.0, 0.0]
    assert rewards.energy(play)[0] == pytest.approx([-1, -0.25, 0, 0, 0, -0.5])
    assert rewards.energy(play).dtype == np.float32


@pytest.mark.parametrize("name", list_tasks())
def test_terms_equal_the_reference(name: str) -> None:
    task = make_task(name)
    matches = Matches(task, 8, seed=5)
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(20):
        matches.step(pushing(rng, matches))
    play, config = matches.play, task.config
    # The ball is at rest in some tasks, so its motion is added to the frame.
    play.frame.ball.position[:] += rng.uniform(-0.1, 0.1, play.frame.ball.position.shape)
    play.expire_views()
    differences = {
        "ball_to_goal": rewards.ball_to_goal(play, config.field),
        "approach_behind_ball": rewards.approach_behind_ball(play, config.field),
    }
    if config.robot.has_mouth:
        differences["approach_mouth"] = rewards.approach_mouth(play, config)
    for term, difference in differences.items():
        expected = getattr(rewards_reference, term)(play, config)
        np.testing.assert_allclose(difference, expected, atol=1e-6, err_msg=term)
        assert expected.all(), f"{term}: a difference of 0 compares nothing"
    assert np.array_equal(rewards.nearest_to_ball(play), rewards_reference.nearest_to_ball(play))
    np.testing.assert_allclose(rewards.energy(play), rewards_reference.energy(play), rtol=1e-6)
    play.last_frame.robots.absent[:, ::2] = 1.0
    assert np.array_equal(rewards.nearest_to_ball(play), rewards_reference.nearest_to_ball(play))
    gone = play.last_frame.robots.absent[:, play.observers] > 0.0
    assert not rewards.ball_to_goal(play, config.field)[gone].any()
    assert not rewards.nearest_to_ball(play)[gone].any()


def test_terms_do_not_depend_on_the_number_of_threads() -> None:
    plays = [moved_play(threads) for threads in (1, 2, 5)]
    for term in (rewards.ball_to_goal, rewards.approach_behind_ball):
        alone, *shared = (term(play, FIELD) for play in plays)
        assert alone.any(axis=1).all()
        assert all(np.array_equal(alone, other) for other in shared)


def moved_play(threads: int) -> Play:
    """Many worlds after a step, on some threads."""
    matches = Matches(TASK, 700, seed=3, threads=threads)
    matches.reset()
    matches.play.frame.ball.position[:] += np.float32(0.01)
    return matches.play


def test_wrong_arrays_are_refused_by_name() -> None:
    play = initial_play(2)
    last_rows, rows, viewpoint = play.last_frame.rows, play.frame.rows, play.viewpoint.core
    potential = Potential.ball_to_goal(FIELD)
    with pytest.raises(ValueError, match=r"last_rows must have shape \(2, 89\), got \(1, 89\)"):
        potential.difference(viewpoint, last_rows[:1], rows)
    with pytest.raises(ValueError, match="rows must have 2 axes"):
        potential.difference(viewpoint, last_rows, rows[0])
    with pytest.raises(TypeError, match="rows must be an array of float32, got float64"):
        potential.difference(viewpoint, last_rows, rows.astype(np.float64))
    with pytest.raises(ValueError, match="robot must have a mouth, got vss_440rpm"):
        rewards.approach_mouth(play, TASK.config)
    for distance in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="distance must be above 0 m"):
            Potential.behind_ball(FIELD, distance)
    for observer in (-1, 6):
        with pytest.raises(ValueError, match=f"observers must be robots below 6, got {observer}"):
            nearest_to_ball(play.frame.rows, 3, np.array([0, observer]))
        with pytest.raises(ValueError, match=f"observers must be robots below 6, got {observer}"):
            mean_action_magnitude(play.actions, np.array([0, observer]))
    with pytest.raises(TypeError, match="observers must be an array of int64"):
        nearest_to_ball(play.frame.rows, 3, np.array([0.0]))

import pytest

import rsoccer
from rsoccer.evaluate import first_seed
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.replay.evaluation import record_last_match
from rsoccer.task import LEARN


@pytest.mark.parametrize(
    ("task", "policy", "opponent", "side"),
    [("VSSSelfPlay-v0", "chase", "ou", "yellow"), ("SSLGoToBall-v0", "fetch", None, None)],
)
def test_the_last_match_is_the_one_that_was_evaluated(
    task: str, policy: str, opponent: str | None, side: str | None
) -> None:
    made = rsoccer.make_task(task, max_steps=200)
    replay = record_last_match(policy, opponent, 6, seed=4, task=made)
    controllers = lineup(made, LEARN, opponent and make_policy(opponent, made), side)
    runner = EpisodeRunner(made, controllers, make_policy(policy, made), 50, 1)
    per_side = 3 if side else 6
    episodes = runner.run(per_side, first_seed(4, 1 if side else 0))
    (episode,) = replay.episodes
    assert replay.seconds == pytest.approx(episodes.seconds[-1])
    assert episode.metrics[episodes.metric] == episodes.scores[-1]
    learners = [replay.observers.index(name) for name in made.robots if name in replay.observers]
    assert learners
    assert episode.end in ("terminated", "truncated")


def test_the_board_names_the_policies_by_their_team() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=5)
    assert record_last_match("chase", "ou", 2, task=task).names == ("OU", "CHASE")
    assert record_last_match("chase", None, 2, task=task, names=("A", "B")).names == ("B", "A")
    solo = rsoccer.make_task("SSLGoToBall-v0", max_steps=5)
    assert record_last_match("fetch", matches=1, task=solo).names == ("FETCH", "")


def test_arguments_are_checked_as_in_an_evaluation() -> None:
    with pytest.raises(ValueError, match="matches: expected an even number"):
        record_last_match("chase", "ou", 3)
    with pytest.raises(ValueError, match="unknown policy"):
        record_last_match("unknown")

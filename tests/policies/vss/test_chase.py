import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.vss.chase import Chase
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay

TASK = VssSelfPlay()


def score(blue: str, yellow: str, robots: int = 3) -> float:
    """Goals of blue less goals of yellow, per match of 30 s."""
    worlds = 80
    matches = Matches(
        VssSelfPlay(n_blue=robots, n_yellow=robots),
        worlds,
        seed=3,
        threads=2,
        controllers={"blue": blue, "yellow": yellow},
        autoreset="disabled",
    )
    matches.reset()
    total = 0.0
    for _ in range(matches.task.max_steps):
        outcome = matches.step(np.zeros((worlds, 0, 2), np.float32))
        total += float(outcome.metrics["goal_score"][outcome.terminated].sum())
        if matches.done.all():
            break
    return total / worlds


@pytest.mark.parametrize("robots", [1, 3])
def test_chase_scores_against_standing_robots(robots: int) -> None:
    assert score("chase", "zero", robots) > 0.85


def test_chase_plays_for_yellow_too() -> None:
    assert score("zero", "chase", 1) < -0.85


def test_chase_beats_ou() -> None:
    assert score("chase", "ou") > 0.75


def test_chase_refuses_other_actions() -> None:
    class ThreeActions(VssSelfPlay):
        action_size = 3

    with pytest.raises(ValueError, match="chase needs robots with a differential drive"):
        Chase(ThreeActions())


def test_chase_needs_a_view() -> None:
    chase = Chase(TASK)
    rng = WorldRng.seeded(0, 1)
    with pytest.raises(ValueError, match="chase needs a view"):
        chase.act(PolicyInput((1, 1, 2), None, None), rng, chase.new_memory((1, 1, 2), rng))

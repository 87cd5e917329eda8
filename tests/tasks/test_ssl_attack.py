"""Initial states of the attacks that start with the ball, for training."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.rng import WorldRng
from rsoccer.tasks.ssl_attack import RANDOM_START_CLEARANCE, SslAttack
from rsoccer.testing import check_task

NAMES = ("SSLContestedPossession-v0", "SSLStaticDefenders-v0")
OPTIONS: list[tuple[str, dict[str, Any]]] = [(name, {}) for name in NAMES] + [
    ("SSLContestedPossession-v0", {"scenario": 5}),
    ("SSLStaticDefenders-v0", {"scenario": 9}),
    ("SSLStaticDefenders-v0", {"n_opponents": 0}),
]


def attack(name: str, **options: Any) -> SslAttack:  # noqa: ANN401  (any option)
    """The task, as its base class."""
    task = rsoccer.make_task(name, **options)
    assert isinstance(task, SslAttack)
    return task


@pytest.mark.parametrize(("name", "options"), OPTIONS)
def test_half_of_the_random_starts_have_the_ball_and_room(
    name: str, options: dict[str, Any]
) -> None:
    task = attack(name, random_start=True, **options)
    frame = task.get_initial_positions_frame(WorldRng.seeded(3, 400))
    usual = attack(name, **options).get_initial_positions_frame(WorldRng.seeded(3, 400))
    attacker = frame.blue.position[:, 0]
    distance = np.linalg.norm(frame.ball.position - attacker, axis=-1)
    moved = np.abs(distance - task.mouth_offset) < 1e-5
    assert 0.4 < moved.mean() < 0.6
    assert (frame.rows[~moved] == usual.rows[~moved]).all(), "the others start as usual"
    assert (frame.yellow.position == usual.yellow.position).all()
    radius = task.config.robot.bounding_radius
    if task.n_yellow:
        gap = np.linalg.norm(attacker[:, None] - frame.yellow.position, axis=-1).min(axis=1)
        assert gap[moved].min() > 2 * radius + RANDOM_START_CLEARANCE - 1e-5
    assert not task.is_in_goal_area(frame.ball.position[moved]).any()
    assert (frame.ball.position[moved] > [0.0, -task.config.field.half_width]).all()
    assert attacker[moved].std(axis=0).min() > 0.5, "everywhere in the half"


@pytest.mark.parametrize("name", NAMES)
def test_episodes_with_the_ball_can_be_played(name: str) -> None:
    check_task(attack(name, random_start=True), worlds=8, steps=60)


@pytest.mark.parametrize("name", NAMES)
def test_other_values_are_refused(name: str) -> None:
    with pytest.raises(TypeError, match="random_start: expected True or False, got 1"):
        attack(name, random_start=1)

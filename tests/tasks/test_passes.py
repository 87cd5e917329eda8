"""Passes that `SSLSelfPlay-v0` counts, in scenes with one kick or a rolling ball."""

from collections.abc import Mapping

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.tasks import SslSelfPlay
from rsoccer.tasks.passes import NOBODY
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, scene

TASK = SslSelfPlay()
MOUTH = float(TASK.mouth_offset)
FACING = {"blue_0": (-1.0, 0.0, 0.0), "blue_1": (1.0, 0.0, np.pi)}
"""Two teammates 2 m apart, face to face."""


def passes_after_kick(
    poses: Mapping[str, tuple[float, ...]], kicker: str = "blue_0"
) -> tuple[float, float]:
    """Passes of blue and yellow after a robot kicks; all others dribble where they stand."""
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=scene(TASK, **poses).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, len(matches.agents), 1))
    for step in range(60):
        softly = (*KICK[:3], 0.5, -1.0)
        actions[0, TASK.robots.index(kicker)] = softly if step < 2 else STAND
        outcome = matches.step(actions)
    metrics = outcome.metrics
    return float(metrics["blue_passes"][0]), float(metrics["yellow_passes"][0])


def test_a_ball_from_mouth_to_mouth_of_teammates_is_one_pass() -> None:
    assert passes_after_kick({**FACING, "ball": (-1.0 + MOUTH, 0.0)}) == (1.0, 0.0)


def test_passes_are_those_of_the_team() -> None:
    poses = {"yellow_0": FACING["blue_0"], "yellow_1": FACING["blue_1"]}
    assert passes_after_kick({**poses, "ball": (-1.0 + MOUTH, 0.0)}, "yellow_0") == (0.0, 1.0)


@pytest.mark.parametrize(
    ("case", "poses"),
    [
        ("to an opponent", {"blue_0": FACING["blue_0"], "yellow_0": FACING["blue_1"]}),
        ("too short", {"blue_0": (-0.25, 0.0, 0.0), "blue_1": (0.25, 0.0, np.pi)}),
        ("touched by an opponent", {**FACING, "yellow_0": (0.0, 0.109, np.pi / 2)}),
    ],
)
def test_other_balls_are_no_passes(case: str, poses: dict[str, tuple[float, ...]]) -> None:
    ball = (poses["blue_0"][0] + MOUTH, 0.0)
    assert passes_after_kick({**poses, "ball": ball}) == (0.0, 0.0), case


def test_a_ball_that_nobody_touched_is_no_pass() -> None:
    assert passes_after_kick({**FACING, "ball": (0.0, 0.0, 1.5, 0.0)}) == (0.0, 0.0)


def test_a_ball_that_stopped_is_no_pass() -> None:
    task = SslSelfPlay(n_yellow=0)
    matches = Matches(task, 1, autoreset="disabled")
    poses = {"blue_0": (-2.0, 0.0, 0.0), "blue_1": (1.5, 0.0, np.pi)}
    matches.reset(rows=scene(task, **poses, ball=(-2.0 + MOUTH, 0.0)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 3, 1))
    for step in range(400):
        actions[0, 0] = (*KICK[:3], 0.25, -1.0) if step < 2 else STAND
        matches.step(actions)
    ball = matches.frame.ball
    assert ball.position[0, 0] > -2.0 + MOUTH + 0.5, "the kick is long enough for a pass"
    assert not ball.velocity.any()
    assert matches.frame.blue.position[0, 1, 0] > ball.position[0, 0] + 0.3, "blue_1 is beyond it"
    actions[0, 1] = (-0.15, 0.0, 0.0, -1.0, 1.0)
    for _ in range(400):
        outcome = matches.step(actions)
        if matches.frame.robots.infrared[0, 1]:
            break
    assert matches.frame.robots.infrared[0, 1], "blue_1 collected the ball"
    assert outcome.metrics["blue_passes"][0] == 0.0


def test_a_ball_that_left_the_field_is_no_pass() -> None:
    matches = Matches(TASK, 1, autoreset="disabled")
    start = scene(TASK, blue_0=(0.0, 1.7, np.pi / 2), ball=(0.0, 1.7 + MOUTH))
    matches.reset(rows=start.rows)
    actions = np.tile(np.array(STAND, np.float32), (1, 6, 1))
    actions[0, 0] = KICK
    seen = []
    for _ in range(20):
        matches.step(actions)
        seen.append(int(matches.play.memory["touched_by"][0]))
    assert 0 in seen, "blue_0 had the ball"
    assert seen[-1] == NOBODY


def test_passes_are_rewarded_on_demand() -> None:
    task = SslSelfPlay(reward_weights={"passes": 2.0})
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=scene(task, **FACING, ball=(-1.0 + MOUTH, 0.0)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    total = np.zeros(6, np.float32)
    for step in range(60):
        actions[0, 0] = (*KICK[:3], 0.5, -1.0) if step < 2 else STAND
        total += matches.step(actions).terms["passes"][0]
    assert total.tolist() == [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]

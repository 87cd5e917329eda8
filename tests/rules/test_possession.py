"""Possession that `SSLSelfPlay-v0` counts: interceptions, time with the ball."""

import numpy as np

from rsoccer import Matches
from rsoccer.tasks import SslSelfPlay
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, scene

TASK = SslSelfPlay()
START = {"ball": (-1.0 + float(TASK.mouth_offset), 0.0), "blue_0": (-1.0, 0.0)}


def kicked(**poses: tuple[float, ...]) -> tuple[dict[str, float], Matches]:
    """Metrics after blue_0 has kicked, all others dribble where they stand."""
    matches = Matches(TASK, autoreset="disabled")
    matches.reset(rows=scene(TASK, **START, **poses).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    for step in range(60):
        actions[0, 0] = (*KICK[:3], 0.4, -1.0) if step < 2 else STAND
        outcome = matches.step(actions)
    return {name: float(values[0]) for name, values in outcome.metrics.items()}, matches


def test_a_ball_that_an_opponent_catches_is_intercepted_once() -> None:
    metrics, matches = kicked(yellow_0=(1.0, 0.0, np.pi))
    assert (metrics["yellow_interceptions"], metrics["blue_interceptions"]) == (1.0, 0.0)
    assert (metrics["blue_passes"], metrics["yellow_passes"]) == (0.0, 0.0)
    assert abs(metrics["blue_possession"] + metrics["yellow_possession"] - 1.0) < 1e-6
    assert 0.1 < metrics["yellow_possession"] < 0.9
    assert matches.play.game.possession_steps[0].sum() <= 60


def test_a_pass_is_no_interception() -> None:
    metrics, _ = kicked(blue_1=(1.0, 0.0, np.pi))
    assert (metrics["blue_passes"], metrics["yellow_interceptions"]) == (1.0, 0.0)
    assert metrics["blue_possession"] == 1.0


def test_an_opponent_too_near_intercepts_nothing() -> None:
    metrics, _ = kicked(yellow_0=(-0.6, 0.0, np.pi))
    assert metrics["yellow_possession"] > 0.0
    assert metrics["yellow_interceptions"] == 0.0

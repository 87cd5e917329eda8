"""Kicks are matched with the commands of the robots that were next to the ball."""

import numpy as np
import pytest

from rsoccer import BallModel
from rsoccer.arrays import Array
from rsoccer.identify.ball_fit import BallFit
from rsoccer.identify.ball_runs import runs
from rsoccer.identify.kick_fit import kick_estimates
from rsoccer.identify.log import Commands, Log, Track
from rsoccer.identify.results import Estimate
from tests.identify.test_ball_fit import NOISE, kicks

FLOOR = np.array([3.0, 0.26, 0.0])
SPEEDS = np.array([1.5, 3.0, 4.0, 4.5])
FIRST, BETWEEN = 0.5, 10.0
"""Times of the kicks of `kicks`, s."""
SENT = FIRST + BETWEEN * np.arange(len(SPEEDS)) - 0.1
FAR = (3.0, -2.0)
BEHIND = (-0.1, 0.0)


def robot(place: tuple[float, float]) -> Track:
    """Poses of a robot that stands."""
    times = np.arange(0.0, 45.0, 0.015)
    return Track(times, np.tile(place, (len(times), 1)), 0.0 * times, np.full(len(times), np.nan))


def sent(times: Array, speeds: Array) -> Commands:
    """Kicks that are commanded for a tenth of a second each."""
    moments = np.sort(np.concatenate([[0.0], times, times + 0.1]))
    values = np.zeros(len(moments))
    values[np.searchsorted(moments, times)] = speeds
    return Commands(moments, np.zeros((len(moments), 3)), values)


def found(commands: dict[str, Commands], poses: dict[str, Track]) -> dict[str, Estimate]:
    """Estimates of the log of a ball that is kicked four times."""
    ball = kicks(SPEEDS, FLOOR, 2 / 3, np.random.default_rng(0)).ball
    fit = BallFit(runs(Log(None, {}, {}, ball), NOISE), NOISE, BallModel("ssl_tigers"))
    fit.run()
    assert len(fit.runs) == len(SPEEDS)
    return {each.name: each for each in kick_estimates(Log("omni", commands, poses, ball), fit)}


def test_kicks_are_of_the_robot_next_to_the_ball() -> None:
    commands = {"far": sent(SENT - 0.2, 3.0 * SPEEDS), "near": sent(SENT, SPEEDS)}
    estimates = found(commands, {"far": robot(FAR), "near": robot(BEHIND)})
    assert estimates["kick_gain"].value == pytest.approx(1.0, rel=0.02)
    assert estimates["kick_latency"].value == pytest.approx(0.1, abs=0.01)


def test_kicks_of_nobody_near_identify_nothing() -> None:
    commands = {"far": sent(SENT, SPEEDS)}
    estimates = found(commands, {"far": robot(FAR)})
    assert not any(each.is_identified for each in estimates.values())
    other = found(commands, {"far": robot(FAR), "near": robot(BEHIND)})
    assert not any(each.is_identified for each in other.values())


def test_a_run_of_the_ball_is_one_kick() -> None:
    times = np.sort(np.concatenate([SENT - 0.7, SENT]))
    speeds = np.repeat(SPEEDS, 2) * np.tile([2.0, 1.0], len(SPEEDS))
    estimates = found({"near": sent(times, speeds)}, {"near": robot(BEHIND)})
    assert estimates["kick_gain"].value == pytest.approx(1.0, rel=0.02)
    assert estimates["kick_latency"].value == pytest.approx(0.1, abs=0.01)


def test_kicks_that_differ_too_much_identify_nothing() -> None:
    commands = {"near": sent(SENT[:2], np.array([1.5, 2.0]))}
    estimates = found(commands, {"near": robot(BEHIND)})
    assert not estimates["kick_gain"].is_identified
    assert "differ" in estimates["kick_gain"].hint
    assert estimates["kick_latency"].is_identified


def test_kicks_without_any_latency_are_matched() -> None:
    estimates = found({"near": sent(SENT + 0.1, SPEEDS)}, {"near": robot(BEHIND)})
    latency = estimates["kick_latency"]
    assert 0.0 <= latency.low <= latency.value <= latency.high < 0.02
    assert estimates["kick_gain"].value == pytest.approx(1.0, rel=0.02)

"""Sliding and rolling of balls with known numbers."""

import numpy as np
import pytest

from rsoccer import BallModel
from rsoccer.arrays import Doubles
from rsoccer.identify.ball_fit import BallFit
from rsoccer.identify.ball_runs import runs
from rsoccer.identify.log import Log, Track
from rsoccer.identify.rolling import rolled, slid_and_rolled

NOISE = 0.001
BASE = BallModel("ssl_tigers")


def kicks(speeds: Doubles, floor: Doubles, ratio: float, rng: np.random.Generator) -> Log:
    """Log of a ball that is kicked along lines in several directions, each from rest."""
    times, positions = [], []
    for number, speed in enumerate(speeds.tolist()):
        moment = np.arange(0.0, 2.5, 0.015)
        since = np.maximum(moment - 0.5, 0.0)
        away = slid_and_rolled(floor, speed, ratio * speed, since)
        direction = np.array([np.cos(number), np.sin(number)])
        positions.append(away[:, None] * direction)
        times.append(moment + 10.0 * number)
    points = np.concatenate(positions)
    points = points + rng.normal(0.0, NOISE, points.shape)
    moments = np.concatenate(times)
    empty = np.zeros(len(moments))
    return Log(None, {}, {}, Track(moments, points, empty, np.full(len(moments), np.nan)))


def test_rolling_has_a_closed_form() -> None:
    times, step = np.arange(0.0, 2.0, 1e-4), 1e-4
    speed, distance, way = 2.0, 0.0, []
    for _ in times:
        way.append(distance)
        distance += speed * step
        speed -= (0.2 + 0.05 * speed) * step
    assert rolled(0.2, 0.05, 2.0, times) == pytest.approx(np.array(way), abs=1e-3)
    assert rolled(0.2, 0.0, 2.0, times) == pytest.approx(2.0 * times - 0.1 * times**2)


def test_sliding_and_rolling_are_identified() -> None:
    floor = np.array([3.4, 0.2, 0.04])
    log = kicks(np.array([1.5, 3.0, 4.5, 6.0]), floor, 0.7, np.random.default_rng(0))
    found = runs(log, NOISE)
    assert len(found) == 4
    fit = BallFit(found, NOISE, BASE)
    fit.run()
    values = [each.value for each in fit.estimates(np.random.default_rng(0))]
    assert values == pytest.approx([3.4, 0.7, 0.2, 0.04], rel=0.05)
    kicked = [fit.kick(index) for index in range(4)]
    assert [kick[0] for kick in kicked if kick] == pytest.approx([1.5, 3.0, 4.5, 6.0], rel=0.02)
    starts = [kick[1] for kick in kicked if kick]
    assert starts == pytest.approx([0.5, 10.5, 20.5, 30.5], abs=0.01)


def test_a_drag_that_does_not_stand_out_is_not_reported() -> None:
    floor = np.array([3.0, 0.26, 0.0])
    log = kicks(np.array([1.5, 3.0, 6.0]), floor, 2 / 3, np.random.default_rng(1))
    fit = BallFit(runs(log, NOISE), NOISE, BASE)
    fit.run()
    *_, rolling, drag = fit.estimates(np.random.default_rng(0))
    assert not drag.is_identified
    assert rolling.value == pytest.approx(0.26, rel=0.02)


@pytest.mark.parametrize("rolling", [0.08, 0.37, 0.387, 0.6])
def test_rolling_far_from_the_base_is_found(rolling: float) -> None:
    rng = np.random.default_rng(12)
    times, positions = [], []
    for number, speed in enumerate((0.65, 1.08)):
        moment = np.arange(0.0, min(0.85 * speed / rolling, 2.0), 0.015)
        away = rolled(rolling, 0.0, speed, moment)
        positions.append(np.column_stack([away, 0.5 + 0.0 * away]))
        times.append(moment + 5.0 * number)
    points = np.concatenate(positions)
    points = points + rng.normal(0.0, NOISE, points.shape)
    moments = np.concatenate(times)
    empty = np.zeros(len(moments))
    log = Log(None, {}, {}, Track(moments, points, empty, np.full(len(moments), np.nan)))
    base = BallModel("vss_rsim")
    assert abs(base.rolling_deceleration - rolling) > 0.03
    found = runs(log, NOISE)
    assert len(found) == 2
    fit = BallFit(found, NOISE, base)
    fit.run()
    assert fit.estimates(rng)[2].value == pytest.approx(rolling, rel=0.03)


def test_intervals_of_rolling_hold_the_truth() -> None:
    held, runs_ = 0, 30
    for seed in range(runs_):
        rng = np.random.default_rng(seed)
        floor = np.array([3.0, 0.26, 0.0])
        log = kicks(rng.uniform(1.0, 5.0, 4), floor, 2 / 3, rng)
        fit = BallFit(runs(log, NOISE), NOISE, BASE)
        fit.run()
        estimate = fit.estimates(rng)[2]
        assert estimate.high - estimate.low < 0.1
        held += estimate.low <= 0.26 <= estimate.high
    assert held >= 0.85 * runs_


def test_a_bounce_ends_a_run() -> None:
    log = kicks(np.array([4.0]), np.array([3.0, 0.26, 0.0]), 2 / 3, np.random.default_rng(0))
    positions = log.ball.positions.copy()
    wall = 3.0
    positions[:, 0] = np.where(
        positions[:, 0] > wall, wall - 0.5 * (positions[:, 0] - wall), positions[:, 0]
    )
    ball = Track(log.ball.times, positions, log.ball.headings, log.ball.captured)
    found = runs(Log(None, {}, {}, ball), NOISE)
    assert len(found) == 2
    assert np.isfinite(found[0].rest)
    assert np.isnan(found[1].rest)


def test_without_runs_nothing_is_identified() -> None:
    fit = BallFit([], NOISE, BASE)
    fit.run()
    assert not any(each.is_identified for each in fit.estimates(np.random.default_rng(0)))

from pathlib import Path

import numpy as np
import pytest

from rsoccer._core import BallModel
from rsoccer.arrays import Array
from tools.fit_kicks import (
    MARGIN,
    VENUES,
    fit_rolling,
    fit_sliding,
    fit_to_speeds,
    read,
    rolling_part,
    tracked_pairs,
)
from tools.physics.kick_page import figures, roll
from tools.physics.kicks import rolled, slid_then_rolled
from tools.physics.rolling import Rolling

LAW = Rolling(0.17, 0.06)
SLIDING, RATIO = 3.5, 0.7
FRAME = 0.0145  # s
LAG = 0.05  # s of the tracked speed


def tracked_kick(speed: float, rng: np.random.Generator) -> Array:
    """Return the rows of a kick over 8 m of floor, and of its return from a board there."""
    times = np.arange(0, 40, FRAME)
    way = slid_then_rolled((SLIDING, RATIO, LAW), speed, times - 1.0)
    far = way > 8
    way = way[: int(np.argmax(np.diff(way) < 0)) or len(way)]
    if far.any():
        hit = int(far.argmax())
        back = rolled(LAW, 1.2, times[: len(times) - hit])
        back = back[: int(np.argmax(np.diff(back) < 0)) or len(back)]
        way = np.concatenate([way[:hit], 8 - back])
    way = np.concatenate([way, np.full(60, way[-1])])
    speeds = np.abs(np.gradient(way, FRAME))
    share = FRAME / LAG
    for frame in range(1, len(speeds)):  # the tracker smooths
        speeds[frame] = speeds[frame - 1] + share * (speeds[frame] - speeds[frame - 1])
    positions = np.stack([way, np.zeros_like(way)], axis=1)
    positions += rng.normal(0, 3e-4, positions.shape)
    positions[len(way) // 3 : len(way) // 3 + 5, 0] += 0.03  # another camera
    rows = np.concatenate([1000 * positions, 1000 * speeds[:, None], 0 * speeds[:, None]], axis=1)
    with_gaps: Array = np.zeros((2 * len(rows), 4))  # every other frame has no ball
    with_gaps[::2] = rows
    return with_gaps


def test_a_fit_recovers_the_floor_that_made_the_kicks(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    speeds = (2.0, 3.5, 5.0, 6.0)
    for speed in speeds:
        rows = tracked_kick(speed, rng)
        header = "position_x,position_y,velocity_x,velocity_y"
        np.savetxt(tmp_path / f"{speed}.csv", rows, delimiter=",", header=header, comments="")
    kicks = read(sorted(tmp_path.glob("*.csv")), two_cameras=False)
    assert [kick.bounced is not None for kick in kicks] == [False, True, True, True]
    runs, slides = [], []
    for kick, speed in zip(kicks, speeds, strict=True):
        slide, error = fit_sliding(kick.first, LAW)
        assert error < 0.006
        slides.append(slide / [speed, SLIDING, RATIO, 1.0])
        slid = speed**2 * (1 - RATIO**2) / (2 * SLIDING)
        runs.append(rolling_part(kick.first, slid + MARGIN))
    # A camera's offset within one slide misleads the fit of that kick, not the medians.
    assert np.median(slides, axis=0)[:3] == pytest.approx(1.0, abs=0.03)
    law = fit_rolling([run for run in runs if run is not None])
    for speed in (1.0, 2.5, 4.0):
        expected = LAW.deceleration + LAW.drag * speed
        assert law.deceleration + law.drag * speed == pytest.approx(expected, rel=0.05)


def test_tracked_speeds_recover_the_law_that_made_them(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    for speed in (3.0, 4.0, 5.0):
        header = "position_x,position_y,velocity_x,velocity_y"
        rows = tracked_kick(speed, rng)
        np.savetxt(tmp_path / f"{speed}.csv", rows, delimiter=",", header=header, comments="")
    kicks = read(sorted(tmp_path.glob("*.csv")), two_cameras=False)
    pairs = [tracked_pairs(kick, 3.5) for kick in kicks]
    assert all(pairs)
    law = fit_to_speeds(pairs)
    for speed in (1.5, 2.5):
        expected = LAW.deceleration + LAW.drag * speed
        assert law.deceleration + law.drag * speed == pytest.approx(expected, rel=0.06)


def test_the_presets_have_the_numbers_of_the_fit() -> None:
    assert set(figures()) == set(VENUES.values())
    for name, venue in figures().items():
        ball = BallModel(name)
        for number in (
            "sliding_deceleration",
            "slide_to_roll_ratio",
            "rolling_deceleration",
            "rolling_drag",
        ):
            assert getattr(ball, number) == pytest.approx(venue[number], rel=1e-3)


def test_measured_rolls_are_simulated_within_a_few_percent() -> None:
    for name, venue in figures().items():
        for kick in venue["kicks"]:
            for run in kick["speeds"]:
                distance, speed = np.array(run).T
                away, simulated = roll(name, float(speed[:3].mean()), float(distance[-1]))
                at = min(3.0, float(away[-1])) * 0.8
                measured = np.interp(at, distance - distance[:3].mean(), speed)
                error = np.interp(at, away, simulated) - measured
                assert abs(error) < 0.1 * speed[0]

"""Windows of logs: which are left out, and what they hold."""

import numpy as np
import pytest

from rsoccer.arrays import Doubles
from rsoccer.identify.log import Commands, Log, Track
from rsoccer.identify.simulation import TICK
from rsoccer.identify.windows import LENGTH, cut

TIMES = np.arange(0.0, 10.0, 0.015)


def track(x: Doubles) -> Track:
    """Poses of a body that moves along x."""
    none = np.zeros(len(TIMES))
    return Track(TIMES, np.column_stack([x, none]), none, np.full(len(TIMES), np.nan))


def log(x: Doubles | None = None, **others: Track) -> Log:
    """Log of a robot that drives at 0.5 m/s since 0.2 s."""
    sent = np.array([[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]])
    commands = {"a": Commands(np.array([0.0, 0.2]), sent, np.zeros(2))}
    own = track(np.maximum(TIMES - 0.2, 0.0) * 0.5 if x is None else x)
    ball = others.pop("ball", track(0.0 * TIMES + 9.0))
    return Log("omni", commands, {"a": own, **others}, ball)


def test_windows_hold_poses_and_the_commands_before_them() -> None:
    windows = cut(log(), 0.0, heavy=True)
    assert len(windows) == 10
    assert windows.seen.sum() == len(TIMES)
    assert np.allclose(windows.velocities[3:], [0.5, 0.0, 0.0], atol=1e-6)
    # The change of the command begins a tick.
    first = windows.commands[:, 0, 0]
    change = int(np.flatnonzero(np.diff(first))[0]) + 1
    start = windows.times[0, 0] * TICK
    assert change * TICK - start == pytest.approx(0.2, abs=1e-9)
    assert windows.take(np.arange(10) < 4).times.shape[1] == 4


def test_robots_that_were_carried_or_unseen_are_left_out() -> None:
    x = np.maximum(TIMES - 0.2, 0.0) * 0.5
    carried = log(np.where(TIMES > 5.5, x + 2.0, x))
    assert 6 <= len(cut(carried, 0.0, heavy=True)) <= 8
    whole = log()
    seen = (whole.poses["a"].times < 5.1) | (whole.poses["a"].times > 5.6)
    own = whole.poses["a"]
    part = Track(own.times[seen], own.positions[seen], own.headings[seen], own.captured[seen])
    gap = Log("omni", whole.commands, {"a": part}, whole.ball)
    assert 6 <= len(cut(gap, 0.0, heavy=True)) <= 8


def test_robots_that_may_be_pushed_are_left_out() -> None:
    other = track(0.0 * TIMES + 2.5)
    assert len(cut(log(b=other), 0.0, heavy=True)) < 9
    assert len(cut(log(ball=other), 0.0, heavy=True)) == 10
    assert len(cut(log(ball=other), 0.0, heavy=False)) < 9


def test_a_log_without_windows_is_refused() -> None:
    with pytest.raises(ValueError, match="no window of 1 s"):
        cut(Log("omni", {}, {"a": track(TIMES)}, track(TIMES)), 0.0, heavy=True)
    assert LENGTH == 1.0

"""Clocks without a wall."""

from __future__ import annotations

import math

import pytest

from rsoccer.bridge.clocks import MAX_LAG, ScaledClock
from rsoccer.bridge.match_tasks import TICK


def run(clock: ScaledClock, now: float) -> int:
    """Play what is due and return the number of ticks."""
    due = clock.due(now)
    for _ in range(due):
        clock.step()
    return due


@pytest.mark.parametrize("speed", [0.5, 1.0, 4.0])
def test_ticks_keep_pace_with_the_wall(speed: float) -> None:
    clock = ScaledClock(speed)
    ticks = sum(run(clock, 50.0 + 0.0007 * turn) for turn in range(10_000))
    assert ticks == pytest.approx(0.0007 * 9_999 * speed / TICK, abs=1)
    assert clock.skipped == 0.0


def test_the_next_tick_is_known() -> None:
    clock = ScaledClock(2.0)
    run(clock, 10.0)
    due = clock.next_due(10.0)
    assert due == pytest.approx(10.0 + TICK / 2)
    assert run(clock, due - 1e-4) == 0
    assert run(clock, due + 1e-6) == 1
    clock.set_speed(0.0, 20.0)
    assert clock.next_due(20.0) == math.inf
    run(clock, 20.0)
    assert run(clock, 30.0) == 0


def test_jumps_are_skipped() -> None:
    clock = ScaledClock()
    run(clock, 10.0)
    assert run(clock, 10.0 + 0.9 * MAX_LAG) > 1, "a lag is made up for"
    assert run(clock, 1000.0) == 1
    assert clock.skipped > 900
    assert run(clock, 10.0) == 0
    assert run(clock, 10.0 + 4.5 * TICK) == 4


@pytest.mark.parametrize("speed", [-1.0, math.nan, math.inf])
def test_a_speed_is_a_number_above_0(speed: float) -> None:
    with pytest.raises(ValueError, match="speed: expected 0 or above"):
        ScaledClock(speed)
    with pytest.raises(ValueError, match="speed: expected 0 or above"):
        ScaledClock().set_speed(speed, 0.0)


def test_what_a_faster_clock_owed_is_neither_played_nor_skipped() -> None:
    clock = ScaledClock(1000.0)
    run(clock, 10.0)
    clock.due(10.1)  # 100 s of play
    clock.set_speed(1.0, 10.1)
    assert run(clock, 10.1) == int(MAX_LAG / TICK)
    assert clock.skipped == 0.0

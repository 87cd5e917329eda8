"""Time from the stamps of vision."""

from __future__ import annotations

import pytest

from rsoccer.drive.vision_clock import CONFIRMED, FRAME, VisionClock

UNIX = 1.7e9


def times(clock: VisionClock, *stamps: float) -> list[float | None]:
    """Times of frames in microseconds' precision; None for those of no use."""
    found = [clock.at(stamp) for stamp in stamps]
    return [None if each is None else round(each[0], 6) for each in found]


def test_time_is_that_of_the_stamps_since_the_first() -> None:
    clock = VisionClock()
    stamps = [UNIX + 0.25 * frame for frame in range(5)]
    assert times(clock, *stamps) == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert clock.jumps == 0


def test_frames_that_are_late_on_their_way_are_of_no_use() -> None:
    clock = VisionClock()
    stamps = [UNIX, UNIX + 0.03125, UNIX + 0.015625, UNIX + 0.0625]
    assert times(clock, *stamps) == [0.0, 0.03125, None, 0.0625]
    assert clock.older == 1


def test_frames_of_other_cameras_may_be_a_little_late() -> None:
    clock = VisionClock()
    found = []
    for frame in range(3):
        time = UNIX + 0.015625 * frame
        found += [clock.at(time, 0), clock.at(time - 0.00390625, 1)]
    assert found == [(0.015625 * (k // 2), False) for k in range(6)]
    assert clock.at(UNIX, 1) is None
    assert (clock.older, clock.jumps) == (1, 0)


@pytest.mark.parametrize("jump", [3600.0, -3600.0, 1e9, -UNIX])
def test_a_jump_is_believed_once_others_confirm_it(jump: float) -> None:
    clock = VisionClock()
    clock.at(UNIX)
    stamps = [UNIX + jump + 0.015625 * frame for frame in range(CONFIRMED + 1)]
    found = [clock.at(stamp) for stamp in stamps]
    assert found[: CONFIRMED - 1] == [None] * (CONFIRMED - 1)
    assert found[CONFIRMED - 1] == (FRAME, True)
    assert found[CONFIRMED] == (FRAME + 0.015625, False)
    assert clock.jumps == 1


def test_a_single_wrong_stamp_changes_nothing() -> None:
    clock = VisionClock()
    clock.at(UNIX)
    for frame in range(1, 20):
        time = 0.015625 * frame
        assert times(clock, 5.0 * frame, UNIX + time) == [None, round(time, 6)]
    assert clock.jumps == 0

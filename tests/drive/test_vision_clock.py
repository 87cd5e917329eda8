"""Time from the stamps of vision."""

from __future__ import annotations

import pytest

from rsoccer.drive.vision_clock import CONFIRMED, FRAME, VisionClock

UNIX = 1.7e9


def test_time_is_that_of_the_stamps_since_the_first() -> None:
    clock = VisionClock()
    found = [clock.at(UNIX + 0.016 * frame) for frame in range(5)]
    assert found[0] == (0.0, False)
    assert [time for time, _ in found if found] == pytest.approx(
        [0.016 * f for f in range(5)], abs=1e-6
    )
    assert clock.jumps == 0


def test_frames_of_other_cameras_may_be_a_little_late() -> None:
    clock = VisionClock()
    assert clock.at(UNIX) is not None
    assert clock.at(UNIX + 0.02) is not None
    assert clock.at(UNIX + 0.01) is None
    assert clock.at(UNIX + 0.03) == (pytest.approx(0.03, abs=1e-6), False)


@pytest.mark.parametrize("jump", [3600.0, -3600.0, 1e9, -UNIX])
def test_a_jump_is_believed_once_others_confirm_it(jump: float) -> None:
    clock = VisionClock()
    clock.at(UNIX)
    found = [clock.at(UNIX + jump + 0.016 * frame) for frame in range(CONFIRMED + 1)]
    assert found[: CONFIRMED - 1] == [None] * (CONFIRMED - 1)
    assert found[CONFIRMED - 1] == (FRAME, True)
    assert found[CONFIRMED] == (pytest.approx(FRAME + 0.016, abs=1e-6), False)
    assert clock.jumps == 1


def test_a_single_wrong_stamp_changes_nothing() -> None:
    clock = VisionClock()
    clock.at(UNIX)
    for frame in range(1, 20):
        assert clock.at(5.0 * frame) is None
        assert clock.at(UNIX + 0.016 * frame) == (pytest.approx(0.016 * frame, abs=1e-6), False)
    assert clock.jumps == 0

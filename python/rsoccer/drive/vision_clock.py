"""An even clock from the time stamps of vision, which may jump."""

from __future__ import annotations

from typing import Final

MAX_STEP: Final = 0.5
"""Longest time between two frames by their stamps, s: more is a jump of the sender's clock, or a
time without vision after which estimates are of no use."""
MAX_DISORDER: Final = 0.05
"""Time by which a frame may be older than the last one, s. One of another camera counts, as cameras
expose one after the other; one of the same camera was late on its way and is ignored."""
CONFIRMED: Final = 3
"""Frames in a row with stamps of another time after which it is believed."""
FRAME: Final = 1 / 60
"""Time that passes in a jump, s: none is known, and time goes on."""


class VisionClock:
    """Time that never goes back.

    Attributes:
        now: time of the newest frame since the first one, s.
        jumps: jumps of the stamps that were believed.
        older: frames that were of no use because they were older than the last one of their camera.
    """

    def __init__(self) -> None:
        """Begin before the first frame."""
        self.now = 0.0
        self.jumps = self.older = 0
        self._last: float | None = None
        self._of: dict[int, float] = {}
        self._other: float | None = None
        self._others = 0

    def at(self, stamp: float, camera: int = 0) -> tuple[float, bool] | None:
        """Return the time of a frame, and whether its stamp has jumped.

        Args:
            stamp: time stamp of the frame, s; finite.
            camera: number of the camera.

        Returns:
            The time, which is `now` for a frame older than the last one of another camera. None for
            a frame that is of no use: older than the last one of its camera, or with a stamp of
            another time that no other frame confirms.
        """
        if self._last is None:
            self._last = self._of[camera] = stamp
            return self.now, False
        step = stamp - self._last
        if 0.0 <= step <= MAX_STEP:
            self._others, self._other = 0, None
            self._last = self._of[camera] = stamp
            self.now += step
            return self.now, False
        if -MAX_DISORDER <= step < 0.0:
            if stamp < self._of.get(camera, stamp):
                self.older += 1
                return None
            self._of[camera] = stamp
            return self.now, False
        if self._other is None or abs(stamp - self._other) > MAX_STEP:
            self._others = 0
        self._other = stamp
        self._others += 1
        if self._others < CONFIRMED:
            return None
        self._others, self._other = 0, None
        self._last, self._of = stamp, {camera: stamp}
        self.now += FRAME
        self.jumps += 1
        return self.now, True

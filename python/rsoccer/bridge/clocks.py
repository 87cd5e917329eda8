"""Clocks of a simulation that is served: how many ticks are due."""

from __future__ import annotations

import math
from typing import Final

from rsoccer.bridge.match_tasks import TICK

MAX_LAG: Final = 0.25
"""Time by which a simulation may lag behind its clock, s. More is skipped: after a machine
has slept, or a clock was set, the match goes on at its speed and does not race."""
_ROUNDING: Final = 1e-9


class ScaledClock:
    """The time of a wall, times a speed.

    Attributes:
        speed: simulated seconds in a second; 0 to stand still.
        skipped: time that was skipped because the simulation lagged or the clock jumped, s.
    """

    def __init__(self, speed: float = 1.0) -> None:
        """Begin at the first call of `due`.

        Args:
            speed: simulated seconds in a second, 0 or above.

        Raises:
            ValueError: a speed that is negative or not finite.
        """
        self.speed = _checked(speed)
        self.skipped = 0.0
        self._last: float | None = None
        self._debt = 0.0  # simulated time that is due, s

    def set_speed(self, speed: float, now: float) -> None:
        """Go on at another speed.

        Args:
            speed: simulated seconds in a second, 0 or above.
            now: time on the wall, s.

        Raises:
            ValueError: a speed that is negative or not finite.
        """
        _checked(speed)
        self._pass_time(now)
        self.speed = speed
        self._debt = min(self._debt, self._most)  # what a faster clock may owe is dropped

    def due(self, now: float) -> int:
        """Return the ticks that are due.

        Args:
            now: time on the wall, s. It may jump: back, or far ahead.
        """
        self._pass_time(now)
        return max(0, math.floor(self._debt / TICK + _ROUNDING))

    def step(self) -> None:
        """Take note of a tick."""
        self._debt -= TICK

    def next_due(self, now: float) -> float:
        """Return the time on the wall of the next tick; infinite if time stands still.

        Args:
            now: time on the wall, s.
        """
        if self.speed == 0.0:
            return math.inf
        return now + max(0.0, TICK - self._debt) / self.speed

    def _pass_time(self, now: float) -> None:
        last = now if self._last is None else self._last
        self._last = now
        self._debt += max(0.0, now - last) * self.speed
        if self._debt > self._most:
            self.skipped += self._debt - TICK
            self._debt = TICK

    @property
    def _most(self) -> float:
        """Greatest debt, s: slow computers would gather more and more.

        A fast clock may owe what it makes in that time.
        """
        return max(TICK, MAX_LAG * max(self.speed, 1.0))


def _checked(speed: float) -> float:
    if not 0.0 <= speed < math.inf:
        raise ValueError(f"speed: expected 0 or above, got {speed}")
    return speed

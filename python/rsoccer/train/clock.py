"""Time of a run by part: physics, matches, opponents, acting, learning."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from rsoccer.simulator_interface import Stepper


class Clock:
    """Stopwatch that sums the seconds spent in each named part.

    Attributes:
        seconds: seconds by part since the last `take`.
    """

    def __init__(self) -> None:
        """Start with no parts."""
        self.seconds: dict[str, float] = {}
        self._started = time.perf_counter()

    @contextmanager
    def measure(self, part: str) -> Iterator[None]:
        """Return a context manager that adds the time of its block to a part.

        Args:
            part: name of the part; the time of a part nested in another counts in both.
        """
        started = time.perf_counter()
        try:
            yield
        finally:
            elapsed = time.perf_counter() - started
            self.seconds[part] = self.seconds.get(part, 0.0) + elapsed

    def take(self) -> tuple[float, dict[str, float]]:
        """Return the seconds since the last call and each part's share of them; start again.

        Returns:
            Seconds since the last call, and the share of each part, 0 to 1, by name.
        """
        now = time.perf_counter()
        total, seconds = now - self._started, self.seconds
        self._started, self.seconds = now, {}
        return total, {part: elapsed / total for part, elapsed in seconds.items()}


METHODS: Final = (
    "place",
    "restart",
    "reposition_balls",
    "step",
    "sense",
    "begin_senses",
    "read",
    "close",
    "snapshot",
    "restore",
)
"""Methods of a simulator whose time counts, those of them that it has."""


class TimedSimulator:
    """A simulator whose time is measured as "physics"; what it cannot do, this cannot either."""

    place: Callable[..., Any]
    restart: Callable[..., Any]
    reposition_balls: Callable[..., Any]
    step: Callable[..., Any]

    def __init__(self, simulator: Stepper, clock: Clock) -> None:
        """Wrap the methods of a simulator.

        Args:
            simulator: moves the robots.
            clock: measures the time of its methods.
        """
        self.__wrapped__ = simulator
        for name in METHODS:
            if (method := getattr(simulator, name, None)) is not None:
                setattr(self, name, _timed(method, clock))


def _timed(method: Callable[..., Any], clock: Clock) -> Callable[..., Any]:
    """The method, with its time measured as "physics"."""

    def call(*arguments: Any, **named: Any) -> Any:  # noqa: ANN401  (those of the method)
        with clock.measure("physics"):
            return method(*arguments, **named)

    return call

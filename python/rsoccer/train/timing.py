"""Where the time of a run goes: physics, task code, opponents, choosing actions, learning."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rsoccer._core import SimConfig, Simulator
from rsoccer.frame import Floats, Mask


class Clock:
    """Seconds spent in each named part since the last `take`."""

    def __init__(self) -> None:
        """Start with nothing measured."""
        self.seconds: dict[str, float] = {}
        self._started = time.perf_counter()

    @contextmanager
    def measure(self, part: str) -> Iterator[None]:
        """Add the time of the block to a part; a part inside another counts in both."""
        started = time.perf_counter()
        try:
            yield
        finally:
            spent = time.perf_counter() - started
            self.seconds[part] = self.seconds.get(part, 0.0) + spent

    def take(self) -> tuple[float, dict[str, float]]:
        """Seconds since the last call, and the share of them in each part; starts afresh."""
        now = time.perf_counter()
        total, seconds = now - self._started, self.seconds
        self._started, self.seconds = now, {}
        return total, {part: spent / total for part, spent in seconds.items()}


class TimedSimulator:
    """The simulator that `Matches` would make, with its time counted as physics."""

    def __init__(self, config: SimConfig, worlds: int, threads: int, clock: Clock) -> None:
        """Wrap a fresh simulator."""
        self._simulator = Simulator(config, worlds=worlds, threads=threads)
        self._clock = clock
        self.config, self.worlds, self.threads = config, worlds, threads

    def place(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        """Start some worlds from the given rows."""
        with self._clock.measure("physics"):
            self._simulator.place(worlds, rows, out)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
        """Put the balls of some worlds elsewhere."""
        with self._clock.measure("physics"):
            self._simulator.reposition_balls(worlds, balls, out)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        """One control step of every active world."""
        with self._clock.measure("physics"):
            self._simulator.step(commands, out, active)

    def read(self, out: Floats) -> None:
        """Write the worlds' present rows."""
        self._simulator.read(out)

    def snapshot(self) -> bytes:
        """All worlds, exactly."""
        return self._simulator.snapshot()

    def restore(self, snapshot: bytes) -> None:
        """Go back to a snapshot."""
        self._simulator.restore(snapshot)

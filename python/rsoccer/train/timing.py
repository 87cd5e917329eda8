"""Time of a run by part: physics, matches, opponents, acting, learning."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rsoccer._core import SimConfig, Simulator
from rsoccer.arrays import Floats, Mask


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


class TimedSimulator:
    """The simulator that `Matches` creates by default, with its time measured as "physics".

    Attributes:
        config: the simulated robots, ball and field.
        worlds: number of worlds.
        threads: number of threads.
    """

    def __init__(self, config: SimConfig, worlds: int, threads: int, clock: Clock) -> None:
        """Create the simulator.

        Args:
            config: robots, ball and field to simulate.
            worlds: number of worlds n.
            threads: number of threads.
            clock: measures the time of its methods.
        """
        self._simulator = Simulator(config, worlds=worlds, threads=threads)
        self._clock = clock
        self.config, self.worlds, self.threads = config, worlds, threads

    def place(self, worlds: Mask, rows: Floats, out: Floats, params: Floats | None = None) -> None:
        """Start some worlds from given states.

        Args:
            worlds: (n,) mask of the k worlds to start.
            rows: (k, row) states of these worlds.
            out: (n, row) their rows are written.
            params: (k, parameters) factors on the models' numbers in these worlds.
        """
        with self._clock.measure("physics"):
            self._simulator.place(worlds, rows, out, params)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        """Restart play in some worlds.

        Args:
            worlds: (n,) mask of the k worlds.
            rows: (k, row) new states of these worlds.
            out: (n, row) their rows are written.
        """
        with self._clock.measure("physics"):
            self._simulator.restart(worlds, rows, out)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
        """Move the balls of some worlds; robots are not changed.

        Args:
            worlds: (n,) mask of the k worlds.
            balls: (k, ball column) new states of the balls.
            out: (n, row) the rows of these worlds are written.
        """
        with self._clock.measure("physics"):
            self._simulator.reposition_balls(worlds, balls, out)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        """Simulate one control step of every active world.

        Args:
            commands: (n, robots, command) commands of the robots.
            out: (n, row) the rows of active worlds are written.
            active: (n,) mask of the worlds to step; all by default.
        """
        with self._clock.measure("physics"):
            self._simulator.step(commands, out, active)

    def snapshot(self) -> bytes:
        """Return the exact state of all worlds."""
        return self._simulator.snapshot()

    def restore(self, snapshot: bytes) -> None:
        """Restore the state of all worlds.

        Args:
            snapshot: bytes from `snapshot`.
        """
        self._simulator.restore(snapshot)

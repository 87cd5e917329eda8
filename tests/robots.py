"""Robots that cannot be placed, in the place of a simulator."""

import numpy as np

from rsoccer import SimConfig, Simulator, Task, WorldRng
from rsoccer.arrays import Doubles, Floats, Mask


class Robots:
    """Robots that cannot be placed, with a clock and a position of their own."""

    def __init__(self, config: SimConfig, worlds: int = 1, stamps: bool = True) -> None:
        self._simulator, self._stamps = Simulator(config, worlds), stamps
        self.clock, self.closed = np.full(worlds, 7.0), 0

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        self._simulator.step(commands, out, active)
        self.clock += 0.03 if active is None else np.where(active, 0.03, 0.0)
        return self.clock if self._stamps else None

    def read(self, out: Floats) -> Doubles | None:
        self._simulator.read(out)
        return self.clock if self._stamps else None

    def snapshot(self) -> bytes:
        return self._simulator.snapshot()

    def restore(self, snapshot: bytes) -> None:
        self._simulator.restore(snapshot)

    def close(self) -> None:
        self.closed += 1


def robots_of(task: Task, worlds: int = 1, stamps: bool = True) -> Robots:
    """Robots that stand where an episode of the task begins."""
    robots = Robots(task.config, worlds, stamps)
    rows = task.get_initial_positions_frame(WorldRng.seeded(5, worlds)).rows
    robots._simulator.place(np.ones(worlds, np.bool_), rows, np.empty_like(rows))
    return robots

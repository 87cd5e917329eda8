"""Simulators and sensor models of one's own, as a user names them: tests.simulators:still."""

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from rsoccer import SimConfig, Simulator
from rsoccer._core import Threads
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng


class Still:
    """The package's simulator with robots that have no power: only the ball moves."""

    def __init__(self, config: SimConfig, worlds: int, threads: Threads) -> None:
        own = self._own = Simulator(config, worlds, threads)
        self.place, self.restart, self.reposition_balls = (
            own.place,
            own.restart,
            own.reposition_balls,
        )
        self.snapshot, self.restore = own.snapshot, own.restore

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._own.step(np.zeros_like(commands), out, active)


def still(config: SimConfig, worlds: int, threads: Threads) -> Still:
    return Still(config, worlds, threads)


class Elsewhere:
    """A simulator that cannot be saved, as one on a network.

    Attributes:
        left: steps until it answers no more, of all of them.
        error: what it raises then.
        starts: rows of the first matches that were put, of all of them.
    """

    left: ClassVar[float] = math.inf
    error: ClassVar[Exception] = ConnectionError("nobody answers")
    starts: ClassVar[list[bytes]] = []

    def __init__(self, config: SimConfig, worlds: int, threads: Threads) -> None:
        self._own = Simulator(config, worlds, threads)
        self.restart, self.reposition_balls = self._own.restart, self._own.reposition_balls

    def place(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        if Elsewhere.left < 0:
            raise Elsewhere.error
        Elsewhere.starts.append(rows[0].tobytes())
        self._own.place(worlds, rows, out)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        Elsewhere.left -= 1
        if Elsewhere.left < 0:
            raise Elsewhere.error
        self._own.step(commands, out, active)


class OneMatch(Elsewhere):
    """One that plays one match at a time."""

    plays_one_match = True

    def __init__(self, config: SimConfig, worlds: int, threads: Threads) -> None:
        assert worlds == 1, worlds
        super().__init__(config, worlds, threads)


class Blind:
    """Robots sense the ball in the middle of the field, at rest."""

    def columns(self, n: int) -> dict[str, Array]:
        return {}

    def begin(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        sensed.ball.position[:] = 0.0
        sensed.ball.velocity[:] = 0.0

    def sense(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        sensed.rows[:] = frame.rows
        self.begin(frame, sensed, state, rng)


BLIND = Blind()
NOTHING = None

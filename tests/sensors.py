"""A sensor model for tests: a frame late, with noise, and a count of its calls."""

from collections.abc import Mapping

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng


class LateAndNoisy:
    """Robots sense the state before the last step, with noise on all positions."""

    def __init__(self, row_size: int, noise: float = 0.02) -> None:
        self._row_size, self._noise = row_size, noise

    def columns(self, n: int) -> dict[str, Array]:
        return {
            "before": np.zeros((n, self._row_size), np.float32),
            "calls": np.zeros(n, np.int64),
        }

    def begin(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        state["before"][:] = frame.rows
        self._add_noise(sensed, rng)

    def sense(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        sensed.rows[:] = state["before"]
        state["before"][:] = frame.rows
        state["calls"][:] += 1
        self._add_noise(sensed, rng)

    def _add_noise(self, sensed: Frame, rng: WorldRng) -> None:
        robots = sensed.robots.position
        robots += rng.uniform(-self._noise, self._noise, robots.shape[1:])
        sensed.ball.position[:] += rng.uniform(-self._noise, self._noise, (2,))

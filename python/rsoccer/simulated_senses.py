"""Senses that the simulator computes: cameras, delays, losses, tracker; see `rsoccer.Sensing`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.randomization import NumberRanges
from rsoccer.rng import WorldRng
from rsoccer.senses import Senses
from rsoccer.simulator_interface import Stepper


class SensingStepper(Protocol):
    """A stepper with senses of its own, as its `config.sensing` has them."""

    def begin_senses(
        self, worlds: Mask, keys: NDArray[np.uint64], numbers: Floats | None = None
    ) -> None:
        """Begin the senses of some worlds, which have just been placed.

        Args:
            worlds: (n,) bool, k of them True.
            keys: (k,) keys of the random numbers of these worlds.
            numbers: (k, numbers) values of all numbers of `Sensing`; those of the configuration if
                None.
        """

    def sense(self, out: Floats, active: Mask | None = None) -> None:
        """Write what the robots know.

        Args:
            out: (n, row) output; the rows of the active worlds are overwritten.
            active: (n,) bool, worlds to write; all if None.
        """


def sensing_stepper(stepper: Stepper) -> SensingStepper:
    """Return a stepper after a check that it has senses.

    Args:
        stepper: the stepper.

    Raises:
        TypeError: it has no `sense` or no `begin_senses`.
    """
    if not all(callable(getattr(stepper, name, None)) for name in ("sense", "begin_senses")):
        raise TypeError(
            f"sensing: {type(stepper).__name__} has no senses (sense, begin_senses), as "
            "rsoccer.Simulator has; expected None or a rsoccer.senses.SensorModel"
        )
    found: SensingStepper = stepper  # type: ignore[assignment]  # checked by its methods
    return found


@dataclass
class SimulatedSenses(Senses):
    """Senses of n worlds of a simulator, whose own state they are."""

    stepper: SensingStepper
    """The simulator."""
    total: int
    """Number of its worlds."""
    ranges: NumberRanges | None
    """Ranges of numbers that each episode draws; None if all are those of the configuration."""
    frame: Frame
    rng: WorldRng

    def begin(self, frame: Frame, worlds: NDArray[np.intp]) -> None:
        """Sense the initial state of all n episodes; see `Senses.begin`."""
        mask = np.zeros(self.total, np.bool_)
        mask[worlds] = True
        words = self.rng.integers(2**32, (2,)).astype(np.uint64)
        keys = (words[:, 0] << np.uint64(32)) | words[:, 1]
        numbers = None if self.ranges is None else self.ranges.draw(self.rng)
        self.stepper.begin_senses(mask, keys, numbers)
        rows = np.empty((self.total, frame.rows.shape[1]), np.float32)
        self.stepper.sense(rows, mask)
        self.frame.rows[:] = rows[worlds]

    def sense(self, frame: Frame) -> None:
        """Sense the state after a step; see `Senses.sense`."""
        self.stepper.sense(self.frame.rows)

    def take(self, worlds: NDArray[np.intp]) -> SimulatedSenses:
        """Return a copy of some worlds; see `Senses.take`."""
        frame, rng = self.frame.take(worlds), self.rng[worlds]
        return SimulatedSenses(self.stepper, self.total, self.ranges, frame, rng)

"""Senses that the simulator computes: cameras, delays, losses, tracker; see `rsoccer.Sensing`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.randomization import NumberRanges
from rsoccer.rng import WorldRng
from rsoccer.senses import Senses
from rsoccer.simulator_interface import Stepper
from rsoccer.view import SIDES


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

    def sense(self, out: Floats, active: Mask | None = None, known: str | None = "blue") -> None:
        """Write what the robots know.

        Args:
            out: (n, row) output; the rows of the active worlds are overwritten.
            active: (n,) bool, worlds to write; all if None.
            known: team that knows it, "blue" or "yellow", by its own commands on their way if it
                forecasts, and by its own cameras; None for no forecast. Without `forecast` and
                `own_cameras` all know the same, and it is not given.
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
    observing: tuple[int, ...] | None
    """Teams with forecasts or cameras of their own, 0 for blue and 1 for yellow; the others know
    what is sensed. None if all robots know the same."""
    frame: Frame
    rng: WorldRng
    teams: tuple[Frame, Frame] | None = None

    @classmethod
    def new(
        cls,
        stepper: SensingStepper,
        total: int,
        ranges: NumberRanges | None,
        observing: tuple[int, ...] | None,
        frame: Frame,
        rng: WorldRng,
    ) -> SimulatedSenses:
        """Return the senses of n worlds before their episodes begin.

        Args:
            stepper: the simulator.
            total: number of its worlds.
            ranges: ranges of numbers that each episode draws.
            observing: teams with forecasts or cameras of their own; None if all robots know the
                same.
            frame: frame of n worlds; copied.
            rng: (n,) random streams.
        """
        is_divided = bool(observing) and frame.n_blue > 0 < frame.n_yellow
        teams = (frame.copy(), frame.copy()) if is_divided else None
        return cls(stepper, total, ranges, observing, frame.copy(), rng, teams)

    def begin(self, frame: Frame, worlds: NDArray[np.intp]) -> None:
        """Sense the initial state of all n episodes; see `Senses.begin`."""
        mask = np.zeros(self.total, np.bool_)
        mask[worlds] = True
        words = self.rng.integers(2**32, (2,)).astype(np.uint64)
        keys = (words[:, 0] << np.uint64(32)) | words[:, 1]
        numbers = None if self.ranges is None else self.ranges.draw(self.rng)
        self.stepper.begin_senses(mask, keys, numbers)
        rows = np.empty((self.total, frame.rows.shape[1]), np.float32)
        for team, known in self._known:
            self.stepper.sense(rows, mask, *team)
            known.rows[:] = rows[worlds]
        self._join()

    def sense(self, frame: Frame, active: Mask | None = None) -> None:
        """Sense the state after a step; see `Senses.sense`."""
        for team, known in self._known:
            self.stepper.sense(known.rows, active, *team)
        self._join()

    @property
    def own_rows(self) -> Floats | None:
        """(n, row) rows of `frame`, if all robots know the same; see `Senses.own_rows`."""
        return self.frame.rows if self.observing is None else None

    def take(self, worlds: NDArray[np.intp]) -> SimulatedSenses:
        """Return a copy of some worlds; see `Senses.take`."""
        frame, rng, teams = self.frame.take(worlds), self.rng[worlds], None
        if self.teams is not None:
            teams = self.teams[0].take(worlds), self.teams[1].take(worlds)
        part = (self.stepper, self.total, self.ranges, self.observing)
        return SimulatedSenses(*part, frame, rng, teams)

    @cached_property
    def _known(self) -> tuple[tuple[tuple[str | None, ...], Frame], ...]:
        """Arguments `known` of `SensingStepper.sense`, () for its default, and frames for them.

        Frames are written and never replaced, so they stay those of the first call.
        """
        if self.observing is None:
            return (((), self.frame),)
        if self.teams is None:
            return (((SIDES[self.observing[0]] if self.observing else None,), self.frame),)
        names = (SIDES[team] if team in self.observing else None for team in (0, 1))
        return tuple(((name,), known) for name, known in zip(names, self.teams, strict=True))

    def _join(self) -> None:
        """Put together what both teams know: each robot as its own team knows it."""
        if self.teams is not None:
            blue, yellow = self.teams
            self.frame.rows[:] = blue.rows
            self.frame.yellow.data[:] = yellow.yellow.data

"""The place of sensor models: between the true state and what robots know of it.

`Matches` calls the model once in each step, after the restarts of play. Observations, policies and
`Task.get_commands` then read `Play.sensed`; rewards, ends, metrics, rules and pictures read the
truth. Without a model both are the same arrays, and nothing is called.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.view import SIDES


class SensorModel(Protocol):
    """Model of what robots know of the true state of n worlds, for all robots alike.

    A model keeps its state of a match in the arrays that it is given, never on itself, and draws
    only from the random streams that it is given.
    """

    def columns(self, n: int) -> dict[str, Array]:
        """Create the model's state at the start of episodes.

        Args:
            n: number of worlds.

        Returns:
            Arrays (n, ...) by name.
        """

    def begin(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        """Sense the initial state of episodes.

        Args:
            frame: true state of k worlds, to be read only.
            sensed: state of k worlds as the robots know it; equal to `frame`, changed in place.
            state: arrays (k, ...) of `columns`, changed in place.
            rng: (k,) random streams.
        """

    def sense(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        """Sense the state after a step.

        Args:
            frame: true state of n worlds, to be read only.
            sensed: state of n worlds as the robots knew it before; overwritten.
            state: arrays (n, ...) of `columns`, changed in place.
            rng: (n,) random streams.
        """


class Senses(ABC):
    """The state that the robots of n worlds know."""

    frame: Frame
    """(n, ...) state as the robots know it. Where teams know different things, each robot is as its
    own team knows it, and the ball as blue does."""
    rng: WorldRng
    """(n,) random streams."""
    teams: tuple[Frame, Frame] | None = None
    """(n, ...) state as blue and as yellow know it; None if both know `frame`."""

    def known_to(self, team: int) -> Frame:
        """Return (n, ...) the state as a team knows it.

        Args:
            team: 0 for blue, 1 for yellow.
        """
        return self.frame if self.teams is None else self.teams[team]

    @abstractmethod
    def begin(self, frame: Frame, worlds: NDArray[np.intp]) -> None:
        """Sense the initial state of all n episodes.

        Args:
            frame: true state.
            worlds: (n,) indices of the worlds in the simulator.
        """

    @property
    def own_rows(self) -> Floats | None:
        """(n, row) rows of `frame` if `rsoccer.Simulator.step` can write them, or None."""
        return None

    @abstractmethod
    def sense(self, frame: Frame, active: Mask | None = None) -> None:
        """Sense the state after a step.

        Args:
            frame: true state.
            active: (n,) bool, worlds that went on; all if None. What the others know may be
                anything.
        """

    @abstractmethod
    def take(self, worlds: NDArray[np.intp]) -> Self:
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """

    def put(self, worlds: NDArray[np.intp], part: Self) -> None:
        """Overwrite some worlds.

        Args:
            worlds: (k,) indices of worlds.
            part: senses of k worlds.
        """
        self.frame.put(worlds, part.frame)
        self.rng.put(worlds, part.rng)
        for own, other in zip(self.teams or (), part.teams or (), strict=True):
            own.put(worlds, other)

    def arrays(self) -> dict[str, Array]:
        """Return the arrays to save, by name; not copied. The streams are saved by others."""
        arrays = {"frame": self.frame.rows}
        if self.teams is not None:
            arrays |= {name: known.rows for name, known in zip(SIDES, self.teams, strict=True)}
        return arrays


@dataclass
class ModelSenses(Senses):
    """Senses by a model in Python."""

    model: SensorModel
    """The model."""
    frame: Frame
    state: dict[str, Array]
    """(n, ...) arrays of the model by name."""
    rng: WorldRng

    @classmethod
    def new(cls, model: SensorModel, frame: Frame, rng: WorldRng) -> "ModelSenses":
        """Return the senses of n worlds before their episodes begin.

        Args:
            model: the model.
            frame: frame of n worlds; copied.
            rng: (n,) random streams.

        Raises:
            ValueError: a column whose first axis is not n.
        """
        n = len(frame)
        state = checks.memory(f"{type(model).__name__}.columns", model.columns(n), n)
        return cls(model, frame.copy(), state, rng)

    def begin(self, frame: Frame, worlds: NDArray[np.intp]) -> None:
        """Sense the initial state of all n episodes; see `Senses.begin`."""
        self.frame.rows[:] = frame.rows
        self.model.begin(frame.read_only, self.frame, self.state, self.rng)
        self._check("begin")

    def sense(self, frame: Frame, active: Mask | None = None) -> None:
        """Sense the state after a step; see `Senses.sense`."""
        self.model.sense(frame.read_only, self.frame, self.state, self.rng)
        self._check("sense")

    def _check(self, method: str) -> None:
        """Check the state that a method of the model wrote."""
        checks.rows(f"{type(self.model).__name__}.{method}", self.frame)

    def take(self, worlds: NDArray[np.intp]) -> "ModelSenses":
        """Return a copy of some worlds; see `Senses.take`."""
        state = {name: array[worlds] for name, array in self.state.items()}
        return ModelSenses(self.model, self.frame.take(worlds), state, self.rng[worlds])

    def put(self, worlds: NDArray[np.intp], part: "ModelSenses") -> None:
        """Overwrite some worlds; see `Senses.put`."""
        super().put(worlds, part)
        for name, array in self.state.items():
            array[worlds] = part.state[name]

    def arrays(self) -> dict[str, Array]:
        """Return the arrays to save, by name; see `Senses.arrays`."""
        return super().arrays() | {f"state.{name}": array for name, array in self.state.items()}

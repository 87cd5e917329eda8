"""The complete state of matches as named arrays, for saving and resuming."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Array
from rsoccer.controllers import PolicyGroup
from rsoccer.matches import result_checks
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.simulator_interface import Stepper, require_snapshots

_OF_AUTHORS: Final = ("memory.", "game.", "senses.state.")
"""Beginnings of the names of arrays that tasks, rules and sensor models define."""
_REFEREE: Final = ("game.referee", "game.statistics")
"""Rows of the package's own referee among them."""


@dataclass
class MatchState:
    """References to all parts of the state of matches: simulator, arrays, random streams."""

    simulator: Stepper
    """Simulator of all worlds."""
    arrays: dict[str, Array]
    """(n, ...) arrays by name."""
    streams: dict[str, WorldRng]
    """(n,) random streams by name."""
    shared: Sequence[str]
    """Names of what does not depend on the controllers."""
    free: Collection[str]
    """Names of arrays whose numbers may be infinite or NaN: their authors decide."""

    @classmethod
    def of(
        cls,
        simulator: Stepper,
        play: Play,
        groups: Sequence[PolicyGroup],
        streams: dict[str, WorldRng],
        others: dict[str, Array],
        shared: Sequence[str],
    ) -> "MatchState":
        """Collect the state of some matches.

        Args:
            simulator: moves the robots.
            play: frames, actions and the task's memory.
            groups: policies with their memory.
            streams: all random streams by name.
            others: further arrays by name.
            shared: names of what does not depend on the controllers.

        Returns:
            The parts; arrays are not copied.
        """
        arrays = play.arrays() | others
        free = {name for name in arrays if name.startswith(_OF_AUTHORS)} - {*_REFEREE}
        for group in groups:
            arrays |= group.arrays()
            free |= set(group.arrays())
        return cls(simulator, arrays, streams, shared, free)

    def read(self) -> dict[str, Array]:
        """Return copies of all arrays by name.

        Raises:
            TypeError: the simulator has no `snapshot`.
        """
        snapshot = np.frombuffer(require_snapshots(self.simulator).snapshot(), np.uint8)
        arrays = {name: array.copy() for name, array in self.arrays.items()}
        return {result_checks.SIMULATOR: snapshot.copy(), **arrays, **self._stream_arrays()}

    def check(self, state: Mapping[str, Array], names: Collection[str] | None = None) -> None:
        """Check that a state fits these matches, but for the content of the snapshot.

        Args:
            state: arrays by name.
            names: names of the arrays to check; all if None.

        Raises:
            TypeError: no arrays by name.
            ValueError: arrays that do not fit these matches.
        """
        snapshot = {result_checks.SIMULATOR: np.empty(0)}
        expected = {**snapshot, **self.arrays, **self._stream_arrays()}
        if names is not None:
            state = {name: array for name, array in state.items() if name in names}
            expected = {name: array for name, array in expected.items() if name in names}
        result_checks.state(state, expected, self.free)

    def write(self, state: Mapping[str, Array]) -> None:
        """Overwrite the matches with a state that `read` returned.

        Args:
            state: arrays by name.

        Raises:
            TypeError: the simulator has no `restore`, or no arrays by name.
            ValueError: arrays that do not fit these matches. Nothing has changed.
        """
        simulator = require_snapshots(self.simulator)
        self.check(state)
        simulator.restore(state[result_checks.SIMULATOR].tobytes())
        for name, array in self.arrays.items():
            array[...] = state[name]
        for name, rng in self.streams.items():
            rng.put(np.arange(len(rng)), WorldRng.from_state(state[f"rng.{name}"]))

    def _stream_arrays(self) -> dict[str, Array]:
        return {f"rng.{name}": rng.state for name, rng in self.streams.items()}

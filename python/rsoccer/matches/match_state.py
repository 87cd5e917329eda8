"""The complete state of matches as named arrays, for saving and resuming."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rsoccer.arrays import Array
from rsoccer.controllers import PolicyGroup
from rsoccer.matches import result_checks
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.simulator_interface import Stepper, require_snapshots


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
        for group in groups:
            arrays |= group.arrays()
        return cls(simulator, arrays, streams, shared)

    def read(self) -> dict[str, Array]:
        """Return copies of all arrays by name.

        Raises:
            TypeError: the simulator has no `snapshot`.
        """
        snapshot = np.frombuffer(require_snapshots(self.simulator).snapshot(), np.uint8)
        arrays = {name: array.copy() for name, array in self.arrays.items()}
        return {"simulator": snapshot.copy(), **arrays, **self._stream_arrays()}

    def write(self, state: Mapping[str, Array]) -> None:
        """Overwrite the matches with a state that `read` returned.

        Args:
            state: arrays by name.

        Raises:
            TypeError: the simulator has no `restore`.
            ValueError: arrays that do not fit these matches. Nothing has changed.
        """
        simulator = require_snapshots(self.simulator)
        result_checks.state(
            state, {"simulator": np.empty(0), **self.arrays, **self._stream_arrays()}
        )
        simulator.restore(state["simulator"].tobytes())
        for name, array in self.arrays.items():
            array[...] = state[name]
        for name, rng in self.streams.items():
            rng.put(np.arange(len(rng)), WorldRng.from_state(state[f"rng.{name}"]))

    def _stream_arrays(self) -> dict[str, Array]:
        return {f"rng.{name}": rng.state for name, rng in self.streams.items()}

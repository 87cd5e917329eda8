"""Matches as arrays: all that their future depends on, read and put back."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rsoccer import checks
from rsoccer.controllers import Crew
from rsoccer.frame import Array
from rsoccer.rng import WorldRng
from rsoccer.simulator import Worlds, snapshots
from rsoccer.task import Play


@dataclass
class Saved:
    """Where the state of matches is kept: their simulator, their arrays, their streams."""

    simulator: Worlds
    arrays: dict[str, Array]
    streams: dict[str, WorldRng]

    @classmethod
    def of(
        cls,
        simulator: Worlds,
        play: Play,
        crews: Sequence[Crew],
        start: WorldRng,
        others: dict[str, Array],
    ) -> "Saved":
        """All of some matches: their play and drivers, the streams of starts, other arrays."""
        arrays = arrays_of(play, crews) | others
        streams = {"start": start, "task": play.rng} | {crew.name: crew.rng for crew in crews}
        return cls(simulator, arrays, streams)

    def read(self) -> dict[str, Array]:
        """Copies of everything, by name."""
        snapshot = np.frombuffer(snapshots(self.simulator).snapshot(), np.uint8)
        arrays = {name: array.copy() for name, array in self.arrays.items()}
        return {"simulator": snapshot.copy(), **arrays, **self._states()}

    def put(self, state: Mapping[str, Array]) -> None:
        """Be as `read` found it; what does not fit is refused before anything has changed."""
        simulator = snapshots(self.simulator)
        checks.state(state, {"simulator": np.empty(0), **self.arrays, **self._states()})
        simulator.restore(state["simulator"].tobytes())
        for name, array in self.arrays.items():
            array[...] = state[name]
        for name, rng in self.streams.items():
            rng.put(np.arange(len(rng)), WorldRng.from_state(state[f"rng.{name}"]))

    def _states(self) -> dict[str, Array]:
        return {f"rng.{name}": rng.state for name, rng in self.streams.items()}


def arrays_of(play: Play, crews: Sequence[Crew]) -> dict[str, Array]:
    """Arrays of a play and its drivers by name, but for the streams and what follows from them."""
    arrays: dict[str, Array] = {
        "frame": play.frame.rows,
        "last_frame": play.last_frame.rows,
        "commands": play.commands,
        "actions": play.actions,
        "steps": play.steps,
    }
    arrays |= {f"memory.{name}": array for name, array in play.memory.items()}
    for crew in crews:
        arrays |= {f"{crew.name}.{name}": array for name, array in crew.memory.items()}
    return arrays

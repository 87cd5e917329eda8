"""Whom the learners play against: themselves, their past selves, and random drifting.

Self-play against the latest self alone chases its own tail: it beats what it just was and
forgets how to beat the rest. Frozen past selves and a slice of drifting robots keep old curriculum.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np

from rsoccer.frame import Array, Floats
from rsoccer.policies import make
from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.policies.network import Network
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.train.checkpoint import owned
from rsoccer.train.timing import Clock

OU, LATEST, PAST = 0, 1, 2
"""Codes of opponents; past self `k` of the pool has code `PAST + k`."""

KINDS = ("ou", "latest", "past")
"""Names of the codes, where all past selves are one kind."""


class OpponentPool(Policy):
    """Gives each world an opponent of its own, drawn anew whenever an episode starts."""

    observes: Literal["nothing", "view", "observation"] = "observation"

    def __init__(
        self, task: Task, shares: dict[str, float], size: int, repeat: int, clock: Clock
    ) -> None:
        """`shares` of worlds by kind; networks hold each decision for `repeat` control steps."""
        self.latest: Network | None = None
        self.past: list[Network] = []
        self.born: list[int] = []
        self.opponents = np.zeros(0, np.int64)  # code of each world's opponent in the last step
        self._clock = clock
        self._drift = make("ou", task)
        self._shares, self._size, self._repeat = shares, size, repeat

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> dict[str, Array]:
        """Opponents of fresh episodes, and what they have in mind."""
        n = shape[0]
        drift = self._drift.new_memory(shape, rng)
        return {
            "opponent": self._draw(rng),
            "age": np.zeros(n, np.int64),
            "held": np.zeros(shape, np.float32),
            **{f"drift.{name}": array for name, array in drift.items()},
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: dict[str, Array]) -> Floats:
        """Each world's opponent acts, (n, robots, action)."""
        with self._clock.measure("opponents"):
            self.opponents = memory["opponent"]
            return self._act(inputs, rng, memory)

    def _act(self, inputs: PolicyInput, rng: WorldRng, memory: dict[str, Array]) -> Floats:
        assert inputs.observations is not None, "a pool observes"
        drift = {name[6:]: array for name, array in memory.items() if name.startswith("drift.")}
        drifting = self._drift.act(inputs, rng, drift)
        opponent, held = memory["opponent"], memory["held"]
        due = memory["age"] % self._repeat == 0
        memory["age"] += 1
        for code, network in self._networks():
            rows = due & (opponent == code)
            if rows.any():
                streams = rng[rows]
                held[rows] = network.choose(inputs.observations[rows], streams)
                rng.put(rows, streams)
        return np.where((opponent == OU)[:, None, None], drifting, held)

    def freeze(self, network: Network, born: int) -> None:
        """Keep a copy of a policy; once full, the one that leaves the smallest gap makes room.

        So the pool stays spread over the whole run. A match against the one that left goes on
        against the one that came.
        """
        if len(self.past) < self._size:
            self.past.append(network)
            self.born.append(born)
            return
        slot = self._most_crowded()
        self.past[slot], self.born[slot] = network, born

    def _most_crowded(self) -> int:
        """Slot whose removal leaves the smallest gap between the ages of its neighbours."""
        order = np.argsort(self.born)
        if len(order) < 3:
            return int(order[0])
        times = np.array(self.born)[order]
        return int(order[1 + np.argmin(times[2:] - times[:-2])])

    def _draw(self, rng: WorldRng) -> Array:
        """Code of an opponent for each world (n,); before there is a past, the latest self."""
        share = rng.uniform(0.0, 1.0)
        chosen = rng.integers(max(len(self.past), 1))
        past = PAST + chosen if self.past else np.full(len(rng), LATEST)
        ou = share < self._shares["ou"]
        recent = share < self._shares["ou"] + self._shares["latest"]
        return np.where(ou, OU, np.where(recent, LATEST, past))

    def state_dict(self) -> dict[str, Array]:
        """Arrays of the past selves; the latest self is the trainer's to keep."""
        arrays: dict[str, Array] = {"born": np.array(self.born, np.int64)}
        for slot, network in enumerate(self.past):
            arrays |= {f"{slot}.{name}": array for name, array in network.arrays().items()}
        return arrays

    def load_state_dict(self, arrays: dict[str, Array], metadata: dict[str, str]) -> None:
        """Continue from what `state_dict` gave; `metadata` is that of all these networks."""
        self.born = arrays["born"].tolist()
        self.past = [Network(owned(str(slot), arrays), metadata) for slot in range(len(self.born))]

    def _networks(self) -> Iterator[tuple[int, Network]]:
        if self.latest is not None:
            yield LATEST, self.latest
        yield from enumerate(self.past, PAST)


def kinds(opponent: Array) -> Array:
    """Index into `KINDS` of each opponent's code (n,)."""
    return np.minimum(opponent, PAST)

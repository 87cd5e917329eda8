"""Pool of opponents for self-play: the current policy, frozen past policies, the `ou` policy.

Self-play against the current policy alone can cycle: a policy learns to beat its predecessor and
forgets how to beat others. Frozen past policies and a share of `ou` opponents keep that skill.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.policies import make_policy
from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.policies.network import Network
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.train.checkpoint import add_prefix, select_prefix
from rsoccer.train.pool_slots import LATEST, OU, PAST, PoolSlots, choose_opponents
from rsoccer.train.timing import Clock

KINDS = ("ou", "latest", "past")
"""Names of the kinds of opponents by code; all past policies are one kind."""


class OpponentPool(Policy):
    """A policy that gives each world its own opponent, drawn when an episode starts.

    Attributes:
        latest: the current policy, which the trainer sets after every update; None at first.
        past: frozen past policies.
        slots: ages of the past policies.
        opponents: (n,) code of each world's opponent in the last step.
    """

    observes: Literal["nothing", "view", "observation"] = "observation"

    def __init__(
        self,
        task: Task,
        fractions: dict[str, float],
        size: int,
        action_repeat: int,
        clock: Clock,
    ) -> None:
        """Create a pool without past policies.

        Args:
            task: the task that is trained.
            fractions: shares of the episodes, 0 to 1, by the names in `KINDS`; they sum to 1.
            size: largest number of past policies.
            action_repeat: control steps that networks hold each decision.
            clock: measures the time of the opponents.
        """
        self.latest: Network | None = None
        self.past: list[Network] = []
        self.slots = PoolSlots(size)
        self.opponents = np.zeros(0, np.int64)
        self._clock = clock
        self._ou = make_policy("ou", task)
        self._fractions, self._action_repeat = fractions, action_repeat

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> dict[str, Array]:
        """Draw opponents for new episodes, and return their memory, arrays (n, ...)."""
        n = shape[0]
        ou_memory = self._ou.new_memory(shape, rng)
        return {
            "opponent": self._draw(rng),
            "age": np.zeros(n, np.int64),
            "held": np.zeros(shape, np.float32),
            **add_prefix("ou", ou_memory),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: dict[str, Array]) -> Floats:
        """Return the actions of each world's opponent, (n, robots, action)."""
        with self._clock.measure("opponents"):
            self.opponents = memory["opponent"]
            return self._act(inputs, rng, memory)

    def _act(self, inputs: PolicyInput, rng: WorldRng, memory: dict[str, Array]) -> Floats:
        """Actions (n, robots, action); networks decide every `action_repeat` steps."""
        assert inputs.observations is not None, "a pool observes"
        ou_actions = self._ou.act(inputs, rng, select_prefix("ou", memory))
        opponent, held = memory["opponent"], memory["held"]
        due = memory["age"] % self._action_repeat == 0
        memory["age"] += 1
        for code, network in self._networks():
            rows = due & (opponent == code)
            if rows.any():
                streams = rng[rows]
                held[rows] = network.choose(inputs.observations[rows], streams)
                rng.put(rows, streams)
        return np.where((opponent == OU)[:, None, None], ou_actions, held)

    def freeze(self, network: Network, update: int) -> None:
        """Add a past policy. A full pool evicts the one closest in age to its neighbours.

        The ages in the pool thus stay spread over the whole run. Matches in progress against the
        evicted policy continue against its replacement.

        Args:
            network: the policy to add.
            update: number of updates that the policy was trained for.
        """
        slot = self.slots.take(update)
        self.past[slot : slot + 1] = [network]  # appends where the pool is not full

    def _draw(self, rng: WorldRng) -> Array:
        """Code of an opponent for each world (n,); `LATEST` for past ones in an empty pool."""
        uniform = rng.uniform(0.0, 1.0)
        slot = rng.integers(max(len(self.past), 1))
        opponents = choose_opponents(uniform, slot, self._fractions)
        return opponents if self.past else np.minimum(opponents, LATEST)

    def state_dict(self) -> dict[str, Array]:
        """Return the arrays of the past policies by name; the trainer saves the current one."""
        arrays: dict[str, Array] = {"frozen_at": np.array(self.slots.frozen_at, np.int64)}
        for slot, network in enumerate(self.past):
            arrays |= add_prefix(str(slot), network.arrays())
        return arrays

    def load_state_dict(self, arrays: dict[str, Array], metadata: dict[str, str]) -> None:
        """Restore the past policies.

        Args:
            arrays: arrays from `state_dict`.
            metadata: metadata of the networks, the same for all.
        """
        self.slots.frozen_at = arrays["frozen_at"].tolist()
        self.past = [
            Network(select_prefix(str(slot), arrays), metadata)
            for slot in range(len(self.slots.frozen_at))
        ]

    def _networks(self) -> Iterator[tuple[int, Network]]:
        """Codes and networks of the current policy and of the past ones."""
        if self.latest is not None:
            yield LATEST, self.latest
        yield from enumerate(self.past, PAST)


def kinds_of(opponents: Array) -> Array:
    """Return the kind of each opponent as an index into `KINDS`, (n,).

    Args:
        opponents: (n,) codes of opponents.
    """
    return np.minimum(opponents, PAST)

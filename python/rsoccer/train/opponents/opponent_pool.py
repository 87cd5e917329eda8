"""Opponents for self-play: the current policy, frozen past policies, and fixed policies.

Self-play against the current policy alone can cycle: a policy learns to beat its predecessor and
forgets how to beat others. Frozen past policies and a share of fixed ones keep that skill. Past
policies are drawn by prioritized fictitious self-play: those that the learner seldom beats often.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.history import ObservationStack
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.policies.network import Network
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.policy_mix import SELVES, PolicyMix
from rsoccer.train.opponents.pool_slots import PoolSlots, draw
from rsoccer.train.prefixes import add_prefix, select_prefix

POOL_SIZE: Final = 8
"""Largest number of past policies."""
FREEZE_INTERVAL: Final = 10
"""Updates between two additions to the past policies."""


class OpponentPool(PolicyMix):
    """A policy that gives each world its own opponent, drawn when an episode starts.

    Codes of opponents are the indices of the fixed policies, then `latest_code`; the past policy
    in slot k has the code `latest_code + 1 + k`.

    Attributes:
        latest: the current policy, which the trainer sets after every update; None at first.
        past: frozen past policies.
        slots: ages of the past policies, and the win rates against them.
        latest_code: code of the current policy.
    """

    def __init__(
        self,
        task: Task,
        fixed: Mapping[str, float],
        selves: tuple[float, float],
        action_repeat: int,
        clock: Clock,
        stack: ObservationStack,
    ) -> None:
        """Create a pool without past policies.

        Args:
            task: the task that is trained.
            fixed: shares of the fixed policies by name or file, relative to each other.
            selves: shares of the episodes against the current policy and against past ones, 0 to
                1; the fixed policies have the rest.
            action_repeat: control steps that networks hold each decision.
            clock: measures the time of the opponents.
            stack: what the networks observe of the task.

        Raises:
            FileNotFoundError: no such policy file.
            ValueError: an unknown policy, or one that does not fit the task.
        """
        super().__init__(task, fixed, clock)
        self.observes = "observation"
        self.forecasts &= not sum(selves)  # past selves have learned what the learners know
        self.needs_forecast &= self.forecasts
        self.latest: Network | None = None
        self.past: list[Network] = []
        self.slots = PoolSlots(POOL_SIZE)
        self.latest_code = len(self.kinds)
        self._shares = np.array([*self._shares * max(1.0 - sum(selves), 0.0), *selves])
        self.kinds = (*self.kinds, *SELVES)
        self._action_repeat, self._stack = action_repeat, stack

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Draw opponents for new episodes, and return their memory, arrays (n, ...)."""
        return {
            **super().new_memory(shape, rng),
            "age": np.zeros(shape[0], np.int64),
            "held": np.zeros(shape, np.float32),
            **self._stack.new_memory(*shape[:2]),
        }

    def _act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Actions (n, robots, action); networks decide every `action_repeat` steps."""
        observations, stack = inputs.observations, self._stack
        assert observations is not None, "a pool observes"
        actions = super()._act(inputs, rng, memory)
        drawn, held, age = memory["drawn"], memory["held"], memory["age"]
        stack.begin(memory, age == 0, observations[age == 0])
        due = age % self._action_repeat == 0
        for code, network in self._networks():
            rows = due & (drawn == code)
            if rows.any():
                streams = rng[rows]
                stacked = stack.stack(memory, rows, observations[rows])
                held[rows] = network.choose(stacked, streams)
                rng.put(rows, streams)
        selves = drawn >= self.latest_code
        played = self._shielded(inputs, selves, held)
        stack.push(memory, slice(None), observations, played)
        age += 1
        return np.where(selves[:, None, None], played, actions)

    def _shielded(self, inputs: PolicyInput, selves: Mask, held: Floats) -> Floats:
        """Actions of networks behind their shield, the same for all, as the learners' are."""
        shield = next((network.shield for _, network in self._networks()), None)
        worlds = np.flatnonzero(selves)
        if shield is None or inputs.match is None or not len(worlds):
            return held
        played, part = held.copy(), held[worlds]
        shield.apply(inputs.match.take(worlds), part)
        played[worlds] = part
        return played

    def show(self, network: Network, update: int) -> None:
        """Make a policy the latest one, and freeze it every `FREEZE_INTERVAL` updates.

        Args:
            network: the policy after an update.
            update: number of updates that it was trained for.
        """
        self.latest = network
        if update % FREEZE_INTERVAL == 0:
            self.freeze(network, update)

    def freeze(self, network: Network, update: int) -> None:
        """Add a past policy. A full pool evicts the one closest in age to its neighbors.

        The ages in the pool thus stay spread over the whole run. Matches in progress against the
        evicted policy continue against its replacement.

        Args:
            network: the policy to add.
            update: number of updates that the policy was trained for.
        """
        slot = self.slots.take(update)
        self.past[slot : slot + 1] = [network]  # appends where the pool is not full

    def _draw(self, rng: WorldRng) -> Array:
        """Code of an opponent for each world (n,); the current policy for past ones if none is."""
        kinds = super()._draw(rng)
        uniform = rng.uniform(0.0, 1.0)
        if not self.past:
            return np.minimum(kinds, self.latest_code)
        slots = draw(uniform, self.slots.shares())
        return np.where(kinds > self.latest_code, kinds + slots, kinds)

    def kinds_of(self, codes: Array) -> Array:
        """Return the kind of each opponent as an index into `kinds`, (n,).

        Args:
            codes: (n,) codes of opponents.
        """
        return np.minimum(codes, self.latest_code + 1)

    def record(self, ended: Mask, scores: Array) -> None:
        """Update the win rates against past policies with the matches that ended.

        Args:
            ended: (n,) mask of the matches that ended in the last step.
            scores: (n,) scores of the learners, valid where a match ended.
        """
        worlds = np.flatnonzero(ended & (self.drawn > self.latest_code))
        self.slots.record(self.drawn[worlds] - self.latest_code - 1, scores[worlds])

    def state_dict(self) -> dict[str, Array]:
        """Return the arrays of the past policies by name; the trainer saves the current one."""
        arrays: dict[str, Array] = {
            "frozen_at": np.array(self.slots.frozen_at, np.int64),
            "win_rates": np.array(self.slots.win_rates, np.float64),
        }
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
        self.slots.win_rates = arrays["win_rates"].tolist()
        self.past = [
            Network(select_prefix(str(slot), arrays), metadata)
            for slot in range(len(self.slots.frozen_at))
        ]

    def _networks(self) -> Iterator[tuple[int, Network]]:
        """Codes and networks of the current policy and of the past ones."""
        if self.latest is not None:
            yield self.latest_code, self.latest
        yield from enumerate(self.past, self.latest_code + 1)

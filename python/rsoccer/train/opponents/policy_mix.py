"""Mix of policies: each world is played by one of them, drawn when its episode starts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.policies import make_policy
from rsoccer.policies.base import (
    Memory,
    Observes,
    Policy,
    PolicyInput,
    actions_of,
    require_actions,
)
from rsoccer.policies.labels import labels
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.pool_slots import draw
from rsoccer.train.prefixes import add_prefix, select_prefix

SELVES: Final = ("latest", "past")
"""Kinds of opponents in self-play after the fixed policies; all past policies are one kind. No file
has one of these names."""
_INPUTS: Final[tuple[Observes, ...]] = ("nothing", "view", "observation")


class PolicyMix(Policy):
    """A policy that gives each world one of several policies, drawn when an episode starts.

    Attributes:
        kinds: names of the kinds of opponents in logs, one for each policy.
        drawn: (n,) code of each world's policy in the last step.
    """

    kinds: tuple[str, ...]

    def __init__(self, task: Task, shares: Mapping[str, float], clock: Clock) -> None:
        """Make the policies.

        Args:
            task: the task that is trained.
            shares: shares of the episodes by name or file of the policy; they need not sum to 1.
            clock: measures the time of the policies, as "opponents".

        Raises:
            FileNotFoundError: no such policy file.
            ValueError: an unknown policy, or one that does not fit the task.
        """
        super().__init__()
        self.kinds = tuple(labels(shares, SELVES))
        self.drawn: Array = np.zeros(0, np.int64)
        self.observes = "nothing"
        self._policies = [make_policy(name, task) for name in shares]
        for policy in self._policies:
            require_actions("opponents", policy)
            self.observes = max(self.observes, policy.observes, key=_INPUTS.index)
        # A team forecasts in all worlds or in none, and some have learned without a forecast.
        looking = [each for each in self._policies if each.observes != "nothing"]
        self.forecasts = bool(looking) and all(each.forecasts for each in looking)
        self.needs_forecast = self.forecasts and any(each.needs_forecast for each in looking)
        self._shares: Doubles = np.array(list(shares.values()), np.float64)
        self._shares /= max(self._shares.sum(), 1e-12)
        self._clock = clock

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Draw policies for new episodes, and return their memory, arrays (n, ...)."""
        memory: Memory = {}
        for code, policy in enumerate(self._policies):
            memory |= add_prefix(str(code), policy.new_memory(shape, rng))
        return {"drawn": self._draw(rng), **memory}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions of each world's policy, (n, robots, action)."""
        with self._clock.measure("opponents"):
            self.drawn = memory["drawn"]
            return self._act(inputs, rng, memory)

    def _act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Actions of each world's policy (n, robots, action); zeros in worlds with another code."""
        actions = np.zeros(inputs.action_shape, np.float32)
        for code, policy in enumerate(self._policies):
            worlds = self._worlds_of(code, memory["drawn"])
            if len(worlds):
                own = select_prefix(str(code), memory)
                actions[worlds] = _act_in(worlds, policy, inputs, rng, own)
        return actions

    def _worlds_of(self, code: int, drawn: Array) -> NDArray[np.intp]:
        """Indices of the worlds in which a policy acts."""
        return np.flatnonzero(drawn == code)

    def _draw(self, rng: WorldRng) -> Array:
        """Code of a policy for each world, (n,)."""
        return draw(rng.uniform(0.0, 1.0), self._shares)

    def kinds_of(self, codes: Array) -> Array:
        """Return the kind of each opponent as an index into `kinds`, (n,).

        Args:
            codes: (n,) codes of opponents.
        """
        return codes

    def record(self, ended: Mask, scores: Array) -> None:
        """Record the results of matches in progress; a mix without a memory of them ignores them.

        Args:
            ended: (n,) mask of the matches that ended in the last step.
            scores: (n,) scores of the learners, valid where a match ended.
        """


def _act_in(
    worlds: NDArray[np.intp], policy: Policy, inputs: PolicyInput, rng: WorldRng, memory: Memory
) -> Floats:
    """Actions of a policy in some worlds (k, robots, action); streams and memory advance there."""
    shape = (len(worlds), *inputs.action_shape[1:])
    needed = _INPUTS.index(policy.observes)
    view, observations = inputs.view, inputs.observations
    part = PolicyInput(
        shape,
        None if view is None or needed < 1 else view.take(worlds),
        None if observations is None or needed < 2 else observations[worlds],
        inputs.optional_actions,
        None if inputs.match is None or needed < 1 else inputs.match.take(worlds),
    )
    streams = rng[worlds]
    own = {name: array[worlds] for name, array in memory.items()}
    actions = actions_of(policy, part, streams, own)
    rng.put(worlds, streams)
    for name, array in own.items():
        memory[name][worlds] = array
    return actions

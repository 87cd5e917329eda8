"""Policies that hold each decision for some control steps, and may decide from their past."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput

if TYPE_CHECKING:
    from rsoccer.arrays import Floats, Mask
    from rsoccer.history import ObservationStack
    from rsoccer.policies.shield import Shield
    from rsoccer.rng import WorldRng


class HeldActions(Policy):
    """A policy that decides from the observation at every `action_repeat`-th control step."""

    observes: Observes = "observation"

    action_repeat: int
    """Control steps for which an action is held, at least 1."""
    stack: ObservationStack | None = None
    """Stacks the observations that the policy decides from; None if it decides from plain ones."""
    shield: Shield | None = None
    """Changes actions against rules; None for a policy without one."""

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the held action (n, robots, action), control steps played (n,), and the past."""
        if not self._has_memory:
            return {}
        past = {} if self.stack is None else self.stack.new_memory(*shape[:2])
        return {"held": np.zeros(shape, np.float32), "age": np.zeros(shape[0], np.int64), **past}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, action): new decisions, or held ones, behind the shield."""
        observations = inputs.observations
        if observations is None:
            raise ValueError(f"a {type(self).__name__} needs observations (n, robots, o), got none")
        if not self._has_memory:
            return self._shielded(inputs, self.choose(observations, rng))
        held, age = memory["held"], memory["age"]
        due = age % self.action_repeat == 0
        if self.stack is not None:
            self.stack.begin(memory, age == 0, observations[age == 0])
        if due.any():
            streams = rng[due]
            held[due] = self.choose(self._stacked(memory, due, observations[due]), streams)
            rng.put(due, streams)
        actions = self._shielded(inputs, held.copy())
        if self.stack is not None:  # of what robots did, as in training
            self.stack.push(memory, slice(None), observations, actions)
        age += 1
        return actions

    def _shielded(self, inputs: PolicyInput, actions: Floats) -> Floats:
        """The actions, changed in place by the shield."""
        if self.shield is not None and inputs.match is not None:
            self.shield.apply(inputs.match, actions)
        return actions

    @property
    def _has_memory(self) -> bool:
        return self.action_repeat > 1 or self.stack is not None

    def _stacked(self, memory: Memory, worlds: Mask, observations: Floats) -> Floats:
        """Stacked observations of some worlds; the plain ones of a policy without a stack."""
        if self.stack is None:
            return observations
        return self.stack.stack(memory, worlds, observations)

    @abstractmethod
    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """Choose actions, without holding them.

        Args:
            observations: (n, robots, o) observations, stacked if the policy has a stack.
            rng: (n,) random streams.

        Returns:
            (n, robots, action) in [-1, 1].
        """

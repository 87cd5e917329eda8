"""Policies that hold each decision for some control steps."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput

if TYPE_CHECKING:
    from rsoccer.arrays import Floats
    from rsoccer.rng import WorldRng


class HeldActions(Policy):
    """A policy that decides from the observation at every `action_repeat`-th control step."""

    observes: Observes = "observation"

    action_repeat: int
    """Control steps for which an action is held, at least 1."""

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the held action (n, robots, action) and its age (n,), control steps."""
        if self.action_repeat == 1:
            return {}
        return {"held": np.zeros(shape, np.float32), "age": np.zeros(shape[0], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, action): new decisions, or held ones."""
        if inputs.observations is None:
            raise ValueError(f"a {type(self).__name__} needs observations (n, robots, o), got none")
        if self.action_repeat == 1:
            return self.choose(inputs.observations, rng)
        held, age = memory["held"], memory["age"]
        due = age == 0
        if due.any():
            streams = rng[due]
            held[due] = self.choose(inputs.observations[due], streams)
            rng.put(due, streams)
        age[:] = (age + 1) % self.action_repeat
        return held.copy()

    @abstractmethod
    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """Choose actions, without holding them.

        Args:
            observations: (n, robots, o) observations.
            rng: (n,) random streams.

        Returns:
            (n, robots, action) in [-1, 1].
        """

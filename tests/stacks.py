"""Stacked observations made by hand, number for number as `rsoccer.history` defines them."""

from dataclasses import dataclass, field

import numpy as np

from rsoccer.arrays import Floats


@dataclass
class HandStack:
    """Observations and actions of an episode, each of the same shape but for the last axis."""

    history: int
    action_size: int
    observations: list[Floats] = field(default_factory=list)
    actions: list[Floats] = field(default_factory=list)

    def begin(self, observation: Floats) -> None:
        """Begin an episode with its first observation."""
        self.observations, self.actions = [observation], []

    def step(self, action: Floats, observation: Floats) -> None:
        """Add an action and the observation that follows it."""
        self.actions.append(np.clip(action, -1.0, 1.0))
        self.observations.append(observation)

    @property
    def value(self) -> Floats:
        """Stacked observation."""
        first = self.observations[0]
        still = np.zeros((*first.shape[:-1], self.action_size), np.float32)
        observations = [first] * self.history + self.observations
        actions = [still] * self.history + self.actions
        newest = observations[: -self.history - 1 : -1]
        past = actions[: -self.history : -1]
        return np.concatenate([*newest, *past], axis=-1)

"""Stacked observations made by hand, number for number as `rsoccer.history` defines them."""

from dataclasses import dataclass, field

import numpy as np

from rsoccer import Matches
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


TASK, WORLDS, HISTORY, LIMIT, STEPS = "VSSMulti-v0", 2, 3, 5, 12


def expected_stacks(actions: Floats) -> list[tuple[Floats, Floats]]:
    """Observations after a reset with seed 4 and after each step, and those before new episodes."""
    plain = Matches(TASK, WORLDS, max_steps=LIMIT)
    hand = HandStack(HISTORY, plain.action_size)  # all matches end at the time limit
    hand.begin(plain.reset(seed=4))
    stacks = [(hand.value, hand.value)]
    for each in actions:
        outcome = plain.step(each)
        hand.step(each, outcome.final_observations)
        final = hand.value
        if outcome.ended.any():
            assert outcome.ended.all()
            hand.begin(outcome.observations)
        stacks.append((hand.value, final))
    return stacks

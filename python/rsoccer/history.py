"""Stacked observations: the last observations of a robot, and its actions between them.

Sensors and radio are late, so a robot acts on a state that its last actions have not reached yet.
An observation with these actions is a state again (Katsikopoulos and Engelbrecht, "Markov decision
processes with delays and asynchronous cost collection", 2003), and of several noisy observations a
network can take the mean and the difference. A network without a memory of its own then copes with
delay and noise.

With observations o, actions a and a history of k control steps, a stacked observation is

    [o_t, o_{t-1}, ..., o_{t-k+1}, a_{t-1}, ..., a_{t-k+1}]

which are k o + (k - 1) a numbers, the newest first. When an episode begins, all past observations
are the first one, and all past actions are 0.

    >>> import rsoccer
    >>> matches = rsoccer.Matches("VSS-v0", history=3)
    >>> matches.observation_size == 3 * matches.task.layout.size + 2 * matches.action_size
    True
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.reflection import Reflection
from rsoccer.task import Task

Memory = dict[str, Array]
"""Past of some robots in n worlds: arrays (n, robots, k - 1, size) by name, the newest first."""
Worlds = slice | Mask | NDArray[np.intp]
"""Selection of m of n worlds: a slice, a mask (n,) or indices (m,)."""


@dataclass(frozen=True)
class ObservationStack:
    """Sizes of stacked observations, and operations on the memory that they are made of.

    The memory belongs to the caller, so that it is copied and saved with the caller's state.
    """

    history: int
    """Observations in a stacked one, k; 1 for plain observations, which need no memory."""
    observation_size: int
    """Numbers in a plain observation, o."""
    action_size: int
    """Numbers in an action, a."""

    @classmethod
    def of(cls, task: Task, history: int) -> Self:
        """Return the stack of a task.

        Args:
            task: the task that is played.
            history: observations in a stacked one, at least 1.

        Raises:
            TypeError: `history` is not a whole number.
            ValueError: it is below 1.
        """
        return cls(checks.integer("history", history, 1), task.layout.size, task.action_size)

    @property
    def size(self) -> int:
        """Numbers in a stacked observation."""
        return self.history * self.observation_size + (self.history - 1) * self.action_size

    def join(self, observation: Floats, action: Floats) -> Floats:
        """Return one number for each number of a stacked observation, such as its bound.

        Args:
            observation: (o,) numbers for each of the observations.
            action: (a,) numbers for each of the past actions.

        Returns:
            (size,) numbers, a new array.
        """
        return np.concatenate([np.tile(observation, self.history), np.tile(action, self._past)])

    def columns(self, history: int, observation: Array, action: Array) -> Array:
        """Return the columns of some numbers of the newest observations and actions.

        Args:
            history: number of observations, at most that of the stack, and of actions plus one.
            observation: columns of a plain observation.
            action: columns of an action.

        Returns:
            Columns of a stacked observation: those of each observation, then of each past action.
        """
        first = self.history * self.observation_size
        observed = [observation + nth * self.observation_size for nth in range(history)]
        acted = [first + nth * self.action_size + action for nth in range(history - 1)]
        return np.concatenate([*observed, *acted])

    def reflection(self, task: Task) -> Reflection | None:
        """Return the reflection of a stacked observation, (size,).

        Args:
            task: the task that is played.

        Returns:
            The reflection; None if that of the task's observations is not known.
        """
        symmetry, plain = task.symmetry, task.layout.reflection
        if symmetry is None or plain is None:
            return None
        return Reflection.join([plain] * self.history + [symmetry.action] * self._past)

    def new_memory(self, worlds: int, robots: int) -> Memory:
        """Return the memory before episodes `begin`.

        Args:
            worlds: number of worlds, n.
            robots: number of robots in each.

        Returns:
            New arrays; none for a history of 1.
        """
        if not self._past:
            return {}
        sizes = {"past_observations": self.observation_size, "past_actions": self.action_size}
        shape = (worlds, robots, self._past)
        return {name: np.zeros((*shape, size), np.float32) for name, size in sizes.items()}

    def begin(self, memory: Memory, worlds: Worlds, observations: Floats) -> None:
        """Begin episodes in m worlds.

        Args:
            memory: memory of n worlds; changed in place.
            worlds: the m worlds.
            observations: (m, robots, o) first observations.
        """
        if self._past:
            memory["past_observations"][worlds] = observations[:, :, None]
            memory["past_actions"][worlds] = 0.0

    def push(self, memory: Memory, worlds: Worlds, observations: Floats, actions: Floats) -> None:
        """Remember a control step in m worlds, and forget the oldest one.

        Args:
            memory: memory of n worlds; changed in place.
            worlds: the m worlds.
            observations: (m, robots, o) observations before the step.
            actions: (m, robots, a) actions of the step.
        """
        if self._past:
            for name, newest in (("past_observations", observations), ("past_actions", actions)):
                past = memory[name]
                past[worlds, :, 1:] = past[worlds, :, :-1]
                past[worlds, :, :1] = newest[:, :, None]

    def stack(self, memory: Memory, worlds: Worlds, observations: Floats) -> Floats:
        """Return stacked observations of m worlds.

        Args:
            memory: memory of n worlds.
            worlds: the m worlds.
            observations: (m, robots, o) current observations.

        Returns:
            (m, robots, size) a new array; the argument itself for a history of 1.
        """
        if not self._past:
            return observations
        parts = [observations]
        for name in ("past_observations", "past_actions"):
            past = memory[name][worlds]
            parts.append(past.reshape(*past.shape[:2], past.shape[2] * past.shape[3]))
        return np.concatenate(parts, axis=-1)

    @property
    def _past(self) -> int:
        """Control steps in the memory."""
        return self.history - 1

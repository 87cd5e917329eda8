"""Check that observations are within the limits beyond which they are clipped."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.observation_layout import DEFAULT_LIMIT
from rsoccer.task import Play, Task
from rsoccer.testing.errors import TaskError

MAX_FRACTION: Final = 0.5
"""Largest fraction of states in which a number may be clipped."""


class Excesses:
    """Counts how often each number of an observation is beyond its limit."""

    def __init__(self, task: Task) -> None:
        """Begin to count.

        Args:
            task: the task.
        """
        self._task, self._states = task, 0
        self._counts: dict[str, Floats] = {}

    def count(self, play: Play) -> None:
        """Count the numbers of a state that are beyond their limits.

        Args:
            play: state of n worlds with observers.
        """
        limits = self._task.observation_limits()
        self._states += len(play.frame) * len(play.observers)
        for name, block in self._task.frame_to_observations(play).items():
            beyond = np.abs(block) > limits.get(name, DEFAULT_LIMIT)
            counts: Floats = beyond.sum(axis=(0, 1))
            self._counts[name] = self._counts.get(name, np.zeros_like(counts)) + counts

    def check(self) -> None:
        """Raise unless every number was within its limit in most of the states.

        Raises:
            TaskError: a number is clipped in most states, so nothing can be learned from it.
        """
        limits = self._task.observation_limits()
        for name, counts in self._counts.items():
            fraction = counts.max(initial=0) / max(self._states, 1)
            if fraction > MAX_FRACTION:
                raise TaskError(
                    f"observation_limits: a number of {name!r} is beyond its limit of "
                    f"{limits.get(name, DEFAULT_LIMIT):g} in {fraction:.0%} of the states, and "
                    "clipped there; scale it, or raise the limit"
                )

"""Worlds that wait after the end of their episode while the other worlds are stepped."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats
from rsoccer.controllers import PolicyGroup
from rsoccer.matches.outcome import Outcome
from rsoccer.play import Play
from rsoccer.task import Task


class PausedWorlds:
    """A copy of the worlds that must not change during a step."""

    def __init__(
        self,
        worlds: NDArray[np.intp],
        play: Play,
        groups: Sequence[PolicyGroup],
        observations: Floats,
    ) -> None:
        """Copy all that a step may change in some worlds.

        Args:
            worlds: (k,) indices of the worlds.
            play: state of all worlds; `restore` writes into it.
            groups: policies with their memory and streams; `restore` writes into them.
            observations: (n, observers, o) current observations.
        """
        self._worlds, self._play, self._groups = worlds, play, groups
        self._saved_play = play.take(worlds)
        self._saved_groups = [group.take(worlds) for group in groups]
        self._observations = observations[worlds]

    def restore(self, task: Task, observations: Floats, outcome: Outcome) -> None:
        """Undo the step in the paused worlds, and in their part of its outcome.

        Rewards and ends become 0, and metrics those of the episode that ended.

        Args:
            task: the task.
            observations: (n, observers, o) observations after the step; changed in place.
            outcome: outcome of the step; changed in place.
        """
        observations[self._worlds] = self._observations
        self._play.put(self._worlds, self._saved_play)
        self._play.events.forget(self._worlds)
        for group, saved in zip(self._groups, self._saved_groups, strict=True):
            group.put(self._worlds, saved)
        for array in (outcome.rewards, outcome.terminated, outcome.truncated):
            array[self._worlds] = 0
        for term in outcome.terms.values():
            term[self._worlds] = 0.0
        for name, value in task.metrics(self._saved_play).items():
            outcome.metrics[name][self._worlds] = value

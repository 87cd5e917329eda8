"""Results of one step of many matches."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Doubles, Floats, Mask


@dataclass(frozen=True)
class Episodes:
    """Statistics of the k episodes that ended in one step."""

    worlds: NDArray[np.intp]
    """(k,) indices of their worlds, in ascending order."""
    lengths: NDArray[np.int64]
    """(k,) control steps."""
    returns: Doubles
    """(k, agents) sums of each agent's rewards."""
    terminated: Mask
    """(k,) True where the task ended the episode, False at the time limit."""
    metrics: dict[str, Floats]
    """(k,) metrics of the task by name."""

    def info(self, index: int = 0) -> dict[str, float]:
        """Return the metrics of one of the episodes, and its length as `steps`.

        Args:
            index: index of the episode, 0 to k - 1.
        """
        metrics = {name: float(values[index]) for name, values in self.metrics.items()}
        return {**metrics, "steps": float(self.lengths[index])}


@dataclass
class Outcome:
    """Results of a step for the agents. All arrays belong to the caller."""

    observations: Floats
    """(n, agents, o) observations for the next action; of the new episode where one began."""
    final_observations: Floats
    """(n, agents, o) last observations of the old episode where one began, equal elsewhere.

    The same array as `observations` where no episode began."""
    rewards: Floats
    """(n, agents) sums of the reward terms."""
    terms: dict[str, Floats]
    """(n, agents) weighted reward terms by name."""
    terminated: Mask
    """(n,) the task ended the episode: there is no future to value."""
    truncated: Mask
    """(n,) the time limit ended the episode: the future exists but is not played."""
    metrics: dict[str, Floats]
    """(n,) metrics of the task by name; valid where the episode ended."""
    episodes: Episodes | None = None
    """Statistics of the episodes that ended in this step; None where none ended."""

    @property
    def ended(self) -> Mask:
        """(n,) whether the episode is over, terminated or truncated."""
        return self.terminated | self.truncated

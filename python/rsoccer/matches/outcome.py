"""Results of one step of many matches."""

from dataclasses import dataclass

from rsoccer.arrays import Floats, Mask


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

    @property
    def ended(self) -> Mask:
        """(n,) whether the episode is over, terminated or truncated."""
        return self.terminated | self.truncated

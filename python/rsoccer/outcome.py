"""What a step of many matches led to."""

from dataclasses import dataclass

from rsoccer.frame import Floats, Mask


@dataclass
class Outcome:
    """What a step led to, for the robots that learn. Every array is the receiver's own."""

    observations: Floats  # (n, agents, o) to act upon next; of the new episode where one began
    # (n, agents, o) of the old episode there, equal elsewhere; where none began, the same array.
    final_observations: Floats
    rewards: Floats  # (n, agents) sum of the terms
    terms: dict[str, Floats]  # (n, agents) weighted parts of the reward
    terminated: Mask  # (n,) the task ended the episode: nothing comes after
    truncated: Mask  # (n,) the clock ended it: what comes after is merely not played
    metrics: dict[str, Floats]  # (n,) the task's facts; meant where the episode ended

    @property
    def ended(self) -> Mask:
        """(n,) whether the episode is over, for either reason."""
        return self.terminated | self.truncated

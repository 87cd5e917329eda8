"""White noise: each action drawn afresh."""

from typing import Literal

from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.rng import WorldRng


class Uniform(Policy):
    """Every action is drawn evenly from [-1, 1] in each step."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) drawn from [-1, 1]."""
        return rng.uniform(-1.0, 1.0, seen.shape[1:])

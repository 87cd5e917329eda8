"""Robots that stand still: the least that a policy must beat."""

from typing import Literal

import numpy as np

from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.rng import WorldRng


class Zero(Policy):
    """Every action is zero."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) of zeros."""
        return np.zeros(seen.shape, np.float32)

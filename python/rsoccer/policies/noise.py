"""Policies that ignore the game: zero actions, uniform noise, Ornstein-Uhlenbeck noise."""

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.rng import WorldRng


class Zero(Policy):
    """Zero actions. The robots stand still."""

    observes: Observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return zeros, (n, robots, action)."""
        return np.zeros(inputs.action_shape, np.float32)


class Uniform(Policy):
    """Actions drawn uniformly from [-1, 1], independent in each step."""

    observes: Observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Draw actions (n, robots, action) from [-1, 1]."""
        return rng.uniform(-1.0, 1.0, inputs.action_shape[1:])


class OrnsteinUhlenbeck(Policy):
    """Ornstein-Uhlenbeck noise: a random walk that is pulled toward zero.

    The default parameters are those of rSoccer's VSSS environment. Their stationary standard
    deviation is sigma / sqrt(2 theta) = 0.86: actions change slowly and are often near -1 or 1, so
    robots drive long arcs.
    """

    observes: Observes = "nothing"

    def __init__(self, theta: float = 0.17, sigma: float = 0.5, time_step: float = 0.025) -> None:
        """Set the parameters of the process.

        Args:
            theta: rate of the pull toward zero, 1/s.
            sigma: strength of the noise, 1/sqrt(s).
            time_step: duration of a control step, s.
        """
        self._keep = np.float32(1.0 - theta * time_step)
        self._noise = np.float32(sigma * time_step**0.5)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return `walk` (n, robots, action), the state of the process; it starts at zero."""
        return {"walk": np.zeros(shape, np.float32)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Advance the process one step; the actions are clipped, its state is not."""
        walk = memory["walk"]
        walk *= self._keep
        walk += self._noise * rng.normal(inputs.action_shape[1:])
        return np.minimum(np.maximum(walk, -1.0), 1.0)

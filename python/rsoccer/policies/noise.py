"""Policies that ignore the game: standing still, white noise, Ornstein-Uhlenbeck noise."""

from typing import Literal

import numpy as np

from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng


class Zero(Policy):
    """Every action is zero."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) of zeros."""
        return np.zeros(inputs.action_shape, np.float32)


class Uniform(Policy):
    """Every action is drawn evenly from [-1, 1] in each step."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) drawn from [-1, 1]."""
        return rng.uniform(-1.0, 1.0, inputs.action_shape[1:])


class OrnsteinUhlenbeck(Policy):
    """A random walk with a pull to zero; its long-run deviation is sigma / sqrt(2 theta) = 0.86.

    Its numbers are those of rSoccer's VSSS environment. At them it is a slow drift near full
    speed, so a robot draws long arcs.
    """

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def __init__(self, theta: float = 0.17, sigma: float = 0.5, time_step: float = 0.025) -> None:
        """`theta` is the pull (1/s), `sigma` the noise (1/sqrt(s)), `time_step` in seconds."""
        self._keep = np.float32(1.0 - theta * time_step)
        self._noise = np.float32(sigma * time_step**0.5)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Where the walk is (n, robots, action); it starts at rest."""
        return {"walk": np.zeros(shape, np.float32)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """One step of the walk, (n, robots, action); only what it tells the robot is clipped."""
        walk = memory["walk"]
        walk *= self._keep
        walk += self._noise * rng.normal(inputs.action_shape[1:])
        return np.minimum(np.maximum(walk, -1.0), 1.0)

"""Decisions of the current policy, in parts of the robots on several threads."""

from __future__ import annotations

from typing import Final

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Floats
from rsoccer.train.network.actor_critic import OBSERVATION_CLIP
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.rollout.running_mean_std import RunningMeanStd

ALONE: Final = 256
"""Most rows that one thread decides alone: with more, another one is worth its waking."""


class Acting:
    """Normalizes observations and draws actions; `begin` begins a rollout."""

    def __init__(
        self, evaluator: Evaluator, obs_rms: RunningMeanStd, generator: torch.Generator
    ) -> None:
        """Prepare the policy.

        Args:
            evaluator: evaluates the policy that acts.
            obs_rms: running mean and standard deviation of the observations.
            generator: draws actions.
        """
        self._evaluator, self._obs_rms, self._generator = evaluator, obs_rms, generator
        mask = evaluator.model.mask.numpy()
        self._mask = None if mask.all() else mask
        self.begin()

    def begin(self) -> None:
        """Take over the statistics and the spread of the policy, which stay during a rollout."""
        self._mean_std = self._obs_rms.as_float32()
        self._std = self._evaluator.model.log_std.exp()

    @torch.no_grad()
    def decide(
        self, observations: Floats, normalized: Tensor, means: Tensor, actions: Tensor
    ) -> None:
        """Draw an action for each robot.

        Args:
            observations: (robots, o) observations.
            normalized: (robots, o), which gets the normalized observations.
            means: (robots, action), which gets the mean actions.
            actions: (robots, action), which gets the actions, not clipped.
        """
        noise = torch.randn(actions.shape, generator=self._generator).mul_(self._std)

        def decide(part: slice, thread: int) -> None:
            inputs = normalized[part]
            self._normalize(observations[part], inputs)
            means[part] = self._evaluator.actor(thread).outputs(inputs)

        self._evaluator.each_part(len(observations), decide, ALONE)
        torch.add(means, noise, out=actions)

    def normalized(self, observations: Floats) -> Tensor:
        """Return normalized observations, (..., o).

        Args:
            observations: (..., o) observations.
        """
        result = torch.empty(observations.shape)
        self._normalize(observations, result)
        return result

    def _normalize(self, observations: Floats, out: Tensor) -> None:
        """Write normalized observations."""
        (mean, std), array = self._mean_std, out.numpy()
        np.subtract(observations, mean, out=array)
        np.divide(array, std, out=array)
        np.clip(array, -OBSERVATION_CLIP, OBSERVATION_CLIP, out=array)
        if self._mask is not None:
            np.multiply(array, self._mask, out=array)

"""Decisions of the current policy, in parts of the robots on several threads."""

from __future__ import annotations

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Floats
from rsoccer.train.network.actor_critic import OBSERVATION_CLIP
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.rollout.running_mean_std import RunningMeanStd


class Acting:
    """Normalizes observations and draws actions."""

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

    @torch.no_grad()
    def decide(
        self, observations: Floats, normalized: Tensor, actions: Tensor, log_probs: Tensor
    ) -> None:
        """Draw an action for each robot.

        Args:
            observations: (robots, o) observations.
            normalized: (robots, o), which gets the normalized observations.
            actions: (robots, action), which gets the actions, not clipped.
            log_probs: (robots,), which gets their log densities.
        """
        model, mean_std = self._evaluator.model, self._obs_rms.as_float32()
        noise = torch.randn(actions.shape, generator=self._generator)
        noise.mul_(model.log_std.exp())

        def decide(part: slice, thread: int) -> None:
            self._normalize(observations[part], normalized[part], mean_std)
            mean = self._evaluator.actor(thread).outputs(normalized[part])
            torch.add(mean, noise[part], out=actions[part])
            log_probs[part] = model.log_prob(mean, actions[part])

        self._evaluator.each_part(len(observations), decide)

    def normalized(self, observations: Floats) -> Tensor:
        """Return normalized observations, (..., o).

        Args:
            observations: (..., o) observations.
        """
        result = torch.empty(observations.shape)
        self._normalize(observations, result, self._obs_rms.as_float32())
        return result

    def _normalize(
        self, observations: Floats, out: Tensor, mean_std: tuple[Floats, Floats]
    ) -> None:
        """Write normalized observations."""
        (mean, std), array = mean_std, out.numpy()
        np.subtract(observations, mean, out=array)
        np.divide(array, std, out=array)
        np.clip(array, -OBSERVATION_CLIP, OBSERVATION_CLIP, out=array)
        if self._mask is not None:
            np.multiply(array, self._mask, out=array)

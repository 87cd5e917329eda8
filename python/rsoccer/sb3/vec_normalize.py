"""Normalized rows: `VecNormalize` with compiled statistics."""

from __future__ import annotations

import math

import numpy as np
from stable_baselines3.common.vec_env import VecNormalize

from rsoccer._core import add_rewards, normalized, pooled_moments
from rsoccer.arrays import Floats, Mask
from rsoccer.sb3.vec_env import Info


class SoccerVecNormalize(VecNormalize):  # type: ignore[misc]
    """`VecNormalize` of Stable-Baselines3 with statistics in compiled code.

    Arguments, attributes and methods are those of `VecNormalize`. Statistics equal its own within
    rounding: sums are in float64.
    Observations are vectors (o,) float32, such as those of `SoccerVecEnv`.

    `VecNormalize.load` restores an object of the class that `save` wrote; files of this class need
    rsoccer.

    Example:
        >>> from rsoccer.sb3 import SoccerVecEnv, SoccerVecNormalize  # doctest: +SKIP
        >>> envs = SoccerVecNormalize(SoccerVecEnv("VSS-v0", worlds=64))  # doctest: +SKIP
        >>> envs.save("statistics")  # doctest: +SKIP
    """

    def _sanity_checks(self) -> None:
        """Refuse observations that are no vectors of float32."""
        super()._sanity_checks()
        space = self.observation_space
        if space.dtype != np.float32 or space.shape is None or len(space.shape) != 1:
            raise ValueError(f"observation_space: expected Box (o,) float32, got {space}")

    def step_wait(self) -> tuple[Floats, Floats, Mask, list[Info]]:
        """Advance all rows by one step, and normalize the results.

        Returns:
            Observations (rows, o) float32 and rewards (rows,) float32, both normalized, ends
            (rows,) bool and an info for each row, in which terminal observations are normalized.
        """
        observations, rewards, ends, infos = self.venv.step_wait()
        self.old_obs, self.old_reward = observations, rewards
        if self.training:
            if self.norm_obs:
                moments = self.obs_rms
                moments.mean, moments.var = pooled_moments(
                    observations, moments.mean, moments.var, moments.count
                )
                moments.count += len(observations)
            self._update_reward(rewards)
        if np.count_nonzero(ends):
            for row in np.flatnonzero(ends).tolist():
                if (last := infos[row].get("terminal_observation")) is not None:
                    infos[row]["terminal_observation"] = self.normalize_obs(last)
            self.returns[ends] = 0
        return self.normalize_obs(observations), self.normalize_reward(rewards), ends, infos

    def _update_reward(self, reward: Floats) -> None:
        """Add the discounted returns to their statistics."""
        moments = self.ret_rms
        moments.mean, moments.var = add_rewards(
            self.returns, reward, self.gamma, moments.mean, moments.var, moments.count
        )
        moments.count += len(reward)

    def normalize_reward(self, reward: Floats) -> Floats:
        """Return normalized rewards, without an update of the statistics.

        Args:
            reward: rewards (rows,) float32.

        Returns:
            A new array (rows,) float32, within -`clip_reward` to `clip_reward`.
        """
        if not self.norm_reward:
            return reward.copy()
        scaled: Floats = reward / math.sqrt(self.ret_rms.var + self.epsilon)
        limit = self.clip_reward
        np.maximum(scaled, -limit, out=scaled)
        return np.minimum(scaled, limit, out=scaled)

    def normalize_obs(self, obs: Floats) -> Floats:
        """Return normalized observations, without an update of the statistics.

        Args:
            obs: observations (rows, o) or (o,) float32.

        Returns:
            A new array of the same shape, float32, within -`clip_obs` to `clip_obs`.
        """
        if not self.norm_obs:
            return obs.copy()
        mean, variance = self.obs_rms.mean, self.obs_rms.var
        rows = obs.reshape(-1, obs.shape[-1])
        rows = normalized(rows, mean, variance, self.epsilon, self.clip_obs)
        return rows.reshape(obs.shape)

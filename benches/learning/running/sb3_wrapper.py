"""Action repeat and masked observations for the vector environment of Stable-Baselines3."""

from __future__ import annotations

from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv, VecEnvWrapper

from rsoccer.arrays import Floats, Mask


class ActionRepeat(VecEnvWrapper):  # type: ignore[misc]
    """Holds every action for some control steps.

    The reward of a decision is the discounted sum over its steps. A match that ends within a
    decision has begun its next episode; its robots stand still for the rest of the decision, and
    these steps give no reward.
    """

    def __init__(self, envs: VecEnv, action_repeat: int, gamma: float) -> None:
        """Wrap environments.

        Args:
            envs: The environments.
            action_repeat: Control steps per decision, at least 1.
            gamma: Discount factor per control step.
        """
        super().__init__(envs)
        self.action_repeat, self.gamma = action_repeat, gamma
        self._actions = np.zeros((self.num_envs, *self.action_space.shape), np.float32)

    def reset(self) -> Floats:
        """Begin new episodes."""
        observations: Floats = self.venv.reset()
        return observations

    def step_async(self, actions: Floats) -> None:
        """Store the actions of a decision."""
        self._actions = np.array(actions, np.float32)

    def step_wait(self) -> tuple[Floats, Floats, Mask, list[dict[str, Any]]]:
        """Play one decision."""
        total = np.zeros(self.num_envs, np.float32)
        ended = np.zeros(self.num_envs, np.bool_)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for step in range(self.action_repeat):
            observations, rewards, ends, new = self.venv.step(self._actions)
            total += np.where(ended, 0.0, rewards) * self.gamma**step
            for row in np.flatnonzero(ends & ~ended):
                infos[row] = new[row]
            ended |= ends
            self._actions[ended] = 0.0
        return observations, total, ended, infos


class MaskedObservations(VecEnvWrapper):  # type: ignore[misc]
    """Sets some numbers of every observation to 0."""

    def __init__(self, envs: VecEnv, mask: Floats) -> None:
        """Wrap environments.

        Args:
            envs: The environments.
            mask: (o,) 0 for the numbers that become 0, 1 for others.
        """
        super().__init__(envs)
        self._mask = mask

    def reset(self) -> Floats:
        """Begin new episodes."""
        observations: Floats = self.venv.reset()
        return observations * self._mask

    def step_wait(self) -> tuple[Floats, Floats, Mask, list[dict[str, Any]]]:
        """Play one control step; final observations are masked, too."""
        observations, rewards, ended, infos = self.venv.step_wait()
        for row in np.flatnonzero(ended):
            infos[row]["terminal_observation"] = infos[row]["terminal_observation"] * self._mask
        return observations * self._mask, rewards, ended, infos

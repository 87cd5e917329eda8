"""Environments that do nothing but hand over zeros: none of their shape is faster."""

from typing import Any

import gymnasium
import numpy as np
from pettingzoo import ParallelEnv

from rsoccer.frame import Floats

Bools = dict[str, bool]
Infos = dict[str, Any]


class EmptyParallelEnv(ParallelEnv[str, Floats, Floats]):
    """Nothing but the dictionaries that PettingZoo asks for."""

    def __init__(self, like: ParallelEnv[str, Floats, Floats]) -> None:
        """Have the agents and spaces of another env."""
        self.possible_agents = like.possible_agents
        self._like = like
        self._shape = like.observation_space(like.possible_agents[0]).shape or ()

    def observation_space(self, agent: str) -> gymnasium.Space[Any]:
        """The other env's."""
        return self._like.observation_space(agent)

    def action_space(self, agent: str) -> gymnasium.Space[Any]:
        """The other env's."""
        return self._like.action_space(agent)

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats], Infos]:
        """Zeros."""
        self.agents = list(self.possible_agents)
        return self._zeros(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, Floats]
    ) -> tuple[dict[str, Floats], dict[str, float], Bools, Bools, Infos]:
        """Zeros."""
        agents = self.agents
        return (
            self._zeros(),
            dict.fromkeys(agents, 0.0),
            dict.fromkeys(agents, False),
            dict.fromkeys(agents, False),
            {agent: {} for agent in agents},
        )

    def _zeros(self) -> dict[str, Floats]:
        return {agent: np.zeros(self._shape, np.float32) for agent in self.agents}


class EmptyEnv(gymnasium.Env[Floats, Any]):
    """Nothing but what Gymnasium asks for."""

    def __init__(self, like: gymnasium.Env[Floats, Any]) -> None:
        """Have the spaces of another env."""
        self.observation_space, self.action_space = like.observation_space, like.action_space
        self._shape = like.observation_space.shape or ()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, Infos]:
        """Zeros."""
        return np.zeros(self._shape, np.float32), {}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, Infos]:
        """Zeros."""
        return np.zeros(self._shape, np.float32), 0.0, False, False, {}

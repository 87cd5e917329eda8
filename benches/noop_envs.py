"""No-op environments that return zeros: an upper bound of speed for an interface."""

from typing import Any

import gymnasium
import numpy as np
from pettingzoo import ParallelEnv

from rsoccer.arrays import Floats

Bools = dict[str, bool]
Infos = dict[str, Any]


class NoOpParallelEnv(ParallelEnv[str, Floats, Floats]):
    """PettingZoo environment that returns zeros in dictionaries by agent."""

    def __init__(self, template: ParallelEnv[str, Floats, Floats]) -> None:
        """Copy agents and spaces of another environment."""
        self.possible_agents = template.possible_agents
        self._template = template
        self._shape = template.observation_space(template.possible_agents[0]).shape or ()

    def observation_space(self, agent: str) -> gymnasium.Space[Any]:
        """Return the space of the other environment."""
        return self._template.observation_space(agent)

    def action_space(self, agent: str) -> gymnasium.Space[Any]:
        """Return the space of the other environment."""
        return self._template.action_space(agent)

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats], Infos]:
        """Return zeros."""
        self.agents = list(self.possible_agents)
        return self._zeros(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, Floats]
    ) -> tuple[dict[str, Floats], dict[str, float], Bools, Bools, Infos]:
        """Return zeros."""
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


class NoOpEnv(gymnasium.Env[Floats, Any]):
    """Gymnasium environment that returns zeros."""

    def __init__(self, template: gymnasium.Env[Floats, Any]) -> None:
        """Copy the spaces of another environment."""
        self.observation_space, self.action_space = (
            template.observation_space,
            template.action_space,
        )
        self._shape = template.observation_space.shape or ()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, Infos]:
        """Return zeros."""
        return np.zeros(self._shape, np.float32), {}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, Infos]:
        """Return zeros."""
        return np.zeros(self._shape, np.float32), 0.0, False, False, {}

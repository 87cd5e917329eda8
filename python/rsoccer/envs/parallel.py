"""One match for PettingZoo: dictionaries by robot name, all robots at once or one after another.

>>> import rsoccer
>>> env = rsoccer.parallel_env("VSSSelfPlay-v0")
>>> observations, infos = env.reset(seed=0)
>>> while env.agents:
...     actions = {agent: env.action_space(agent).sample() for agent in env.agents}
...     observations, rewards, terminations, truncations, infos = env.step(actions)
"""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from pettingzoo import AECEnv, ParallelEnv
from pettingzoo.utils.conversions import parallel_to_aec_wrapper
from pettingzoo.utils.wrappers import OrderEnforcingWrapper

from rsoccer.controllers import Controllers
from rsoccer.envs import agent_dicts, spaces
from rsoccer.envs.env_matches import EnvMatches, episode_info
from rsoccer.envs.options import reset_options, starts, timed
from rsoccer.envs.spaces import ActionSpace
from rsoccer.envs.viewer import Image, Viewer, metadata
from rsoccer.frame import Floats
from rsoccer.global_state import LIMIT, StateEncoder
from rsoccer.registry import make_task
from rsoccer.task import Task

Infos = dict[str, dict[str, Any]]


def parallel_env(
    name: str,
    render_mode: str | None = None,
    *,
    controllers: Controllers | None = None,
    max_cycles: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> SoccerParallelEnv:
    """A registered task as a PettingZoo ParallelEnv; `options` are the task's own.

    `controllers` names drivers for robots that shall not learn, as for `Matches`; `max_cycles`
    is PettingZoo's word for the task's `max_steps`.
    """
    if max_cycles is not None:
        options["max_steps"] = max_cycles
    return SoccerParallelEnv(make_task(name, **options), render_mode, controllers=controllers)


def env(
    name: str,
    render_mode: str | None = None,
    **options: Any,  # noqa: ANN401  (those of parallel_env)
) -> AECEnv[str, Floats, Floats | None]:
    """The same match for PettingZoo's turn-by-turn API (AEC): agents act one after another."""
    return OrderEnforcingWrapper(Turns(parallel_env(name, render_mode, **options)))


class Turns(parallel_to_aec_wrapper[str, Floats, Any]):
    """Agents act one after another; the match moves once all have chosen."""

    def __init__(self, match: SoccerParallelEnv) -> None:
        """Play this match."""
        super().__init__(match)
        self._match = match

    def step(self, action: Any) -> None:  # noqa: ANN401  (whatever the agent's space holds)
        """The agent whose turn it is chooses, unless the match was closed."""
        self._match.expect_open("step")
        super().step(action)


class SoccerParallelEnv(ParallelEnv[str, Floats, Any]):
    """One match of a task; everything in and out is a dictionary by robot name.

    All agents play from `reset` until the episode ends for all of them in one step: by
    termination (a goal) or by truncation (the clock), never some by one and some by the other.

    Infos are empty. Trainers turn what they find in the infos of a reset into a fixed set of
    numbers that every later step must repeat, which metrics of an ended match cannot; these are in
    `last_metrics` instead.
    """

    def __init__(
        self,
        task: Task,
        render_mode: str | None = None,
        *,
        controllers: Controllers | None = None,
    ) -> None:
        """A match that `reset` will begin; `render_mode` is "human", "rgb_array" or None."""
        self._viewer = Viewer(render_mode, task)
        self.render_mode = render_mode
        self.last_metrics: dict[str, float] = {}
        """Facts of the last episode that ended, such as goal_score and steps; empty before."""
        # Seeded anywhere, so that two environments that nobody seeds do not play the same match.
        self._matches = EnvMatches(
            task, 1, secrets.randbits(63), controllers=controllers, autoreset="disabled"
        )
        self.agents: list[str] = []
        self.possible_agents = list(self._matches.agents)
        if not self.possible_agents:
            raise ValueError("controllers: at least one robot must learn; Matches does without")
        self.metadata = metadata(task) | {"is_parallelizable": True}
        # A space for each agent: seeding one agent's samples must not seed another's.
        agents = self.possible_agents
        self._observation_spaces = {agent: spaces.observation_space(task) for agent in agents}
        self._action_spaces = {agent: spaces.action_space(task) for agent in agents}
        self._scale = StateEncoder(task.config)
        self.state_space = Box(-LIMIT, LIMIT, (self._scale.size,))

    @property
    def task(self) -> Task:
        """The task that is played."""
        return self._matches.task

    @property
    def max_cycles(self) -> int:
        """Steps after which the clock ends an episode; can be set, as PettingZoo's tests do."""
        return self.task.max_steps

    @max_cycles.setter
    def max_cycles(self, limit: int) -> None:
        self._matches.task = timed(self.task, "max_cycles", limit)

    def observation_space(self, agent: str) -> Box[np.float32]:
        """Bounds of what the agent sees, (o,) float32."""
        return self._observation_spaces[agent]

    def action_space(self, agent: str) -> ActionSpace:
        """What the agent does: (action,) float32 in [-1, 1], or a choice of a discrete task."""
        return self._action_spaces[agent]

    def state(self) -> Floats:
        """The whole game, absolute, (state,) float32: for critics that may see everything."""
        state: Floats = self._scale.encode(self._matches.frame.rows)[0]
        return state

    @property
    def score(self) -> tuple[int, int]:
        """Goals of blue and of yellow in this match: 0 to 0 until a goal ends it."""
        return self._matches.score()

    @property
    def clock(self) -> float:
        """Seconds played of this match."""
        return self._matches.clock()

    def reset(
        self, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[dict[str, Floats], Infos]:
        """Begin an episode; the same seed gives the same one, whatever was played before.

        Without a seed the random streams go on. `options["frame"]` is a row (row,) to start from
        in place of the task's own starts, laid out as `Frame.rows`; other options are left to
        whoever else may read them.
        """
        self.expect_open("reset")
        row = starts(reset_options(options), self.task, np.ones(1, np.bool_))
        observations = self._matches.reset(seed, rows=row)
        self.agents = self.possible_agents.copy()
        if self.render_mode == "human":
            self.render()
        return agent_dicts.split(self.possible_agents, observations), self._no_infos()

    def step(
        self, actions: Mapping[str, Any]
    ) -> tuple[dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], Infos]:
        """All agents act for one control step; actions beyond [-1, 1] count as the bound."""
        self.expect_open("step")
        self._matches.check_turn()
        try:
            outcome = self._matches.step(agent_dicts.stack(actions, self.agents, self.task))
        except (LookupError, TypeError, ValueError):
            agent_dicts.name_fault(actions, self.agents, self.task)
            raise
        terminated, truncated = bool(outcome.terminated[0]), bool(outcome.truncated[0])
        if terminated or truncated:
            self.agents = []
            self.last_metrics = episode_info(outcome, self._matches)
        if self.render_mode == "human":
            self.render()
        return (
            agent_dicts.split(self.possible_agents, outcome.observations),
            dict(zip(self.possible_agents, outcome.rewards[0].tolist(), strict=True)),
            dict.fromkeys(self.possible_agents, terminated),
            dict.fromkeys(self.possible_agents, truncated),
            self._no_infos(),
        )

    def _no_infos(self) -> Infos:
        return {agent: {} for agent in self.possible_agents}

    def expect_open(self, call: str) -> None:
        """ClosedEnvironmentError for a call that comes after `close`."""
        self._viewer.expect_open(call)

    def render(self) -> Image | None:
        """The match as an image (height, width, 3), or in a window."""
        return self._viewer.show(self._matches)

    def close(self) -> None:
        """End its use: `reset`, `step` and `render` raise ClosedEnvironmentError from now on.

        A window closes too. May be repeated.
        """
        self._viewer.close()

"""One match for PettingZoo as a ParallelEnv: all agents act at once.

>>> import rsoccer
>>> env = rsoccer.parallel_env("VSSSelfPlay-v0")
>>> observations, infos = env.reset(seed=0)
>>> while env.agents:
...     actions = {agent: env.action_space(agent).sample() for agent in env.agents}
...     observations, rewards, terminations, truncations, infos = env.step(actions)
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from gymnasium.spaces import Box
from pettingzoo import ParallelEnv

from rsoccer import checks, spaces
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.envs import agent_dicts
from rsoccer.envs.env_matches import EnvMatches, PublicMatches
from rsoccer.envs.options import initial_rows, require_learners, reset_options
from rsoccer.envs.viewer import ViewedMatch, Viewer, metadata
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task, with_max_steps
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.spaces import ActionSpace
from rsoccer.task import Task

Infos = dict[str, dict[str, Any]]
TESTED_OPTION: Final = "options"
"""Key that a reset ignores: PettingZoo's `api_test` and `parallel_api_test` reset with it, to see
that environments take options."""


def parallel_env(
    task: Task | str,
    render_mode: str | None = None,
    *,
    controllers: Controllers | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
    history: int = 1,
    max_steps: int | None = None,
    max_cycles: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> SoccerParallelEnv:
    """Return a task as a PettingZoo ParallelEnv: one match, all agents act at once.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        render_mode: "rgb_array" for images from `render`, "human" for a window that `reset` and
            `step` update, or None for no rendering.
        controllers: policies of robots that do not learn, by robot ("blue_0"), team ("blue") or
            "all": a policy, its name or its file; `LEARN` makes a robot an agent. The task's
            defaults apply elsewhere.
        simulator: moves the robots, as for `Matches`. With a simulator itself the environment
            cannot be copied.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.
        history: observations in a stacked one, as for `Matches`.
        max_steps: time limit of an episode in control steps, at least 1; None for the task's own.
        max_cycles: the same by PettingZoo's name; it takes precedence.
        **options: options of a registered task, the fields of its class.

    Returns:
        An environment to `reset`. `SoccerParallelEnv` describes spaces, infos and ends.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
            object.
        ValueError: an unknown task, controller or render mode, a value out of range, or no
            robot that learns.

    Example:
        >>> import rsoccer
        >>> env = rsoccer.parallel_env("VSSSelfPlay-v0", controllers={"yellow": "ou"})
        >>> env.possible_agents
        ['blue_0', 'blue_1', 'blue_2']
    """
    limit = ("max_steps", max_steps) if max_cycles is None else ("max_cycles", max_cycles)
    task = resolve_task(task, limit[1], options, parallel_env, limit[0])
    return SoccerParallelEnv(
        task,
        render_mode,
        controllers=controllers,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
        history=history,
    )


class SoccerParallelEnv(ViewedMatch, PublicMatches, ParallelEnv[str, Floats, Any]):
    """One match of a task as a PettingZoo ParallelEnv; arguments and results are by agent name.

    Spaces: observations are Box (o,) float32. Actions are Box (action,) float32 from -1 to 1;
    values beyond are clipped. Tasks with an `action_table` have Discrete actions instead.

    Ends: all agents play from `reset` until the episode ends for all of them in the same step, by
    termination (the task's end, such as a goal) or by truncation (the time limit). `agents` is
    empty from then on, until the next `reset`.

    Infos: one dictionary per agent, empty except in the last step of an episode. Then each holds
    the task's metrics, such as `goal_score`, and `steps`, as floats; and `TimeLimit.truncated`,
    from which Stable-Baselines3 (through SuperSuit) concludes that the value of the last
    observation is to be bootstrapped. `last_metrics` keeps the metrics.

    Seeding: `reset(seed=s)` begins the same episode in every environment of the same task, whatever
    was played before. Without a seed the random streams continue; those of a new environment begin
    with a seed from the operating system. The sampling of each agent's action space has a seed of
    its own: `env.action_space(agent).seed(s)`.

    Rendering: `render_mode` is None, "rgb_array" (`render` returns an image) or "human" (`reset`
    and `step` draw into a window).

    Copies by `copy.deepcopy` or `pickle` continue with the same future; copies of an environment
    that was never reset begin with random seeds of their own.

    Attributes:
        agents: names of the agents that act in the next step; all or none.
        possible_agents: names of all robots that learn, such as "blue_0", blue first.
        render_mode: "human", "rgb_array" or None.
        metadata: `name`, `render_modes`, `render_fps` and `is_parallelizable`.
        last_metrics: metrics of the last episode that ended, such as `goal_score`, and its
            `steps`; empty before.
        state_space: Box (state,) float32 of `state`.
    """

    def __init__(
        self,
        task: Task,
        render_mode: str | None = None,
        *,
        controllers: Controllers | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
    ) -> None:
        """Prepare a match; `reset` begins it.

        Args:
            task: the task that is played.
            render_mode: "human", "rgb_array" or None.
            controllers: policies of robots that do not learn, by robot, team or "all", as for
                `parallel_env`.
            simulator: moves the robots, as for `parallel_env`.
            sensing: what robots know of the true state, as for `parallel_env`.
            randomization: numbers that each episode draws, as for `parallel_env`.
            history: observations in a stacked one, as for `parallel_env`.

        Raises:
            TypeError: something that is not a controller.
            ValueError: an unknown render mode or controller, or no robot that learns.
        """
        self._viewer = Viewer(render_mode, task)
        self.render_mode = render_mode
        self.last_metrics: dict[str, float] = {}
        self._matches = EnvMatches(
            task,
            1,
            controllers=controllers,
            autoreset="disabled",
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
        )
        self.agents: list[str] = []
        self.possible_agents = list(self._matches.agents)
        require_learners(self.possible_agents)
        self.metadata = metadata(task) | {"is_parallelizable": True}
        # One space per agent: a seed for one agent's samples must not affect another's.
        agents = self.possible_agents
        self._observation_spaces = {
            agent: spaces.observation_space(task, history) for agent in agents
        }
        self._action_spaces = {agent: spaces.action_space(task) for agent in agents}
        self.state_space = spaces.state_space(task)

    @property
    def task(self) -> Task:
        """Task that is played."""
        return self._matches.task

    @property
    def max_cycles(self) -> int:
        """Time limit of an episode in control steps; can be set, as PettingZoo's tests do."""
        return self.task.max_steps

    @max_cycles.setter
    def max_cycles(self, limit: int) -> None:
        self._matches.task = with_max_steps(self.task, limit, "max_cycles")

    def observation_space(self, agent: str) -> Box[np.float32]:
        """Return the observation space of an agent.

        Args:
            agent: name of the agent.

        Returns:
            Box (o,) float32, always the same object; `task.layout.blocks` names the parts.

        Raises:
            KeyError: an unknown agent.
        """
        return self._observation_spaces[agent]

    def action_space(self, agent: str) -> ActionSpace:
        """Return the action space of an agent.

        Args:
            agent: name of the agent.

        Returns:
            Box (action,) float32 from -1 to 1, or Discrete for tasks with an `action_table`;
            always the same object.

        Raises:
            KeyError: an unknown agent.
        """
        return self._action_spaces[agent]

    def state(self) -> Floats:
        """Return the global state for centralized critics.

        Returns:
            (state,) float32 in `state_space`: ball, blue robots, yellow robots, in absolute
            coordinates, scaled to about 1.
        """
        state: Floats = self._matches.states()[0]
        return state

    @property
    def score(self) -> tuple[int, int]:
        """Goals of blue and of yellow in this episode; 0 and 0 until a goal ends it."""
        return self._matches.score()

    @property
    def clock(self) -> float:
        """Time since the episode began, in seconds."""
        return self._matches.clock()

    def reset(
        self, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[dict[str, Floats], Infos]:
        """Begin an episode.

        Args:
            seed: seed of the episode and of those that follow, at least 0. The same seed gives the
                same episode, whatever was played before. None: the random streams continue.
            options: `options["frame"]` (row,) is an initial state in the layout of a row of
                `Frame.rows`, in place of the task's own.

        Returns:
            Observations (o,) and empty infos by agent name.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            TypeError: a seed or options of the wrong type. Nothing has changed.
            ValueError: a negative seed, an unknown option, or an initial state with a wrong shape
                or with bodies that overlap or are outside. Nothing has changed.
        """
        self.check_open("reset")
        seed = None if seed is None else checks.integer("seed", seed, 0)
        rows = initial_rows(
            reset_options(options, "frame", ignored=(TESTED_OPTION,)),
            self.task,
            np.ones(1, np.bool_),
        )
        observations = self._matches.reset(seed, rows=rows)
        self.agents = self.possible_agents.copy()
        if self.render_mode == "human":
            self.render()
        return agent_dicts.split_by_agent(self.possible_agents, observations), self._empty_infos()

    def step(
        self, actions: Mapping[str, Any]
    ) -> tuple[dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], Infos]:
        """Advance the match by one control step.

        Args:
            actions: action of every agent by name: (action,) floats, clipped to [-1, 1], or an
                index for tasks with an `action_table`.

        Returns:
            Five dictionaries by agent name: observations (o,), rewards (sums of the task's
            terms), terminations, truncations, and infos; those of the last step of an episode
            hold the metrics.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: no episode has begun or it has ended, or the match is inconsistent after
                a failure.
            TypeError: actions of the wrong type. Nothing has changed.
            ValueError: a missing or unknown agent, or an action with a wrong shape or value.
                Nothing has changed.
        """
        self.check_open("step")
        self._matches.check_running()
        try:
            outcome = self._matches.step(agent_dicts.stack_actions(actions, self.agents, self.task))
        except (LookupError, TypeError, ValueError):
            agent_dicts.check_actions(actions, self.agents, self.task)
            raise
        terminated, truncated = bool(outcome.terminated[0]), bool(outcome.truncated[0])
        infos = self._empty_infos()
        if outcome.episodes is not None:
            self.agents = []
            self.last_metrics = outcome.episodes.info()
            for info in infos.values():
                info.update(self.last_metrics)
                info["TimeLimit.truncated"] = truncated
        if self.render_mode == "human":
            self.render()
        return (
            agent_dicts.split_by_agent(self.possible_agents, outcome.observations),
            dict(zip(self.possible_agents, outcome.rewards[0].tolist(), strict=True)),
            dict.fromkeys(self.possible_agents, terminated),
            dict.fromkeys(self.possible_agents, truncated),
            infos,
        )

    def _empty_infos(self) -> Infos:
        return {agent: {} for agent in self.possible_agents}

    def check_open(self, call: str) -> None:
        """Refuse a call after `close`.

        Args:
            call: name of the called method, for the error message.

        Raises:
            ClosedEnvironmentError: the environment is closed.
        """
        self._viewer.check_open(call)

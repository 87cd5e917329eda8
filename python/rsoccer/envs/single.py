"""One match with one learner for Gymnasium; policies control the other robots.

>>> import rsoccer
>>> env = rsoccer.single_env("VSS-v0")
>>> observation, info = env.reset(seed=0)
>>> ended = False
>>> while not ended:
...     action = env.action_space.sample()
...     observation, reward, terminated, truncated, info = env.step(action)
...     ended = terminated or truncated
>>> sorted(info)
['goal_score', 'steps']
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np

from rsoccer import checks, spaces
from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers
from rsoccer.envs.env_matches import EnvMatches, SeededCopies, SingleLearner, random_seed
from rsoccer.envs.options import (
    action_array,
    initial_rows,
    reset_options,
    single_learner_controllers,
)
from rsoccer.envs.viewer import RENDER_MODES, ViewedMatch, Viewer, metadata
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task

Action = Array | np.integer[Any] | int
"""(action,) vector, or an index for tasks with an `action_table`."""
Info = dict[str, Any]


def single_env(
    task: Task | str,
    render_mode: str | None = None,
    *,
    learner: str | None = None,
    controllers: Controllers | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
    history: int = 1,
    max_steps: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> SoccerEnv:
    """Return a task as a Gymnasium Env: one match with one learner.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        render_mode: "rgb_array" for images from `render`, "human" for a window that `reset` and
            `step` update, or None for no rendering.
        learner: the robot that learns, such as "blue_0"; needed for tasks with several learners.
            It takes precedence over `controllers`.
        controllers: policies of the other robots, by robot ("blue_1"), team ("blue") or "all": a
            policy, its name or its file. The task's defaults apply elsewhere, and "ou" in place of
            further learners if `learner` is given.
        simulator: moves the robots, as for `Matches`. With a simulator itself the environment
            cannot be copied.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.
        history: observations in a stacked one, as for `Matches`.
        max_steps: time limit of an episode in control steps, at least 1; None for the task's own.
        **options: options of a registered task, the fields of its class.

    Returns:
        An environment to `reset`. `SoccerEnv` describes spaces, infos and seeding.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
            object.
        ValueError: an unknown task, robot, controller or render mode, a value out of
            range, or not exactly one learner.

    Example:
        >>> import rsoccer
        >>> others = {"blue": "chase", "yellow": "ou"}
        >>> env = rsoccer.single_env("VSSSelfPlay-v0", learner="blue_0", controllers=others)
        >>> env.action_space
        Box(-1.0, 1.0, (2,), float32)
    """
    task = resolve_task(task, max_steps, options, single_env)
    return SoccerEnv(
        task,
        render_mode,
        learner=learner,
        controllers=controllers,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
        history=history,
    )


# `gymnasium.make` reads the modes here, and so offers "rgb_array_list" too.
single_env.metadata = {"render_modes": list(RENDER_MODES)}  # type: ignore[attr-defined]


class SoccerEnv(ViewedMatch, SingleLearner, SeededCopies, gymnasium.Env[Floats, Any]):
    """One match of a task with one learner, as a Gymnasium Env.

    Spaces: observations are Box (o,) float32. Actions are Box (action,) float32 from -1 to 1;
    values beyond are clipped. Tasks with an `action_table` have Discrete actions instead.

    Ends: `terminated` is the task's end of the episode (such as a goal), `truncated` the time
    limit.

    Infos: empty, except for the last step of an episode. The last info holds the task's metrics,
    such as `goal_score`, and `steps`, as floats.

    Seeding: `reset(seed=s)` begins the same episode in every environment of the same task, whatever
    was played before. Without a seed the random streams continue; those of a new environment begin
    with a random seed, `np_random_seed`. The generator `np_random` is not used. The sampling of
    the action space has a seed of its own: `env.action_space.seed(s)`.

    Rendering: `render_mode` is None, "rgb_array" (`render` returns an image) or "human" (`reset`
    and `step` draw into a window).

    Copies by `copy.deepcopy` or `pickle` continue with the same future; copies of an environment
    that was never reset begin with random seeds of their own.

    Attributes:
        observation_space: Box (o,) float32; `task.layout.blocks` names the parts.
        action_space: Box (action,) float32 from -1 to 1, or Discrete.
        render_mode: "human", "rgb_array" or None.
        metadata: `name`, `render_modes` and `render_fps`.
    """

    def __init__(
        self,
        task: Task,
        render_mode: str | None = None,
        *,
        learner: str | None = None,
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
            learner: the robot that learns; needed for tasks with several learners.
            controllers: policies of the other robots, as for `single_env`.
            simulator: moves the robots, as for `single_env`.
            sensing: what robots know of the true state, as for `single_env`.
            randomization: numbers that each episode draws, as for `single_env`.
            history: observations in a stacked one, as for `single_env`.

        Raises:
            TypeError: something that is not a controller.
            ValueError: an unknown render mode, robot or controller, or not exactly one learner.
        """
        self._viewer = Viewer(render_mode, task)
        self.render_mode = render_mode
        self.metadata = metadata(task)
        self._matches = EnvMatches(
            task,
            1,
            random_seed(self),
            controllers=single_learner_controllers(task, learner, controllers),
            autoreset="disabled",
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
        )
        self.observation_space = self._matches.observation_space
        self.action_space = spaces.action_space(task)

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Floats, Info]:
        """Begin an episode.

        Args:
            seed: seed of the episode and of those that follow, at least 0. The same seed gives the
                same episode, whatever was played before. None: the random streams continue.
            options: `options["frame"]` (row,) is an initial state in the layout of a row of
                `Frame.rows`, in place of the task's own.

        Returns:
            Observation (o,) float32 and an empty info.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            TypeError: a seed or options of the wrong type. Nothing has changed.
            ValueError: a negative seed, an unknown option, or an initial state with a wrong shape
                or with bodies that overlap or are outside. Nothing has changed.
        """
        self._viewer.check_open("reset")
        seed = None if seed is None else checks.integer("seed", seed, 0)
        rows = initial_rows(reset_options(options, "frame"), self.task, np.ones(1, np.bool_))
        observations = self._matches.reset(seed, rows=rows)
        super().reset(seed=seed)
        if self.render_mode == "human":
            self.render()
        return observations[0, 0], {}

    def step(self, action: Action) -> tuple[Floats, float, bool, bool, Info]:
        """Advance the match by one control step.

        Args:
            action: (action,) floats, clipped to [-1, 1], or an index for tasks with an
                `action_table`.

        Returns:
            Observation (o,) float32, reward (sum of the task's terms), terminated, truncated and
            info; the info of the last step of an episode holds the metrics and `steps`.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: no episode has begun or it has ended, or the match is inconsistent after
                a failure.
            TypeError: an action of the wrong type. Nothing has changed.
            ValueError: an action with a wrong shape or value. Nothing has changed.
        """
        self._viewer.check_open("step")
        self._matches.check_running()
        vector = action_array(self.task, action, self.action_space)
        outcome = self._matches.step(vector[None, None])
        terminated, truncated = bool(outcome.terminated[0]), bool(outcome.truncated[0])
        info = {} if outcome.episodes is None else outcome.episodes.info()
        if self.render_mode == "human":
            self.render()
        reward = float(outcome.rewards[0, 0])
        return outcome.observations[0, 0], reward, terminated, truncated, info

"""Many matches with one learner each for Gymnasium, stepped together in Rust.

>>> import rsoccer
>>> envs = rsoccer.vector_env("VSS-v0", num_envs=64, threads=2)
>>> observations, infos = envs.reset(seed=0)
>>> for _ in range(10):
...     actions = envs.action_space.sample()
...     observations, rewards, terminations, truncations, infos = envs.step(actions)
>>> observations.shape[0]
64
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.envs import spaces
from rsoccer.envs.env_matches import EnvMatches, SingleLearner
from rsoccer.envs.options import (
    action_array,
    initial_rows,
    reset_options,
    single_learner_controllers,
)
from rsoccer.envs.viewer import Image, Viewer, metadata
from rsoccer.matches import Outcome
from rsoccer.registry import resolve_task
from rsoccer.task import Task

RENDER_MODES = ("rgb_array",)

Infos = dict[str, Any]


def vector_env(
    task: Task | str,
    num_envs: int = 1,
    render_mode: str | None = None,
    *,
    learner: str | None = None,
    controllers: Controllers | None = None,
    threads: int = 1,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    max_steps: int | None = None,
    max_episode_steps: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> SoccerVectorEnv:
    """Return a task as a native Gymnasium VectorEnv: many matches with one learner each.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        num_envs: number of matches, n, at least 1.
        render_mode: "rgb_array" for images of all matches from `render`, or None.
        learner: the robot that learns in every match, such as "blue_0"; needed for tasks with
            several learners. It takes precedence over `controllers`.
        controllers: policies of the other robots, by robot ("blue_1"), team ("blue") or "all": a
            policy, its name or its file. The task's defaults apply elsewhere.
        threads: threads for physics, at least 1. Results do not depend on their number.
        autoreset_mode: reset of a match that ended, as an `AutoresetMode` or by name: "next_step"
            (the next step resets it, ignores its action and pays no reward), "same_step" (within
            the step that ends it) or "disabled" (it waits for `reset`).
        max_steps: time limit of an episode in control steps, at least 1; None for the task's own.
        max_episode_steps: the same by Gymnasium's name, for `gymnasium.make_vec`; `max_steps`
            takes precedence.
        **options: options of a registered task, the fields of its class.

    Returns:
        Environments to `reset`. `SoccerVectorEnv` describes spaces, infos and seeding.

    Raises:
        TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
            object.
        ValueError: an unknown task, robot, controller or mode, a value out of range, or
            not exactly one learner.

    Example:
        >>> import rsoccer
        >>> envs = rsoccer.vector_env("VSS-v0", 4, autoreset_mode="same_step")
        >>> envs.action_space.shape
        (4, 2)
    """
    time_limit = max_episode_steps if max_steps is None else max_steps
    return SoccerVectorEnv(
        resolve_task(task, time_limit, options),
        num_envs,
        render_mode,
        learner=learner,
        controllers=controllers,
        threads=threads,
        autoreset_mode=autoreset_mode,
    )


class SoccerVectorEnv(SingleLearner, VectorEnv[Floats, Array, Array]):
    """n matches of a task with one learner each, as a Gymnasium VectorEnv.

    Spaces: observations are Box (n, o) float32. Actions are Box (n, action) float32 from -1 to 1;
    values beyond are clipped. Tasks with an `action_table` have MultiDiscrete actions (n,).

    Rewards are (n,) float64, `terminations` (the task's end of an episode, such as a goal) and
    `truncations` (the time limit) are (n,) bool.

    Infos: empty, except for steps in which episodes end. Then they hold an array (n,) float64 for
    each metric of the task, such as `goal_score`, and for `steps`; each has a mask (n,) bool under
    the same name with an underscore, such as `_goal_score`. With "same_step" these arrays are
    inside `final_info`, and `final_obs` (n,) holds the last observations (o,) of the episodes that
    ended, None elsewhere; both with masks.

    Seeding: `reset(seed=s)` seeds match i with `s + i`. Match i then equals, bit for bit, a
    `SoccerEnv` with the seed `s + i`. Without a seed the random streams continue; those of a new
    environment begin with a random seed. The sampling of the action space has a seed of its own:
    `envs.action_space.seed(s)`.

    Rendering: `render_mode` is None or "rgb_array" (`render` returns an image of each match).

    Copies by `copy.deepcopy` or `pickle` continue with the same future.

    Attributes:
        num_envs: number of matches, n.
        observation_space: Box (n, o) float32.
        action_space: Box (n, action) float32 from -1 to 1, or MultiDiscrete (n,).
        single_observation_space: Box (o,) float32 of one match; `task.blocks` names the parts.
        single_action_space: Box (action,) float32 or Discrete, of one match.
        autoreset_mode: the `AutoresetMode`, also in `metadata`.
        render_mode: "rgb_array" or None.
        metadata: `name`, `render_modes`, `render_fps` and `autoreset_mode`.
    """

    def __init__(
        self,
        task: Task,
        num_envs: int = 1,
        render_mode: str | None = None,
        *,
        learner: str | None = None,
        controllers: Controllers | None = None,
        threads: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        """Prepare matches; `reset` begins them.

        Args:
            task: the task that is played.
            num_envs: number of matches, n, at least 1.
            render_mode: "rgb_array" or None.
            learner: the robot that learns; needed for tasks with several learners.
            controllers: policies of the other robots, as for `vector_env`.
            threads: threads for physics, at least 1.
            autoreset_mode: reset of a match that ended, as for `vector_env`.

        Raises:
            TypeError: an argument of the wrong type.
            ValueError: an unknown mode, robot or controller, a number out of range, or not
                exactly one learner.
        """
        self._viewer = Viewer(render_mode, task, RENDER_MODES)
        self.render_mode = render_mode
        self.autoreset_mode = _autoreset_mode(autoreset_mode)
        self.metadata = metadata(task, RENDER_MODES) | {"autoreset_mode": self.autoreset_mode}
        self._matches = EnvMatches(
            task,
            num_envs,
            int(self.np_random_seed or 0),  # drawn at random: there is no seed yet
            threads=threads,
            controllers=single_learner_controllers(task, learner, controllers),
            autoreset=self.autoreset_mode.name.lower(),
        )
        self.num_envs = self._matches.worlds
        self.single_observation_space = spaces.observation_space(task)
        self.single_action_space = spaces.action_space(task)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: Mapping[str, Any] | None = None,
    ) -> tuple[Floats, Infos]:
        """Begin episodes.

        Args:
            seed: match i is seeded with `seed + i`, or with `seed[i]`. The same seed gives the
                same episodes, whatever was played before. None: random streams continue, of all
                matches or of those with None.
            options: `options["reset_mask"]` (n,) bool selects the matches to reset, all by
                default. `options["frame"]` is an initial state (row,) for all of them, or (n, row)
                with one for each of the n matches, in the layout of `Frame.rows`, in place of the
                task's own. Other keys are ignored.

        Returns:
            Observations (n, o) float32 of all matches, and empty infos.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a reset of some matches while they are inconsistent after a failure.
            TypeError: a seed or options of the wrong type. Nothing has changed.
            ValueError: a negative seed, a wrong shape, a mask without a match, or an initial state
                with bodies that overlap or are outside. Nothing has changed.
        """
        self._viewer.check_open("reset")
        options = reset_options(options)
        mask = _reset_mask(options, self.num_envs)
        rows = initial_rows(options, self.task, mask)
        observations = self._matches.reset(seed, mask, rows)
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
        elif seed is not None:
            self._np_random_seed = -1  # Gymnasium's value for seeds that one number cannot express
        return observations[:, 0], {}

    def step(self, actions: Array) -> tuple[Floats, Doubles, Mask, Mask, Infos]:
        """Advance all matches by one control step.

        Args:
            actions: (n, action) floats, clipped to [-1, 1], or (n,) indices for tasks with an
                `action_table`.

        Returns:
            Observations (n, o) float32, rewards (n,) float64, terminations (n,), truncations (n,)
            and infos, which hold metrics where episodes ended.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a match has not begun, or has ended and needs a reset ("disabled"), or the
                matches are inconsistent after a failure.
            TypeError: actions of the wrong type. Nothing has changed.
            ValueError: actions with a wrong shape or value. Nothing has changed.
        """
        self._viewer.check_open("step")
        if self.autoreset_mode is AutoresetMode.DISABLED:
            self._matches.check_running()
        vectors = action_array(self.task, actions, self.action_space)
        steps = self._matches.play.steps + 1
        outcome = self._matches.step(vectors[:, None])
        return (
            outcome.observations[:, 0],
            outcome.rewards[:, 0].astype(np.float64),
            outcome.terminated,
            outcome.truncated,
            self._infos(outcome, steps),
        )

    def render(self) -> tuple[Image, ...] | None:
        """Render all matches.

        Returns:
            Images (height, width, 3) uint8, one per match; None without a render mode, which warns.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a match has not begun.
        """
        if self.render_mode is None:
            self._viewer.render(self._matches)
            return None
        return tuple(self._viewer.image(self._matches, world) for world in range(self.num_envs))

    def close_extras(self, **kwargs: Any) -> None:  # noqa: ANN401  (Gymnasium's own)
        """Refuse later calls: `reset`, `step` and `render` raise `ClosedEnvironmentError`.

        Args:
            **kwargs: ignored.
        """
        self._viewer.close()

    def _infos(self, outcome: Outcome, steps: NDArray[np.int64]) -> Infos:
        """Metrics and steps of the matches that have ended, in Gymnasium's form."""
        ended = outcome.ended
        if not ended.any():
            return {}
        metrics = {name: value.astype(np.float64) for name, value in outcome.metrics.items()}
        metrics["steps"] = steps.astype(np.float64)
        infos = _with_masks({name: np.where(ended, metrics[name], 0.0) for name in metrics}, ended)
        if self.autoreset_mode is not AutoresetMode.SAME_STEP:
            return infos
        last = np.full(self.num_envs, None, np.object_)
        for world in np.flatnonzero(ended):
            last[world] = outcome.final_observations[world, 0].copy()
        return _with_masks({"final_obs": last, "final_info": infos}, ended)


def _autoreset_mode(given: AutoresetMode | str) -> AutoresetMode:
    """Autoreset mode by itself, its name ("next_step") or its value ("NextStep")."""
    for mode in AutoresetMode:
        if given in (mode, mode.name.lower(), mode.value):
            return mode
    valid = [mode.name.lower() for mode in AutoresetMode]
    raise ValueError(f"autoreset_mode: expected one of {valid}, got {given!r}")


def _reset_mask(options: Mapping[str, Any], n: int) -> Mask:
    """Mask (n,) of the matches to reset; all without the option."""
    given = options.get("reset_mask")
    if given is None:
        return np.ones(n, np.bool_)
    if not isinstance(given, np.ndarray) or given.dtype != np.bool_ or given.shape != (n,):
        got = f"{given.dtype} {given.shape}" if isinstance(given, np.ndarray) else repr(given)
        raise ValueError(f"options['reset_mask']: expected a bool array ({n},), got {got}")
    if not given.any():
        raise ValueError("options['reset_mask']: expected at least one match to reset, got none")
    return given


def _with_masks(infos: Infos, mask: Mask) -> Infos:
    """Infos, each with a copy of the mask under its name with an underscore."""
    return infos | {f"_{name}": mask.copy() for name in infos}

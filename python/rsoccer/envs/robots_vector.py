"""Many matches for Gymnasium in which every robot that learns is an environment of its own.

>>> import rsoccer
>>> envs = rsoccer.robots_vector_env("VSSSelfPlay-v0", worlds=8, threads=2)
>>> observations, infos = envs.reset(seed=0)
>>> for _ in range(10):
...     actions = envs.action_space.sample()
...     observations, rewards, terminations, truncations, infos = envs.step(actions)
>>> observations.shape[0]  # six robots in each of eight matches
48
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from rsoccer import checks, spaces
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.envs.env_matches import EnvMatches, SeededCopies, random_seed
from rsoccer.envs.options import (
    action_array,
    initial_rows,
    learner_controllers,
    reset_options,
)
from rsoccer.envs.robot_rows import RobotRows, RobotRowsEnv
from rsoccer.envs.viewer import Image, Viewer, metadata
from rsoccer.matches import Outcome
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import LEARN, Task

RENDER_MODES = ("rgb_array",)

Infos = dict[str, Any]


def robots_vector_env(
    task: Task | str,
    num_envs: int | None = None,
    render_mode: str | None = None,
    *,
    worlds: int | None = None,
    learner: str | None = None,
    controllers: Controllers | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
    history: int = 1,
    threads: int = 1,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    max_steps: int | None = None,
    max_episode_steps: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> RobotsVectorEnv:
    """Return a task as a native Gymnasium VectorEnv with a row for each robot that learns.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        num_envs: number of rows, a multiple of the number of robots that learn in a match; None
            for that of `worlds`.
        render_mode: "rgb_array" for images of all matches from `render`, or None.
        worlds: number of matches, at least 1, in place of `num_envs`; 1 if neither is given.
        learner: the only robot that learns, such as "blue_0"; None for all robots that the task
            and `controllers` let learn.
        controllers: policies of the other robots, by robot ("blue_1"), team ("blue") or "all": a
            policy, its name or its file; `LEARN` makes a robot a row. The task's defaults apply
            elsewhere, and "ou" in place of further learners if `learner` is given.
        simulator: moves the robots, as for `Matches`. With a simulator itself the environment
            cannot be copied.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.
        history: observations in a stacked one, as for `Matches`.
        threads: threads for physics, at least 1. Results do not depend on their number.
        autoreset_mode: reset of a match that ended, as an `AutoresetMode` or by name: "next_step"
            (the next step resets it, ignores its actions and pays no reward), "same_step" (within
            the step that ends it) or "disabled" (it waits for `reset`).
        max_steps: time limit of an episode in control steps, at least 1; None for the task's own.
        max_episode_steps: the same by Gymnasium's name, for `gymnasium.make_vec`; `max_steps`
            takes precedence.
        **options: options of a registered task, the fields of its class.

    Returns:
        Environments to `reset`. `RobotsVectorEnv` describes rows, spaces, infos and seeding.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
            object.
        ValueError: an unknown task, robot, controller or mode, a value out of range, both
            `num_envs` and `worlds`, or no robot that learns.

    Example:
        >>> import rsoccer
        >>> envs = rsoccer.robots_vector_env("VSSMulti-v0", 12, autoreset_mode="same_step")
        >>> envs.robots
        ('blue_0', 'blue_1', 'blue_2')
        >>> envs.worlds
        4
    """
    limit = ("max_steps", max_steps)
    if max_steps is None:
        limit = ("max_episode_steps", max_episode_steps)
    task = resolve_task(task, limit[1], options, robots_vector_env, limit[0])
    resolved = learner_controllers(task, learner, controllers)
    return RobotsVectorEnv(
        task,
        _world_count(num_envs, worlds, list(resolved.values()).count(LEARN)),
        render_mode,
        controllers=resolved,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
        history=history,
        threads=threads,
        autoreset_mode=autoreset_mode,
    )


class RobotsVectorEnv(RobotRowsEnv, SeededCopies, VectorEnv[Floats, Array, Array]):
    """n matches of a task as a Gymnasium VectorEnv with a row for each robot that learns.

    Rows: with k robots that learn in a match, row `i * k + j` is robot `robots[j]` of match i, and
    `num_envs` is `n * k`. All robots of a match begin and end together.

    Spaces: observations are Box (rows, o) float32. Actions are Box (rows, action) float32 from -1
    to 1; values beyond are clipped. Tasks with an `action_table` have MultiDiscrete actions
    (rows,).

    Rewards are (rows,) float64, `terminations` (the task's end of an episode, such as a goal) and
    `truncations` (the time limit) are (rows,) bool.

    Infos: empty, except for steps in which episodes end. Then they hold an array (rows,) float64
    for each metric of the task, such as `goal_score`, and for `steps`; each has a mask (rows,) bool
    under the same name with an underscore, such as `_goal_score`. With "same_step" these arrays are
    inside `final_info`, and `final_obs` (rows,) holds the last observations (o,) of the episodes
    that ended, None elsewhere; both with masks. `final_info` then also has `episode`, with each
    row's return `r` (rows,) float64 and length `l` (rows,) int64, as Gymnasium's own loop over
    environments in `RecordEpisodeStatistics` reports them.

    Seeding: `reset(seed=s)` seeds match i with `s + i`. Match i then equals, bit for bit, a
    `SoccerParallelEnv` with the seed `s + i`. Without a seed the random streams continue; those of
    a new environment begin with a random seed. The sampling of the action space has a seed of its
    own: `envs.action_space.seed(s)`.

    Rendering: `render_mode` is None or "rgb_array" (`render` returns an image for each row, which
    the rows of a match share).

    Copies by `copy.deepcopy` or `pickle` continue with the same future; copies of an environment
    that was never reset begin with random seeds of their own.

    Attributes:
        num_envs: number of rows.
        observation_space: Box (rows, o) float32.
        action_space: Box (rows, action) float32 from -1 to 1, or MultiDiscrete (rows,).
        single_observation_space: Box (o,) float32 of one row; `task.layout.blocks` names the parts.
        single_action_space: Box (action,) float32 or Discrete, of one row.
        autoreset_mode: the `AutoresetMode`, also in `metadata`.
        render_mode: "rgb_array" or None.
        metadata: `name`, `render_modes`, `render_fps` and `autoreset_mode`.
    """

    # Before Gymnasium 1.3 a VectorEnv closes itself when it is deleted, even one whose arguments
    # were refused and that has nothing to close.
    closed = True

    def __init__(
        self,
        task: Task,
        worlds: int = 1,
        render_mode: str | None = None,
        *,
        controllers: Controllers | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
        threads: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    ) -> None:
        """Prepare matches; `reset` begins them.

        Args:
            task: the task that is played.
            worlds: number of matches, n, at least 1.
            render_mode: "rgb_array" or None.
            controllers: policies of robots that do not learn, as for `robots_vector_env`.
            simulator: moves the robots, as for `robots_vector_env`.
            sensing: what robots know of the true state, as for `robots_vector_env`.
            randomization: numbers that each episode draws, as for `robots_vector_env`.
            history: observations in a stacked one, as for `robots_vector_env`.
            threads: threads for physics, at least 1.
            autoreset_mode: reset of a match that ended, as for `robots_vector_env`.

        Raises:
            TypeError: an argument of the wrong type.
            ValueError: an unknown mode or controller, a number out of range, or no robot that
                learns.
        """
        self._viewer = Viewer(render_mode, task, RENDER_MODES)
        self.render_mode = render_mode
        self.autoreset_mode = _autoreset_mode(autoreset_mode)
        self.metadata = metadata(task, RENDER_MODES) | {"autoreset_mode": self.autoreset_mode}
        self._matches = EnvMatches(
            task,
            worlds,
            random_seed(self),
            threads=threads,
            controllers=learner_controllers(task, None, controllers),
            autoreset=self.autoreset_mode.name.lower(),
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
        )
        self._rows = RobotRows.of(self._matches)
        self.num_envs = len(self._rows)
        self.single_observation_space = self._matches.observation_space
        self.single_action_space = spaces.action_space(task)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.closed = False

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
            options: `options["reset_mask"]` (rows,) bool selects the matches to reset, all by
                default; it has to be equal for the robots of a match. `options["frame"]` is an
                initial state (row,) for all of them, or (n, row) with one for each of the n
                matches, in the layout of `Frame.rows`, in place of the task's own.

        Returns:
            Observations (rows, o) float32 of all matches, and empty infos.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a reset of some matches while they are inconsistent after a failure.
            TypeError: a seed or options of the wrong type. Nothing has changed.
            ValueError: a negative seed, an unknown option, a wrong shape, a mask without a match or
                with a part of one, or an initial state with bodies that overlap or are outside.
                Nothing has changed.
        """
        self._viewer.check_open("reset")
        options = reset_options(options, "reset_mask", "frame")
        mask = _reset_mask(options, self._rows)
        rows = initial_rows(options, self.task, mask)
        observations = self._matches.reset(seed, mask, rows)
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
        elif seed is not None:
            self._np_random_seed = -1  # Gymnasium's value for seeds that one number cannot express
        return self._rows.flat(observations), {}

    def step(self, actions: Array) -> tuple[Floats, Doubles, Mask, Mask, Infos]:
        """Advance all matches by one control step.

        Args:
            actions: (rows, action) floats, clipped to [-1, 1], or (rows,) indices for tasks with an
                `action_table`.

        Returns:
            Observations (rows, o) float32, rewards (rows,) float64, terminations (rows,),
            truncations (rows,) and infos, which hold metrics where episodes ended.

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
        rows = self._rows
        outcome = self._matches.step(rows.by_match(vectors))
        return (
            rows.flat(outcome.observations),
            rows.flat(outcome.rewards.astype(np.float64)),
            rows.repeated(outcome.terminated),
            rows.repeated(outcome.truncated),
            self._infos(outcome),
        )

    def render(self) -> tuple[Image, ...] | None:
        """Render all matches.

        Returns:
            Images (height, width, 3) uint8, one per row; None without a render mode, which warns.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a match has not begun.
        """
        if self.render_mode is None:
            self._viewer.render(self._matches)
            return None
        return tuple(image for image in self._images() for _ in self.robots)

    def close_extras(self, **kwargs: Any) -> None:  # noqa: ANN401  (Gymnasium's own)
        """Refuse later calls: `reset`, `step` and `render` raise `ClosedEnvironmentError`.

        Args:
            **kwargs: ignored.
        """
        self._matches.close()
        self._viewer.close()

    def _infos(self, outcome: Outcome) -> Infos:
        """Metrics and steps of the matches that have ended, in Gymnasium's form."""
        episodes = outcome.episodes
        if episodes is None:
            return {}
        rows, mask = self._rows, self._rows.repeated(outcome.ended)
        metrics: dict[str, Array] = {**episodes.metrics, "steps": episodes.lengths}
        infos: Infos = {
            name: rows.scattered(episodes.worlds, values[:, None].astype(np.float64))
            for name, values in metrics.items()
        }
        infos = _with_masks(infos, mask)
        if self.autoreset_mode is not AutoresetMode.SAME_STEP:
            return infos
        episode = {
            "r": rows.scattered(episodes.worlds, episodes.returns),
            "l": rows.scattered(episodes.worlds, episodes.lengths[:, None]),
        }
        infos |= _with_masks({"episode": _with_masks(episode, mask)}, mask)
        last = np.full(self.num_envs, None, np.object_)
        final = rows.flat(outcome.final_observations)
        for row in np.flatnonzero(mask):
            last[row] = final[row].copy()
        return _with_masks({"final_obs": last, "final_info": infos}, mask)


def _world_count(num_envs: int | None, worlds: int | None, learners: int) -> int:
    """Number of matches that has these rows, or is given."""
    if num_envs is None:
        return 1 if worlds is None else checks.integer("worlds", worlds, 1)
    if worlds is not None:
        raise ValueError(f"num_envs and worlds: expected one of them, got {num_envs} and {worlds}")
    if checks.integer("num_envs", num_envs, 1) % learners:
        raise ValueError(
            f"num_envs: expected a multiple of the {learners} robots that learn in a match, got "
            f"{num_envs}"
        )
    return num_envs // learners


def _autoreset_mode(given: AutoresetMode | str) -> AutoresetMode:
    """Autoreset mode by itself, its name ("next_step") or its value ("NextStep")."""
    for mode in AutoresetMode:
        if given in (mode, mode.name.lower(), mode.value):
            return mode
    valid = [mode.name.lower() for mode in AutoresetMode]
    raise ValueError(f"autoreset_mode: expected one of {valid}, got {given!r}")


def _reset_mask(options: Mapping[str, Any], rows: RobotRows) -> Mask:
    """Mask (n,) of the matches to reset; all without the option."""
    given = options.get("reset_mask")
    if given is None:
        return np.ones(rows.worlds, np.bool_)
    shape = (len(rows),)
    if not isinstance(given, np.ndarray) or given.dtype != np.bool_ or given.shape != shape:
        got = f"{given.dtype} {given.shape}" if isinstance(given, np.ndarray) else repr(given)
        raise ValueError(f"options['reset_mask']: expected a bool array {shape}, got {got}")
    if not given.any():
        raise ValueError("options['reset_mask']: expected at least one match to reset, got none")
    by_match: Mask = rows.by_match(given)
    mask: Mask = by_match[:, 0]
    if (by_match != mask[:, None]).any():
        parts = np.flatnonzero((by_match != mask[:, None]).any(axis=1)).tolist()
        raise ValueError(
            f"options['reset_mask']: expected equal values for the {len(rows.robots)} robots of a "
            f"match, got different ones in matches {parts}"
        )
    return mask


def _with_masks(infos: Infos, mask: Mask) -> Infos:
    """Infos, each with a copy of the mask under its name with an underscore."""
    return infos | {f"_{name}": mask.copy() for name in infos}

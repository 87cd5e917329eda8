"""Matches as a `VecEnv`: a row for each robot that learns."""

from __future__ import annotations

import time
from collections.abc import Iterable
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from rsoccer import checks, spaces
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.envs.env_matches import EnvMatches
from rsoccer.envs.options import initial_rows, learner_controllers, reset_options
from rsoccer.envs.robot_rows import RobotRows, RobotRowsEnv
from rsoccer.envs.viewer import Image, Viewer, metadata
from rsoccer.matches import Outcome
from rsoccer.matches.changes import option_names
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task

RENDER_MODES = ("rgb_array",)

Info = dict[str, Any]
Indices = int | Iterable[int] | None


class SoccerVecEnv(RobotRowsEnv, VecEnv):  # type: ignore[misc]
    """n matches of a task as a VecEnv of Stable-Baselines3.

    Rows: with k robots that learn in a match, row `i * k + j` is robot `robots[j]` of match i, and
    `num_envs` is `n * k`. All robots of a match begin and end together. One policy therefore
    learns for all robots, also for both teams: each robot sees the field as if its team attacked
    +x.

    Spaces: observations are Box (o,) float32. Actions are Box (action,) float32 from -1 to 1;
    values beyond are clipped. Tasks with an `action_table` have Discrete actions instead.

    Ends: a match that ends is restarted within the same step. The infos of its rows then hold

    | key | value |
    | --- | --- |
    | `terminal_observation` | (o,) the last observation of this robot |
    | `TimeLimit.truncated` | True at the time limit, where algorithms bootstrap the value |
    | `steps`, and each metric of the task, such as `goal_score` | floats |
    | `episode` | `r` (return of this robot), `l` (length), `t` (seconds since the start), metrics |

    All other infos are empty. The algorithms log `episode` without `VecMonitor`;
    `model.ep_info_buffer` has the metrics.

    Seeding: `seed(s)` before a `reset` seeds match i with `s + i`, as algorithms with a `seed` do.
    Row i of one learner then equals, bit for bit, a `SoccerEnv` with the seed `s + i`. Without a
    seed the random streams continue; those of a new environment begin with a random seed.

    Options: `set_options({"frame": row})` before a `reset` sets the initial state (row,) of all
    matches, in the layout of `Frame.rows`; a list has the options of every row, of which those of
    a match's first row count. They hold once, as in the library; `matches.start_from` sets the
    starts of all later episodes.

    Curricula: `set_attr("reward_weights", {...})` and `set_attr("controllers", {"yellow": ...})`
    change options and opponents of running matches, see `Matches.change_options`.

    Copies by `copy.deepcopy` or `pickle` continue with the same future; copies of an environment
    that was never reset begin with random seeds of their own.

    Attributes:
        num_envs: number of rows.
        observation_space: Box (o,) float32 of one row; `task.layout.blocks` names the parts.
        action_space: Box (action,) float32 or Discrete, of one row.
        render_mode: "rgb_array" or None.
        metadata: `name`, `render_modes` and `render_fps`.

    Example:
        >>> from rsoccer.sb3 import SoccerVecEnv  # doctest: +SKIP
        >>> envs = SoccerVecEnv("VSSMulti-v0", worlds=8)  # doctest: +SKIP
        >>> envs.robots, envs.num_envs  # doctest: +SKIP
        (('blue_0', 'blue_1', 'blue_2'), 24)
    """

    def __init__(
        self,
        task: Task | str,
        worlds: int = 1,
        *,
        threads: int = 1,
        controllers: Controllers | None = None,
        learner: str | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
        render_mode: str | None = None,
        max_steps: int | None = None,
        **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
    ) -> None:
        """Prepare matches; `reset` begins them.

        Args:
            task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
            worlds: number of matches, n, at least 1.
            threads: threads for physics, at least 1. Results do not depend on their number.
            controllers: policies of the other robots, by robot ("blue_1"), team ("blue") or "all":
                a policy, its name or its file; `LEARN` makes a robot a row. The task's defaults
                apply elsewhere, and "ou" in place of further learners if `learner` is given.
            learner: the only robot that learns, such as "blue_0"; None for all robots that the
                task and `controllers` let learn.
            simulator: moves the robots, as for `Matches`. With a simulator itself the environment
                cannot be copied.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.
            history: observations in a stacked one, as for `Matches`.
            render_mode: "rgb_array" for images from `render` and `get_images`, or None.
            max_steps: time limit of an episode in control steps, at least 1; None for the task's
                own.
            **options: options of a registered task, the fields of its class.

        Raises:
            ImportError: a text "module:name" whose module or name does not exist.
            TypeError: an argument of the wrong type, an unknown option, or options for a `Task`
                object.
            ValueError: an unknown task, robot, controller or render mode, a value out of range, or
                no robot that learns.
        """
        task = resolve_task(task, max_steps, options, SoccerVecEnv)
        self._viewer = Viewer(render_mode, task, RENDER_MODES)
        self.render_mode = render_mode
        self._matches = EnvMatches(
            task,
            worlds,
            threads=threads,
            controllers=learner_controllers(task, learner, controllers),
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
        )
        self._rows = RobotRows.of(self._matches)
        self._actions: Array | None = None
        self._began = time.time()
        super().__init__(
            len(self._rows), self._matches.observation_space, spaces.action_space(task)
        )
        self.metadata = metadata(task, RENDER_MODES)

    def seed(self, seed: int | None = None) -> list[int | None]:
        """Set the seeds of the next `reset`.

        Args:
            seed: seed of the first match, at least 0; match i has `seed + i`. None draws one from
                NumPy's global generator, which the algorithms seed.

        Returns:
            The seed of each row's match.

        Raises:
            TypeError: not an integer.
            ValueError: a negative seed.
        """
        if seed is None:
            seed = int(np.random.randint(0, 2**31))  # noqa: NPY002  (as Stable-Baselines3 does)
        first = checks.integer("seed", seed, 0)
        seeds: list[int | None] = [first + self._rows.world(i) for i in range(self.num_envs)]
        self._seeds = seeds
        return seeds

    def reset(self) -> Floats:
        """Begin episodes in all matches, with the seeds and options that were set.

        Returns:
            Observations (rows, o) float32.

        Raises:
            TypeError: options of the wrong type. Nothing has changed.
            ValueError: a list of options of another length, an unknown option, or an initial state
                with a wrong shape, or with bodies that overlap or are outside. Nothing has changed.
        """
        self._viewer.check_open("reset")
        k = len(self.robots)
        if len(self._options) != self.num_envs:
            raise ValueError(
                f"options: expected a dictionary or one for each of {self.num_envs} rows, "
                f"got {len(self._options)}"
            )
        seeds: list[int | None] = list(self._seeds[::k])
        options = [reset_options(given, "frame") for given in self._options[::k]]
        framed = np.array([given.get("frame") is not None for given in options])
        if framed.any():
            observations = self._reset_to(options, framed, seeds)
        else:
            observations = self._matches.reset(seeds)
        self._reset_seeds()
        self._reset_options()
        self.reset_infos: list[Info] = [{} for _ in range(self.num_envs)]
        return self._rows.flat(observations)

    def _reset_to(self, options: list[Any], framed: Mask, seeds: list[int | None]) -> Floats:
        """Observations (n, k, o) after a reset in which some matches have an initial state."""
        one = np.ones(1, np.bool_)
        # None is excluded by the mask.
        rows: list[Any] = [initial_rows(options[i], self.task, one) for i in np.flatnonzero(framed)]
        # These first: they may be refused, and then nothing has changed.
        observations = self._matches.reset(seeds, framed, np.concatenate(rows))
        return observations if framed.all() else self._matches.reset(seeds, ~framed)

    def step_async(self, actions: Array) -> None:
        """Store the actions for `step_wait`.

        Args:
            actions: (rows, action) floats, or (rows,) indices for tasks with an `action_table`.
        """
        self._actions = checks.as_array("actions", actions)

    def step_wait(self) -> tuple[Floats, Floats, Mask, list[Info]]:
        """Advance all matches by one control step, and restart those that end.

        Returns:
            Observations (rows, o) float32, of the new episode where one began, rewards (rows,)
            float32, ends (rows,) bool and an info for each row.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: no actions were given, a match has not begun, or the matches are
                inconsistent after a failure.
            TypeError: actions of the wrong type. Nothing has changed.
            ValueError: actions with a wrong shape or value. Nothing has changed.
        """
        self._viewer.check_open("step")
        if self._actions is None:
            raise RuntimeError("step_wait before step_async: there are no actions")
        actions, self._actions = self._actions, None
        shape = (self.num_envs, *(self.action_space.shape or ()))
        if actions.shape != shape:
            raise ValueError(f"actions: expected shape {shape}, got {actions.shape}")
        rows = self._rows
        outcome = self._matches.step(rows.by_match(actions))
        return (
            rows.flat(outcome.observations),
            rows.flat(outcome.rewards),
            rows.repeated(outcome.ended),
            self._infos(outcome),
        )

    def _infos(self, outcome: Outcome) -> list[Info]:
        """An info for each row; those of matches that ended have the keys of the class."""
        infos: list[Info] = [{} for _ in range(self.num_envs)]
        episodes = outcome.episodes
        if episodes is None:
            return infos
        clock = round(time.time() - self._began, 6)
        for index, world in enumerate(episodes.worlds.tolist()):
            info, length = episodes.info(index), int(episodes.lengths[index])
            metrics = {name: info[name] for name in episodes.metrics}
            for robot in range(len(self.robots)):
                total = float(episodes.returns[index, robot])
                infos[world * len(self.robots) + robot] = {
                    **info,
                    "terminal_observation": outcome.final_observations[world, robot].copy(),
                    "TimeLimit.truncated": not episodes.terminated[index],
                    "episode": {"r": total, "l": length, "t": clock, **metrics},
                }
        return infos

    def get_images(self) -> list[Image | None]:
        """Return an image of each match.

        Returns:
            n images (height, width, 3) uint8; None in place of them without a render mode.

        Raises:
            ClosedEnvironmentError: the environment is closed.
            RuntimeError: a match has not begun.
        """
        if self.render_mode is None:
            return [None] * self.worlds
        return list(self._images())

    def close(self) -> None:
        """Refuse later calls: `reset`, `step` and images raise `ClosedEnvironmentError`."""
        self._matches.close()
        self._viewer.close()

    def get_attr(self, attr_name: str, indices: Indices = None) -> list[Any]:
        """Return an attribute of this environment for each row: all rows share it.

        Args:
            attr_name: name of the attribute, such as "task" or "render_mode".
            indices: rows; None for all.

        Raises:
            AttributeError: there is no such attribute.
        """
        value = getattr(self, attr_name)
        return [value for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Indices = None) -> None:  # noqa: ANN401
        """Change an option of the task, or the policies of other robots, of all matches.

        Args:
            attr_name: name of an option, such as "reward_weights", as for
                `Matches.change_options`; or "controllers", as for `Matches.change_controllers`.
            value: its value.
            indices: rows; None for all. They must be all rows, as matches share their options.

        Raises:
            AttributeError: another name.
            TypeError: a value of the wrong type. Nothing has changed.
            ValueError: a value out of range, or some rows only. Nothing has changed.
        """
        names = ["controllers", *option_names(self.task)]
        if attr_name not in names:
            raise AttributeError(
                f"{attr_name}: attributes of matches cannot be set, except {names}"
            )
        rows = set(self._get_indices(indices))
        if len(rows) != self.num_envs:
            raise ValueError(
                f"indices: expected all {self.num_envs} rows, as matches share their options, "
                f"got {sorted(rows)}"
            )
        if attr_name == "controllers":
            self._matches.change_controllers(value)
        else:
            self._matches.change_options(**{attr_name: value})

    def env_method(
        self,
        method_name: str,
        *method_args: Any,  # noqa: ANN401
        indices: Indices = None,
        **method_kwargs: Any,  # noqa: ANN401
    ) -> list[Any]:
        """Call a method of rows: "render" (image of the match) or "state" (its global state).

        Args:
            method_name: name of the method.
            *method_args: none.
            indices: rows; None for all.
            **method_kwargs: none.

        Returns:
            The result for each row.

        Raises:
            AttributeError: rows have no such method: matches are stepped and reset together.
            TypeError: arguments, which these methods do not take.
        """
        methods = {"render": self._image, "state": self._state}
        if method_name not in methods:
            raise AttributeError(f"rows have no method {method_name!r}; they have {list(methods)}")
        if method_args or method_kwargs:
            given = method_args or method_kwargs
            raise TypeError(f"{method_name}: expected no arguments, got {given}")
        return [methods[method_name](row) for row in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: Indices = None) -> list[bool]:
        """Return False for each row: matches have no wrappers.

        Args:
            wrapper_class: class of the wrapper.
            indices: rows; None for all.
        """
        return [False for _ in self._get_indices(indices)]

    def _image(self, row: int) -> Image | None:
        if self.render_mode is None:
            return None
        return self._viewer.image(self._matches, self._rows.world(row))

    def _state(self, row: int) -> Floats:
        state: Floats = self._matches.states()[self._rows.world(row)]
        return state

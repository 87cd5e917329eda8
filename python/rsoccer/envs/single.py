"""One match with one learner for Gymnasium; policies drive the other robots.

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

from rsoccer import checks
from rsoccer.controllers import Controllers
from rsoccer.envs import spaces
from rsoccer.envs.env_matches import EnvMatches, SingleLearner, episode_info
from rsoccer.envs.options import actions_of, chosen_task, one_learner, reset_options, starts
from rsoccer.envs.viewer import RENDER_MODES, Image, Viewer, metadata
from rsoccer.frame import Array, Floats
from rsoccer.task import Task

Action = Array | np.integer[Any] | int  # numbers, or the choice of a discrete task
Info = dict[str, Any]


def single_env(
    task: Task | str,
    render_mode: str | None = None,
    *,
    learner: str | None = None,
    controllers: Controllers | None = None,
    max_steps: int | None = None,
    **options: Any,  # noqa: ANN401  (fields of the task, checked by the registry)
) -> SoccerEnv:
    """A task, or a registered one by its name and options, as a Gymnasium Env.

    `learner` is the robot that learns and may be left out where the task has only one; then
    `controllers` names drivers for the others, as for `Matches`, and `learner` wins over it.
    """
    chosen = chosen_task(task, max_steps, options)
    return SoccerEnv(chosen, render_mode, learner=learner, controllers=controllers)


# Where `gymnasium.make` looks for the modes, to offer lists of images too.
single_env.metadata = {"render_modes": list(RENDER_MODES)}  # type: ignore[attr-defined]


class SoccerEnv(SingleLearner, gymnasium.Env[Floats, Any]):
    """One match of a task, seen and played by one robot.

    Infos are empty but for that of the last step of an episode, which holds the task's metrics
    (such as `goal_score`) and `steps`, as floats. Who is not seeded draws a seed, which
    `np_random_seed` tells; from then on only `reset(seed=...)` matters, not `np_random`.
    """

    def __init__(
        self,
        task: Task,
        render_mode: str | None = None,
        *,
        learner: str | None = None,
        controllers: Controllers | None = None,
    ) -> None:
        """A match that `reset` will begin; `render_mode` is "human", "rgb_array" or None."""
        self._viewer = Viewer(render_mode, task)
        self.render_mode = render_mode
        self.metadata = metadata(task)
        self._matches = EnvMatches(
            task,
            1,
            self.np_random_seed,
            controllers=one_learner(task, learner, controllers),
            autoreset="disabled",
        )
        self.observation_space = spaces.observation_space(task)
        self.action_space = spaces.action_space(task)

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Floats, Info]:
        """Begin an episode; the same seed gives the same one, whatever was played before.

        Without a seed the random streams go on. `options["frame"]` is a row (row,) to start from
        in place of the task's own starts, laid out as `Frame.rows`; other options are left to
        whoever else may read them.
        """
        self._viewer.expect_open("reset")
        seed = None if seed is None else checks.integer("seed", seed, 0)
        rows = starts(reset_options(options), self.task, np.ones(1, np.bool_))
        observations = self._matches.reset(seed, rows=rows)
        super().reset(seed=seed)
        if self.render_mode == "human":
            self.render()
        return observations[0, 0], {}

    def step(self, action: Action) -> tuple[Floats, float, bool, bool, Info]:
        """The learner acts for one control step; an action beyond [-1, 1] counts as the bound."""
        self._viewer.expect_open("step")
        self._matches.check_turn()
        chosen = actions_of(self.task, action, self.action_space)
        outcome = self._matches.step(chosen[None, None])
        terminated, truncated = bool(outcome.terminated[0]), bool(outcome.truncated[0])
        info = episode_info(outcome, self._matches) if terminated or truncated else {}
        if self.render_mode == "human":
            self.render()
        reward = float(outcome.rewards[0, 0])
        return outcome.observations[0, 0], reward, terminated, truncated, info

    def render(self) -> Image | None:
        """The match as an image (height, width, 3), or in a window."""
        return self._viewer.show(self._matches)

    def close(self) -> None:
        """End its use: `reset`, `step` and `render` raise ClosedEnvironmentError from now on.

        A window closes too. May be repeated.
        """
        self._viewer.close()

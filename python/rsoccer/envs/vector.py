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

from typing import Any

from gymnasium.vector import AutoresetMode

from rsoccer import checks
from rsoccer.controllers import Controllers
from rsoccer.envs.env_matches import SingleLearner
from rsoccer.envs.options import single_learner_controllers
from rsoccer.envs.robots_vector import RobotsVectorEnv
from rsoccer.randomization import Ranges
from rsoccer.registry import resolve_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task


def vector_env(
    task: Task | str,
    num_envs: int = 1,
    render_mode: str | None = None,
    *,
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
) -> SoccerVectorEnv:
    """Return a task as a native Gymnasium VectorEnv: many matches with one learner each.

    Args:
        task: a `Task`, or the name of a registered one; see `rsoccer.list_tasks()`.
        num_envs: number of rows, n, at least 1: one learner each, in a match of its own.
        render_mode: "rgb_array" for images of all matches from `render`, or None.
        learner: the robot that learns in every match, such as "blue_0"; needed for tasks with
            several learners. It takes precedence over `controllers`.
        controllers: policies of the other robots, by robot ("blue_1"), team ("blue") or "all": a
            policy, its name or its file. The task's defaults apply elsewhere, and "ou" in place of
            further learners if `learner` is given.
        simulator: moves the robots, as for `Matches`. With a simulator itself the environment
            cannot be copied.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.
        history: observations in a stacked one, as for `Matches`.
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
        ImportError: a text "module:name" whose module or name does not exist.
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
    limit = ("max_steps", max_steps)
    if max_steps is None:
        limit = ("max_episode_steps", max_episode_steps)
    return SoccerVectorEnv(
        resolve_task(task, limit[1], options, vector_env, limit[0]),
        num_envs,
        render_mode,
        learner=learner,
        controllers=controllers,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
        history=history,
        threads=threads,
        autoreset_mode=autoreset_mode,
    )


class SoccerVectorEnv(SingleLearner, RobotsVectorEnv):
    """n matches of a task with one learner each, as a Gymnasium VectorEnv.

    Spaces: observations are Box (n, o) float32. Actions are Box (n, action) float32 from -1 to 1;
    values beyond are clipped. Tasks with an `action_table` have MultiDiscrete actions (n,).

    Rewards are (n,) float64, `terminations` (the task's end of an episode, such as a goal) and
    `truncations` (the time limit) are (n,) bool.

    Infos: empty, except for steps in which episodes end. Then they hold an array (n,) float64 for
    each metric of the task, such as `goal_score`, and for `steps`; each has a mask (n,) bool under
    the same name with an underscore, such as `_goal_score`. With "same_step" these arrays are
    inside `final_info`, and `final_obs` (n,) holds the last observations (o,) of the episodes that
    ended, None elsewhere; both with masks. `final_info` then also has `episode`, with the return
    `r` (n,) float64 and the length `l` (n,) int64 of each match.

    Seeding: `reset(seed=s)` seeds match i with `s + i`. Match i then equals, bit for bit, a
    `SoccerEnv` with the seed `s + i`. Without a seed the random streams continue; those of a new
    environment begin with a random seed. The sampling of the action space has a seed of its own:
    `envs.action_space.seed(s)`.

    Rendering: `render_mode` is None or "rgb_array" (`render` returns an image of each match).

    Copies by `copy.deepcopy` or `pickle` continue with the same future; copies of an environment
    that was never reset begin with random seeds of their own.

    Attributes:
        num_envs: number of rows, n, each of a match of its own.
        observation_space: Box (n, o) float32.
        action_space: Box (n, action) float32 from -1 to 1, or MultiDiscrete (n,).
        single_observation_space: Box (o,) float32 of one match; `task.layout.blocks` names its
            parts.
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
            num_envs: number of rows, n, at least 1: one learner each, in a match of its own.
            render_mode: "rgb_array" or None.
            learner: the robot that learns; needed for tasks with several learners.
            controllers: policies of the other robots, as for `vector_env`.
            simulator: moves the robots, as for `vector_env`.
            sensing: what robots know of the true state, as for `vector_env`.
            randomization: numbers that each episode draws, as for `vector_env`.
            history: observations in a stacked one, as for `vector_env`.
            threads: threads for physics, at least 1.
            autoreset_mode: reset of a match that ended, as for `vector_env`.

        Raises:
            TypeError: an argument of the wrong type.
            ValueError: an unknown mode, robot or controller, a number out of range, or not
                exactly one learner.
        """
        super().__init__(
            task,
            checks.integer("num_envs", num_envs, 1),
            render_mode,
            controllers=single_learner_controllers(task, learner, controllers),
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
            history=history,
            threads=threads,
            autoreset_mode=autoreset_mode,
        )

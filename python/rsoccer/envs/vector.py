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

from rsoccer.controllers import Controllers
from rsoccer.envs import spaces
from rsoccer.envs.env_matches import EnvMatches, SingleLearner
from rsoccer.envs.options import actions_of, chosen_task, one_learner, reset_options, starts
from rsoccer.envs.viewer import Image, Viewer, metadata
from rsoccer.frame import Array, Floats, Mask
from rsoccer.matches import Outcome
from rsoccer.task import Task

RENDER_MODES = ("rgb_array",)

Doubles = NDArray[np.float64]
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
    """A task, or a registered one by its name and options, as a native Gymnasium VectorEnv.

    `learner` and `controllers` are those of `single_env`; `max_episode_steps` is Gymnasium's word
    for `max_steps`, by which `make_vec` hands it on.
    """
    limit = max_episode_steps if max_steps is None else max_steps
    return SoccerVectorEnv(
        chosen_task(task, limit, options),
        num_envs,
        render_mode,
        learner=learner,
        controllers=controllers,
        threads=threads,
        autoreset_mode=autoreset_mode,
    )


class SoccerVectorEnv(SingleLearner, VectorEnv[Floats, Array, Array]):
    """n matches of a task, each seen and played by one robot.

    Match i seeded `seed + i` equals a `SoccerEnv` with that seed, bit for bit. Rewards are float64
    and infos have Gymnasium's form: at the end of an episode the task's metrics and `steps`, each
    with a mask, within `final_info` where the match begins anew in the same step.
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
        """Matches that `reset` will begin; `autoreset_mode` also by name, such as "same_step"."""
        self._viewer = Viewer(render_mode, task, RENDER_MODES)
        self.render_mode = render_mode
        self.autoreset_mode = _mode(autoreset_mode)
        self.metadata = metadata(task) | {"autoreset_mode": self.autoreset_mode}
        self._matches = EnvMatches(
            task,
            num_envs,
            int(self.np_random_seed or 0),  # drawn, as nobody has said one
            threads=threads,
            controllers=one_learner(task, learner, controllers),
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
        """Begin episodes; the same seed gives the same ones, whatever was played before.

        Match i gets `seed + i` or `seed[i]`; where that is None its random streams go on.
        `options["reset_mask"]` (n,) says in which matches, if not in all; `options["frame"]` is a
        row (row,), or one for each match (n, row), to start from. Other options are ignored.
        """
        self._viewer.expect_open("reset")
        told = reset_options(options)
        mask = _reset_mask(told, self.num_envs)
        rows = starts(told, self.task, mask)
        observations = self._matches.reset(seed, mask, rows)
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
        elif seed is not None:
            self._np_random_seed = -1  # Gymnasium's sign that no one number tells
        return observations[:, 0], {}

    def step(self, actions: Array) -> tuple[Floats, Doubles, Mask, Mask, Infos]:
        """The learners act for one control step, actions (n, action) or choices (n,)."""
        self._viewer.expect_open("step")
        if self.autoreset_mode is AutoresetMode.DISABLED:
            self._matches.check_turn()
        chosen = actions_of(self.task, actions, self.action_space)
        steps = self._matches.play.steps + 1
        outcome = self._matches.step(chosen[:, None])
        return (
            outcome.observations[:, 0],
            outcome.rewards[:, 0].astype(np.float64),
            outcome.terminated,
            outcome.truncated,
            self._infos(outcome, steps),
        )

    def render(self) -> tuple[Image, ...] | None:
        """An image (height, width, 3) of each match."""
        if self.render_mode is None:
            self._viewer.show(self._matches)
            return None
        return tuple(self._viewer.image(self._matches, world) for world in range(self.num_envs))

    def close_extras(self, **kwargs: Any) -> None:  # noqa: ANN401  (Gymnasium's own)
        """After `close`, `reset`, `step` and `render` raise ClosedEnvironmentError."""
        self._viewer.close()

    def _infos(self, outcome: Outcome, steps: NDArray[np.int64]) -> Infos:
        """What there is to tell of matches that have ended."""
        ended = outcome.ended
        if not ended.any():
            return {}
        told = {name: fact.astype(np.float64) for name, fact in outcome.metrics.items()}
        told["steps"] = steps.astype(np.float64)
        infos = _masked({name: np.where(ended, told[name], 0.0) for name in told}, ended)
        if self.autoreset_mode is not AutoresetMode.SAME_STEP:
            return infos
        last = np.full(self.num_envs, None, np.object_)
        for world in np.flatnonzero(ended):
            last[world] = outcome.final_observations[world, 0].copy()
        return _masked({"final_obs": last, "final_info": infos}, ended)


def _mode(given: AutoresetMode | str) -> AutoresetMode:
    """A mode, or the one of this name ("next_step") or value ("NextStep")."""
    for mode in AutoresetMode:
        if given in (mode, mode.name.lower(), mode.value):
            return mode
    valid = [mode.name.lower() for mode in AutoresetMode]
    raise ValueError(f"autoreset_mode: expected one of {valid}, got {given!r}")


def _reset_mask(options: Mapping[str, Any], n: int) -> Mask:
    """(n,) the matches to begin anew; all unless told otherwise."""
    given = options.get("reset_mask")
    if given is None:
        return np.ones(n, np.bool_)
    if not isinstance(given, np.ndarray) or given.dtype != np.bool_ or given.shape != (n,):
        got = f"{given.dtype} {given.shape}" if isinstance(given, np.ndarray) else repr(given)
        raise ValueError(f"options['reset_mask']: expected a bool array ({n},), got {got}")
    if not given.any():
        raise ValueError("options['reset_mask']: expected at least one match to begin, got none")
    return given


def _masked(infos: Infos, mask: Mask) -> Infos:
    """Infos, and with each of them where it holds."""
    return infos | {f"_{name}": mask.copy() for name in infos}

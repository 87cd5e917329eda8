"""Every task with one learner, for tests of Gymnasium's environments."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import RecordEpisodeStatistics

import rsoccer
from rsoccer.arrays import Array
from rsoccer.controllers import resolve
from rsoccer.envs.single import SoccerEnv, single_env
from rsoccer.registry import list_options
from rsoccer.task import LEARN
from tests.helpers import comparable

TASKS = rsoccer.list_tasks()
ONE_LEARNER = [name for name in TASKS if len(rsoccer.make_task(name).agents) == 1]
DISCRETE = [name for name in TASKS if "discrete" in list_options(type(rsoccer.make_task(name)))]


def learner_options(name: str) -> dict[str, Any]:
    """Options that leave one learner in a task: the last agent, so that yellow is tested too."""
    agents = rsoccer.make_task(name).agents
    return {} if len(agents) == 1 else {"learner": agents[-1], "controllers": {"all": "ou"}}


def learner_controllers(name: str) -> dict[str, Any]:
    """The same as controllers for `Matches` and `parallel_env`."""
    options = learner_options(name)
    given = {**options.get("controllers", {})}
    if options:
        given[options["learner"]] = LEARN
    return dict(resolve(rsoccer.make_task(name), given))


def draw(env: SoccerEnv, rng: np.random.Generator) -> Array:
    """A random action."""
    return rng.uniform(-1.0, 1.0, env.task.action_size).astype(np.float32)


def play_episode(env: SoccerEnv, seed: int | None, **reset: Any) -> list[Any]:  # noqa: ANN401
    """All results of one episode, from reset to end, as comparable values."""
    rng = np.random.default_rng(0 if seed is None else seed)
    transcript: list[Any] = [comparable(env.reset(seed=seed, **reset))]
    ended = False
    while not ended:
        given = env.step(draw(env, rng))
        ended = given[2] or given[3]
        transcript.append(comparable(given))
    return transcript


def one_by_one(name: str, n: int, mode: AutoresetMode, **options: Any) -> SyncVectorEnv:  # noqa: ANN401
    """Gymnasium's own loop over n single matches.

    With "same_step" each records the statistics of its episodes, which our environments report.
    """

    def make() -> gymnasium.Env[Any, Any]:
        env = single_env(name, **learner_options(name), **options)
        return RecordEpisodeStatistics(env) if mode is AutoresetMode.SAME_STEP else env

    return SyncVectorEnv([make] * n, autoreset_mode=mode)


def without_times(infos: dict[str, Any]) -> dict[str, Any]:
    """Infos whose statistics of episodes have no wall time."""
    timed = ("t", "_t")
    shown = infos.copy()
    for name in {"episode", "final_info"} & infos.keys():
        shown[name] = without_times({k: v for k, v in infos[name].items() if k not in timed})
    return shown


def short_env(name: str, max_steps: int = 40) -> SoccerEnv:
    """A short match with one learner."""
    return single_env(name, max_steps=max_steps, **learner_options(name))

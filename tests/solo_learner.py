"""Every task with one robot that learns: what the tests of Gymnasium's environments share."""

from typing import Any

import numpy as np

import rsoccer
from rsoccer.controllers import resolve
from rsoccer.envs.single import SoccerEnv, single_env
from rsoccer.frame import Array
from rsoccer.registry import list_options
from rsoccer.task import LEARN

TASKS = rsoccer.list_tasks()
LONE = [name for name in TASKS if len(rsoccer.make_task(name).agents) == 1]
DISCRETE = [name for name in TASKS if "discrete" in list_options(type(rsoccer.make_task(name)))]


def lone(name: str) -> dict[str, Any]:
    """What leaves one learner in a task: the last of several, so that yellow is seen as well."""
    agents = rsoccer.make_task(name).agents
    return {} if len(agents) == 1 else {"learner": agents[-1], "controllers": {"all": "ou"}}


def lone_controllers(name: str) -> dict[str, Any]:
    """The same for `Matches` and the PettingZoo env."""
    chosen = lone(name)
    given = {**chosen.get("controllers", {})}
    if chosen:
        given[chosen["learner"]] = LEARN
    return dict(resolve(rsoccer.make_task(name), given))


def plain(value: Any) -> Any:  # noqa: ANN401
    """What `==` can compare to the last bit, arrays of objects included."""
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, tuple | list):
        return [plain(part) for part in value]
    if isinstance(value, np.ndarray) and value.dtype == np.object_:
        return ("objects", [plain(part) for part in value])
    return (value.dtype.str, value.shape, value.tobytes()) if hasattr(value, "tobytes") else value


def draw(env: SoccerEnv, rng: np.random.Generator) -> Array:
    """A random action."""
    return rng.uniform(-1.0, 1.0, env.task.action_size).astype(np.float32)


def play_episode(env: SoccerEnv, seed: int | None, **reset: Any) -> list[Any]:  # noqa: ANN401
    """All that one episode returns, from reset to end."""
    rng = np.random.default_rng(0 if seed is None else seed)
    transcript: list[Any] = [plain(env.reset(seed=seed, **reset))]
    ended = False
    while not ended:
        given = env.step(draw(env, rng))
        ended = given[2] or given[3]
        transcript.append(plain(given))
    return transcript


def hurried(name: str, max_steps: int = 40) -> SoccerEnv:
    """A short match with one learner."""
    return single_env(name, max_steps=max_steps, **lone(name))

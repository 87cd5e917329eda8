"""Speed of matches through other libraries, with random actions held for ten steps.

Every measure counts world-steps, also where each robot is a row, so that it compares with `Matches`
of as many worlds on one thread.
"""

from __future__ import annotations

import importlib
import warnings
from types import ModuleType
from typing import Any

import gymnasium

import rsoccer
from benches import interfaces
from benches.measuring import Measure, UnavailableError, Values, world_steps_per_second
from benches.third_party import silence

SETTLING = 50
"""Steps before a measurement, so that matches are in progress."""
FRAGMENT = 32
"""Steps of each match in a sample of RLlib."""
RUNNERS = "ray.rllib.env"
"""Package of RLlib's runners."""


def required(module: str) -> ModuleType:
    """Import a module.

    Raises:
        UnavailableError: Its library is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise UnavailableError(str(error)) from error


def sb3(task: str, worlds: int, normalizer: str = "") -> Measure:
    """Return a measure of `rsoccer.sb3.SoccerVecEnv`.

    Args:
        task: Name of the task.
        worlds: Number of matches.
        normalizer: `SoccerVecNormalize` or `VecNormalize`, around a `VecMonitor` around it; ""
            for neither.
    """
    ours = required("rsoccer.sb3")
    envs = ours.SoccerVecEnv(task, worlds)
    if normalizer:
        library = required("stable_baselines3.common.vec_env")
        source = ours if normalizer == "SoccerVecNormalize" else library
        envs = getattr(source, normalizer)(library.VecMonitor(envs))
    envs.seed(0)
    return _rows(envs, worlds)


def sb3_dummy(task: str, worlds: int) -> Measure:
    """Return a measure of Stable-Baselines3's own loop over environments of `gymnasium.make`."""
    loop = required("stable_baselines3.common.vec_env").DummyVecEnv
    envs = loop([lambda: gymnasium.make(f"rsoccer/{task}") for _ in range(worlds)])
    envs.seed(0)
    return _rows(envs, worlds)


def supersuit(task: str, worlds: int) -> Measure:
    """Return a measure of SuperSuit's concatenated matches, with each robot as a row."""
    library = required("supersuit")
    match = library.pettingzoo_env_to_vec_env_v1(rsoccer.parallel_env(task))
    return _rows(library.concat_vec_envs_v1(match, worlds), worlds)


def robots(task: str, worlds: int) -> Measure:
    """Return a measure of `robots_vector_env`."""
    envs = rsoccer.robots_vector_env(task, worlds=worlds, autoreset_mode="same_step")
    envs.reset(seed=0)
    actions = interfaces.random_actions(interfaces.shape_of(envs.action_space))
    return _settled(envs, actions, worlds)


def torchrl(task: str, worlds: int) -> Measure:
    """Return a measure of `rsoccer.torchrl.SoccerEnv`, resets of ended matches included."""
    env = required("rsoccer.torchrl").SoccerEnv(task, worlds, seed=0)
    return _tensors(env, worlds)


def torchrl_vector(task: str, worlds: int) -> Measure:
    """Return a measure of TorchRL's wrapper of `gymnasium.make_vec`."""
    wrapper = required("torchrl.envs.libs.gym").GymWrapper
    envs = gymnasium.make_vec(f"rsoccer/{task}", worlds, autoreset_mode="disabled")
    return _tensors(wrapper(envs), worlds)


def torchrl_pettingzoo(task: str, worlds: int) -> Measure:
    """Return a measure of TorchRL's wrapper of `parallel_env`, which has one match.

    Args:
        task: Name of the task.
        worlds: Number of matches; they are played one after the other.
    """
    wrapper = required("torchrl.envs.libs.pettingzoo").PettingZooWrapper
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it was tested with another version
        env = wrapper(rsoccer.parallel_env(task), seed=0)
    return _tensors(env, 1)


def rllib(task: str, worlds: int, *, stock: bool) -> Measure:
    """Return a measure of sampling episodes in RLlib, inference of a small policy included.

    Args:
        task: Name of the task.
        worlds: Number of matches.
        stock: Whether RLlib's own runner samples, with its wrapper of `parallel_env`.
    """
    ours = required("rsoccer.rllib")
    torch = required("torch")
    settings = {"env_runner_cls": ours.MatchesEnvRunner}
    create: Any = ours.SoccerMultiAgentEnv
    if stock:
        wrapper = required("ray.rllib.env.wrappers.pettingzoo_env").ParallelPettingZooEnv
        settings = {
            "env_runner_cls": required(f"{RUNNERS}.multi_agent_env_runner").MultiAgentEnvRunner
        }
        create = _Wrapped(wrapper, task)
    config = (
        required("ray.rllib.algorithms.ppo")
        .PPOConfig()
        .environment(create, env_config={"task": task})
        .env_runners(num_env_runners=0, num_envs_per_env_runner=worlds, **settings)
        .multi_agent(policies={"shared"}, policy_mapping_fn=lambda *_, **__: "shared")
    )
    with silence(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        runner = config.env_runner_cls(config=config)
        runner.sample(num_timesteps=worlds)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(1)

        def sample() -> None:
            runner.sample(num_timesteps=worlds * FRAGMENT)
            runner.get_metrics()

        return world_steps_per_second(sample, worlds * FRAGMENT)(seconds)

    return measure


class _Wrapped:
    """Creates a match in RLlib's wrapper."""

    def __init__(self, wrapper: Any, task: str) -> None:  # noqa: ANN401
        self._wrapper, self._task = wrapper, task

    def __call__(self, config: object) -> Any:  # noqa: ANN401
        return self._wrapper(rsoccer.parallel_env(self._task))


def _tensors(env: Any, worlds: int) -> Measure:  # noqa: ANN401
    """Measure of an environment of TorchRL, which resets the matches that ended."""
    torch = required("torch")
    env.set_seed(0)
    data = env.reset()
    spec = env.full_action_spec
    actions = [
        dict(spec.rand().items(include_nested=True, leaves_only=True))
        for _ in range(interfaces.N_ACTIONS)
    ]

    def act(action: dict[Any, Any]) -> None:
        nonlocal data
        for key, value in action.items():  # as a policy writes its result
            data.set(key, value)
        _, data = env.step_and_maybe_reset(data)

    step = interfaces.held_actions(actions, act)
    torch.set_num_threads(1)
    for _ in range(SETTLING):
        step()
    measured = world_steps_per_second(step, worlds)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(1)
        return measured(seconds)

    return measure


def _rows(envs: Any, worlds: int) -> Measure:  # noqa: ANN401  (types only where it is installed)
    """Measure of environments whose action space is that of one row."""
    envs.reset()
    shape = (envs.num_envs, *interfaces.shape_of(envs.action_space))
    return _settled(envs, interfaces.random_actions(shape), worlds)


def _settled(envs: Any, actions: list[Any], worlds: int) -> Measure:  # noqa: ANN401
    """Measure of environments that have begun, after some steps."""
    step = interfaces.held_actions(actions, envs.step)
    for _ in range(SETTLING):
        step()
    return world_steps_per_second(step, worlds)

"""Speed of matches through other libraries, with random actions held for ten steps.

Every measure counts world-steps, also where each robot is a row, so that it compares with `Matches`
of as many worlds on one thread.
"""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any

import gymnasium

import rsoccer
from benches import interfaces
from benches.measuring import Measure, UnavailableError, world_steps_per_second

SETTLING = 50
"""Steps before a measurement, so that matches are in progress."""


def required(module: str) -> ModuleType:
    """Import a module.

    Raises:
        UnavailableError: Its library is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise UnavailableError(str(error)) from error


def sb3(task: str, worlds: int, *, wrapped: bool) -> Measure:
    """Return a measure of `rsoccer.sb3.SoccerVecEnv`.

    Args:
        task: Name of the task.
        worlds: Number of matches.
        wrapped: Whether `VecMonitor` and `VecNormalize` are around it.
    """
    envs = required("rsoccer.sb3").SoccerVecEnv(task, worlds)
    if wrapped:
        wrappers = required("stable_baselines3.common.vec_env")
        envs = wrappers.VecNormalize(wrappers.VecMonitor(envs))
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
    envs = rsoccer.robots_vector_env(task, matches=worlds, autoreset_mode="same_step")
    envs.reset(seed=0)
    actions = interfaces.random_actions(interfaces.shape_of(envs.action_space))
    return _settled(envs, actions, worlds)


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

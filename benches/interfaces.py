"""Speed of the interfaces to a task, with random actions held for ten steps.

A measured step is complete: commands, physics, observations, rewards, and a reset where an episode
ended.
"""

from collections.abc import Callable, Iterator
from itertools import count
from typing import Any, Final, TypeVar

import gymnasium
import numpy as np
from gymnasium.vector import VectorEnv
from pettingzoo import AECEnv, ParallelEnv

import rsoccer
from benches.measuring import (
    SPEED,
    Measure,
    Quantity,
    Values,
    calls_per_second,
    world_steps_per_second,
)
from benches.scenarios import DEFAULT_ENGINE, HELD
from rsoccer import SimConfig, Simulator
from rsoccer._core import Threads
from rsoccer.arrays import Array, Floats
from rsoccer.train.clock import Clock, TimedSimulator

OUTSIDE: Final = Quantity("time outside physics", "us per world-step")
N_ACTIONS: Final = 16  # different random actions, drawn in advance so as not to be measured
# World-steps, at most 200 steps, so that matches are in progress when measured.
WARM_UP: Final = 100_000

T = TypeVar("T")


def matches(task: str, worlds: int, threads: int, engine: str = DEFAULT_ENGINE) -> Measure:
    """Return a measure of `Matches`: speed and time outside physics."""
    instance, clock = rsoccer.make_task(task, engine=engine), Clock()

    def simulator(config: SimConfig, worlds: int, threads: Threads) -> TimedSimulator:
        return TimedSimulator(Simulator(config, worlds, threads), clock)

    batch = rsoccer.Matches(instance, worlds, seed=0, threads=threads, simulator=simulator)
    batch.reset()
    actions = random_actions((worlds, len(batch.agents), instance.action_size))
    step = held_actions(actions, batch.step)
    for _ in range(min(200, WARM_UP // worlds)):
        step()

    def measure(seconds: float) -> Values:
        clock.take()
        rate = worlds * calls_per_second(step, seconds)
        outside = 1.0 - clock.take()[1]["physics"]
        return {SPEED: rate, OUTSIDE: 1e6 * outside / rate}

    return measure


def parallel(env: ParallelEnv[str, Floats, Any]) -> Measure:
    """Return a measure of PettingZoo's parallel interface with dictionaries by agent."""
    env.reset(seed=0)
    agents = list(env.possible_agents)
    arrays = random_actions((len(agents), *shape_of(env.action_space(agents[0]))))

    def act(actions: dict[str, Floats]) -> None:
        env.step(actions)
        if not env.agents:
            env.reset()

    return world_steps_per_second(
        held_actions([dict(zip(agents, array, strict=True)) for array in arrays], act), 1
    )


def aec(env: AECEnv[str, Floats, Any]) -> Measure:
    """Return a measure of PettingZoo's AEC interface; one step is a turn of every agent."""
    env.reset(seed=0)
    agents = list(env.possible_agents)
    arrays = random_actions((len(agents), *shape_of(env.action_space(agents[0]))))

    def act(actions: Floats) -> None:
        for action in actions:
            if env.terminations[env.agent_selection] or env.truncations[env.agent_selection]:
                env.reset()
            env.last()
            env.step(action)

    return world_steps_per_second(held_actions(arrays, act), 1)


def single(env: gymnasium.Env[Floats, Any]) -> Measure:
    """Return a measure of Gymnasium's Env."""
    env.reset(seed=0)

    def act(action: Floats) -> None:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()

    return world_steps_per_second(held_actions(random_actions(shape_of(env.action_space)), act), 1)


def vector(env: VectorEnv[Floats, Array, Array]) -> Measure:
    """Return a measure of Gymnasium's VectorEnv."""
    env.reset(seed=0)
    step = held_actions(random_actions(shape_of(env.action_space)), env.step)
    for _ in range(min(200, WARM_UP // env.num_envs)):
        step()
    return world_steps_per_second(step, env.num_envs)


def random_actions(shape: tuple[int, ...]) -> list[Floats]:
    """Draw a few arrays of a shape, uniform in [-1, 1]."""
    rng = np.random.default_rng(0)
    return [rng.uniform(-1.0, 1.0, shape).astype(np.float32) for _ in range(N_ACTIONS)]


def held_actions(actions: list[T], act: Callable[[T], object]) -> Callable[[], None]:
    """Return a step function that cycles through the actions and holds each for ten steps."""
    calls: Iterator[int] = count()

    def step() -> None:
        act(actions[next(calls) // HELD % len(actions)])

    return step


def shape_of(space: gymnasium.Space[Any]) -> tuple[int, ...]:
    """Return the shape of a space's arrays.

    Raises:
        TypeError: The space has no shape.
    """
    if space.shape is None:
        raise TypeError(f"expected a space of arrays, got {space}")
    return space.shape

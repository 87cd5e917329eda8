"""The front doors: everything that plays a task, with random actions held for ten steps.

Each is measured as its users step it, whatever that takes: commands, physics, observations,
rewards, and a new episode wherever one ended.
"""

from collections.abc import Callable, Iterator
from itertools import count
from typing import Any, Final, TypeVar

import gymnasium
import numpy as np
from gymnasium.vector import VectorEnv
from pettingzoo import AECEnv, ParallelEnv

import rsoccer
from benches.games import HELD
from benches.measuring import SPEED, Measure, Quantity, Values, calls, repeated
from rsoccer.frame import Array, Floats
from rsoccer.train.timing import Clock, TimedSimulator

OUTSIDE: Final = Quantity("outside physics", "us a world-step")
DRAWN: Final = 16  # different random actions, drawn ahead: drawing them is not what is measured
WARM_UP: Final = 100_000  # world-steps, at most 200 steps: matches are under way when measured

T = TypeVar("T")


def matches(task: str, worlds: int, threads: int) -> Measure:
    """`Matches`: arrays in, arrays out. Also its time that is not physics."""
    made, clock = rsoccer.make_task(task), Clock()
    simulator = TimedSimulator(made.config, worlds, threads, clock)
    played = rsoccer.Matches(made, worlds, seed=0, threads=threads, simulator=simulator)
    played.reset()
    actions = drawn((worlds, len(played.agents), made.action_size))
    step = held(actions, played.step)
    for _ in range(min(200, WARM_UP // worlds)):
        step()

    def measure(seconds: float) -> Values:
        clock.take()
        rate = worlds * calls(step, seconds)
        outside = 1.0 - clock.take()[1]["physics"]
        return {SPEED: rate, OUTSIDE: 1e6 * outside / rate}

    return measure


def parallel(env: ParallelEnv[str, Floats, Any]) -> Measure:
    """PettingZoo's parallel interface: dictionaries by agent."""
    env.reset(seed=0)
    agents = list(env.possible_agents)
    arrays = drawn((len(agents), *shape_of(env.action_space(agents[0]))))

    def act(actions: dict[str, Floats]) -> None:
        env.step(actions)
        if not env.agents:
            env.reset()

    return repeated(held([dict(zip(agents, array, strict=True)) for array in arrays], act), 1)


def aec(env: AECEnv[str, Floats, Any]) -> Measure:
    """PettingZoo's turns of one agent after the other; all of them together are a step."""
    env.reset(seed=0)
    agents = list(env.possible_agents)
    arrays = drawn((len(agents), *shape_of(env.action_space(agents[0]))))

    def act(actions: Floats) -> None:
        for action in actions:
            if env.terminations[env.agent_selection] or env.truncations[env.agent_selection]:
                env.reset()
            env.last()
            env.step(action)

    return repeated(held(arrays, act), 1)


def single(env: gymnasium.Env[Floats, Any]) -> Measure:
    """Gymnasium's Env."""
    env.reset(seed=0)

    def act(action: Floats) -> None:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()

    return repeated(held(drawn(shape_of(env.action_space)), act), 1)


def vector(env: VectorEnv[Floats, Array, Array]) -> Measure:
    """Gymnasium's VectorEnv."""
    env.reset(seed=0)
    step = held(drawn(shape_of(env.action_space)), env.step)
    for _ in range(min(200, WARM_UP // env.num_envs)):
        step()
    return repeated(step, env.num_envs)


def drawn(shape: tuple[int, ...]) -> list[Floats]:
    """A few random arrays within [-1, 1]."""
    chance = np.random.default_rng(0)
    return [chance.uniform(-1.0, 1.0, shape).astype(np.float32) for _ in range(DRAWN)]


def held(actions: list[T], act: Callable[[T], object]) -> Callable[[], None]:
    """Acts with one action after the other, ten times each, round and round."""
    times: Iterator[int] = count()

    def step() -> None:
        act(actions[next(times) // HELD % len(actions)])

    return step


def shape_of(space: gymnasium.Space[Any]) -> tuple[int, ...]:
    """Shape of a space's arrays."""
    if space.shape is None:
        raise TypeError(f"expected a space of arrays, got {space}")
    return space.shape

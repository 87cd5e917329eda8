"""How fast this machine plays: `make bench`, or `python -m benches.throughput`.

Random play, three a side, observations and rewards included. Every case is measured once a
round, and the rounds repeat, so that a busy moment of the machine hits all cases alike; the
table holds the median round and the slowest and fastest one. A debug build is refused.
"""

import argparse
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from pettingzoo import ParallelEnv

import rsoccer
from benches.table import RESULTS, Figure, physics_alone, store, this_machine
from rsoccer.frame import Floats
from rsoccer.train.clock import Clock, TimedSimulator

TASK = "VSSSelfPlay-v0"
WORLDS = (1, 64, 1024)
THREADS = (1, 2)
DRAWN = 16  # different random actions, drawn ahead: drawing them is not what is measured

Step = Callable[[], object]


@dataclass(frozen=True)
class Case:
    """One thing to measure."""

    name: str
    worlds: int
    threads: int


def main(arguments: list[str] | None = None) -> Path:
    """Measure, print and store; the path of the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=7, help="times each case is measured")
    parser.add_argument("--seconds", type=float, default=1.0, help="length of each measurement")
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder of the table")
    options = parser.parse_args(arguments)
    machine = this_machine()
    if machine.profile != "release":
        sys.exit(f"this is a {machine.profile} build; its speed says nothing: build in release")
    figures = [
        *physics_alone(),
        *measure(cases(), options.rounds, options.seconds),
        *shares(options.rounds, options.seconds),
    ]
    for figure in figures:
        case = f"{figure.name}, {figure.worlds} worlds, {figure.threads} threads"
        print(f"{case:<48}{figure.median:>12,.2f} {figure.unit}")
    return store(figures, machine, options.out)


# -- What is measured --------------------------------------------------------------------------


def cases() -> dict[Case, Step]:
    """Every case with the function that makes one step of it."""
    found: dict[Case, Step] = {}
    for worlds in WORLDS:
        for threads in THREADS if worlds > 1 else (1,):
            found[Case("physics", worlds, threads)] = physics(worlds, threads)
            found[Case("matches", worlds, threads)] = matches(worlds, threads)
    soccer = rsoccer.parallel_env(TASK)
    found[Case("parallel_env", 1, 1)] = dictionaries(soccer)
    found[Case("empty_parallel_env", 1, 1)] = dictionaries(EmptyEnv(soccer))
    return found


def physics(worlds: int, threads: int) -> Step:
    """Steps of the simulator alone, from random starts; commands are random wheel speeds."""
    task = rsoccer.make_task(TASK)
    simulator = rsoccer.Simulator(task.config, worlds=worlds, threads=threads)
    starts = task.get_initial_positions_frame(rsoccer.WorldRng.seeded(0, worlds)).rows
    rows = np.empty_like(starts)
    simulator.place(np.ones(worlds, np.bool_), starts, rows)
    shape = (worlds, task.config.n_robots, len(task.config.command_columns))
    commands = drawn(shape, task.config.robot.max_wheel_speed)
    return lambda: simulator.step(next(commands), rows)


def matches(worlds: int, threads: int, clock: Clock | None = None) -> Step:
    """Steps of `Matches`: physics, views, observations, rewards, restarts."""
    task = rsoccer.make_task(TASK)
    simulator = None if clock is None else TimedSimulator(task.config, worlds, threads, clock)
    played = rsoccer.Matches(task, worlds, seed=0, threads=threads, simulator=simulator)
    played.reset()
    actions = drawn((worlds, len(played.agents), task.action_size), 1.0)
    return lambda: played.step(next(actions))


def dictionaries(env: ParallelEnv[str, Floats, Floats]) -> Step:
    """Steps of a PettingZoo env, which starts anew when its agents are gone."""
    env.reset(seed=0)
    agents = env.possible_agents
    shape = env.action_space(agents[0]).shape or ()
    arrays = drawn((len(agents), *shape), 1.0)
    actions = cycle([dict(zip(agents, next(arrays), strict=True)) for _ in range(DRAWN)])

    def step() -> None:
        env.step(next(actions))
        if not env.agents:
            env.reset()

    return step


class EmptyEnv(ParallelEnv[str, Floats, Floats]):
    """Nothing but the dictionaries that PettingZoo asks for: no env of this shape is faster."""

    def __init__(self, like: ParallelEnv[str, Floats, Floats]) -> None:
        """Have the agents and spaces of another env."""
        self.possible_agents = like.possible_agents
        self._like = like
        self._shape = like.observation_space(like.possible_agents[0]).shape

    def observation_space(self, agent: str) -> gymnasium.Space[Any]:
        """The other env's."""
        return self._like.observation_space(agent)

    def action_space(self, agent: str) -> gymnasium.Space[Any]:
        """The other env's."""
        return self._like.action_space(agent)

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats], dict[str, Any]]:
        """Zeros."""
        self.agents = list(self.possible_agents)
        return self._zeros(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, Floats]
    ) -> tuple[
        dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], dict[str, Any]
    ]:
        """Zeros."""
        agents = self.agents
        return (
            self._zeros(),
            dict.fromkeys(agents, 0.0),
            dict.fromkeys(agents, False),
            dict.fromkeys(agents, False),
            {agent: {} for agent in agents},
        )

    def _zeros(self) -> dict[str, Floats]:
        return {agent: np.zeros(self._shape or (), np.float32) for agent in self.agents}


def drawn(shape: tuple[int, ...], most: float) -> Iterator[Floats]:
    """An endless round of a few random arrays."""
    chance = np.random.default_rng(0)
    return cycle([chance.uniform(-most, most, shape).astype(np.float32) for _ in range(DRAWN)])


# -- Measuring ---------------------------------------------------------------------------------


def measure(steps: dict[Case, Step], rounds: int, seconds: float) -> Iterator[Figure]:
    """World-steps per second of each case; one round before the first warms everything up."""
    rates: dict[Case, list[float]] = {case: [] for case in steps}
    for _ in range(rounds + 1):
        for case, step in steps.items():
            rates[case].append(case.worlds * rate(step, seconds))
    for case, values in rates.items():
        yield figure(case, "world-steps/s", values[1:])


def rate(step: Step, seconds: float) -> float:
    """Calls per second."""
    calls, start = 0, time.perf_counter()
    while (spent := time.perf_counter() - start) < seconds:
        step()
        calls += 1
    return calls / spent


def shares(rounds: int, seconds: float) -> Iterator[Figure]:
    """Share of the time of `Matches` that is physics; the rest is views, tasks and restarts."""
    for worlds in WORLDS:
        clock = Clock()
        step, values = matches(worlds, 1, clock), []
        for _ in range(rounds):
            clock.take()
            rate(step, seconds / 2)
            values.append(clock.take()[1]["physics"])
        yield figure(Case("physics_share", worlds, 1), "share", values)


def figure(case: Case, unit: str, values: list[float]) -> Figure:
    """The median of a case with its extremes."""
    middle, least, most = statistics.median(values), min(values), max(values)
    return Figure(
        case.name, case.worlds, case.threads, unit, middle, least, most, rounds=len(values)
    )


if __name__ == "__main__":
    main()

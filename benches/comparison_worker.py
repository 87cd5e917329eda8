"""Child process of `benches.comparison`: steps one version of the package in turns.

    python comparison_worker.py INTERFACE TASK WORLDS

It imports only what all versions of the package have, but for the scenes of a `Simulator`, which
are in `benches`: the version is the one that comes first in `PYTHONPATH`. Each line of the input is
a number of steps; the answer is the time that they took in this process, in seconds. The file of
the imported package comes first.
"""

import json
import sys
import time
from collections.abc import Callable, Sequence
from itertools import count
from typing import Any, Final

import numpy as np

import rsoccer

HELD: Final = 10  # steps with the same actions
ACTIONS: Final = 16  # different random actions, drawn in advance so as not to be measured

Step = Callable[[], object]


def main() -> None:
    """Answer all lines of the input."""
    interface, task, worlds = sys.argv[1:]
    step = stepper(interface, task, int(worlds))
    answer(rsoccer.__file__)
    for line in sys.stdin:
        answer(timed(step, int(line)))


def answer(value: object) -> None:
    """Write a value as a line of JSON."""
    sys.stdout.write(f"{json.dumps(value)}\n")
    sys.stdout.flush()


def timed(step: Step, steps: int) -> float:
    """Return the processor time of some steps, s."""
    start = time.process_time()
    for _ in range(steps):
        step()
    return time.process_time() - start


def stepper(interface: str, task: str, worlds: int) -> Step:
    """Return a function that makes a step with random actions, and resets what has ended."""
    if interface == "Matches":
        return matches(task, worlds)
    if interface == "Simulator":
        return physics(task, worlds)
    env: Any = getattr(rsoccer, interface)(task)
    env.reset(seed=0)
    return {"single_env": single, "parallel_env": parallel, "env": turns}[interface](env)


def matches(task: str, worlds: int) -> Step:
    """Return a step of `Matches`."""
    batch = rsoccer.Matches(task, worlds, seed=0)
    batch.reset()
    held = Held((worlds, len(batch.agents), batch.action_size))
    return lambda: batch.step(held.next())


def physics(name: str, worlds: int) -> Step:
    """Return a step of `Simulator` in a scene, which begins anew after its last step."""
    from benches.scenarios import SCENARIOS, Driver
    from benches.simulators import SimulatorAdapter

    scenario = next(scenario for scenario in SCENARIOS if scenario.name == name)
    simulator, driver = SimulatorAdapter(scenario, worlds), Driver(scenario, worlds)
    start, commands = scenario.start(rsoccer.WorldRng.seeded(0, worlds)), list[Any]()
    simulator.place(start)
    for first in range(0, scenario.episode, driver.held):
        # The commands of a crowd depend on its positions: they are the same when it plays again.
        commands.append(simulator.prepare(driver.commands(first, simulator.positions())))
        for _ in range(driver.held):
            simulator.step(commands[-1])
    steps = count()

    def step_again() -> None:
        step = next(steps) % scenario.episode
        if step == 0:
            simulator.place(start)
        simulator.step(commands[step // driver.held])

    return step_again


def single(env: Any) -> Step:  # noqa: ANN401  (of Gymnasium)
    """Return a step of a Gymnasium environment."""
    held = Held(env.action_space.shape)

    def step() -> None:
        _, _, terminated, truncated, _ = env.step(held.next())
        if terminated or truncated:
            env.reset()

    return step


def parallel(env: Any) -> Step:  # noqa: ANN401  (of PettingZoo)
    """Return a step of a PettingZoo environment in which all agents act at once."""
    agents = list(env.agents)
    held = Held((len(agents), *env.action_space(agents[0]).shape))

    def step() -> None:
        env.step(dict(zip(agents, held.next(), strict=True)))
        if not env.agents:
            env.reset()

    return step


def turns(env: Any) -> Step:  # noqa: ANN401  (of PettingZoo)
    """Return a step of a PettingZoo environment in which one agent acts after the other."""
    agents = list(env.agents)
    held = Held((len(agents), *env.action_space(agents[0]).shape))

    def step() -> None:
        for action in held.next():
            env.step(action)
        if any(env.terminations.values()) or any(env.truncations.values()):
            env.reset()

    return step


class Held:
    """Random actions, each held for some steps."""

    def __init__(self, shape: Sequence[int]) -> None:
        """Draw actions, always the same for a shape."""
        rng = np.random.default_rng(1)
        self._actions = rng.uniform(-1.0, 1.0, (ACTIONS, *shape)).astype(np.float32)
        self._calls = count()

    def next(self) -> Any:  # noqa: ANN401  (float32 array)
        """Return the actions of the next step."""
        return self._actions[next(self._calls) // HELD % ACTIONS]


if __name__ == "__main__":
    main()

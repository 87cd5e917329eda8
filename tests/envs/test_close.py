"""Environments close their simulator, once."""

from typing import Any

import pytest

import rsoccer
from rsoccer import SimConfig, Simulator
from rsoccer._core import Threads


class Closing:
    """A simulator that counts how often it is closed."""

    def __init__(self, config: SimConfig, worlds: int, threads: Threads) -> None:
        self.own = Simulator(config, worlds, threads)
        self.closed = 0

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self.own, name)

    def close(self) -> None:
        self.closed += 1


@pytest.mark.parametrize("name", ["single_env", "parallel_env", "vector_env", "robots_vector_env"])
def test_an_environment_closes_its_simulator_once(name: str) -> None:
    made: list[Closing] = []

    def factory(config: SimConfig, worlds: int, threads: Threads) -> Closing:
        made.append(Closing(config, worlds, threads))
        return made[-1]

    make: Any = getattr(rsoccer, name)
    env = make("VSS-v0", simulator=factory)
    env.reset(seed=0)
    env.close()
    assert [simulator.closed for simulator in made] == [1] * len(made)
    env.close()
    assert [simulator.closed for simulator in made] == [1] * len(made)
    assert made

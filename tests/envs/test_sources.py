"""Every environment takes a simulator and a sensor model, in the same ways."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import gymnasium
import numpy as np
import pytest

import rsoccer
from tests.environments import MAKERS
from tests.simulators import Blind, Still, still

TEXT = "tests.simulators:still"
SOURCES: dict[str, Any] = {"function": still, "class": Still, "text": TEXT}


def matches_of(env: Any) -> Any:  # noqa: ANN401
    """Matches of an environment."""
    own = env.unwrapped
    return getattr(own, "_match", own)._matches


@pytest.mark.parametrize("source", SOURCES.values(), ids=SOURCES)
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_an_environment_has_the_simulator_that_is_named(
    make: Callable[..., Any],
    source: Any,  # noqa: ANN401
) -> None:
    env = make(simulator=source)
    matches = matches_of(env)
    env.reset(seed=0)
    before = matches.frame.robots.position.copy()
    for _ in range(5):
        matches.step(np.ones((matches.worlds, len(matches.agents), 2), np.float32))
    assert isinstance(matches._simulator, Still)
    np.testing.assert_allclose(matches.frame.robots.position, before, atol=0.02)


@pytest.mark.parametrize("source", [Blind(), "tests.simulators:Blind", "tests.simulators:BLIND"])
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_an_environment_has_the_senses_that_are_named(
    make: Callable[..., Any],
    source: Any,  # noqa: ANN401
) -> None:
    env = make(sensing=source)
    env.reset(seed=0)
    play = matches_of(env).play
    assert not play.sensed.ball.position.any()
    np.testing.assert_array_equal(play.sensed.robots.position, play.frame.robots.position)


COPIES: dict[str, Callable[[Any], Any]] = {
    "deepcopy": copy.deepcopy,
    "pickle": lambda env: pickle.loads(pickle.dumps(env)),
    "cloudpickle": lambda env: cloudpickle.loads(cloudpickle.dumps(env)),
}


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("source", SOURCES.values(), ids=SOURCES)
def test_copies_have_simulators_of_their_own(copied: Callable[[Any], Any], source: Any) -> None:  # noqa: ANN401
    for make in (MAKERS["single"], MAKERS["robots"]):
        env = make(simulator=source, sensing=Blind())
        env.reset(seed=1)
        twin = copied(env)
        ours, theirs = matches_of(env), matches_of(twin)
        assert isinstance(theirs._simulator, Still)
        assert theirs._simulator is not ours._simulator
        np.testing.assert_array_equal(twin.reset()[0], env.reset()[0])


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("begun", [False, True])
def test_a_simulator_itself_serves_one_environment(
    copied: Callable[[Any], Any], begun: bool
) -> None:
    task = rsoccer.make_task("VSS-v0")
    own = Still(task.config, 1, rsoccer._core.Threads(1))
    env = rsoccer.single_env(task, simulator=own)
    assert matches_of(env)._simulator is own
    if begun:
        env.reset(seed=0)
    with pytest.raises(
        TypeError, match=r"^simulator: a copy .* needs one of its own; expected a fu"
    ):
        copied(env)


def test_worker_processes_have_the_simulator_that_is_named() -> None:
    made = [lambda: gymnasium.make("rsoccer:rsoccer/VSS-v0", simulator=TEXT) for _ in range(2)]
    envs = gymnasium.vector.AsyncVectorEnv(made, context="spawn")
    try:
        assert envs.reset(seed=0)[0].shape[0] == 2
        names = envs.call("get_wrapper_attr", "_matches")
        assert [type(each._simulator).__name__ for each in names] == ["Still", "Still"]
    finally:
        envs.close()

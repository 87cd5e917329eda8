"""Copies of environments that were never reset play different matches; others are equal."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import gymnasium
import numpy as np
import pytest

import rsoccer
from tests.helpers import comparable

NAME = "VSSSelfPlay-v0"
MAKERS: dict[str, Callable[[], Any]] = {
    "parallel": lambda: rsoccer.parallel_env(NAME),
    "aec": lambda: rsoccer.env(NAME),
    "single": lambda: rsoccer.single_env("VSS-v0"),
    "make": lambda: gymnasium.make("rsoccer/VSS-v0"),
    "vector": lambda: rsoccer.vector_env("VSS-v0", 2),
    "robots": lambda: rsoccer.robots_vector_env(NAME, worlds=2),
}
COPIES: dict[str, Callable[[Any], Any]] = {
    "deepcopy": copy.deepcopy,
    "pickle": lambda env: pickle.loads(pickle.dumps(env)),
    "cloudpickle": lambda env: cloudpickle.loads(cloudpickle.dumps(env)),
}


def start(env: Any, **options: Any) -> Any:  # noqa: ANN401
    """First observations of an episode."""
    given = env.reset(**options)
    return comparable(env.last() if given is None else given)  # an AEC environment returns nothing


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_copies_that_were_never_reset_play_different_matches(
    make: Callable[[], Any], copied: Callable[[Any], Any]
) -> None:
    """All of them once played the same match."""
    env = make()
    envs = [env, *(copied(env) for _ in range(3)), copied(copied(env))]
    starts = [str(start(each)) for each in envs]
    assert len(set(starts)) == len(envs)
    assert len({str(start(each, seed=5)) for each in envs}) == 1


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
@pytest.mark.parametrize("seed", [3, None])
def test_copies_in_an_episode_continue_with_the_same_future(
    make: Callable[[], Any], copied: Callable[[Any], Any], seed: int | None
) -> None:
    env = make()
    start(env, seed=seed)
    twin = copied(env)
    assert start(env) == start(twin)


def test_the_seed_of_a_copy_reproduces_it() -> None:
    """Gymnasium's `np_random_seed` names the seed of the matches."""
    for make in (MAKERS["single"], MAKERS["vector"], MAKERS["robots"]):
        env = make()
        twin = copy.deepcopy(env)
        seed = twin.np_random_seed
        assert seed != env.np_random_seed
        observations = twin.reset()[0]
        np.testing.assert_array_equal(make().reset(seed=seed)[0], observations)

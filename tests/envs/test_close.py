"""Calls of closed environments raise; formerly they continued without an error."""

import copy
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from gymnasium.error import ClosedEnvironmentError
from pettingzoo.utils.conversions import aec_to_parallel

import rsoccer

SINGLE = "SSLGoToBall-v0"


def environments() -> list[Any]:
    """One environment of each kind."""
    in_turn = rsoccer.env("VSSMulti-v0")
    return [
        pytest.param(rsoccer.parallel_env("VSSMulti-v0"), id="parallel"),
        pytest.param(in_turn, id="aec"),
        pytest.param(aec_to_parallel(rsoccer.env("VSSMulti-v0")), id="aec as parallel"),
        pytest.param(rsoccer.single_env(SINGLE), id="single"),
        *(
            pytest.param(rsoccer.vector_env(SINGLE, 2, autoreset_mode=mode), id=mode)
            for mode in ("next_step", "same_step", "disabled")
        ),
    ]


def an_action(env: Any) -> Any:  # noqa: ANN401  (depends on the library)
    """A random argument of `step`."""
    if hasattr(env, "agent_selection"):
        return env.action_space(env.agent_selection).sample()
    if hasattr(env, "possible_agents"):
        return {agent: env.action_space(agent).sample() for agent in env.agents}
    return env.action_space.sample()


def closed(env: Any, steps: int = 0) -> Any:  # noqa: ANN401
    """A copy of an environment that is stepped and then closed twice."""
    env = copy.deepcopy(env)
    env.reset(seed=0)
    for _ in range(steps):
        env.step(an_action(env))
    env.close()
    env.close()
    return env


CALLS: dict[str, Callable[[Any], object]] = {
    "reset": lambda env: env.reset(seed=1),
    "step": lambda env: env.step(an_action(env)),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("env", environments())
def test_calls_after_close_raise(env: Any, call: str) -> None:  # noqa: ANN401
    for steps in (0, 1, 2):  # of an AEC env: the first, second and last agent's
        with pytest.raises(ClosedEnvironmentError, match=f"{call} after close: make another"):
            CALLS[call](closed(env, steps))
    env.reset(seed=0)
    env.step(an_action(env))  # the original is still open


@pytest.mark.parametrize("make", [rsoccer.parallel_env, rsoccer.env, rsoccer.single_env])
def test_render_after_close_raises(make: Callable[..., Any]) -> None:
    env = make(SINGLE, render_mode="rgb_array")
    env.reset(seed=0)
    assert isinstance(env.render(), np.ndarray)
    env.close()
    with pytest.raises(ClosedEnvironmentError, match="render after close"):
        env.render()


def test_render_of_closed_vector_environments_raises() -> None:
    envs = rsoccer.vector_env(SINGLE, 2, "rgb_array")
    envs.reset(seed=0)
    envs.close()
    with pytest.raises(ClosedEnvironmentError, match="render after close"):
        envs.render()

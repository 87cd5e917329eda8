"""Environments of trainer libraries close their simulator, once, after an error too.

Those of RLlib are in the files of its tests.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.closing import PLANTED, TEXT, check_closing

NAME = "VSSSelfPlay-v0"


def vec_env(normalized: bool) -> tuple[Any, Callable[[], Any]]:
    """An environment of Stable-Baselines3, and its step."""
    pytest.importorskip("stable_baselines3")
    from rsoccer.sb3 import SoccerVecEnv, SoccerVecNormalize

    envs: Any = SoccerVecEnv(NAME, 2, simulator=TEXT)
    envs = SoccerVecNormalize(envs) if normalized else envs
    return envs, lambda: envs.step(np.zeros((envs.num_envs, 2), np.float32))


def torchrl_env() -> tuple[Any, Callable[[], Any]]:
    """An environment of TorchRL, and its step."""
    pytest.importorskip("torchrl")
    from rsoccer.torchrl import SoccerEnv

    env = SoccerEnv(NAME, 2, simulator=TEXT)
    return env, lambda: env.rollout(1)


MAKERS: dict[str, Callable[[], tuple[Any, Callable[[], Any]]]] = {
    "SoccerVecEnv": lambda: vec_env(False),
    "SoccerVecNormalize": lambda: vec_env(True),
    "torchrl": torchrl_env,
}


@pytest.mark.parametrize("fails_after", [None, 3])
@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_an_environment_closes_its_simulator_once(
    make: Callable[[], tuple[Any, Callable[[], Any]]], fails_after: int | None
) -> None:
    PLANTED.clear(fails_after)
    env, step = make()
    env.reset()
    for _ in range(3):
        step()
    check_closing(env.close, None if fails_after is None else step)


def test_torchrl_closes_the_simulator_of_groups_that_it_refuses() -> None:
    pytest.importorskip("torchrl")
    from rsoccer.torchrl import SoccerEnv

    PLANTED.clear()
    with pytest.raises(ValueError, match="blue_0"):
        SoccerEnv(NAME, simulator=TEXT, group_map={"blue": ["blue_0", "blue_0"]})
    assert PLANTED.closed() == [1]


def test_a_wrapper_of_torchrl_passes_it_on() -> None:
    pytest.importorskip("torchrl")
    from torchrl.envs import RewardSum, TransformedEnv

    PLANTED.clear()
    env = TransformedEnv(torchrl_env()[0], RewardSum())
    env.reset()
    env.close()
    assert PLANTED.closed() == [1]

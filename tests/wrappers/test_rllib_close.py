"""RLlib's environment and runner close their simulator, once, after an error too."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.closing import PLANTED, TEXT, check_closing

pytest.importorskip("torch")
pytest.importorskip("ray.rllib")

from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
from ray.rllib.env.multi_agent_env_runner import MultiAgentEnvRunner

from rsoccer.rllib import MatchesEnvRunner, SoccerMultiAgentEnv

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")

SETTINGS = {"task": "VSSSelfPlay-v0", "simulator": TEXT}


def config_of(runner: type) -> Any:  # noqa: ANN401
    """PPO with a small network."""
    return (
        PPOConfig()
        .environment(SoccerMultiAgentEnv, env_config=SETTINGS)
        .env_runners(env_runner_cls=runner, num_env_runners=0, num_envs_per_env_runner=2)
        .multi_agent(policies={"shared"}, policy_mapping_fn=lambda *_, **__: "shared")
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[16]))
    )


def environment() -> tuple[Callable[[], Any], Callable[[], Any]]:
    """The step of an environment, and what closes it."""
    env = SoccerMultiAgentEnv(SETTINGS)
    env.reset()
    zeros = dict.fromkeys(env.agents, np.zeros(2, np.float32))
    return lambda: env.step(zeros), env.close


def runner() -> tuple[Callable[[], Any], Callable[[], Any]]:
    """The step of a runner, and what closes it."""
    made = MatchesEnvRunner(config=config_of(MatchesEnvRunner))
    return lambda: made.sample(num_timesteps=2, random_actions=True), made.stop


@pytest.mark.parametrize("fails_after", [None, 3])
@pytest.mark.parametrize("make", [environment, runner])
def test_what_plays_matches_closes_its_simulator_once(
    make: Callable[[], tuple[Callable[[], Any], Callable[[], Any]]], fails_after: int | None
) -> None:
    PLANTED.clear(fails_after)
    step, close = make()
    for _ in range(3):
        step()
    check_closing(close, None if fails_after is None else step)


def test_rllibs_own_runner_closes_all_of_its_environments() -> None:
    PLANTED.clear()
    made = MultiAgentEnvRunner(config=config_of(MultiAgentEnvRunner))
    made.sample(num_timesteps=2, random_actions=True)
    made.stop()
    assert len(PLANTED.made) >= 2
    assert PLANTED.closed() == [1] * len(PLANTED.made)


def test_new_matches_of_a_runner_close_those_before() -> None:
    PLANTED.clear()
    made = MatchesEnvRunner(config=config_of(MatchesEnvRunner))
    made.make_env()
    assert PLANTED.closed() == [1, 0]
    made.stop()
    assert PLANTED.closed() == [1, 1]


def test_a_runner_that_is_refused_closes_its_simulator() -> None:
    PLANTED.clear()
    config = config_of(MatchesEnvRunner)
    with pytest.raises(ValueError, match="recurrent"):
        MatchesEnvRunner(config=config.rl_module(model_config=DefaultModelConfig(use_lstm=True)))
    assert PLANTED.closed() == [1]

"""RLlib's wrapper of a match, and its runners, which play episodes for training.

The runners are called without an algorithm, which would start a cluster.
"""

from typing import Any

import gymnasium
import pytest

import rsoccer
from rsoccer.envs.parallel import SoccerParallelEnv, parallel_env
from rsoccer.envs.vector import SoccerVectorEnv
from tests.parallel_matches import TASKS

wrappers = pytest.importorskip("ray.rllib.env.wrappers.pettingzoo_env")
ppo = pytest.importorskip("ray.rllib.algorithms.ppo")
many = pytest.importorskip("ray.rllib.env.multi_agent_env_runner")
single = pytest.importorskip("ray.rllib.env.single_agent_env_runner")

gymnasium.register_envs(rsoccer)

# Each of RLlib's runners registers the same id.
pytestmark = pytest.mark.filterwarnings("ignore:.*Overriding environment rllib:UserWarning")

MAX_CYCLES = 5


def short_match() -> SoccerParallelEnv:
    """A match with a short time limit."""
    return parallel_env("VSSSelfPlay-v0", max_cycles=MAX_CYCLES)


def wrapped(_: object = None) -> Any:  # noqa: ANN401  (types only where it is installed)
    """The same in RLlib's wrapper."""
    return wrappers.ParallelPettingZooEnv(short_match())


def whole(_: object = None) -> Any:  # noqa: ANN401
    """The same as this package's environment for RLlib."""
    from rsoccer.rllib import SoccerMultiAgentEnv

    return SoccerMultiAgentEnv({"task": "VSSSelfPlay-v0", "max_steps": MAX_CYCLES})


def test_a_match_is_wrapped_and_ends_for_all_at_once() -> None:
    env, match = wrapped(), short_match()
    assert sorted(env.agents) == sorted(env.possible_agents) == sorted(match.possible_agents)
    for _ in range(2):
        observations, _ = env.reset(seed=0)
        assert env.observation_space.contains(observations)
        for step in range(1, MAX_CYCLES + 1):
            _, rewards, terminated, truncated, _ = env.step(env.action_space.sample())
            ended = step == MAX_CYCLES
            everyone = [*match.possible_agents, "__all__"]
            assert terminated == dict.fromkeys(everyone, False)
            assert truncated == dict.fromkeys(everyone, ended)
            assert sorted(rewards) == sorted(match.possible_agents)


@pytest.mark.parametrize("name", TASKS)
def test_every_task_is_wrapped(name: str) -> None:
    env = wrappers.ParallelPettingZooEnv(parallel_env(name, max_cycles=MAX_CYCLES))
    observations, _ = env.reset(seed=0)
    ended = False
    while not ended:
        assert env.observation_space.contains(observations)
        observations, _, terminated, truncated, _ = env.step(env.action_space.sample())
        ended = terminated["__all__"] or truncated["__all__"]
    assert set(observations) == set(env.possible_agents)


@pytest.mark.parametrize(("create", "terminated"), [(wrapped, True), (whole, False)])
def test_its_runner_plays_a_match_with_one_policy_for_all(create: Any, terminated: bool) -> None:  # noqa: ANN401
    """RLlib takes an end of all agents for a termination, and then bootstraps no value.

    Its wrapper reports each agent's time limit, so that every episode is terminated.
    `SoccerMultiAgentEnv` reports only the common end.
    """
    config = (
        ppo.PPOConfig()
        .environment(create)
        .env_runners(num_env_runners=0)
        .multi_agent(policies={"shared"}, policy_mapping_fn=lambda *_, **__: "shared")
    )
    runner = many.MultiAgentEnvRunner(config=config)
    episodes = runner.sample(num_episodes=2)
    runner.stop()
    assert [len(episode) for episode in episodes] == [MAX_CYCLES] * 2
    for episode in episodes:
        assert (episode.is_terminated, episode.is_truncated) == (terminated, True)
        for robot in episode.agent_episodes.values():
            assert (robot.is_terminated, robot.is_truncated) == (terminated, True)
        assert sorted(episode.agent_episodes) == sorted(short_match().possible_agents)
        assert {len(robot) for robot in episode.agent_episodes.values()} == {MAX_CYCLES}


def test_its_runner_plays_many_single_learner_matches() -> None:
    config = (
        ppo.PPOConfig()
        .environment("rsoccer/VSS-v0", env_config={"max_steps": MAX_CYCLES})
        .env_runners(
            num_env_runners=0,
            num_envs_per_env_runner=3,
            gym_env_vectorize_mode="vector_entry_point",
        )
    )
    runner = single.SingleAgentEnvRunner(config=config)
    assert isinstance(runner.env.unwrapped, SoccerVectorEnv)
    episodes = runner.sample(num_episodes=6)
    runner.stop()
    assert len(episodes) >= 6
    for episode in episodes:
        assert (len(episode), episode.is_terminated) == (MAX_CYCLES, False)
        assert episode.is_truncated

"""SuperSuit's vector environments: each robot of a match is one of their environments."""

from typing import Any

import numpy as np
import pytest

from rsoccer.arrays import Floats
from rsoccer.envs.parallel import parallel_env
from tests.parallel_matches import TASKS

supersuit = pytest.importorskip("supersuit")

MAX_CYCLES = 5
ROBOTS = 6
MATCHES = 3


def robots() -> Any:  # noqa: ANN401  (SuperSuit has no types)
    """The robots of one short match."""
    match = parallel_env("VSSSelfPlay-v0", max_cycles=MAX_CYCLES)
    return supersuit.pettingzoo_env_to_vec_env_v1(match)


def test_the_robots_of_a_match_are_a_vector_with_autoreset() -> None:
    envs = robots()
    assert envs.num_envs == ROBOTS
    assert len(envs.reset(seed=0)[0]) == ROBOTS
    actions = np.zeros((ROBOTS, 2), np.float32)
    for step in range(1, 2 * MAX_CYCLES + 1):
        observations, rewards, terminated, truncated, infos = envs.step(actions)
        assert observations.shape == (ROBOTS, *envs.observation_space.shape)
        assert rewards.shape == (ROBOTS,)
        assert not terminated.any()
        ended = step % MAX_CYCLES == 0
        assert truncated.tolist() == [ended] * ROBOTS
        metrics = {"goal_score", "free_balls", "steps"}
        names = {"terminal_observation", "TimeLimit.truncated"} | metrics
        assert all(set(info) == (names if ended else set()) for info in infos)


@pytest.mark.parametrize("name", TASKS)
def test_the_robots_of_every_task_are_a_vector(name: str) -> None:
    match = parallel_env(name, max_cycles=MAX_CYCLES)
    envs = supersuit.pettingzoo_env_to_vec_env_v1(match)
    envs.reset(seed=0)
    ends, actions = 0, np.zeros((envs.num_envs, match.task.action_size), np.float32)
    for _ in range(2 * MAX_CYCLES):
        observations, _, terminated, truncated, _ = envs.step(actions)
        assert observations.shape == (len(match.possible_agents), *envs.observation_space.shape)
        ends += bool((terminated | truncated).all())
    assert ends >= 2


def played(seed: int) -> tuple[Floats, Floats]:
    """First and last observations of several matches over more than an episode."""
    envs = supersuit.concat_vec_envs_v1(robots(), MATCHES)  # in this process
    first, _ = envs.reset(seed=seed)
    rng = np.random.default_rng(0)
    for _ in range(MAX_CYCLES + 2):
        actions = rng.uniform(-1.0, 1.0, (envs.num_envs, 2)).astype(np.float32)
        last = envs.step(actions)[0]
    return first, last


def test_copies_of_a_match_follow_their_own_seeds() -> None:
    first, last = played(seed=7)
    again = played(seed=7)
    np.testing.assert_array_equal(first, again[0])
    np.testing.assert_array_equal(last, again[1])
    assert len(np.unique(first, axis=0)) == MATCHES * ROBOTS
    assert len(np.unique(last, axis=0)) == MATCHES * ROBOTS


def test_unseeded_copies_play_different_matches() -> None:
    """All of them once played the same match."""
    envs = supersuit.concat_vec_envs_v1(robots(), MATCHES)
    assert len(np.unique(envs.reset()[0], axis=0)) == MATCHES * ROBOTS


def test_its_stable_baselines3_form_bootstraps_at_the_time_limit() -> None:
    pytest.importorskip("stable_baselines3")
    envs = supersuit.concat_vec_envs_v1(robots(), 2, base_class="stable_baselines3")
    envs.reset()
    for _ in range(MAX_CYCLES):
        _, _, ended, infos = envs.step(np.zeros((2 * ROBOTS, 2), np.float32))
    assert ended.all()
    for info in infos:
        assert info["TimeLimit.truncated"] is True
        assert info["steps"] == MAX_CYCLES
        assert info["terminal_observation"].shape == envs.observation_space.shape


# Python 3.12 and later warn of forks; tests/matches/test_fork.py shows ours to be safe.
@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")
def test_copies_in_other_processes_play_the_same() -> None:
    envs = supersuit.concat_vec_envs_v1(robots(), 2, num_cpus=2)
    here = supersuit.concat_vec_envs_v1(robots(), 2)
    actions = np.full((2 * ROBOTS, 2), 0.5, np.float32)
    try:
        np.testing.assert_array_equal(envs.reset(seed=3)[0], here.reset(seed=3)[0])
        for _ in range(3):
            np.testing.assert_array_equal(envs.step(actions)[0], here.step(actions)[0])
    finally:
        envs.close()


def test_its_stable_baselines3_form_trains() -> None:
    """Its wrapper has no seed, so the vector environment below it is seeded, and PPO is not."""
    ppo = pytest.importorskip("stable_baselines3").PPO
    envs = supersuit.concat_vec_envs_v1(robots(), MATCHES, base_class="stable_baselines3")
    envs.venv.reset(seed=0)
    assert len(np.unique(envs.reset(), axis=0)) == MATCHES * ROBOTS
    model = ppo("MlpPolicy", envs, n_steps=8, batch_size=48, n_epochs=1, device="cpu")
    model.learn(8 * MATCHES * ROBOTS)
    assert model.num_timesteps == 8 * MATCHES * ROBOTS

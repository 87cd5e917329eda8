"""Stable-Baselines3 checks one robot's match, and trains on it."""

from typing import Any

import gymnasium
import numpy as np
import pytest

import rsoccer

stable_baselines3 = pytest.importorskip("stable_baselines3")
env_checker = pytest.importorskip("stable_baselines3.common.env_checker")

gymnasium.register_envs(rsoccer)

MAX_STEPS = 20


def lone_match(**options: Any) -> gymnasium.Env[Any, Any]:  # noqa: ANN401
    """A short match by its id."""
    return gymnasium.make("rsoccer/VSS-v0", max_steps=MAX_STEPS, **options)


@pytest.mark.parametrize("options", [{}, {"discrete": True}, {"render_mode": "rgb_array"}])
def test_its_checker_accepts_us(options: dict[str, Any]) -> None:
    if "render_mode" in options:
        pytest.importorskip("pygame")
    env_checker.check_env(lone_match(**options))


def learned(seed: int) -> Any:  # noqa: ANN401  (types only where it is installed)
    """What PPO has become after some episodes."""
    model = stable_baselines3.PPO(
        "MlpPolicy", lone_match(), n_steps=64, batch_size=32, n_epochs=1, seed=seed, device="cpu"
    )
    return model.learn(128)


def test_ppo_trains_the_same_from_the_same_seed() -> None:
    model, again, other = learned(0), learned(0), learned(1)
    episodes = [episode["l"] for episode in model.ep_info_buffer]
    assert sum(episodes) > 128 - MAX_STEPS
    assert max(episodes) == MAX_STEPS
    seen = np.zeros(model.observation_space.shape, np.float32)
    actions = [each.predict(seen, deterministic=True)[0] for each in (model, again, other)]
    np.testing.assert_array_equal(actions[0], actions[1])
    assert (actions[0] != actions[2]).any()


def test_the_clock_truncates_so_that_values_are_carried_over_the_end() -> None:
    model = stable_baselines3.PPO("MlpPolicy", lone_match(), n_steps=8, batch_size=8, device="cpu")
    envs = model.get_env()
    envs.reset()
    ended = [envs.step(np.zeros((1, 2), np.float32))[2:] for _ in range(MAX_STEPS)][-1]
    assert ended[0].tolist() == [True]
    assert ended[1][0]["TimeLimit.truncated"]
    assert ended[1][0]["steps"] == MAX_STEPS
    assert ended[1][0]["terminal_observation"].shape == envs.observation_space.shape

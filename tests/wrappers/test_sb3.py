"""Stable-Baselines3: its checker, training on one match, and the example with many matches."""

import runpy
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

import rsoccer
from tests.single_learner import ONE_LEARNER

stable_baselines3 = pytest.importorskip("stable_baselines3")
env_checker = pytest.importorskip("stable_baselines3.common.env_checker")

gymnasium.register_envs(rsoccer)

MAX_STEPS = 20
EXAMPLE = Path(__file__).parents[2] / "examples" / "10_stable_baselines3.py"


def short_match(**options: Any) -> gymnasium.Env[Any, Any]:  # noqa: ANN401
    """A short match by id."""
    return gymnasium.make("rsoccer/VSS-v0", max_steps=MAX_STEPS, **options)


@pytest.mark.parametrize("options", [{}, {"discrete": True}, {"render_mode": "rgb_array"}])
def test_its_checker_accepts_the_env(options: dict[str, Any]) -> None:
    if "render_mode" in options:
        pytest.importorskip("pygame")
    env_checker.check_env(short_match(**options))


def learned(seed: int) -> Any:  # noqa: ANN401  (types only where it is installed)
    """PPO after some episodes."""
    model = stable_baselines3.PPO(
        "MlpPolicy", short_match(), n_steps=64, batch_size=32, n_epochs=1, seed=seed, device="cpu"
    )
    return model.learn(128)


def test_ppo_trains_the_same_from_the_same_seed() -> None:
    model, again, other = learned(0), learned(0), learned(1)
    episodes = [episode["l"] for episode in model.ep_info_buffer]
    assert sum(episodes) > 128 - MAX_STEPS
    assert max(episodes) == MAX_STEPS
    observation = np.zeros(model.observation_space.shape, np.float32)
    actions = [each.predict(observation, deterministic=True)[0] for each in (model, again, other)]
    np.testing.assert_array_equal(actions[0], actions[1])
    assert (actions[0] != actions[2]).any()


def test_the_time_limit_truncates_for_bootstrapped_values() -> None:
    model = stable_baselines3.PPO("MlpPolicy", short_match(), n_steps=8, batch_size=8, device="cpu")
    envs = model.get_env()
    envs.reset()
    ended = [envs.step(np.zeros((1, 2), np.float32))[2:] for _ in range(MAX_STEPS)][-1]
    assert ended[0].tolist() == [True]
    assert ended[1][0]["TimeLimit.truncated"]
    assert ended[1][0]["steps"] == MAX_STEPS
    assert ended[1][0]["terminal_observation"].shape == envs.observation_space.shape


# -- Many matches, by the example -------------------------------------------------------------


def many(name: str = "VSS-v0", matches: int = 3, **options: Any) -> Any:  # noqa: ANN401
    """Short matches in the example's class."""
    return runpy.run_path(str(EXAMPLE))["StableMatches"](
        f"rsoccer/{name}", matches, **{"max_steps": MAX_STEPS, **options}
    )


@pytest.mark.parametrize("discrete", [False, True])
@pytest.mark.parametrize("name", ONE_LEARNER)
def test_ppo_makes_a_first_update_on_every_task(name: str, discrete: bool) -> None:
    envs = many(name, discrete=discrete)
    model = stable_baselines3.PPO(
        "MlpPolicy", envs, n_steps=24, batch_size=36, n_epochs=1, seed=0, device="cpu"
    )
    before = [weight.detach().clone() for weight in model.policy.parameters()]
    model.learn(72)
    after = list(model.policy.parameters())
    assert model.num_timesteps == 72
    assert all(bool(weight.isfinite().all()) for weight in after)
    assert any(bool((a != b).any()) for a, b in zip(before, after, strict=True))
    envs.close()


def test_matches_of_the_example_equal_single_environments() -> None:
    """Stable-Baselines3 itself can make such a vector environment, which is slower."""
    make_vec_env = pytest.importorskip("stable_baselines3.common.env_util").make_vec_env
    theirs = make_vec_env("rsoccer/VSS-v0", 3, seed=5, env_kwargs={"max_steps": MAX_STEPS})
    ours = many()
    ours.seed(5)
    np.testing.assert_array_equal(ours.reset(), theirs.reset())
    rng = np.random.default_rng(0)
    for _ in range(MAX_STEPS - 1):
        actions = rng.uniform(-1.0, 1.0, (3, 2)).astype(np.float32)
        given, expected = ours.step(actions), theirs.step(actions)
        for value, reference in zip(given[:3], expected[:3], strict=True):
            np.testing.assert_array_equal(value, reference)
        assert given[3] == [{}] * 3
    given, expected = ours.step(actions), theirs.step(actions)
    np.testing.assert_array_equal(given[1], expected[1])
    assert given[2].tolist() == expected[2].tolist() == [True] * 3
    for info, reference in zip(given[3], expected[3], strict=True):
        np.testing.assert_array_equal(
            info["terminal_observation"], reference["terminal_observation"]
        )
        for name in ("TimeLimit.truncated", "goal_score", "steps"):
            assert info[name] == reference[name]
        assert info["TimeLimit.truncated"] is True


def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(EXAMPLE))["main"](2, 256)
    assert "256 steps; goal score" in capsys.readouterr().out

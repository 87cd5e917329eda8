"""Models of Stable-Baselines3 as policies, against `predict`."""

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
import pytest

import rsoccer
from rsoccer import Sensing
from rsoccer.match_evaluation import MatchEvaluation
from rsoccer.policies.libraries import from_sb3
from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng

stable_baselines3 = pytest.importorskip("stable_baselines3")
vec_env = pytest.importorskip("stable_baselines3.common.vec_env")

from rsoccer.sb3 import EvaluationCallback, SoccerVecEnv, SoccerVecNormalize  # noqa: E402

gymnasium.register_envs(rsoccer)

TASK = "VSS-v0"
OFF_POLICY = {"buffer_size": 200, "learning_starts": 40, "batch_size": 32, "train_freq": 20}
ON_POLICY = {"n_steps": 32}
KINDS = {
    "PPO": {"n_steps": 32, "batch_size": 32, "n_epochs": 1},
    "A2C": ON_POLICY,
    "SAC": OFF_POLICY,
    "TD3": OFF_POLICY,
    "DDPG": OFF_POLICY,
    "DQN": OFF_POLICY,
}


def new(kind: str, envs: Any, **settings: Any) -> Any:  # noqa: ANN401
    """A model with small networks."""
    settings = {"policy_kwargs": {"net_arch": [32, 16]}, **KINDS[kind], **settings}
    return getattr(stable_baselines3, kind)("MlpPolicy", envs, seed=0, device="cpu", **settings)


def learned(kind: str, envs: Any, **settings: Any) -> Any:  # noqa: ANN401
    """A model after some steps, so that its weights and statistics are not the first ones."""
    return new(kind, envs, **settings).learn(128)


def observations(model: Any, n: int = 50) -> np.ndarray:  # noqa: ANN401
    size = model.observation_space.shape[0]
    return np.random.default_rng(0).uniform(-4.0, 4.0, (n, size)).astype(np.float32)


def test_senses_and_varied_numbers_of_the_environment_stay_with_the_policy() -> None:
    varied = {"robot.mass": (0.9, 1.1)}
    envs = SoccerVecEnv(TASK, 2, sensing="rc2021, forecast=1", randomization=varied)
    network = from_sb3(new("PPO", envs))
    assert network.needs_forecast
    assert isinstance(network.sensing, Sensing)
    assert network.sensing == Sensing("rc2021", forecast=1.0)
    assert network.randomization == {"robot.mass": [0.9, 1.1]}
    other = from_sb3(new("PPO", envs), sensing=None, randomization={})
    assert (other.sensing, other.randomization, other.needs_forecast) == (None, {}, False)


def check_mean_actions(network: Network, model: Any, inputs: np.ndarray) -> None:  # noqa: ANN401
    """Compare with `predict` on observations of the matches, normalized as in training."""
    normalizer = model.get_vec_normalize_env()
    seen = inputs if normalizer is None else normalizer.normalize_obs(inputs)
    expected, _ = model.predict(seen, deterministic=True)
    if network.head.table is not None:
        expected = network.head.table[expected]
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    assert len(np.unique(expected, axis=0)) > 1, "all actions are equal"


@pytest.mark.parametrize("kind", KINDS)
def test_mean_actions_are_those_of_predict(kind: str) -> None:
    envs = SoccerVecEnv(TASK, worlds=2, discrete=kind == "DQN", history=2)
    model = learned(kind, envs)
    network = from_sb3(model)
    check_mean_actions(network, model, observations(model))
    assert (network.task_name, network.history) == (TASK, 2)
    deterministic = kind in ("TD3", "DDPG", "DQN")
    assert network.mode == ("mean" if deterministic else "sample")


@pytest.mark.parametrize("activation", ["ReLU", "ELU", "SiLU", "LeakyReLU"])
def test_other_activations_are_kept(activation: str) -> None:
    torch = pytest.importorskip("torch")
    keywords = {"activation_fn": getattr(torch.nn, activation), "net_arch": [32, 16]}
    model = new("PPO", SoccerVecEnv(TASK, worlds=2), policy_kwargs=keywords)
    check_mean_actions(from_sb3(model), model, observations(model))


@pytest.mark.parametrize("normalizer", [SoccerVecNormalize, vec_env.VecNormalize])
def test_normalization_is_part_of_the_policy(normalizer: Any) -> None:  # noqa: ANN401
    envs = normalizer(SoccerVecEnv(TASK, worlds=4), clip_obs=1.5)
    model = learned("PPO", envs)
    network = from_sb3(model)
    check_mean_actions(network, model, observations(model))
    assert network.clip == 1.5
    assert network.std.std() > 0.01, "the statistics are those of no observations"
    plain = from_sb3(model, normalize=normalizer(SoccerVecEnv(TASK), norm_obs=False))
    assert (plain.std == 1.0).all()


def test_discrete_choices_of_ppo() -> None:
    model = new("PPO", SoccerVecEnv(TASK, worlds=2, discrete=True))
    network = from_sb3(model)
    check_mean_actions(network, model, observations(model))
    assert network.head.kind == "categorical"
    assert network.task_options == {"discrete": True}


@pytest.mark.parametrize("kind", ["PPO", "SAC"])
def test_draws_have_the_distribution_of_the_model(kind: str) -> None:
    model = new(kind, SoccerVecEnv(TASK, worlds=2))
    network, one, n = from_sb3(model), observations(model, 1), 4000
    drawn = network.choose(np.tile(one, (n, 1, 1)), WorldRng.seeded(0, n))[:, 0]
    expected, _ = model.predict(np.tile(one, (n, 1)), deterministic=False)
    np.testing.assert_allclose(drawn.mean(axis=0), expected.mean(axis=0), atol=0.05)
    np.testing.assert_allclose(drawn.std(axis=0), expected.std(axis=0), atol=0.05)
    assert drawn.std() > 0.1


def test_models_of_gymnasium_know_their_task() -> None:
    envs = vec_env.DummyVecEnv([lambda: gymnasium.make("rsoccer/VSS-v0")])
    model = stable_baselines3.PPO("MlpPolicy", envs, device="cpu")
    assert from_sb3(model).task_name == TASK


def test_a_model_plays(tmp_path: Any) -> None:  # noqa: ANN401
    model = new("SAC", SoccerVecEnv(TASK, worlds=2))
    result = rsoccer.evaluate(from_sb3(model), "zero", matches=2)
    assert (result.matches, result.task) == (2, TASK)
    from_sb3(model).save(tmp_path / "a.safetensors")
    assert rsoccer.evaluate(tmp_path / "a.safetensors", "zero", matches=2).score == result.score


def test_other_models_are_refused() -> None:
    with pytest.raises(TypeError, match="expected one of Stable-Baselines3, got int"):
        from_sb3(3)
    model = stable_baselines3.PPO("MlpPolicy", SoccerVecEnv(TASK), use_sde=True, device="cpu")
    with pytest.raises(ValueError, match="without use_sde"):
        from_sb3(model)
    other = stable_baselines3.PPO("MlpPolicy", SoccerVecEnv("SSLGoToBall-v0"), device="cpu")
    with pytest.raises(ValueError, match=r"the model takes observations of .* numbers, but task"):
        from_sb3(other, make_task(TASK))
    with pytest.raises(ValueError, match="task: expected the task of the training"):
        from_sb3(stable_baselines3.PPO("MlpPolicy", "Pendulum-v1", device="cpu"))


def test_a_callback_logs_scores_and_can_end_the_training(tmp_path: Any) -> None:  # noqa: ANN401
    envs = SoccerVecEnv(TASK, worlds=2, max_steps=40)
    model = new("PPO", envs)
    measured = MatchEvaluation(
        ("ou", "zero"), every=100, matches=2, task=TASK, folder=tmp_path, seconds=0.2
    )
    logged: list[dict[str, float]] = []

    def stop(scores: Mapping[str, float]) -> bool:
        assert set(scores) <= set(model.logger.name_to_value)
        logged.append(dict(scores))
        return len(logged) == 2

    model.learn(1000, EvaluationCallback(measured, stop_when=stop, action_repeat=2))
    assert [samples for samples, _ in measured.results] == [2, 102]
    assert model.num_timesteps == 102
    assert set(logged[0]) == {"evaluation/goal_score_ou", "evaluation/goal_score_zero"}
    assert (tmp_path / "match_102.html").exists()

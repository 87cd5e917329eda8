"""Baselines through Stable-Baselines3."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benches.learning import sb3_settings
from benches.learning.experiments import Experiment, Protocol, Run, Study
from benches.learning.run_files import Folders, load
from benches.learning.running import sb3_run, worker
from rsoccer.rng import WorldRng

pytest.importorskip("stable_baselines3")

QUICK = {"samples": 1_000, "rows": 10, "learning_starts": 100, "hidden_sizes": [8], "n_steps": 3}


def experiment(algorithm: str, task: str = "SSLPassEndurance-v1") -> Experiment:
    return Experiment("baselines", algorithm, task, algorithm, settings=QUICK, seeds=1)


@pytest.mark.parametrize("algorithm", ["ddpg", "sac"])
def test_a_run_leaves_its_result(algorithm: str, tmp_path: Path) -> None:
    study = Study((experiment(algorithm),), Protocol(starts=2))
    folders = Folders(tmp_path / "results", tmp_path / "work")
    run = study.runs()[0]
    assert worker.execute(run, study, folders) is not None
    result = load(folders, run.key)
    assert result is not None
    assert result["samples"] == 1_000
    assert result["gradient_steps"] == (1_000 - 100) // 10
    assert 0.0 < result["learning_seconds"] < result["seconds"]["cpu"]
    assert 10 <= len(result["curve"]["samples"]) <= 12  # close ones are merged
    assert result["curve"]["samples"][-1] == 1_000
    assert result["curve"]["seconds"][-1] <= result["learning_seconds"]
    modes = {"ddpg": ["mean"], "sac": ["sample", "mean"]}[algorithm]
    assert [row["mode"] for row in result["evaluations"]] == modes


@pytest.mark.parametrize("algorithm", ["ddpg", "sac"])
def test_a_repeated_run_is_the_same(algorithm: str, tmp_path: Path) -> None:
    study = Study((replace(experiment(algorithm), seeds=2),), Protocol(starts=2))
    run, other_seed = study.runs()

    def found(run: Run, attempt: str) -> list[bytes]:
        folders = Folders(tmp_path / attempt / "results", tmp_path / attempt / "work")
        assert worker.execute(run, study, folders) is not None
        with np.load(folders.workplace(run.key) / sb3_run.FILE) as weights:
            return [weights[name].tobytes() for name in weights]

    first = found(run, "first")
    assert found(run, "second") == first
    assert found(other_seed, "second") != first


@pytest.mark.parametrize("algorithm", ["ddpg", "sac"])
def test_the_actor_acts_as_the_model(algorithm: str) -> None:
    from stable_baselines3 import DDPG, SAC

    from benches.learning.running.sb3_training import actor_of, environments

    run = Run(experiment(algorithm), 0)
    envs = environments(run.experiment.task, sb3_settings.settings(run))
    model = {"ddpg": DDPG, "sac": SAC}[algorithm]("MlpPolicy", envs, seed=0, device="cpu")
    observations = envs.reset()
    expected, _ = model.predict(observations, deterministic=True)
    mask = np.ones(observations.shape[1], np.float32)
    actor = actor_of(model, 3, mask).mean()
    actions = actor.choose(observations[:, None], WorldRng.seeded(0, len(observations)))
    np.testing.assert_allclose(actions[:, 0], expected, atol=1e-5)


@pytest.mark.parametrize("algorithm", ["ddpg", "sac"])
def test_masked_observations_are_not_read(algorithm: str) -> None:
    from stable_baselines3 import DDPG, SAC

    from benches.learning.running.sb3_training import actor_of, environments, mask_of

    masked = {**QUICK, "masked_observations": ["ball_polar", "teammates:0"]}
    one = replace(experiment(algorithm, "VSS-v0"), settings=masked)
    values = sb3_settings.settings(Run(one, 0))
    envs, mask = environments("VSS-v0", values), mask_of("VSS-v0", values)
    hidden = mask == 0.0
    assert 0 < hidden.sum() < len(mask)
    envs.reset()
    actions = np.ones((envs.num_envs, 2), np.float32)
    ends = 0
    for _ in range(500):
        observations, _, ended, infos = envs.step(actions)
        assert not observations[:, hidden].any()
        for row in np.flatnonzero(ended):
            assert not infos[row]["terminal_observation"][hidden].any()
        ends += ended.sum()
    assert ends > 0
    model = {"ddpg": DDPG, "sac": SAC}[algorithm]("MlpPolicy", envs, seed=0, device="cpu")
    actor = actor_of(model, 3, mask).mean()
    expected, _ = model.predict(observations, deterministic=True)
    noise = np.where(hidden, np.float32(7.0), observations)
    actions = actor.choose(noise[:, None], WorldRng.seeded(0, len(noise)))
    np.testing.assert_allclose(actions[:, 0], expected, atol=1e-5)


def test_a_decision_is_held_and_sums_its_rewards() -> None:
    from benches.learning.running.sb3_wrapper import ActionRepeat
    from rsoccer.sb3 import SoccerVecEnv

    plain = SoccerVecEnv("VSS-v0", 2)
    held = ActionRepeat(SoccerVecEnv("VSS-v0", 2), 3, 0.5)
    for envs in (plain, held):
        envs.seed(5)
        envs.reset()
    actions = np.full((2, 2), 0.5, np.float32)
    steps = [plain.step(actions) for _ in range(3)]
    observations, rewards, ended, _ = held.step(actions)
    np.testing.assert_array_equal(observations, steps[-1][0])
    np.testing.assert_allclose(rewards, sum(0.5**i * step[1] for i, step in enumerate(steps)))
    assert not ended.any()


def test_an_episode_that_ends_within_a_decision_is_reported_once() -> None:
    from benches.learning.running.sb3_wrapper import ActionRepeat
    from rsoccer.sb3 import SoccerVecEnv

    held = ActionRepeat(SoccerVecEnv("VSS-v0", 2, max_steps=4), 3, 1.0)
    held.seed(5)
    held.reset()
    actions = np.ones((2, 2), np.float32)
    assert not held.step(actions)[2].any()
    _, _, ended, infos = held.step(actions)
    assert ended.all()
    assert [info["steps"] for info in infos] == [4.0, 4.0]
    assert all(info["TimeLimit.truncated"] for info in infos)

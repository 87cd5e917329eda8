"""Settings of ablations: normalization, and time limits as ends; the spread of the actions."""

import json
from pathlib import Path

import numpy as np
import pytest
import torch

from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.ppo import gae
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.run.log import read_progress
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import digest, run_until
from tests.train.short_task import tiny


def test_the_annealed_spread_falls_by_equal_factors(tmp_path: Path) -> None:
    args = tiny(tmp_path, action_std=0.8, final_action_std=0.1)
    policy = Network.load(train(args))
    logged = read_progress(tmp_path)["action_std"]
    np.testing.assert_allclose(logged, 0.8 * (0.1 / 0.8) ** (np.arange(6) / 6), rtol=1e-5)
    assert policy.action_std is not None
    np.testing.assert_allclose(policy.action_std, 0.1, rtol=1e-6)


def test_the_annealed_spread_is_not_learned(tmp_path: Path) -> None:
    annealed = Trainer(tiny(tmp_path, final_action_std=0.1)).model
    assert "log_std" not in dict(annealed.named_parameters())
    assert list(annealed.state_dict()) != [] and "log_std" in annealed.state_dict()


CHANGED = {
    "final_action_std": 0.1,
    "normalize_observations": False,
    "normalize_rewards": False,
    "bootstrap_time_limits": False,
    "masked_observations": ("shot",),
    "task_options": {"max_steps": 20},
}


def test_a_resumed_run_with_all_settings_equals_the_uninterrupted_one(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    train(tiny(one, **CHANGED))
    other.mkdir()
    assert run_until(tiny(other, **CHANGED), 2 * 13 + 5) == 2
    with pytest.raises(ValueError, match=r"task_options was .*20.*, now \{\}"):
        train(tiny(other, resume=True, **{**CHANGED, "task_options": {}}))
    train(tiny(other, resume=True, **CHANGED))
    assert digest(one) == digest(other)
    files = [(folder / "policy.safetensors").read_bytes() for folder in (one, other)]
    assert files[0] == files[1]


def test_options_of_the_task_are_saved(tmp_path: Path, finished: Path) -> None:
    trainer = Trainer(tiny(tmp_path, **CHANGED))
    assert trainer.task.max_steps == 20
    policy = Network.load(train(tiny(tmp_path, samples=1, **CHANGED)))
    assert json.loads(policy.metadata["task_options"]) == CHANGED["task_options"]
    assert "task_options" not in Network.load(finished / "policy.safetensors").metadata
    settings = json.loads((tmp_path / "args.json").read_text())
    assert settings["task_options"] == CHANGED["task_options"]


def test_a_wrong_option_is_refused_before_a_folder_is_made(tmp_path: Path) -> None:
    for options in ({"n_bleu": 2}, {"n_blue": 9}):
        with pytest.raises(ValueError, match="n_bl"):
            train(tiny(tmp_path / "run", task_options=options))
    assert not (tmp_path / "run").exists()


def test_without_normalization_numbers_stay_as_they_are(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, normalize_observations=False, normalize_rewards=False))
    first = trainer.collector.observations.copy()
    trainer.collect_rollout(lambda: None)
    batch = trainer.collect_rollout(lambda: None)
    assert trainer.collector.return_rms.std.tolist() == [1.0]
    policy = trainer.network()
    assert not policy.mean.any() and (policy.std == 1.0).all()
    assert np.abs(first).max() <= 4.0 and batch.observations.abs().max() <= 4.0


@pytest.mark.parametrize("bootstrapped", [True, False])
def test_time_limits_are_bootstrapped_or_ends(
    bootstrapped: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    masks: list[tuple[torch.Tensor, ...]] = []

    def spy(*args: torch.Tensor) -> torch.Tensor:
        masks.append(args[3:5])
        return torch.zeros_like(args[0])

    monkeypatch.setattr(gae, "compute_gae", spy)
    args = tiny(tmp_path, bootstrap_time_limits=bootstrapped, random_truncation=0.3)
    batch: Batch = Trainer(args).collect_rollout(lambda: None)
    assert len(batch) == 144
    ((terminated, ended),) = masks
    assert ended.any() and not ended.all()
    assert torch.equal(terminated, ended) != bootstrapped

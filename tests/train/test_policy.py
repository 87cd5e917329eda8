"""What a run leaves for others to play with: the policy as it learned, the same each time."""

from pathlib import Path

import numpy as np
import pytest
import torch

from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.train import checkpoint, train
from rsoccer.train.run_state import restore
from rsoccer.train.trainer import Trainer
from tests.train.short_task import NAME
from tests.train.test_trainer import run_until, tiny


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that nothing interrupted."""
    folder = tmp_path_factory.mktemp("whole")
    train(tiny(folder))
    return folder


def test_the_policy_file_plays_what_was_learned(whole: Path) -> None:
    trainer = Trainer(tiny(whole))
    restore(trainer, checkpoint.load(whole / checkpoint.FILE_NAME))
    observations = (
        np.random.default_rng(0)
        .normal(size=(50, 3, trainer.matches.observation_size))
        .astype(np.float32)
    )
    mean, std = trainer.obs_rms.as_floats()
    normal = torch.tensor(((observations - mean) / std).clip(-10.0, 10.0))
    expected = trainer.model.actor(normal).detach().clamp(-1.0, 1.0).numpy()
    policy = Network.load(whole / "policy.safetensors")
    np.testing.assert_allclose(policy.mean_actions(observations), expected, atol=1e-5)
    untrained = Network.load(whole / "untrained.safetensors")
    assert np.abs(untrained.mean_actions(observations) - expected).max() > 0.01
    assert np.abs(mean).max() > 0.1, "nothing was normalised"
    assert policy.task_name == NAME


def test_a_policy_file_said_nothing_of_repeat_and_spread(whole: Path) -> None:
    trainer = Trainer(tiny(whole))
    restore(trainer, checkpoint.load(whole / checkpoint.FILE_NAME))
    policy = Network.load(whole / "policy.safetensors")
    assert (policy.mode, policy.action_repeat) == ("sample", trainer.args.action_repeat)
    assert policy.action_repeat == 3
    assert policy.action_std is not None
    expected = trainer.model.log_std.detach().exp().numpy()
    assert policy.action_std.tolist() == expected.tolist()
    assert not np.allclose(expected, trainer.args.action_std), "it has learned no spread"


def test_a_policy_file_names_the_task_as_it_was_asked_for(tmp_path: Path) -> None:
    name = "SSLGoToBallIR-v0"  # with six opponents; the task's own name is without
    policy = Network.load(train(tiny(tmp_path, task=name, samples=1, solo_fraction=0.0)))
    assert policy.task_name == name
    task = make_task(policy.task_name)
    policy.check_fits(task, task.observation_size)


def test_equal_runs_wrote_policies_of_different_bytes(whole: Path, tmp_path: Path) -> None:
    (tmp_path / "resumed").mkdir()
    run_until(tiny(tmp_path / "resumed"), 2 * 13)
    train(tiny(tmp_path / "resumed", resume=True))
    train(tiny(tmp_path / "same"))
    expected = (whole / "policy.safetensors").read_bytes()
    for folder in ("resumed", "same"):
        assert (tmp_path / folder / "policy.safetensors").read_bytes() == expected

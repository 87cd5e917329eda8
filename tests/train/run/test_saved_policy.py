"""Policy file of a run: it plays as in training, and equal runs write equal bytes."""

from pathlib import Path

import numpy as np
import torch

from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.train import train
from rsoccer.train.run import checkpoint
from rsoccer.train.run.state import restore
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import run_until
from tests.train.short_task import NAME, tiny


def test_the_policy_file_plays_the_trained_network(finished: Path) -> None:
    trainer = Trainer(tiny(finished))
    restore(trainer, checkpoint.load(finished / checkpoint.FILE_NAME))
    observations = (
        np.random.default_rng(0)
        .normal(size=(50, 3, trainer.collector.matches.observation_size))
        .astype(np.float32)
    )
    mean, std = trainer.collector.obs_rms.as_float32()
    normalized = torch.tensor(((observations - mean) / std).clip(-10.0, 10.0))
    expected = trainer.model.actor(normalized).detach().clamp(-1.0, 1.0).numpy()
    policy = Network.load(finished / "policy.safetensors")
    np.testing.assert_allclose(policy.mean_actions(observations), expected, atol=1e-5)
    untrained = Network.load(finished / "untrained.safetensors")
    assert np.abs(untrained.mean_actions(observations) - expected).max() > 0.01
    assert np.abs(mean).max() > 0.1, "the observations were not normalized"
    assert policy.task_name == NAME


def test_a_policy_file_holds_the_value_network(finished: Path, tmp_path: Path) -> None:
    trainer = Trainer(tiny(finished))
    restore(trainer, checkpoint.load(finished / checkpoint.FILE_NAME))
    size, ppo = trainer.collector.matches.observation_size, trainer.args.ppo
    observations = np.random.default_rng(0).normal(size=(50, 3, size)).astype(np.float32)
    mean, std = trainer.collector.obs_rms.as_float32()
    normalized = torch.tensor(((observations - mean) / std).clip(-10.0, 10.0))
    policy = Network.load(finished / "policy.safetensors")
    expected = trainer.model.value(normalized).detach().numpy()
    np.testing.assert_allclose(policy.values(observations), expected, atol=1e-5)
    assert policy.value is not None
    assert policy.value.action_repeat == trainer.args.rollout.action_repeat == 3
    assert policy.value.discount == ppo.gamma**3
    assert policy.value.reward_std == trainer.collector.return_rms.std[0] != 1.0
    central = Network.load(train(tiny(tmp_path, central_critic=True)))
    assert central.value is None, "it reads more than a robot observes"


def test_a_policy_file_holds_action_repeat_and_action_std(finished: Path) -> None:
    trainer = Trainer(tiny(finished))
    restore(trainer, checkpoint.load(finished / checkpoint.FILE_NAME))
    policy = Network.load(finished / "policy.safetensors")
    assert (policy.mode, policy.action_repeat) == ("sample", trainer.args.rollout.action_repeat)
    assert policy.action_repeat == 3
    assert policy.action_std is not None
    expected = trainer.model.log_std.detach().exp().numpy()
    assert policy.action_std.tolist() == expected.tolist()
    assert not np.allclose(expected, trainer.args.network.action_std), (
        "the standard deviation did not change"
    )


def test_a_saved_policy_may_decide_at_another_rate_than_in_training(
    finished: Path, tmp_path: Path
) -> None:
    policy = Network.load(train(tiny(tmp_path, play_action_repeat=1)))
    usual = Network.load(finished / "policy.safetensors")
    assert (policy.action_repeat, usual.action_repeat) == (1, 3)
    assert all((policy.arrays()[name] == array).all() for name, array in usual.arrays().items())


def test_a_policy_file_names_the_task_by_its_registered_name(tmp_path: Path) -> None:
    name = (
        "SSLGoToBallIR-v0"  # an alias with six opponents; `task.name` is of the task without them
    )
    policy = Network.load(train(tiny(tmp_path, task=name, samples=1, solo_fraction=0.0)))
    assert policy.task_name == name
    task = make_task(policy.task_name)
    policy.check_fits(task, task.layout.size)


def test_the_policy_after_a_signal_is_that_of_the_checkpoint(tmp_path: Path) -> None:
    """The signal comes while the third update changes the network."""
    assert run_until(tiny(tmp_path), 2 * 13 + 11) == 2
    trainer = Trainer(tiny(tmp_path))
    restore(trainer, checkpoint.load(tmp_path / checkpoint.FILE_NAME))
    saved, expected = Network.load(tmp_path / "policy.safetensors"), trainer.saved_network()
    arrays = expected.arrays()
    assert all(array.tobytes() == arrays[name].tobytes() for name, array in saved.arrays().items())


def test_equal_runs_write_policies_of_equal_bytes(finished: Path, tmp_path: Path) -> None:
    (tmp_path / "resumed").mkdir()
    run_until(tiny(tmp_path / "resumed"), 2 * 13)
    train(tiny(tmp_path / "resumed", resume=True))
    train(tiny(tmp_path / "same"))
    expected = (finished / "policy.safetensors").read_bytes()
    for folder in ("resumed", "same"):
        assert (tmp_path / folder / "policy.safetensors").read_bytes() == expected

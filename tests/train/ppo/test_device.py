"""Device of the updates: names, errors, and tensors that all are where they should be."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import torch
from torch import nn
from torch._subclasses.fake_tensor import DataDependentOutputException, FakeTensorMode

from rsoccer.train import PpoSettings, train
from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.device import find_device
from rsoccer.train.ppo.update import PPO
from rsoccer.train.run import checkpoint
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import digest, run_until
from tests.train.short_task import tiny

CPU, CUDA = torch.device("cpu"), torch.device("cuda")


def set_gpu(monkeypatch: pytest.MonkeyPatch, available: bool) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: available)


def test_auto_is_a_gpu_where_there_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    set_gpu(monkeypatch, True)
    assert [find_device(name) for name in ("auto", "cpu", "cuda")] == [CUDA, CPU, CUDA]
    set_gpu(monkeypatch, False)
    assert [find_device(name) for name in ("auto", "cpu")] == [CPU, CPU]


def test_a_missing_gpu_is_refused_before_training(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    set_gpu(monkeypatch, False)
    with pytest.raises(ValueError, match=r"device must be cpu or auto.* no GPU, got 'cuda'"):
        train(tiny(tmp_path / "run", device="cuda"))
    assert not (tmp_path / "run").exists()


def test_a_run_resumes_with_another_device(tmp_path: Path) -> None:
    train(tiny(tmp_path, samples=144))
    train(tiny(tmp_path, samples=288, resume=True, device="auto"))
    assert checkpoint.load(tmp_path / checkpoint.FILE_NAME).info["updates"] == 2


def tensors_of(batch: Batch, trainer: PPO) -> Iterator[torch.Tensor]:
    yield from batch.parts().values()
    yield from trainer._learner.state_dict().values()
    yield from (part for part in vars(trainer.optimizer).values() if torch.is_tensor(part))


def fake_to(model: ActorCritic, device: torch.device) -> ActorCritic:
    """Move a model in the mode of fake tensors, where `nn.Module.to` fails."""
    for module in model.modules():
        for name, parameter in module._parameters.items():
            assert parameter is not None
            fake = nn.Parameter(torch.empty(parameter.shape, device=device))
            module._parameters[name] = fake
        for name, buffer in module._buffers.items():
            assert buffer is not None
            module._buffers[name] = torch.empty(buffer.shape, device=device)
    return model


# A fake tensor has a shape and a device, but no numbers, so this needs no GPU. An operation on
# tensors of two devices raises an error, as it would on a GPU.
@pytest.mark.skipif(
    torch.__version__.startswith("2.6."),
    reason="PyTorch 2.6 aborts the process when fake tensors of a GPU are asked for their device",
)
@pytest.mark.parametrize("overlap", [False, True])
@pytest.mark.parametrize("mixed", [False, True])
def test_updates_do_not_mix_devices(
    mixed: bool, overlap: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ActorCritic, "to", fake_to)
    generator = torch.Generator().manual_seed(0)
    model, copied = (ActorCritic(5, 2, (8,), 0.6, generator) for _ in range(2))
    with FakeTensorMode():
        fake_to(model, CPU)
        monkeypatch.setattr("rsoccer.train.ppo.update.copy.deepcopy", lambda _: copied)
        trainer = PPO(PpoSettings(n_minibatches=2, overlap=overlap), model, generator, CUDA)
        batch = Batch(*(torch.empty(shape) for shape in ((6, 5), (6, 2), (6,), (6,), (6,))))
        if mixed:
            monkeypatch.setattr(Batch, "to", lambda self, _: self)
            with pytest.raises(RuntimeError, match="device"):
                trainer.update(batch, 1e-3, lambda: None)
        else:
            # The first number that is read is the statistics at the end of an epoch.
            with pytest.raises(DataDependentOutputException):
                trainer.update(batch, 1e-3, lambda: None)
            moved = batch.to(CUDA)
            assert {part.device.type for part in tensors_of(moved, trainer)} == {"cuda"}


def test_all_tensors_of_an_update_are_on_its_device(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path))
    batch = trainer.collect_rollout(lambda: None)
    trainer.update(batch, lambda: None)
    assert {part.device for part in tensors_of(batch, trainer.ppo)} == {CPU}
    shared = {part.data_ptr() for part in trainer.model.parameters()}
    assert not shared & {part.data_ptr() for part in trainer.ppo._learner.parameters()}
    for ours, theirs in zip(
        trainer.model.parameters(), trainer.ppo._learner.parameters(), strict=True
    ):
        assert torch.equal(ours, theirs), "copied back"


@pytest.mark.skipif(not torch.cuda.is_available(), reason="needs a GPU")
@pytest.mark.parametrize("changes", [{}, {"robot_units": 4}, {"overlap": True}])
def test_a_gpu_learns_what_the_cpu_learns(changes: dict[str, Any], tmp_path: Path) -> None:
    models = []
    for device in ("cpu", "cuda"):
        trainer = Trainer(tiny(tmp_path, device=device, **changes))
        assert trainer.ppo.device.type == device
        batch = trainer.collect_rollout(lambda: None)
        trainer.update(batch, lambda: None)
        moved = batch.to(trainer.ppo.device)
        assert {part.device.type for part in tensors_of(moved, trainer.ppo)} == {device}
        models.append(trainer.model.state_dict())
    for name, part in models[0].items():
        assert models[1][name].device == CPU
        torch.testing.assert_close(models[1][name], part, rtol=1e-3, atol=1e-4)


@pytest.mark.skipif(not torch.cuda.is_available(), reason="needs a GPU")
def test_a_checkpoint_resumes_on_any_device(tmp_path: Path) -> None:
    train(tiny(tmp_path, samples=144, device="cuda"))
    train(tiny(tmp_path, samples=288, resume=True, device="cpu"))
    train(tiny(tmp_path, samples=432, resume=True, device="cuda"))
    assert checkpoint.load(tmp_path / checkpoint.FILE_NAME).info["updates"] == 3


@pytest.mark.skipif(not torch.cuda.is_available(), reason="needs a GPU")
@pytest.mark.parametrize("changes", [{}, {"overlap": True}, {"overlap": True, "robot_units": 4}])
def test_a_resumed_run_on_a_gpu_equals_the_uninterrupted_one(
    changes: dict[str, Any], tmp_path: Path
) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    train(tiny(one, device="cuda", **changes))
    other.mkdir()
    assert 0 < run_until(tiny(other, device="cuda", **changes), 40) < 6
    train(tiny(other, device="cuda", threads=2, resume=True, **changes))
    assert digest(other) == digest(one)

"""Symmetry augmentation: reflected samples, and statistics that the reflection does not change."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from rsoccer import make_task
from rsoccer.reflection import Reflection
from rsoccer.train import Args, train
from rsoccer.train.ppo import mirror, update
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.mirror import with_reflections
from rsoccer.train.rollout.episode_stats import Row
from rsoccer.train.rollout.running_mean_std import RunningMeanStd
from rsoccer.train.run.trainer import Trainer
from tests.train.one_update import one_update
from tests.train.runs import digest, run_until
from tests.train.short_task import by_name, tiny

SYMMETRIC = {"mirror_augmentation": True}


def test_statistics_are_those_of_the_rows_and_their_reflections() -> None:
    reflection = Reflection.of([1, -1, 1, 1], order=[0, 1, 3, 2])
    rows = np.random.default_rng(0).normal([3.0, 2.0, -1.0, 5.0], [1, 2, 3, 4], (500, 4))
    rms, both = RunningMeanStd(4, reflection=reflection), RunningMeanStd(4)
    rms.update(rows)
    both.update(np.concatenate([rows, rows[:, reflection.order] * reflection.signs]))
    np.testing.assert_allclose(rms.as_float32(), both.as_float32(), rtol=1e-6, atol=1e-7)
    mean, std = rms.as_float32()
    assert np.array_equal(reflection.apply(mean), mean), "not exactly symmetric"
    assert np.array_equal(std[reflection.order], std)


def test_a_batch_holds_each_sample_and_its_reflection(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mirror, "MIN_DENSITY_RATIO", 1e-30)
    trainer = Trainer(tiny(tmp_path, **SYMMETRIC))
    trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
    batch = trainer.collect_rollout(lambda: None)
    assert trainer.samples == 2 * len(batch), "reflected samples were counted"
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    size = len(batch)
    assert len(both) == 2 * size
    for name, part in batch.parts().items():
        assert torch.equal(getattr(both, name)[:size], part)
    assert torch.equal(both.actions[size:], batch.actions.flip(-1)), "the wheels are not swapped"
    assert torch.equal(both.advantages[size:], batch.advantages)
    mean, std = trainer.collector.obs_rms.as_float32()
    raw = batch.observations.numpy() * std + mean
    reflected = both.observations[size:].numpy() * std + mean
    assert trainer.task.layout.reflection is not None
    expected = trainer.task.layout.reflection.apply(raw)
    np.testing.assert_allclose(reflected, expected, atol=1e-5)
    assert np.abs(reflected - raw).max() > 0.5
    model = trainer.model
    with torch.no_grad():
        log_probs = model.log_prob(model.actor(both.observations), both.actions)
    torch.testing.assert_close(log_probs, both.log_probs)


def test_reflected_actions_that_the_policy_would_hardly_draw_are_left_out(tmp_path: Path) -> None:
    """Formerly training diverged: the density of such an action changes by orders of magnitude."""
    trainer = Trainer(tiny(tmp_path, initial_action=(0.9, -0.9), **SYMMETRIC))
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    assert len(batch) < len(both) < 1.2 * len(batch)
    reflected = both.log_probs[len(batch) :]
    assert reflected.min() > batch.log_probs.min() + np.log(0.5)


def test_an_update_starts_at_a_ratio_of_1_and_sees_twice_the_samples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mirror, "MIN_DENSITY_RATIO", 1e-30)
    args = tiny(tmp_path, n_epochs=1, n_minibatches=1, **SYMMETRIC)
    trainer = Trainer(args)
    batch = trainer.collect_rollout(lambda: None)
    sizes, learn = [], trainer.ppo.update

    def record(batch: Batch, *rest: Any, **options: Any) -> Row:  # noqa: ANN401
        sizes.append(len(batch))
        return learn(batch, *rest, **options)

    monkeypatch.setattr(trainer.ppo, "update", record)
    trainer.update(batch, lambda: None)
    assert sizes == [2 * len(batch)]
    assert trainer.update_stats["approx_kl"] == pytest.approx(0.0, abs=1e-6)


def test_learning_makes_the_values_nearly_symmetric(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1e3)
    trainer = Trainer(tiny(tmp_path, worlds=32, n_epochs=80, **SYMMETRIC))
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    deviations = []
    for _ in range(2):
        with torch.no_grad():
            values, reflected = trainer.model.value(both.observations).chunk(2)
        deviations.append(float((values - reflected).std() / values.std()))
        trainer.update(batch, lambda: None)
    assert deviations[0] > 0.9
    assert deviations[1] < 0.6


def test_masked_numbers_stay_masked_in_reflections(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, masked_observations=("action:0",), **SYMMETRIC))
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    first = trainer.task.layout.blocks["action"].columns.start
    assert not both.observations[:, first].any()
    assert batch.observations[:, first + 1].any()


def test_a_resumed_run_equals_the_uninterrupted_one(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    train(tiny(one, **SYMMETRIC))
    other.mkdir()
    run_until(tiny(other, **SYMMETRIC), 2 * 13 + 5)
    train(tiny(other, resume=True, **SYMMETRIC))
    assert digest(one) == digest(other)


def test_the_policy_file_has_symmetric_statistics(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, **SYMMETRIC))
    trainer.collect_rollout(lambda: None)
    policy = trainer.network()
    reflection = trainer.task.layout.reflection
    assert reflection is not None
    assert np.array_equal(reflection.apply(policy.mean), policy.mean)
    assert np.abs(policy.mean).max() > 0.1


def test_an_asymmetric_task_is_refused_before_a_folder_is_made(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="mirror_augmentation must be False, as SSLDribbling-v0"):
        train(tiny(tmp_path / "run", task="SSLDribbling-v0", **SYMMETRIC))
    assert not (tmp_path / "run").exists()


def test_ssl_tasks_are_reflected_too(tmp_path: Path) -> None:
    task = make_task("SSLPassEnduranceMulti-v1")
    args = one_update(task.name, tmp_path).to_json()
    trainer = Trainer(Args.from_json({**args, **by_name(SYMMETRIC)}))
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    signs = torch.tensor([1.0, -1.0, -1.0, 1.0, 1.0])
    assert torch.equal(both.actions[len(batch) :], batch.actions * signs)

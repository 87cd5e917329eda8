"""Schedules of the learning rate: the linear fall, and the rate that follows the divergence."""

import csv
from pathlib import Path
from typing import Any

import pytest

from rsoccer.train import PpoSettings, train
from rsoccer.train.ppo import update
from rsoccer.train.ppo.learning_rate import BOUNDS, TARGET_KL, LearningRate
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.stop_signal import Stopped, StopSignal
from rsoccer.train.run.trainer import Trainer
from tests.train.short_task import tiny


class StopAfterUpdates(StopSignal):
    """A signal that comes after some updates."""

    def __init__(self, trainer: Trainer, updates: int) -> None:
        super().__init__()
        self.trainer, self.updates = trainer, updates

    def check(self) -> None:
        if self.trainer.updates == self.updates:
            raise Stopped("test")


def rates(folder: Path) -> list[float]:
    """Learning rate of each update of a run."""
    with (folder / "progress.csv").open(newline="") as file:
        return [float(row["learning_rate"]) for row in csv.DictReader(file)]


def test_the_linear_rate_falls_to_a_tenth_whatever_the_updates_change() -> None:
    rate = LearningRate(PpoSettings(learning_rate=0.01))
    assert rate.start_update(0.5) == pytest.approx(0.0055)
    rate.end_update(1, 1.0)
    assert rate.start_update(1.0) == pytest.approx(0.001)


def test_the_adaptive_rate_follows_the_divergence() -> None:
    settings = PpoSettings(learning_rate=1e-3, learning_rate_schedule="adaptive", n_epochs=4)
    rate = LearningRate(settings)
    assert rate.start_update(0.9) == 1e-3, "the progress of the run does not matter"
    rate.end_update(2, 1.5 * TARGET_KL)
    assert rate.value < 1e-3, "the update was cut short"
    lower = rate.value
    rate.end_update(4, 0.95 * TARGET_KL)
    assert rate.value == lower, "the update was as large as it should be"
    rate.end_update(4, 0.05 * TARGET_KL)
    assert rate.value > lower, "the update was small"


@pytest.mark.parametrize(("last", "bound"), [((1, 1.0), BOUNDS[0]), ((4, 0.0), BOUNDS[1])])
def test_the_adaptive_rate_is_bounded(last: tuple[int, float], bound: float) -> None:
    rate = LearningRate(PpoSettings(learning_rate_schedule="adaptive", n_epochs=4))
    for _ in range(1000):
        rate.end_update(*last)
    assert rate.value == bound


def test_a_resumed_run_continues_with_its_adapted_rate(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1e-4)  # most updates are cut short
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    settings: dict[str, Any] = {"learning_rate_schedule": "adaptive", "n_epochs": 3}
    train(tiny(whole, **settings))
    parts.mkdir()
    trainer = Trainer(tiny(parts, **settings))
    with pytest.raises(Stopped):
        Loop(trainer, {}).run(StopAfterUpdates(trainer, 3), 0)
    train(tiny(parts, resume=True, **settings))
    assert rates(parts) == rates(whole)
    assert len(set(rates(whole))) > 2, "the rate changed"

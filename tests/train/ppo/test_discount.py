"""The discount: constant, or with a horizon that grows during the run."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from torch import Tensor

from rsoccer.train import PpoSettings
from rsoccer.train.ppo import gae
from rsoccer.train.ppo.discount import discount_per_decision
from rsoccer.train.rollout.samples import Rollout
from rsoccer.train.run.stop_signal import StopSignal
from rsoccer.train.run.trainer import Trainer
from tests.train.short_task import tiny


def test_the_discount_is_constant_without_a_final_one() -> None:
    settings = PpoSettings(gamma=0.98)
    assert [discount_per_decision(settings, 2, p) for p in (0.0, 0.5, 1.0)] == [0.98**2] * 3


def test_the_horizon_changes_geometrically_to_the_final_one() -> None:
    settings = PpoSettings(gamma=0.99, final_gamma=0.9975)
    horizons = [1.0 / (1.0 - discount_per_decision(settings, 1, p)) for p in (0.0, 0.5, 1.0)]
    assert horizons == pytest.approx([100.0, 200.0, 400.0])


@pytest.mark.parametrize(("gamma", "final"), [(1.0, 0.99), (0.99, 1.0)])
def test_an_infinite_horizon_cannot_be_approached(gamma: float, final: float) -> None:
    with pytest.raises(ValueError, match=r"gamma.*below 1 where ppo.final_gamma is set"):
        PpoSettings(gamma=gamma, final_gamma=final)


def test_rollouts_use_the_discount_of_their_samples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    args = tiny(tmp_path, gamma=0.9, final_gamma=0.99)
    trainer = Trainer(args)
    found = []
    used: set[float] = set()
    collect, estimate = trainer.collector.collect, gae.compute_gae

    def spy_collect(gamma: float, check_stop: Callable[[], None]) -> Rollout:
        used.add(gamma)
        return collect(gamma, check_stop)

    def spy_gae(*parts: Any) -> Tensor:  # noqa: ANN401
        used.add(parts[5])
        return estimate(*parts)

    monkeypatch.setattr(trainer.collector, "collect", spy_collect)
    monkeypatch.setattr(gae, "compute_gae", spy_gae)
    while trainer.samples < args.samples:
        expected = discount_per_decision(args.ppo, 3, trainer.samples / args.samples)
        used.clear()
        batch = trainer.collect_rollout(StopSignal().check)
        assert used == {expected}
        trainer.update(batch, StopSignal().check)
        found.append(expected)
    assert len(found) > 1
    assert found == sorted(set(found)), "it rises with every rollout"

"""The discount: constant, or with a horizon that grows during the run."""

from pathlib import Path

import pytest

from rsoccer.train import Args
from rsoccer.train.discount import discount_per_decision
from rsoccer.train.stop_signal import StopSignal
from rsoccer.train.trainer import Trainer
from tests.train.short_task import tiny


def test_the_discount_is_constant_without_a_final_one() -> None:
    args = Args(gamma=0.98, action_repeat=2)
    assert [discount_per_decision(args, p) for p in (0.0, 0.5, 1.0)] == [0.98**2] * 3


def test_the_horizon_changes_geometrically_to_the_final_one() -> None:
    args = Args(gamma=0.99, final_gamma=0.9975, action_repeat=1)
    horizons = [1.0 / (1.0 - discount_per_decision(args, p)) for p in (0.0, 0.5, 1.0)]
    assert horizons == pytest.approx([100.0, 200.0, 400.0])


@pytest.mark.parametrize(("gamma", "final"), [(1.0, 0.99), (0.99, 1.0)])
def test_an_infinite_horizon_cannot_be_approached(gamma: float, final: float) -> None:
    with pytest.raises(ValueError, match=r"gamma.*below 1 where final_gamma is set"):
        Args(gamma=gamma, final_gamma=final)


def test_rollouts_use_the_discount_of_their_samples(tmp_path: Path) -> None:
    args = tiny(tmp_path, gamma=0.9, final_gamma=0.99)
    trainer = Trainer(args)
    found = []
    while trainer.samples < args.samples:
        expected = discount_per_decision(args, trainer.samples / args.samples)
        batch = trainer.collect_rollout(StopSignal().check)
        assert trainer.collector.gamma == expected
        trainer.update(batch, StopSignal().check)
        found.append(expected)
    assert len(found) > 1
    assert found == sorted(set(found)), "it rises with every rollout"

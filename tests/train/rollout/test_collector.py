"""Rollouts: normalized observations, values after each decision, and results for any threads."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from rsoccer.arrays import Floats
from rsoccer.matches import Matches
from rsoccer.train import train
from rsoccer.train.rollout import collector
from rsoccer.train.rollout.samples import Rollout
from rsoccer.train.rollout.transition import Transition, repeat_action
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import digest, digests_by_small_parts, run_until
from tests.train.short_task import tiny

LATE = {"sensing": "rc2021", "history": 3, "random_truncation": 0.2, "worlds": 12, "horizon": 12}


def recorded(
    trainer: Trainer, monkeypatch: pytest.MonkeyPatch
) -> tuple[Rollout, list[Floats], list[Transition]]:
    """Return a rollout, the observations before its decisions and its transitions."""
    before: list[Floats] = []
    transitions: list[Transition] = []

    def record(matches: Matches, *args: Any, **named: Any) -> Transition:  # noqa: ANN401
        before.append(trainer.collector.observations.copy())
        transition = repeat_action(matches, *args, **named)
        transitions.append(
            Transition(**{**vars(transition), "observations": transition.observations.copy()})
        )
        return transition

    monkeypatch.setattr(collector, "repeat_action", record)
    return trainer.collector.collect(0.9, lambda: None), before, transitions


@pytest.mark.parametrize("changes", [{}, LATE, {"masked_observations": ("shot",)}])
def test_each_decision_has_its_observations_and_those_after_it(
    changes: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those after a decision are the ones before the next, unless its episode has ended."""
    trainer = Trainer(tiny(tmp_path, **changes))
    trainer.collector.collect(0.9, lambda: None)  # statistics that do something
    mean, std = trainer.collector.obs_rms.as_float32()
    mask = trainer.model.mask.numpy()
    rollout, before, transitions = recorded(trainer, monkeypatch)

    def normalized(observations: list[Floats]) -> Floats:
        flat = np.stack(observations).reshape(*rollout.rewards.shape, -1)
        result: Floats = np.clip((flat - mean) / std, -10, 10) * mask
        return result

    np.testing.assert_allclose(rollout.observations, normalized(before), atol=1e-6)
    following = rollout.observations.roll(-1, 0)
    following[rollout.needs_next] = rollout.next_inputs
    expected = normalized([each.observations for each in transitions])
    np.testing.assert_allclose(following, expected, atol=1e-6)
    assert 0 < int(rollout.ended[:-1].sum()) < rollout.ended[:-1].numel()
    assert 0 < int(rollout.terminated.sum()) < int(rollout.ended.sum())


def test_actions_have_the_density_of_the_policy(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path))
    rollout = trainer.collector.collect(0.9, lambda: None)
    model = trainer.model
    with torch.no_grad():
        mean = model.actor(rollout.observations)
        torch.testing.assert_close(rollout.log_probs, model.log_prob(mean, rollout.actions))
    offsets = (rollout.actions - mean) / model.log_std.exp()
    assert abs(float(offsets.mean())) < 0.2 and 0.8 < float(offsets.std()) < 1.2


CASES = {
    "self-play": {},
    "mirrored": {"mirror_augmentation": True},
    "central": {"central_critic": True},
}


@pytest.mark.parametrize("changes", CASES.values(), ids=CASES)
def test_runs_are_equal_for_any_number_of_threads(
    changes: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = (
        tiny(tmp_path / str(threads), threads=threads, samples=4 * 144, **changes)
        for threads in (1, 2, 3)
    )
    assert len(digests_by_small_parts(runs, monkeypatch)) == 1


def test_a_run_resumes_with_other_threads(finished: Path, tmp_path: Path) -> None:
    run_until(tiny(tmp_path), 2 * 13 + 5)
    train(tiny(tmp_path, resume=True, threads=3))
    assert digest(tmp_path) == digest(finished)

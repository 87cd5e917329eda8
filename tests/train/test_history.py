"""Runs whose networks read stacked observations."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

import rsoccer
from rsoccer.policies.network import Network
from rsoccer.train import Args, train
from rsoccer.train.ppo import mirror
from rsoccer.train.ppo.mirror import with_reflections
from rsoccer.train.run.trainer import Trainer
from tests.policies.networks import network_input
from tests.train.one_update import one_update
from tests.train.runs import digest, run_until
from tests.train.short_task import tiny

ALL: dict[str, Any] = {
    "history": 3,
    "mirror_augmentation": True,
    "central_critic": True,
    "robot_units": 2,
    "hidden_sizes": (8, 6),
    "masked_observations": ("shot",),
}
"""A history with all settings that depend on the places of numbers in an observation."""


def test_a_run_writes_a_policy_that_plays_with_its_history(tmp_path: Path) -> None:
    args = one_update("SSLGoToBall-v0", tmp_path).to_json()
    path = train(Args.from_json({**args, "history": 3, "task_options": {"max_steps": 20}}))
    policy, task = Network.load(path), rsoccer.make_task("SSLGoToBall-v0")
    assert policy.history == 3
    assert policy.observation_size == 3 * task.layout.size + 2 * task.action_size
    policy.check_fits(task, task.layout.size)
    assert rsoccer.evaluate(path, matches=3, threads=1).matches == 3


def test_the_policy_of_a_run_acts_on_what_the_run_has_seen(tmp_path: Path) -> None:
    """The past of a network that plays is the past in the observations of its training."""
    trainer = Trainer(tiny(tmp_path, history=3, solo_fraction=0.0))
    trainer.collect_rollout(lambda: None)
    matches, policy = trainer.collector.matches, trainer.network()
    policy.mode, policy.action_repeat = "mean", 1
    observations = matches.reset()
    o, rng = trainer.task.layout.size, matches.play.rng
    memory = policy.new_memory((matches.worlds, len(matches.agents), 2), rng)
    for _ in range(5):
        expected = policy.mean_actions(observations)
        assert np.array_equal(
            policy.act(network_input(observations[..., :o]), rng, memory), expected
        )
        observations = matches.step(expected).observations


def test_a_resumed_run_equals_the_uninterrupted_one(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    train(tiny(one, **ALL))
    other.mkdir()
    assert run_until(tiny(other, **ALL), 3 * 13 + 5) == 3
    with pytest.raises(ValueError, match="history was 3, now 2"):
        train(tiny(other, resume=True, **{**ALL, "history": 2}))
    train(tiny(other, resume=True, **ALL))
    assert digest(one) == digest(other)
    assert Network.load(one / "policy.safetensors").history == 3


def test_the_pool_plays_as_its_network_does(tmp_path: Path) -> None:
    """Opponents have the past of their own robots."""
    trainer = Trainer(tiny(tmp_path, history=3, solo_fraction=0.0))
    pool, policy = trainer.pool, trainer.network()
    assert pool is not None and policy.action_repeat == 3
    policy.mode = "mean"
    pool.latest = policy
    rng = rsoccer.rng.WorldRng.seeded(0, 4)
    memory = pool.new_memory((4, 3, 2), rng)
    memory["drawn"][:] = pool.latest_code
    own = policy.new_memory((4, 3, 2), rng)
    observed = np.random.default_rng(0).normal(size=(7, 4, 3, trainer.task.layout.size))
    for each in observed:
        actions = pool.act(network_input(each), rng, memory)
        assert np.array_equal(actions, policy.act(network_input(each), rng, own))
    assert np.abs(actions).max() > 0.0


def test_masked_numbers_are_masked_in_the_past_too(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, history=2, masked_observations=("shot",)))
    o, mask = trainer.task.layout.size, trainer.model.mask.numpy()
    shot = np.arange(o)[trainer.task.layout.blocks["shot"].columns]
    assert set(np.flatnonzero(mask == 0.0)) == {*shot, *(shot + o)}
    batch = trainer.collect_rollout(lambda: None)
    assert not batch.observations[:, [*shot, *(shot + o)]].any()


def test_reflected_samples_have_a_reflected_past(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mirror, "MIN_DENSITY_RATIO", 1e-30)
    trainer = Trainer(tiny(tmp_path, history=2, mirror_augmentation=True))
    trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    mean, std = (torch.tensor(part) for part in trainer.collector.obs_rms.as_float32())
    raw, reflected = ((part.observations * std + mean).numpy() for part in (batch, both))
    reflected, o = reflected[len(batch) :], trainer.task.layout.size
    plain = trainer.task.layout.reflection
    assert plain is not None
    for part in (slice(0, o), slice(o, 2 * o)):
        np.testing.assert_allclose(reflected[:, part], plain.apply(raw[:, part]), atol=1e-5)
    np.testing.assert_allclose(reflected[:, 2 * o :], raw[:, :-3:-1], atol=1e-6)  # wheels
    assert np.abs(raw[:, -1] - raw[:, -2]).max() > 0.5


@pytest.mark.parametrize("history", [0, 1.5, -1, "many", None])
def test_a_wrong_history_is_refused(history: Any) -> None:  # noqa: ANN401
    with pytest.raises(ValueError, match=r"^history must be"):
        Args(history=history)

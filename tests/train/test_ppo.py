"""PPO: statistics of the first update, early stopping, and the log's columns."""

from pathlib import Path

import pytest
import torch

from rsoccer.train import Args
from rsoccer.train.networks import ActorCritic
from rsoccer.train.ppo import PPO
from rsoccer.train.rollout import Batch

SIZE, OBSERVATION_SIZE, ACTION_SIZE = 64, 5, 2


def new_ppo(**changes: float) -> tuple[PPO, Batch]:
    """Return PPO for a small network, and a batch that this network has drawn."""
    settings = {"n_epochs": 1, "n_minibatches": 1, **changes}
    args = Args(out=Path("nowhere"), **settings)  # type: ignore[arg-type]
    generator = torch.Generator().manual_seed(0)
    model = ActorCritic(OBSERVATION_SIZE, ACTION_SIZE, (8,), args.action_std, generator)
    observations = torch.randn((SIZE, OBSERVATION_SIZE), generator=generator)
    with torch.no_grad():
        mean = model.actor(observations)
        actions = mean + torch.randn(mean.shape, generator=generator) * args.action_std
        log_probs = model.log_prob(mean, actions)
    advantages = torch.randn(SIZE, generator=generator)
    batch = Batch(observations, actions, log_probs, advantages, torch.ones(SIZE))
    return PPO(args, model, generator), batch


def test_the_first_epoch_starts_at_the_policy_that_played() -> None:
    ppo, batch = new_ppo()
    stats = ppo.update(batch, 1e-3, lambda: None)
    assert stats["approx_kl"] == pytest.approx(0.0, abs=1e-6)
    assert stats["clip_fraction"] == 0.0
    assert stats["value_loss"] > 0.0
    assert list(stats) == [
        *("clip_fraction", "value_loss", "approx_kl", "n_epochs", "learning_rate", "action_std")
    ]


def test_the_epochs_stop_above_the_target_kl() -> None:
    ppo, batch = new_ppo(n_epochs=10, target_kl=1e-4)
    stats = ppo.update(batch, 0.05, lambda: None)
    assert stats["n_epochs"] == 2  # the first epoch has no divergence yet
    assert stats["approx_kl"] > 1e-4
    ppo, batch = new_ppo(n_epochs=10, target_kl=1e3)
    assert ppo.update(batch, 0.05, lambda: None)["n_epochs"] == 10


def test_updates_raise_the_probability_of_better_actions() -> None:
    ppo, batch = new_ppo(n_epochs=5, target_kl=1e3)
    ppo.update(batch, 0.01, lambda: None)
    model = ppo._model
    ratio = (model.log_prob(model.actor(batch.observations), batch.actions) - batch.log_probs).exp()
    better = batch.advantages > batch.advantages.mean()
    assert ratio[better].mean() > 1.0 > ratio[~better].mean()


def test_a_minibatch_has_the_selected_samples() -> None:
    _, batch = new_ppo()
    minibatch = batch.select(torch.tensor([3, 1]))
    assert len(minibatch) == 2
    assert torch.equal(minibatch.actions, batch.actions[[3, 1]])
    assert torch.equal(minibatch.returns, batch.returns[[3, 1]])

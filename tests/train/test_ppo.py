"""PPO: statistics of the first update, early stopping, and the log's columns."""

from pathlib import Path
from typing import Any

import pytest
import torch

from rsoccer.train import Args
from rsoccer.train.adam import BETA_1
from rsoccer.train.batch import Batch
from rsoccer.train.networks import ActorCritic
from rsoccer.train.ppo import PPO

SIZE, OBSERVATION_SIZE, ACTION_SIZE = 64, 5, 2


def new_ppo(**changes: float) -> tuple[PPO, Batch]:
    """Return PPO for a small network, and a batch that this network has drawn."""
    return ppo_with_model(changes)


def ppo_with_model(changes: dict[str, float], **options: Any) -> tuple[PPO, Batch]:  # noqa: ANN401
    """Return what `new_ppo` does for a model with options."""
    settings = {"n_epochs": 1, "n_minibatches": 1, **changes}
    args = Args(out=Path("nowhere"), **settings)  # type: ignore[arg-type]
    generator = torch.Generator().manual_seed(0)
    model = ActorCritic(OBSERVATION_SIZE, ACTION_SIZE, (8,), args.action_std, generator, **options)
    observations = torch.randn((SIZE, OBSERVATION_SIZE), generator=generator)
    with torch.no_grad():
        mean = model.actor(observations)
        actions = mean + torch.randn(mean.shape, generator=generator) * args.action_std
        log_probs = model.log_prob(mean, actions)
    advantages = torch.randn(SIZE, generator=generator)
    batch = Batch(observations, actions, log_probs, advantages, torch.ones(SIZE))
    if options.get("state_size"):
        states = torch.randn((SIZE, options["state_size"]), generator=generator)
        batch.central_inputs = torch.cat([states, observations], dim=1)
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
    assert model is not ppo._learner
    ratio = (model.log_prob(model.actor(batch.observations), batch.actions) - batch.log_probs).exp()
    better = batch.advantages > batch.advantages.mean()
    assert ratio[better].mean() > 1.0 > ratio[~better].mean()


def textbook_loss(args: Args, model: ActorCritic, minibatch: Batch) -> torch.Tensor:
    """Return the loss of PPO for autograd."""
    advantages = minibatch.advantages
    advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
    log_probs = model.log_prob(model.actor(minibatch.observations), minibatch.actions)
    ratio = (log_probs - minibatch.log_probs).exp()
    clipped = ratio.clamp(1 - args.clip_range, 1 + args.clip_range)
    policy_loss = -torch.minimum(ratio * advantages, clipped * advantages).mean()
    value_loss = (model.value(minibatch.critic_inputs) - minibatch.returns).square().mean()
    return policy_loss + args.value_coef * value_loss - args.entropy_coef * model.entropy()


@pytest.mark.parametrize("options", [{}, {"state_size": 3, "learn_action_std": False}])
@pytest.mark.parametrize("clip_range", [0.001, 0.2, 10.0])
def test_gradients_equal_those_of_autograd(clip_range: float, options: dict[str, Any]) -> None:
    changes = {"clip_range": clip_range, "entropy_coef": 0.3, "value_coef": 0.7}
    ppo, batch = ppo_with_model(changes, **options)
    ppo.update(batch, 0.05, lambda: None)  # so that ratios differ from 1
    gradients, stats = ppo._gradients(batch)
    model = ppo._model
    loss = textbook_loss(ppo._args, model, batch)
    expected = torch.autograd.grad(loss, list(model.parameters()))
    for gradient, wanted in zip(gradients, expected, strict=True):
        torch.testing.assert_close(gradient, wanted)
    low, high = {0.001: (0.9, 1.0), 0.2: (0.1, 0.9), 10.0: (0.0, 0.0)}[clip_range]
    assert low <= stats[1] <= high, "clipped samples"


def test_long_gradients_are_shortened() -> None:
    moved = []
    for max_grad_norm in (1e-6, 1e-3, 0.5):
        ppo, batch = new_ppo(max_grad_norm=max_grad_norm)
        before = ppo.optimiser._vector.clone()
        ppo.update(batch, 1e-3, lambda: None)
        moved.append(float((ppo.optimiser._vector - before).norm()))
        norm = float(ppo.optimiser._mean.norm()) / (1.0 - BETA_1)
        assert norm == pytest.approx(max_grad_norm, rel=1e-3)
    assert moved[0] < moved[1] < moved[2]


def test_an_update_that_is_stopped_leaves_the_model_unchanged() -> None:
    ppo, batch = new_ppo(n_minibatches=2)
    before = {name: part.clone() for name, part in ppo._model.state_dict().items()}
    checks = iter([None])  # the second check raises
    with pytest.raises(StopIteration):
        ppo.update(batch, 1e-3, lambda: next(checks))
    for name, part in ppo._model.state_dict().items():
        assert torch.equal(part, before[name])


def test_a_minibatch_has_the_selected_samples() -> None:
    _, batch = new_ppo()
    minibatch = batch.select(torch.tensor([3, 1]))
    assert len(minibatch) == 2
    assert torch.equal(minibatch.actions, batch.actions[[3, 1]])
    assert torch.equal(minibatch.returns, batch.returns[[3, 1]])
    parts = list(batch.chunk(3))
    assert [len(part) for part in parts] == [22, 22, 20]
    assert torch.equal(torch.cat([part.actions for part in parts]), batch.actions)

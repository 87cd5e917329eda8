"""Gradient of PPO's loss: equal to that of autograd, for any number of threads and parts."""

import pytest
import torch

from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.ppo import loss_gradient
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.loss_gradient import LossGradient, weighted_advantages
from rsoccer.train.workers import Workers
from tests.train.ppo.test_update import SIZE, new_ppo


def textbook_loss(model: ActorCritic, minibatch: Batch) -> torch.Tensor:
    """Return the loss of PPO for autograd."""
    advantages = minibatch.advantages
    advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
    log_probs = model.log_prob(model.actor(minibatch.observations), minibatch.actions)
    ratio = (log_probs - minibatch.log_probs).exp()
    clipped = ratio.clamp(1 - loss_gradient.CLIP_RANGE, 1 + loss_gradient.CLIP_RANGE)
    gains = torch.minimum(ratio * advantages, clipped * advantages)
    weights = torch.ones(()) if minibatch.weights is None else minibatch.weights
    policy_loss = -(weights * gains).mean()
    value_loss = (model.value(minibatch.critic_inputs) - minibatch.returns).square().mean()
    return policy_loss + loss_gradient.VALUE_COEF * value_loss


@pytest.mark.usefixtures("onednn")
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("state_size", [0, 3])
@pytest.mark.parametrize("clip_range", [0.001, 0.2, 10.0])
def test_gradients_equal_those_of_autograd(
    clip_range: float, state_size: int, weighted: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(loss_gradient, "CLIP_RANGE", clip_range)
    monkeypatch.setattr(loss_gradient, "VALUE_COEF", 0.7)
    monkeypatch.setattr(loss_gradient, "SHARD", 20)  # several parts
    ppo, batch = new_ppo(state_size)
    ppo.update(batch, 0.05, lambda: None)  # so that ratios differ from 1
    batch.weights = torch.rand(SIZE) if weighted else None
    rows = torch.randperm(SIZE)[:50]
    model = ppo._model
    gradient, stats = LossGradient(model, Workers(2))(batch, rows, weighted_advantages(batch, rows))
    loss = textbook_loss(model, batch.select(rows))
    expected = torch.autograd.grad(loss, list(model.parameters()))
    wanted = torch.cat([part.flatten() for part in expected])
    torch.testing.assert_close(gradient, wanted, atol=1e-6, rtol=1e-4)
    low, high = {0.001: (0.9, 1.0), 0.2: (0.1, 0.9), 10.0: (0.0, 0.0)}[clip_range]
    assert low <= stats[1] <= high, "clipped samples"


@pytest.mark.usefixtures("onednn")
def test_threads_change_no_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loss_gradient, "SHARD", 7)
    ppo, batch = new_ppo()
    results = []
    for threads in (1, 2, 3, 8):
        compute = LossGradient(ppo._model, Workers(threads))
        for count in (64, 9, 50):  # buffers grow and are used again
            rows = torch.arange(count)
            gradient, stats = compute(batch, rows, weighted_advantages(batch, rows))
        found = (gradient, stats, compute.log_probs(batch))
        results.append(b"".join(part.numpy().tobytes() for part in found))
    assert len(set(results)) == 1


def test_the_critic_alone_leaves_the_policy_without_a_gradient() -> None:
    ppo, batch = new_ppo()
    compute = LossGradient(ppo._model, Workers(1))
    size = sum(part.numel() for part in ppo._model.actor.parameters())
    rows = torch.arange(SIZE)
    found, _ = compute(batch, rows, weighted_advantages(batch, rows))
    gradient = found.clone()  # the next call overwrites it
    assert gradient[:size].abs().max() > 0.0
    alone, _ = compute(batch, rows, weighted_advantages(batch, rows, critic_only=True))
    assert not alone[:size].any()
    assert torch.equal(alone[size:], gradient[size:])


def test_log_densities_are_those_of_the_policy_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loss_gradient, "SHARD", 20)  # several parts
    ppo, batch = new_ppo()
    compute = LossGradient(ppo._model, Workers(2))
    torch.testing.assert_close(compute.log_probs(batch), batch.log_probs)
    ppo.update(batch, 0.05, lambda: None)
    with torch.no_grad():
        expected = ppo._model.log_prob(ppo._model.actor(batch.observations), batch.actions)
    torch.testing.assert_close(compute.log_probs(batch), expected)
    assert (expected - batch.log_probs).abs().max() > 0.1

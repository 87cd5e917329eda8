"""PPO: statistics of the first update, early stopping, and the log's columns."""

from typing import Any

import pytest
import torch

from rsoccer.train import PpoSettings
from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.ppo import update
from rsoccer.train.ppo.adam import BETA_1
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.update import PPO

SIZE, OBSERVATION_SIZE, ACTION_SIZE, ACTION_STD = 64, 5, 2, 0.6


def new_ppo(state_size: int = 0, **changes: int) -> tuple[PPO, Batch]:
    """Return PPO for a small network, and a batch that this network has drawn."""
    values: dict[str, Any] = {"n_epochs": 1, "n_minibatches": 1, **changes}
    settings = PpoSettings(**values)
    generator = torch.Generator().manual_seed(0)
    sizes = (OBSERVATION_SIZE, ACTION_SIZE, (8,))
    model = ActorCritic(*sizes, ACTION_STD, generator, state_size=state_size)
    observations = torch.randn((SIZE, OBSERVATION_SIZE), generator=generator)
    with torch.no_grad():
        mean = model.actor(observations)
        actions = mean + torch.randn(mean.shape, generator=generator) * ACTION_STD
        log_probs = model.log_prob(mean, actions)
    advantages = torch.randn(SIZE, generator=generator)
    batch = Batch(observations, actions, log_probs, advantages, torch.ones(SIZE))
    if state_size:
        states = torch.randn((SIZE, state_size), generator=generator)
        batch.central_inputs = torch.cat([states, observations], dim=1)
    return PPO(settings, model, generator, torch.device("cpu")), batch


def test_the_first_epoch_starts_at_the_policy_that_played() -> None:
    ppo, batch = new_ppo()
    stats = ppo.update(batch, 1e-3, lambda: None)
    assert stats["approx_kl"] == pytest.approx(0.0, abs=1e-6)
    assert stats["clip_fraction"] == 0.0
    assert stats["value_loss"] > 0.0
    assert list(stats) == [
        *("clip_fraction", "value_loss", "approx_kl", "n_epochs", "learning_rate", "action_std")
    ]


def test_the_epochs_stop_above_the_target_kl(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1e-4)
    ppo, batch = new_ppo(n_epochs=10)
    stats = ppo.update(batch, 0.05, lambda: None)
    assert stats["n_epochs"] == 2  # the first epoch has no divergence yet
    assert stats["approx_kl"] > 1e-4
    monkeypatch.setattr(update, "TARGET_KL", 1e3)
    ppo, batch = new_ppo(n_epochs=10)
    assert ppo.update(batch, 0.05, lambda: None)["n_epochs"] == 10


def test_updates_raise_the_probability_of_better_actions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1e3)
    ppo, batch = new_ppo(n_epochs=5)
    ppo.update(batch, 0.01, lambda: None)
    model = ppo._model
    assert model is not ppo._learner
    ratio = (model.log_prob(model.actor(batch.observations), batch.actions) - batch.log_probs).exp()
    better = batch.advantages > batch.advantages.mean()
    assert ratio[better].mean() > 1.0 > ratio[~better].mean()


def test_long_gradients_are_shortened(monkeypatch: pytest.MonkeyPatch) -> None:
    moved = []
    for max_grad_norm in (1e-6, 1e-3, 0.5):
        monkeypatch.setattr(update, "MAX_GRAD_NORM", max_grad_norm)
        ppo, batch = new_ppo()
        before = ppo.optimizer._vector.clone()
        ppo.update(batch, 1e-3, lambda: None)
        moved.append(float((ppo.optimizer._vector - before).norm()))
        norm = float(ppo.optimizer._mean.norm()) / (1.0 - BETA_1)
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


def test_samples_of_an_older_policy_count_by_their_probability_now(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Ratios and the divergence are those to the policy before the update."""
    seen: list[Batch] = []
    ppo, batch = new_ppo(n_epochs=2, overlap=True)
    ppo.update(batch, 0.02, lambda: None)  # after that the batch is of an older policy
    with torch.no_grad():
        present = ppo._model.log_prob(ppo._model.actor(batch.observations), batch.actions)
    ratio = (present - batch.log_probs).exp()
    assert ratio.min() < 0.8 and ratio.max() > update.MAX_WEIGHT
    compute = ppo._loss_gradient

    def record(batch: Batch, *rest: Any, **named: Any) -> tuple[torch.Tensor, torch.Tensor]:  # noqa: ANN401
        seen.append(batch)
        return compute(batch, *rest, **named)

    monkeypatch.setattr(ppo, "_loss_gradient", record)
    monkeypatch.setattr(record, "log_probs", compute.log_probs, raising=False)
    stats = ppo.update(batch, 1e-4, lambda: None)
    torch.testing.assert_close(seen[0].log_probs, present)
    assert seen[0].weights is not None
    torch.testing.assert_close(seen[0].weights, ratio.clamp(max=update.MAX_WEIGHT))
    assert stats["approx_kl"] < 1e-3 < float((ratio - 1 - ratio.log()).mean())

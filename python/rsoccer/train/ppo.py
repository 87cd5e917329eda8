"""Proximal policy optimisation (PPO, Schulman et al. 2017): the clipped loss and the update."""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import Tensor, nn

from rsoccer.train.args import Args
from rsoccer.train.log import Row
from rsoccer.train.networks import ActorCritic
from rsoccer.train.rollout import Batch


class PPO:
    """Updates a policy and its value network on batches of samples.

    Attributes:
        optimiser: Adam over all parameters of the model.
    """

    def __init__(self, args: Args, model: ActorCritic, generator: torch.Generator) -> None:
        """Create the optimiser.

        Args:
            args: settings of the run.
            model: the networks to train.
            generator: draws the minibatches.
        """
        self._args, self._model, self._generator = args, model, generator
        self.optimiser = torch.optim.Adam(
            model.parameters(), lr=args.learning_rate, eps=1e-5, foreach=True
        )

    def update(self, batch: Batch, learning_rate: float, check_stop: Callable[[], None]) -> Row:
        """Train on a batch for `n_epochs`, or until `approx_kl` exceeds `target_kl`.

        Args:
            batch: samples of one rollout.
            learning_rate: step size of Adam.
            check_stop: called before each minibatch; an exception that it raises ends the update.

        Returns:
            Columns of the log: clip_fraction, value_loss and approx_kl, which are means over the
            minibatches of the last epoch, n_epochs, learning_rate, and the mean action_std.
        """
        self.optimiser.param_groups[0]["lr"] = learning_rate
        row: Row = {}
        n_epochs, approx_kl = 0, 0.0
        while n_epochs < self._args.n_epochs and approx_kl <= self._args.target_kl:
            approx_kl, clip_fraction, value_loss = self._train_epoch(batch, check_stop)
            row.update(clip_fraction=clip_fraction, value_loss=value_loss)
            n_epochs += 1
        row.update(
            approx_kl=approx_kl,
            n_epochs=n_epochs,
            learning_rate=learning_rate,
            action_std=float(self._model.log_std.detach().exp().mean()),
        )
        return row

    def _train_epoch(self, batch: Batch, check_stop: Callable[[], None]) -> list[float]:
        """One pass over the batch; the mean of the minibatches' statistics from `_loss`."""
        order = torch.randperm(len(batch), generator=self._generator)
        stats = []
        for indices in order.chunk(self._args.n_minibatches):
            check_stop()
            loss, minibatch_stats = self._loss(batch.select(indices))
            self.optimiser.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]
            nn.utils.clip_grad_norm_(self._model.parameters(), self._args.max_grad_norm)
            self.optimiser.step()
            stats.append(minibatch_stats)
        means: list[float] = torch.stack(stats).mean(0).tolist()
        return means

    def _loss(self, minibatch: Batch) -> tuple[Tensor, Tensor]:
        """Loss of a minibatch, and its statistics (approx_kl, clip_fraction, value_loss), (3,)."""
        args, observations = self._args, minibatch.observations
        advantages = minibatch.advantages
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        log_probs = self._model.log_prob(self._model.actor(observations), minibatch.actions)
        log_ratio = log_probs - minibatch.log_probs
        ratio = log_ratio.exp()
        clipped_ratio = ratio.clamp(1 - args.clip_range, 1 + args.clip_range)
        policy_loss = -torch.minimum(ratio * advantages, clipped_ratio * advantages).mean()
        value_loss = (
            (self._model.value(minibatch.critic_inputs) - minibatch.returns).square().mean()
        )
        loss = policy_loss + args.value_coef * value_loss
        loss = loss - args.entropy_coef * self._model.entropy()
        with torch.no_grad():
            approx_kl = (ratio - 1 - log_ratio).mean()  # never negative, Schulman (2020)
            clip_fraction = ((ratio - 1).abs() > args.clip_range).float().mean()
            return loss, torch.stack([approx_kl, clip_fraction, value_loss])

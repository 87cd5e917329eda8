"""Proximal policy optimization (PPO, Schulman et al. 2017): passes over a batch."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Callable
from typing import Final

import torch
from torch import nn

from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.weight_sharing import WeightSharing
from rsoccer.train.ppo.adam import Adam
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.learning_rate import TARGET_KL
from rsoccer.train.ppo.loss_gradient import LossGradient, weighted_advantages
from rsoccer.train.ppo.settings import PpoSettings
from rsoccer.train.workers import Workers

MAX_GRAD_NORM: Final = 0.5
"""Largest norm of a gradient; longer gradients are shortened to it."""
MAX_WEIGHT: Final = 2.0
"""Largest weight of a sample of an older policy, so that few samples do not make up a gradient."""


class PPO:
    """Updates a policy and its value network on batches of samples.

    The model acts on the CPU. An update trains a copy on the device of the settings, which may be
    the CPU too, and copies the parameters back at its end. `update` does that in one call; in
    three calls `learn` may run in a thread of its own, while the model plays.

    Attributes:
        device: device of the updates.
        optimizer: Adam over all parameters of the copy.
    """

    def __init__(
        self,
        settings: PpoSettings,
        model: ActorCritic,
        generator: torch.Generator,
        device: torch.device,
        sharing: WeightSharing | None = None,
        workers: Workers | None = None,
    ) -> None:
        """Create the copy and the optimizer.

        Args:
            settings: settings of PPO.
            model: the networks to train, on the CPU.
            generator: draws the minibatches, on the CPU.
            device: device of the updates.
            sharing: groups of parameters that stay equal; None for none.
            workers: threads that compute gradients on a CPU; None for the calling one alone.
        """
        self._settings, self._model, self._generator = settings, model, generator
        self._sharing, self.device = sharing, device
        if sharing is not None:
            sharing.move(self.device)
        self._learner = copy.deepcopy(model).to(self.device)
        # The parameters become views of one vector: one norm to clip, one step of Adam.
        vector = nn.utils.parameters_to_vector(self._learner.parameters()).detach()
        nn.utils.vector_to_parameters(vector, self._learner.parameters())
        self.optimizer = Adam(vector)
        if workers is None or device.type != "cpu":  # a GPU computes a minibatch at once
            workers = Workers(1)
        self._loss_gradient = LossGradient(self._learner, workers)

    def update(
        self,
        batch: Batch,
        learning_rate: float,
        check_stop: Callable[[], None],
        *,
        critic_only: bool = False,
    ) -> dict[str, float]:
        """Train on a batch for `n_epochs`, or until `approx_kl` exceeds `TARGET_KL`.

        Args:
            batch: samples of one rollout, on the CPU.
            learning_rate: step size of Adam.
            check_stop: called before each minibatch; an exception that it raises ends the update.
            critic_only: the value network alone learns, and the policy stays as it is.

        Returns:
            Columns of the log, from `learn`.
        """
        self.begin()
        row = self.learn(batch, learning_rate, check_stop, critic_only=critic_only)
        self.finish()
        return row

    def begin(self) -> None:
        """Give the copy the parameters of the model."""
        self._learner.load_state_dict(self._model.state_dict())

    def finish(self) -> None:
        """Give the model the parameters of the copy."""
        self._model.load_state_dict(self._learner.state_dict())

    @torch.no_grad()
    def learn(
        self,
        batch: Batch,
        learning_rate: float,
        check_stop: Callable[[], None],
        *,
        critic_only: bool = False,
    ) -> dict[str, float]:
        """Train the copy as `update` does; the model is only read.

        Args:
            batch: samples of one rollout, on the CPU; with `overlap`, perhaps of an older policy.
            learning_rate: step size of Adam.
            check_stop: called before each minibatch; an exception that it raises ends the update.
            critic_only: the value network alone learns, and the policy stays as it is.

        Returns:
            Columns of the log: clip_fraction, value_loss and approx_kl, which are means over the
            minibatches of the last epoch, n_epochs, learning_rate, and the mean action_std.
        """
        batch = batch.to(self.device)
        if self._settings.overlap:
            batch = self._as_of_now(batch)
        row: dict[str, float] = {}
        n_epochs, approx_kl = 0, 0.0
        while n_epochs < self._settings.n_epochs and approx_kl <= TARGET_KL:
            approx_kl, clip_fraction, value_loss = self._train_epoch(
                batch, learning_rate, check_stop, critic_only=critic_only
            )
            row.update(clip_fraction=clip_fraction, value_loss=value_loss)
            n_epochs += 1
        row.update(
            approx_kl=approx_kl,
            n_epochs=n_epochs,
            learning_rate=learning_rate,
            action_std=float(self._model.log_std.exp().mean()),
        )
        return row

    def _as_of_now(self, batch: Batch) -> Batch:
        """The samples of an older policy, for an update of the present one.

        Ratios are then those to the policy before the update, as without overlap, and the ratio of
        that one to the policy that played is a weight: the decoupled objective of Hilton et al.,
        "Batch size-invariance for policy optimization" (2022). With ratios to the policy that
        played, the divergence of two updates counts as that of one, so passes stop early: a run of
        `VSS-v0` had 1.5 of them in place of 2.7 on average, and learned less.
        """
        log_probs = self._loss_gradient.log_probs(batch)
        weights = (log_probs - batch.log_probs).exp_().clamp_(max=MAX_WEIGHT)
        return dataclasses.replace(batch, log_probs=log_probs, weights=weights)

    def _train_epoch(
        self,
        batch: Batch,
        learning_rate: float,
        check_stop: Callable[[], None],
        *,
        critic_only: bool,
    ) -> list[float]:
        """One pass over the batch; the mean of the minibatches' statistics from `LossGradient`."""
        order = torch.randperm(len(batch), generator=self._generator).to(self.device)
        minibatches = order.chunk(self._settings.n_minibatches)
        # All at once: between other work such small operations take several times as long.
        advantages = [
            weighted_advantages(batch, rows, critic_only=critic_only) for rows in minibatches
        ]
        stats = []
        for rows, weights in zip(minibatches, advantages, strict=True):
            check_stop()
            gradient, minibatch_stats = self._loss_gradient(batch, rows, weights)
            if self._sharing is not None:
                gradient = self._sharing.average(gradient)
            scale = MAX_GRAD_NORM / (torch.linalg.vector_norm(gradient) + 1e-6)
            self.optimizer.step(gradient.mul_(scale.clamp(max=1.0)), learning_rate)
            stats.append(minibatch_stats)
        means: list[float] = torch.stack(stats).mean(0).tolist()
        return means

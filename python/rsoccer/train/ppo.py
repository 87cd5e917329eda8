"""Proximal policy optimisation (PPO, Schulman et al. 2017): the clipped loss and the update."""

from __future__ import annotations

import copy
from collections.abc import Callable

import torch
from torch import Tensor, nn

from rsoccer.train.adam import Adam
from rsoccer.train.args import Args
from rsoccer.train.batch import Batch
from rsoccer.train.device import find_device
from rsoccer.train.log import Row
from rsoccer.train.networks import ActorCritic
from rsoccer.train.weight_sharing import WeightSharing


class PPO:
    """Updates a policy and its value network on batches of samples.

    The model acts on the CPU. An update trains a copy on the device of the settings, which may be
    the CPU too, and copies the parameters back at its end.

    Attributes:
        device: device of the updates.
        optimiser: Adam over all parameters of the copy.
    """

    def __init__(
        self,
        args: Args,
        model: ActorCritic,
        generator: torch.Generator,
        sharing: WeightSharing | None = None,
    ) -> None:
        """Create the copy and the optimiser.

        Args:
            args: settings of the run.
            model: the networks to train, on the CPU.
            generator: draws the minibatches, on the CPU.
            sharing: groups of parameters that stay equal; None for none.

        Raises:
            ValueError: the settings ask for a GPU, and torch finds none.
        """
        self._args, self._model, self._generator = args, model, generator
        self._sharing = sharing
        self.device = find_device(args.device)
        if sharing is not None:
            sharing.move(self.device)
        self._learner = copy.deepcopy(model).to(self.device)
        # The parameters become views of one vector: one norm to clip, one step of Adam.
        vector = nn.utils.parameters_to_vector(self._learner.parameters()).detach()
        nn.utils.vector_to_parameters(vector, self._learner.parameters())
        self.optimiser = Adam(vector)

    @torch.no_grad()
    def update(self, batch: Batch, learning_rate: float, check_stop: Callable[[], None]) -> Row:
        """Train on a batch for `n_epochs`, or until `approx_kl` exceeds `target_kl`.

        Args:
            batch: samples of one rollout, on the CPU.
            learning_rate: step size of Adam.
            check_stop: called before each minibatch; an exception that it raises ends the update.

        Returns:
            Columns of the log: clip_fraction, value_loss and approx_kl, which are means over the
            minibatches of the last epoch, n_epochs, learning_rate, and the mean action_std.
        """
        self._learner.load_state_dict(self._model.state_dict())
        batch = batch.to(self.device)
        row: Row = {}
        n_epochs, approx_kl = 0, 0.0
        while n_epochs < self._args.n_epochs and approx_kl <= self._args.target_kl:
            approx_kl, clip_fraction, value_loss = self._train_epoch(
                batch, learning_rate, check_stop
            )
            row.update(clip_fraction=clip_fraction, value_loss=value_loss)
            n_epochs += 1
        self._model.load_state_dict(self._learner.state_dict())
        row.update(
            approx_kl=approx_kl,
            n_epochs=n_epochs,
            learning_rate=learning_rate,
            action_std=float(self._model.log_std.exp().mean()),
        )
        return row

    def _train_epoch(
        self, batch: Batch, learning_rate: float, check_stop: Callable[[], None]
    ) -> list[float]:
        """One pass over the batch; the mean of the minibatches' statistics from `_gradients`."""
        order = torch.randperm(len(batch), generator=self._generator)
        stats = []
        for minibatch in batch.select(order.to(self.device)).chunk(self._args.n_minibatches):
            check_stop()
            gradients, minibatch_stats = self._gradients(minibatch)
            gradient = torch.cat([part.flatten() for part in gradients])
            if self._sharing is not None:
                gradient = self._sharing.average(gradient)
            scale = self._args.max_grad_norm / (gradient.norm() + 1e-6)
            self.optimiser.step(gradient.mul_(scale.clamp(max=1.0)), learning_rate)
            stats.append(minibatch_stats)
        means: list[float] = torch.stack(stats).mean(0).tolist()
        return means

    def _gradients(self, minibatch: Batch) -> tuple[list[Tensor], Tensor]:
        """Gradients of the loss by parameter, and (approx_kl, clip_fraction, value_loss), (3,).

        With ratios r, advantages A, values V and returns R the loss is
        -mean(min(r A, clip(r) A)) + value_coef mean((V - R)^2) - entropy_coef entropy.
        A test compares the gradients with those of autograd.
        """
        args, model = self._args, self._learner
        advantages = minibatch.advantages
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        actor = model.actor.activations(minibatch.observations)
        offset = model.standardise(actor[-1], minibatch.actions)
        log_ratio = model.log_density(offset) - minibatch.log_probs
        ratio = log_ratio.exp()
        clipped_ratio = ratio.clamp(1 - args.clip_range, 1 + args.clip_range)
        gain = ratio * advantages
        unclipped = gain <= clipped_ratio * advantages
        by_log_prob = torch.where(unclipped, gain, 0.0).mul_(-1.0 / len(minibatch))[:, None]
        by_mean = offset * by_log_prob * (-model.log_std).exp()
        critic = model.critic.activations(minibatch.critic_inputs)
        error = critic[-1] - minibatch.returns[:, None]
        by_value = error * (2.0 * args.value_coef / len(minibatch))
        gradients = model.actor.gradients(actor, by_mean) + model.critic.gradients(critic, by_value)
        if model.log_std.requires_grad:  # it comes first among the parameters
            by_log_std = ((offset.square() - 1.0) * by_log_prob).sum(0) - args.entropy_coef
            gradients.insert(0, by_log_std)
        approx_kl = (ratio - 1 - log_ratio).mean()  # never negative, Schulman (2020)
        clip_fraction = (clipped_ratio != ratio).float().mean()
        return gradients, torch.stack([approx_kl, clip_fraction, error.square().mean()])

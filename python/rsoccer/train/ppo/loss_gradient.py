"""Gradient of PPO's loss over a minibatch, in parts of its samples on several threads.

A part of the samples and a network is a job. Each job gathers its samples, so a pass over a batch
copies it once and in pieces that stay in the cache, and writes its gradient beside those of the
others. They are added up in the order of the parts, so results do not depend on the threads.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Final

import torch
from torch import Tensor

from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.perceptron import PassMemory, Perceptron, PerceptronPass
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.workers import Job, Workers, shards

CLIP_RANGE: Final = 0.2
"""Largest change of an action's probability ratio that the loss rewards."""
VALUE_COEF: Final = 0.5
"""Weight of the value loss."""
SHARD: Final = 4096
"""Samples of a part on a CPU: with smaller ones the calls of torch take a larger share."""


class LossGradient:
    """Gradients of the loss by the parameters of a model.

    With ratios r, advantages A, values V, returns R and weights w of the samples, 1 by default, the
    loss is -mean(w min(r A, clip(r) A)) + VALUE_COEF mean((V - R)^2).
    A test compares the gradients with those of autograd.
    """

    def __init__(self, model: ActorCritic, workers: Workers) -> None:
        """Begin without buffers.

        Args:
            model: the networks, with no other parameters.
            workers: threads that compute.
        """
        self._model, self._workers = model, workers
        memories = [PassMemory() for _ in range(workers.threads)]
        self._actors = [_Place(model.actor, memory) for memory in memories]
        self._critics = [_Place(model.critic, memory) for memory in memories]
        self._size = sum(parameter.numel() for parameter in model.parameters())
        self._actor_parameters = 2 * len(model.actor.linear())
        self._gradients = torch.empty(0)
        self._stats = torch.empty(0)
        self._outs: list[list[Tensor]] = []

    @torch.no_grad()
    def __call__(self, batch: Batch, rows: Tensor, advantages: Tensor) -> tuple[Tensor, Tensor]:
        """Return the gradient, (size,), and (approx_kl, clip_fraction, value_loss), (3,).

        The gradient is valid until the next call, and may be changed.

        Args:
            batch: samples of one rollout, on the device of the model.
            rows: (k,) indices of the samples of the minibatch.
            advantages: (k,) their advantages from `weighted_advantages`; of zeros the gradient of
                the policy is 0.
        """
        parts = shards(len(rows), SHARD if rows.device.type == "cpu" else len(rows))
        self._reserve(len(parts), rows.device)
        jobs: list[Job] = []
        for index, part in enumerate(parts):
            jobs += self._jobs(index, batch, rows[part], advantages[part], len(rows))
        self._workers.run(jobs)
        # In the order of the parts.
        only = len(parts) == 1
        gradient = self._gradients[0] if only else self._gradients[: len(parts)].sum(0)
        return gradient, self._stats[: len(parts)].sum(0).div_(len(rows))

    @torch.no_grad()
    def log_probs(self, batch: Batch) -> Tensor:
        """Return the log densities of the actions under the policy as it is, (size,).

        Args:
            batch: samples on the device of the model.
        """
        found, rows = torch.empty_like(batch.log_probs), torch.arange(len(batch))
        rows = rows.to(found.device)

        def evaluate(part: slice, thread: int) -> None:
            mean = self._actors[thread].outputs(batch.observations, rows[part])
            found[part] = self._model.log_prob(mean, batch.actions[part])

        # On a GPU, too: buffers for the whole batch would be much larger than for a minibatch.
        parts = shards(len(batch), SHARD)
        self._workers.run([functools.partial(evaluate, part) for part in parts])
        return found

    def _jobs(
        self, index: int, batch: Batch, rows: Tensor, advantages: Tensor, total: int
    ) -> Iterator[Job]:
        """The jobs of a part of a minibatch of `total` samples: policy, value network."""

        def policy(thread: int) -> None:
            self._policy(index, self._actors[thread], batch, rows, advantages, total)

        def value(thread: int) -> None:
            self._value(index, self._critics[thread], batch, rows, total)

        yield policy
        yield value

    @torch.no_grad()
    def _policy(
        self,
        index: int,
        place: _Place,
        batch: Batch,
        rows: Tensor,
        advantages: Tensor,
        total: int,
    ) -> None:
        """Write the gradient of the policy for a part, its divergence and its clipped samples."""
        model = self._model
        mean = place.outputs(batch.observations, rows)
        inverse_std = model.inverse_std()
        offset = batch.actions.index_select(0, rows).sub_(mean).mul_(inverse_std)
        log_ratio = model.log_density(offset).sub_(batch.log_probs.index_select(0, rows))
        ratio = log_ratio.exp()
        clipped_ratio = ratio.clamp(1 - CLIP_RANGE, 1 + CLIP_RANGE)
        gain = ratio * advantages
        by_log_prob = gain.masked_fill(gain > clipped_ratio * advantages, 0.0).mul_(-1.0 / total)
        by_mean = offset.mul_(by_log_prob[:, None]).mul_(inverse_std)
        place.gradients(by_mean, self._outs[index][: self._actor_parameters])
        stats = self._stats[index]
        torch.ne(clipped_ratio, ratio, out=clipped_ratio)
        torch.sum(clipped_ratio, 0, out=stats[1])
        ratio.sub_(1.0).sub_(log_ratio)  # never negative, Schulman (2020)
        torch.sum(ratio, 0, out=stats[0])

    @torch.no_grad()
    def _value(self, index: int, place: _Place, batch: Batch, rows: Tensor, total: int) -> None:
        """Write the gradient of the value network for a part, and its squared errors."""
        values = place.outputs(batch.critic_inputs, rows)
        error = values.sub_(batch.returns.index_select(0, rows)[:, None])
        torch.sum(error.square(), (0, 1), out=self._stats[index, 2])
        error.mul_(2.0 * VALUE_COEF / total)
        place.gradients(error, self._outs[index][self._actor_parameters :])

    def _reserve(self, parts: int, device: torch.device) -> None:
        """Have buffers for the gradients and the statistics of some parts."""
        if parts <= len(self._outs):
            return
        self._gradients = torch.empty((parts, self._size), device=device)
        self._stats = torch.empty((parts, 3), device=device)
        shapes = [parameter.shape for parameter in self._model.parameters()]
        sizes = [shape.numel() for shape in shapes]
        self._outs = [
            [part.view(shape) for part, shape in zip(row.split(sizes), shapes, strict=True)]
            for row in self._gradients
        ]


@torch.no_grad()
def weighted_advantages(batch: Batch, rows: Tensor, *, critic_only: bool = False) -> Tensor:
    """Return normalized advantages of a minibatch, times the weights of its samples, (k,).

    Args:
        batch: samples of one rollout.
        rows: (k,) indices of the samples of the minibatch.
        critic_only: all are 0. Adam leaves parameters as they are whose gradients were always 0.
    """
    advantages = batch.advantages.index_select(0, rows)
    advantages.sub_(advantages.mean()).div_(advantages.std() + 1e-8)
    if batch.weights is not None:
        advantages.mul_(batch.weights.index_select(0, rows))
    return advantages.zero_() if critic_only else advantages


class _Place:
    """Passes of a thread through one network, in memory that both networks share."""

    def __init__(self, network: Perceptron, memory: PassMemory) -> None:
        self._pass, self._memory = PerceptronPass(network, memory), memory
        self.gradients = self._pass.gradients

    def outputs(self, inputs: Tensor, rows: Tensor) -> Tensor:
        """Outputs (k, outputs) for some rows of the inputs, valid until the memory's next ones."""
        chosen = self._memory.matrix("inputs", len(rows), inputs.shape[1], inputs)
        torch.index_select(inputs, 0, rows, out=chosen)
        return self._pass.outputs(chosen)

"""Outputs of the policy and of the value network for many rows, on several threads."""

from __future__ import annotations

import functools
from collections.abc import Callable

import torch
from torch import Tensor

from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.perceptron import Perceptron, PerceptronPass
from rsoccer.train.workers import Workers, shards

SHARD = 1024
"""Rows of a part: with fewer the calls of torch take a larger share."""


class Evaluator:
    """Mean actions and values of a model, each of whose threads has buffers of its own.

    Attributes:
        model: policy and value network.
        workers: the threads.
    """

    def __init__(self, model: ActorCritic, workers: Workers) -> None:
        """Begin without buffers.

        Args:
            model: policy and value network, on the CPU.
            workers: the threads.
        """
        self.model, self.workers = model, workers
        self._actors, self._critics = (
            [PerceptronPass(network) for _ in range(workers.threads)]
            for network in (model.actor, model.critic)
        )

    def mean(self, observations: Tensor) -> Tensor:
        """Return the mean actions, (..., action).

        Args:
            observations: (..., o) normalized observations.
        """
        return self._outputs(self.model.actor, self._actors, observations)

    def value(self, inputs: Tensor) -> Tensor:
        """Return the expected discounted returns, in scaled rewards, (...).

        Args:
            inputs: (..., s + o) inputs of the value network, see `ActorCritic.value`.
        """
        return self._outputs(self.model.critic, self._critics, inputs).squeeze(-1)

    def actor(self, thread: int) -> PerceptronPass:
        """Return the buffers of a thread for the policy.

        Args:
            thread: index of the thread.
        """
        return self._actors[thread]

    def each_part(
        self, rows: int, do: Callable[[slice, int], None], alone: int | None = None
    ) -> None:
        """Do something for each part of some rows, on all threads.

        Args:
            rows: number of rows.
            do: takes a part of the rows and the index of a thread; parts are done at the same time.
            alone: most rows of an only part; None for those of any part.
        """
        parts = shards(rows, SHARD, alone)
        self.workers.run([functools.partial(do, part) for part in parts])

    def _outputs(self, network: Perceptron, passes: list[PerceptronPass], inputs: Tensor) -> Tensor:
        """Outputs of a network, (..., outputs)."""
        rows = inputs.reshape(-1, inputs.shape[-1])
        outputs = torch.empty((len(rows), len(network.linear()[-1].bias)))

        def evaluate(part: slice, thread: int) -> None:
            outputs[part] = passes[thread].outputs(rows[part])

        self.each_part(len(rows), evaluate)
        return outputs.reshape(*inputs.shape[:-1], -1)

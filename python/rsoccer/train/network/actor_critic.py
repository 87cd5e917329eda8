"""Policy network and value network in torch, and the export of the policy to NumPy."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from rsoccer.arrays import Floats
from rsoccer.policies.network import Network
from rsoccer.task import Task
from rsoccer.train.network.perceptron import Perceptron

OBSERVATION_CLIP = 10.0
"""Bound of a normalized observation, in standard deviations."""


class ActorCritic(nn.Module):
    """A Gaussian policy and a value network with hidden layers of the same sizes.

    Attributes:
        observation_size: o, the numbers in an observation.
        actor: network from normalized observations (..., o) to mean actions (..., action).
        critic: network from its inputs (..., s + o), normalized states and observations, to values
            (..., 1); s is 0 unless the critic is central.
        log_std: (action,) logarithm of the standard deviation, independent of the observation.
        mask: (o,) 1 for numbers of the observation that the networks read, 0 for others.
    """

    log_std: Tensor
    mask: Tensor

    def __init__(
        self,
        observation_size: int,
        action_size: int,
        hidden_sizes: tuple[int, ...],
        action_std: float,
        generator: torch.Generator,
        *,
        state_size: int = 0,
        mask: Floats | None = None,
    ) -> None:
        """Draw orthogonal weights; a small last layer keeps the first mean actions near zero.

        Args:
            observation_size: numbers in an observation.
            action_size: numbers in an action.
            hidden_sizes: widths of the hidden layers.
            action_std: initial standard deviation of the actions.
            generator: draws the weights.
            state_size: numbers in a global state that the critic reads before the observation.
            mask: (o,) 1 for numbers of the observation that the networks read, 0 for others,
                which have weights of 0 in the first layers; None for all.
        """
        super().__init__()
        self.observation_size = observation_size
        self.actor = _mlp([observation_size, *hidden_sizes, action_size], 0.01, generator)
        self.critic = _mlp([state_size + observation_size, *hidden_sizes, 1], 1.0, generator)
        self.register_buffer("log_std", torch.full((action_size,), math.log(action_std)))
        mask = np.ones(observation_size, np.float32) if mask is None else mask
        self.register_buffer("mask", torch.tensor(mask), persistent=False)
        self.clear_masked_weights()

    @torch.no_grad()
    def clear_masked_weights(self) -> None:
        """Set the first weights of inputs that the networks do not read to 0.

        Inputs of 0 have gradients of 0, so these weights stay 0, also in the exported policy.
        """
        for network in (self.actor, self.critic):
            next(network.parameters())[:, -self.observation_size :].mul_(self.mask)

    @torch.no_grad()
    def set_mean_action(self, action: Sequence[float]) -> None:
        """Set the biases of the policy's last layer, which are the mean action before training.

        Args:
            action: numbers of the first components of the action; those of the others are 0.

        Raises:
            ValueError: more numbers than components.
        """
        *_, bias = self.actor.parameters()
        if len(action) > len(bias):
            raise ValueError(
                f"network.initial_action must have at most {len(bias)} numbers, one per component "
                f"of the action, got {len(action)}"
            )
        bias.zero_()
        bias[: len(action)] = torch.tensor(action)

    @torch.no_grad()
    def set_action_std(self, action_std: float) -> None:
        """Set the standard deviation of all components of the action.

        Args:
            action_std: standard deviation, above 0.
        """
        self.log_std.fill_(math.log(action_std))

    def value(self, inputs: Tensor) -> Tensor:
        """Return the expected discounted return, in scaled rewards, (...).

        Args:
            inputs: (..., s + o) normalized states and observations; s is 0 unless the critic is
                centralized.
        """
        values: Tensor = self.critic(inputs)
        return values.squeeze(-1)

    def log_prob(self, mean: Tensor, actions: Tensor) -> Tensor:
        """Return the log density of Gaussian actions, summed over their components, (...).

        Args:
            mean: (..., action) mean actions from `actor`.
            actions: (..., action) drawn actions.
        """
        return self.log_density(self.standardize(mean, actions))

    def standardize(self, mean: Tensor, actions: Tensor) -> Tensor:
        """Return actions in standard deviations from their mean, (..., action).

        Args:
            mean: (..., action) mean actions from `actor`.
            actions: (..., action) drawn actions.
        """
        return (actions - mean) * self.inverse_std()

    def inverse_std(self) -> Tensor:
        """Return 1 / standard deviation of the actions, (action,)."""
        return (-self.log_std).exp()

    def log_density(self, offset: Tensor) -> Tensor:
        """Return the log density of Gaussian actions, summed over their components, (...).

        Args:
            offset: (..., action) actions from `standardize`.
        """
        constant = offset.shape[-1] * 0.5 * math.log(2 * math.pi)
        return offset.square().sum(-1).mul_(-0.5).sub_(self.log_std.sum()).sub_(constant)

    def export(
        self,
        task: Task,
        mean: Floats,
        std: Floats,
        action_repeat: int,
        history: int,
        task_name: str,
        task_options: Mapping[str, Any],
    ) -> Network:
        """Return a copy of the current policy that plays in NumPy.

        Args:
            task: the task it is trained on.
            mean: (o,) mean of the observations.
            std: (o,) standard deviation of the observations.
            action_repeat: control steps for which the copy holds a decision.
            history: observations in a stacked one.
            task_name: registered name of the task, or an alias.
            task_options: options of the task, JSON values by name.
        """
        return Network.from_layers(
            task,
            self.actor,
            self.log_std.detach().exp().numpy(),
            action_repeat=action_repeat,
            history=history,
            mean=mean,
            std=std,
            clip=OBSERVATION_CLIP,
            task_name=task_name,
            task_options=task_options,
        )


def _mlp(sizes: list[int], last_gain: float, generator: torch.Generator) -> Perceptron:
    """Linear layers of the given sizes with tanh between them."""
    layers: list[nn.Module] = []
    for index, (in_features, out_features) in enumerate(itertools.pairwise(sizes)):
        last = index == len(sizes) - 2
        layer = _linear(in_features, out_features)
        nn.init.orthogonal_(layer.weight, last_gain if last else 2**0.5, generator=generator)
        nn.init.zeros_(layer.bias)
        layers += [layer] if last else [layer, nn.Tanh()]
    return Perceptron(*layers)


def _linear(in_features: int, out_features: int) -> nn.Linear:
    """A new layer, whose weights leave torch's global generator as it is."""
    with torch.random.fork_rng(devices=[]):
        return nn.Linear(in_features, out_features)

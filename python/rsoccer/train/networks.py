"""What learns: a policy network and a value network, and the policy's way into a file."""

from __future__ import annotations

import itertools
import math

import torch
from torch import Tensor, nn

from rsoccer.frame import Array, Floats
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.task import Task

OBSERVATION_CLIP = 10.0  # standard deviations; rarer values are bounded


class ActorCritic(nn.Module):
    """A policy and a value network of the same shape; the spread of actions is a parameter."""

    def __init__(
        self,
        observation: int,
        action: int,
        hidden: tuple[int, ...],
        action_std: float,
        chance: torch.Generator,
    ) -> None:
        """Orthogonal weights; a small last layer, so that the first actions are near zero."""
        super().__init__()
        self.actor = _perceptron([observation, *hidden, action], 0.01, chance)
        self.critic = _perceptron([observation, *hidden, 1], 1.0, chance)
        self.log_std = nn.Parameter(torch.full((action,), math.log(action_std)))

    def value(self, observations: Tensor) -> Tensor:
        """What is still to come, in scaled rewards, (...)."""
        values: Tensor = self.critic(observations)
        return values.squeeze(-1)

    def log_prob(self, mean: Tensor, actions: Tensor) -> Tensor:
        """Logarithm of the density of Gaussian actions (..., action), summed over them."""
        offset = (actions - mean) * (-self.log_std).exp()
        constant = mean.shape[-1] * 0.5 * math.log(2 * math.pi)
        return -0.5 * offset.square().sum(-1) - self.log_std.sum() - constant

    def entropy(self) -> Tensor:
        """Entropy of the Gaussian, the same for every observation."""
        return (self.log_std + 0.5 * math.log(2 * math.pi * math.e)).sum()

    def export(self, task: Task, name: str, repeat: int, mean: Floats, std: Floats) -> Network:
        """The policy as it plays while it learns, in NumPy.

        `name` is that of the task for `make_task`; each decision is held for `repeat` steps.
        """
        spread = self.log_std.detach().exp().numpy().copy()
        arrays: dict[str, Array] = {"mean": mean, "std": std, "action_std": spread}
        linear = [layer for layer in self.actor if isinstance(layer, nn.Linear)]
        for index, layer in enumerate(linear):
            arrays[f"layers.{index}.weight"] = layer.weight.detach().numpy().copy()
            arrays[f"layers.{index}.bias"] = layer.bias.detach().numpy().copy()
        metadata = {
            "format": FORMAT,
            "task": name,
            "layout": task.layout,
            "observation_size": str(linear[0].in_features),
            "action_size": str(linear[-1].out_features),
            "activation": "tanh",
            "clip": f"{OBSERVATION_CLIP:g}",
            "action_repeat": str(repeat),
        }
        return Network(arrays, metadata)


def _perceptron(sizes: list[int], last_gain: float, chance: torch.Generator) -> nn.Sequential:
    """Linear layers of the given sizes with tanh between them."""
    layers: list[nn.Module] = []
    for index, (taken, given) in enumerate(itertools.pairwise(sizes)):
        last = index == len(sizes) - 2
        layer = _empty_linear(taken, given)
        nn.init.orthogonal_(layer.weight, last_gain if last else 2**0.5, generator=chance)
        nn.init.zeros_(layer.bias)
        layers += [layer] if last else [layer, nn.Tanh()]
    return nn.Sequential(*layers)


def _empty_linear(taken: int, given: int) -> nn.Linear:
    """A layer whose weights are yet to be set: torch's own start draws from global chance."""
    layer: nn.Linear = nn.utils.skip_init(nn.Linear, taken, given)  # type: ignore[no-untyped-call]
    return layer

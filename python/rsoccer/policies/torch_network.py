"""A trained policy as a module of torch: `Network.to_torch()`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

import torch
from torch import Tensor, distributions, nn

if TYPE_CHECKING:
    from rsoccer.policies.heads import Deviation
    from rsoccer.policies.perceptron import Perceptron

_ACTIVATIONS: Final[dict[str, Callable[[], nn.Module]]] = {
    "tanh": nn.Tanh,
    "relu": nn.ReLU,
    "leaky_relu": nn.LeakyReLU,
    "elu": nn.ELU,
    "silu": nn.SiLU,
}


class TorchNetwork(nn.Module):
    """The layers of a policy file, with the normalization before them and the head after them.

    `forward` is the mode "mean" of the file; `distribution` is what mode "sample" draws from,
    before the clip to [-1, 1]. Weights and a constant standard deviation are parameters, so that
    the policy can be trained further. Normalization and action table are buffers.

    Attributes:
        layers: `nn.Sequential` of linear layers and activations.
        head: kind of the head, see `rsoccer.policies.heads`.
        log_std: (action,) logarithm of the standard deviation; None where there is none, or where
            the layers compute it.
        mean: (o,) subtracted from observations.
        std: (o,) observations are divided by it.
        clip: bound of a normalized observation.
        action_table: (choices, action) rows to choose from; None for other heads.
    """

    mean: Tensor
    std: Tensor
    action_table: Tensor | None

    def __init__(self, network: Perceptron) -> None:
        """Copy a network.

        Args:
            network: the network.
        """
        super().__init__()
        modules: list[nn.Module] = []
        for weight, bias in network.layers:
            layer = nn.Linear(weight.shape[1], weight.shape[0])
            with torch.no_grad():
                layer.weight.copy_(torch.tensor(weight))
                layer.bias.copy_(torch.tensor(bias))
            modules += [layer, _ACTIVATIONS[network.activation]()]
        self.layers = nn.Sequential(*modules[:-1])
        head = network.head
        self.head = head.kind
        self._deviation: Deviation | None = head.deviation
        std = None if head.action_std is None else torch.tensor(head.action_std)
        self.log_std = None if std is None else nn.Parameter(std.log())
        self.clip = float(network.clip)
        self.register_buffer("mean", torch.tensor(network.mean))
        self.register_buffer("std", torch.tensor(network.std))
        table = None if head.table is None else torch.tensor(head.table)
        self.register_buffer("action_table", table)

    def outputs(self, observations: Tensor) -> Tensor:
        """Return the outputs of the last layer, (..., outputs).

        Args:
            observations: (..., o) observations.
        """
        inputs = ((observations - self.mean) / self.std).clamp(-self.clip, self.clip)
        outputs: Tensor = self.layers(inputs)
        return outputs

    def forward(self, observations: Tensor) -> Tensor:
        """Return the actions of mode "mean", (..., action) in [-1, 1].

        Args:
            observations: (..., o) observations.
        """
        outputs = self.outputs(observations)
        if self.action_table is not None:
            return self.action_table[outputs.argmax(dim=-1)]
        means = outputs if self._deviation is None else outputs.chunk(2, dim=-1)[0]
        return means.tanh() if self.head == "squashed" else means.clamp(-1.0, 1.0)

    def distribution(self, observations: Tensor) -> distributions.Distribution:
        """Return the distribution of the actions, before the clip; of indices for choices.

        Args:
            observations: (..., o) observations.

        Raises:
            ValueError: the policy has none.
        """
        outputs = self.outputs(observations)
        if self.head == "categorical":
            return distributions.Categorical(logits=outputs)
        if self._deviation is not None:
            means, raw = outputs.chunk(2, dim=-1)
            std = _std(self._deviation, raw)
        elif self.log_std is not None:
            means, std = outputs, self.log_std.exp().expand_as(outputs)
        else:
            raise ValueError("the policy has no distribution: it is deterministic")
        normal = distributions.Normal(means, std)
        if self.head == "squashed":
            tanh = distributions.TanhTransform(cache_size=1)
            return distributions.Independent(
                distributions.TransformedDistribution(normal, [tanh]), 1
            )
        return distributions.Independent(normal, 1)


def _std(deviation: Deviation, outputs: Tensor) -> Tensor:
    """Standard deviations as `Deviation.of` has them."""
    if deviation.kind == "softplus":
        shift, offset, least = deviation.numbers
        return (nn.functional.softplus(outputs + shift) + offset).clamp_min(least)
    low, high = deviation.numbers
    if deviation.kind == "exp":
        return outputs.clamp(low, high).exp()
    return (low + 0.5 * (high - low) * (outputs.tanh() + 1.0)).exp()

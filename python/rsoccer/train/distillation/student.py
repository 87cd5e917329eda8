"""The student of a distillation: a network that begins with the weights of a policy."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from rsoccer.arrays import Floats
from rsoccer.history import ObservationStack
from rsoccer.policies.network import Network
from rsoccer.train.network.initial_policy import widened_layers


class Normalizer(nn.Module):
    """Normalization of observations by fixed means and deviations, as policy files have it."""

    def __init__(self, mean: Floats, std: Floats, clip: float) -> None:
        """Keep the numbers.

        Args:
            mean: (o,) means.
            std: (o,) standard deviations.
            clip: bound of a normalized observation.
        """
        super().__init__()
        self.mean, self.std, self.clip = torch.tensor(mean), torch.tensor(std), clip

    def forward(self, observations: Tensor) -> Tensor:
        """Return normalized observations.

        Args:
            observations: (..., o).
        """
        return ((observations - self.mean) / self.std).clamp(-self.clip, self.clip)


def new_student(policy: Network, stack: ObservationStack) -> nn.Sequential:
    """Return the layers of a policy in torch, with weights of 0 for inputs that it does not have.

    Args:
        policy: the policy, of at most the history of the stack.
        stack: what the student observes.
    """
    modules: list[nn.Module] = []
    for weight, bias in widened_layers(policy, stack):
        with torch.random.fork_rng(devices=[]):  # torch's global generator stays as it is
            layer = nn.Linear(weight.shape[1], weight.shape[0])
        with torch.no_grad():
            layer.weight.copy_(torch.tensor(weight))
            layer.bias.copy_(torch.tensor(bias))
        modules += [layer, nn.Tanh()]
    return nn.Sequential(*modules[:-1])

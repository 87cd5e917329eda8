"""Adam (Kingma and Ba 2015) for one vector of parameters."""

from __future__ import annotations

import math

import torch
from torch import Tensor

from rsoccer.arrays import Array

BETA_1 = 0.9
"""Decay of the mean of gradients per step."""
BETA_2 = 0.999
"""Decay of the mean of squared gradients per step."""
EPSILON = 1e-5
"""Added to the root of the mean of squared gradients; PPO's usual value."""


class Adam:
    """Steps of a vector of parameters, equal to those of `torch.optim.Adam` up to rounding.

    For a few thousand parameters the time of an optimizer of torch is in its Python code.
    """

    def __init__(self, vector: Tensor) -> None:
        """Start without steps.

        Args:
            vector: (size,) parameters, which the steps change in place.
        """
        self._vector = vector
        self._mean, self._square = torch.zeros_like(vector), torch.zeros_like(vector)
        self._root = torch.empty_like(vector)  # memory of a step
        self._steps = 0

    def step(self, gradient: Tensor, learning_rate: float) -> None:
        """Change the parameters by one step.

        Args:
            gradient: (size,) gradient of the loss.
            learning_rate: step size.
        """
        self._steps += 1
        self._mean.lerp_(gradient, 1.0 - BETA_1)
        self._square.mul_(BETA_2).addcmul_(gradient, gradient, value=1.0 - BETA_2)
        # Both means start at 0, which the divisions correct.
        root = torch.sqrt(self._square, out=self._root)
        root.div_(math.sqrt(1.0 - BETA_2**self._steps)).add_(EPSILON)
        step_size = learning_rate / (1.0 - BETA_1**self._steps)
        self._vector.addcdiv_(self._mean, root, value=-step_size)

    def state_dict(self) -> dict[str, Array]:
        """Return copies of the means (size,) and of the number of steps () by name."""
        return {
            "mean": self._mean.cpu().numpy().copy(),
            "square": self._square.cpu().numpy().copy(),
            "steps": torch.tensor(self._steps).numpy(),
        }

    def load_state_dict(self, arrays: dict[str, Array]) -> None:
        """Restore the state, on whatever device the parameters are.

        Args:
            arrays: arrays from `state_dict`.
        """
        self._mean.copy_(torch.tensor(arrays["mean"]))
        self._square.copy_(torch.tensor(arrays["square"]))
        self._steps = int(arrays["steps"])

"""The parts of a network that other forms of it are made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy as np

    from rsoccer.arrays import Floats
    from rsoccer.policies.heads import Head


class Perceptron(Protocol):
    """Layers with their normalization and head, as `Network` has them."""

    metadata: dict[str, str]
    """text by key, as in the policy file"""
    layers: list[tuple[Floats, Floats]]
    """weight (out, in) and bias (out,) of each layer"""
    mean: Floats
    """(o,) subtracted from observations"""
    std: Floats
    """(o,) observations are divided by it"""
    clip: np.float32
    """bound of a normalized observation"""
    head: Head
    """actions that the outputs of the last layer stand for"""

    @property
    def activation(self) -> str:
        """Name of the activation between the layers."""

    @property
    def observation_size(self) -> int:
        """Numbers in an observation, a stacked one with a history."""

    @property
    def action_size(self) -> int:
        """Numbers in an action."""

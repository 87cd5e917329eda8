"""Activations of the hidden layers of a network, in NumPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from rsoccer.arrays import Floats

LEAK: Final = np.float32(0.01)
"""Slope of `leaky_relu` below 0, torch's default."""


def _tanh(x: Floats) -> Floats:
    result: Floats = np.tanh(x)
    return result


def _relu(x: Floats) -> Floats:
    result: Floats = np.maximum(x, np.float32(0.0))
    return result


def _leaky_relu(x: Floats) -> Floats:
    result: Floats = np.where(x > 0.0, x, LEAK * x)
    return result


def _elu(x: Floats) -> Floats:
    result: Floats = np.where(x > 0.0, x, np.expm1(np.minimum(x, np.float32(0.0))))
    return result


def _silu(x: Floats) -> Floats:
    return x * sigmoid(x)


def sigmoid(x: Floats) -> Floats:
    """Return 1 / (1 + exp(-x)) without overflow.

    Args:
        x: (...) any numbers.
    """
    half = np.float32(0.5)
    result: Floats = half + half * np.tanh(half * x)
    return result


ACTIVATIONS: Final[dict[str, Callable[[Floats], Floats]]] = {
    "tanh": _tanh,
    "relu": _relu,
    "leaky_relu": _leaky_relu,
    "elu": _elu,
    "silu": _silu,
}
"""Functions by name. `leaky_relu` has a slope of 0.01 below 0, `elu` an alpha of 1."""


def activation(name: str) -> Callable[[Floats], Floats]:
    """Return the function of a name.

    Args:
        name: a key of `ACTIVATIONS`.

    Raises:
        ValueError: an unknown name.
    """
    if name not in ACTIVATIONS:
        raise ValueError(f"activation: expected one of {tuple(ACTIVATIONS)}, got {name!r}")
    return ACTIVATIONS[name]

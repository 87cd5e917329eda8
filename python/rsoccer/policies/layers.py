"""Layers that another program has trained: weights, biases and the activation between them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from rsoccer.arrays import Array, Floats
from rsoccer.policies.activations import activation as checked_activation

if TYPE_CHECKING:
    from torch import nn

    Layers = Iterable[tuple[ArrayLike, ArrayLike] | nn.Module]

Pairs = list[tuple[Floats, Floats]]
"""Weight (out, in) and bias (out,) of each linear layer, float32."""

_MODULES: Final = {
    "Tanh": "tanh",
    "ReLU": "relu",
    "LeakyReLU": "leaky_relu",
    "ELU": "elu",
    "SiLU": "silu",
}
"""Activations by the class of torch."""
_IGNORED: Final = ("Identity", "Dropout", "Flatten")
"""Modules of torch that change nothing in play."""


def read_layers(layers: Layers, activation: str | None = None) -> tuple[Pairs, str]:
    """Return the linear layers of a network, and the activation between them.

    Args:
        layers: pairs of weight (out, in) and bias (out,); or modules of torch, `nn.Linear` and an
            activation in turn, such as an `nn.Sequential`, which may be nested.
        activation: name of the activation; None is that of the modules, or tanh without any.

    Returns:
        Pairs of float32 arrays, and the name of the activation.

    Raises:
        TypeError: something else than layers.
        ValueError: no layers, other modules, or several activations.
    """
    if not isinstance(layers, Iterable) or isinstance(layers, str | Mapping):
        raise TypeError(
            "layers: expected pairs (weight, bias), or modules of torch in turn, as in an "
            f"nn.Sequential, got {type(layers).__name__}; of a model pass the layers of its actor"
        )
    given: list[Any] = list(layers)
    if not given:
        raise ValueError("layers: expected one or more, got none")
    found = None
    if callable(given[0]):  # a module; torch is not imported for pairs of arrays
        given, found = _pairs_of_modules(given)
    if wrong := [part for part in given if not isinstance(part, tuple | list) or len(part) != 2]:
        raise TypeError(f"layers: expected pairs (weight, bias), got {type(wrong[0]).__name__}")
    if found is not None and activation not in (None, found):
        raise ValueError(
            f"activation: expected {found!r} as the modules have it, got {activation!r}"
        )
    name = activation or found or "tanh"
    checked_activation(name)
    return [(np.asarray(w, np.float32), np.asarray(b, np.float32)) for w, b in given], name


def join_outputs(*heads: tuple[ArrayLike, ArrayLike] | nn.Linear) -> tuple[Array, Array]:
    """Return one layer whose outputs are those of several layers of the same inputs, in order.

    Args:
        *heads: pairs of weight (out, in) and bias (out,), or linear modules of torch.
    """
    pairs = [read_layers([head])[0][0] for head in heads]
    weights, biases = zip(*pairs, strict=True)
    return np.concatenate(weights), np.concatenate(biases)


def _pairs_of_modules(modules: list[Any]) -> tuple[list[Any], str | None]:
    """Weight and bias of the linear ones of some modules, and the activation between them."""
    from torch import nn

    flat = [part for part in _flat(modules) if type(part).__name__ not in _IGNORED]
    linear, between = flat[::2], flat[1::2]
    found = [_name(module) for module in between]
    names = {name for name in found if name is not None}
    fits = len(linear) == len(between) + 1 and None not in found
    fits &= all(isinstance(layer, nn.Linear) and layer.bias is not None for layer in linear)
    if not fits:
        kinds = ", ".join(type(module).__name__ for module in flat)
        raise ValueError(
            "layers: expected Linear with bias and one of "
            f"{', '.join(_MODULES)} with torch's defaults in turn, got {kinds}"
        )
    if len(names) > 1:
        raise ValueError(f"layers: expected one kind of activation, got {', '.join(sorted(names))}")
    pairs = [tuple(part.detach().cpu().numpy() for part in (x.weight, x.bias)) for x in linear]
    return pairs, next(iter(names), None)


def _flat(modules: Iterable[Any]) -> Iterable[Any]:
    """Modules without the sequences that hold them."""
    from torch import nn

    for module in modules:
        if isinstance(module, nn.Sequential):
            yield from _flat(module)
        else:
            yield module


def _name(module: Any) -> str | None:  # noqa: ANN401  (modules of torch)
    """Name of an activation of torch; None for other modules, and for other parameters."""
    name = type(module).__name__
    if getattr(module, "negative_slope", 0.01) != 0.01 or getattr(module, "alpha", 1.0) != 1.0:
        return None
    return _MODULES.get(name)

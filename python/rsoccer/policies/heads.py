"""Heads: the actions that the outputs of a network's last layer stand for.

| head | outputs of the last layer | mode "mean" | mode "sample" |
| --- | --- | --- | --- |
| `gaussian` | mean (a,) | mean, clipped to [-1, 1] | mean + std N(0, 1), clipped to [-1, 1] |
| `squashed` | mean (a,) | tanh(mean) | tanh(mean + std N(0, 1)) |
| `categorical` | logits (c,) | row of the largest logit | row drawn with softmax(logits) |
| `greedy` | values (c,) of choices | row of the largest value | none |

A row is one of the `action_table` (c, a), the choices of a discrete task. The std of the first two
is the array `action_std`, or a function of a further a outputs x of the last layer, a `Deviation`.
Without either there is no mode "sample".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Self

import numpy as np

if TYPE_CHECKING:
    from rsoccer.arrays import Floats
    from rsoccer.rng import WorldRng

HEADS: Final = ("gaussian", "squashed", "categorical", "greedy")
"""Names of the heads."""
CHOOSING: Final = ("categorical", "greedy")
"""Heads that choose a row of an action table."""

_NUMBERS: Final = {"exp": 2, "tanh": 2, "softplus": 3}
"""Count of numbers of each kind of deviation."""


@dataclass(frozen=True)
class Deviation:
    """Standard deviation of actions as a function of outputs x of the network.

    | kind | numbers | standard deviation | used by |
    | --- | --- | --- | --- |
    | `exp` | low, high | exp(clip(x, low, high)) | Stable-Baselines3's SAC, RLlib |
    | `tanh` | low, high | exp(low + (high - low) (tanh(x) + 1) / 2) | CleanRL's SAC |
    | `softplus` | shift, offset, least | max(log(1 + exp(x + shift)) + offset, least) | TorchRL |

    Example:
        >>> Deviation("exp", (-20.0, 2.0)).text
        'exp -20 2'
    """

    kind: str
    """`exp`, `tanh` or `softplus`"""
    numbers: tuple[float, ...]
    """numbers of the table"""

    def __post_init__(self) -> None:
        """Check the values."""
        count = _NUMBERS.get(self.kind)
        if count is None:
            raise ValueError(f"deviation: expected one of {tuple(_NUMBERS)}, got {self.kind!r}")
        if len(self.numbers) != count or not np.isfinite(self.numbers).all():
            raise ValueError(
                f"deviation: expected {count} finite numbers after {self.kind!r}, "
                f"got {self.numbers}"
            )
        if self.kind != "softplus" and self.numbers[0] >= self.numbers[1]:
            raise ValueError(
                f"deviation: expected a low number below the high one, got {self.numbers}"
            )
        if self.kind == "softplus" and min(self.numbers[1:]) < 0.0:
            raise ValueError(
                f"deviation: expected an offset and a least of at least 0, got {self.numbers}"
            )
        # NumPy's numbers have another text.
        object.__setattr__(self, "numbers", tuple(float(number) for number in self.numbers))

    @classmethod
    def from_text(cls, text: str) -> Self:
        """Read a deviation.

        Args:
            text: kind and numbers, such as "exp -20 2".

        Returns:
            The deviation.

        Raises:
            ValueError: another text.
        """
        kind, *numbers = text.split() or [""]
        try:
            return cls(kind, tuple(float(number) for number in numbers))
        except ValueError as error:
            if str(error).startswith("deviation: "):
                raise
            raise ValueError(f"deviation: expected numbers after the kind, got {text!r}") from None

    @property
    def text(self) -> str:
        """Kind and numbers, as `from_text` reads them."""
        return " ".join([self.kind, *(f"{number!r}".removesuffix(".0") for number in self.numbers)])

    def of(self, outputs: Floats) -> Floats:
        """Return standard deviations above 0, (...).

        Args:
            outputs: (...) outputs of the network.
        """
        numbers = np.array(self.numbers, np.float32)
        if self.kind == "softplus":
            shift, offset, least = numbers
            soft: Floats = np.maximum(
                np.logaddexp(np.float32(0.0), outputs + shift) + offset, least
            )
            return soft
        low, high = numbers
        if self.kind == "exp":
            exponent = np.clip(outputs, low, high)
        else:
            exponent = low + np.float32(0.5) * (high - low) * (np.tanh(outputs) + np.float32(1.0))
        result: Floats = np.exp(exponent)
        return result


@dataclass(frozen=True)
class Head:
    """The last part of a network: from the outputs of its last layer to actions."""

    kind: str
    """one of `HEADS`"""
    outputs: int
    """numbers that the last layer gives"""
    action_std: Floats | None = None
    """(a,) standard deviation of the actions; None where the outputs give it, and without noise"""
    deviation: Deviation | None = None
    """standard deviation as a function of outputs; None for `action_std`, and without noise"""
    table: Floats | None = None
    """(c, a) rows to choose from"""

    def __post_init__(self) -> None:
        """Check that the parts belong together."""
        _check_parts(self)
        _check_outputs(self)

    @classmethod
    def read(
        cls, metadata: Mapping[str, str], outputs: int, std: Floats | None, table: Floats | None
    ) -> Self:
        """Read the head of a policy file.

        Args:
            metadata: text by key, with `head` and `deviation` or without.
            outputs: numbers that the last layer gives.
            std: (a,) array `action_std`, or None.
            table: (c, a) array `action_table`, or None.

        Returns:
            The head.

        Raises:
            ValueError: an unknown head or deviation, or parts that do not belong together.
        """
        kind = metadata.get("head", "gaussian")
        text = metadata.get("deviation")
        deviation = None if text is None else Deviation.from_text(text)
        return cls(kind, outputs, std, deviation, table)

    @property
    def action_size(self) -> int:
        """Numbers in an action."""
        if self.table is not None:
            return int(self.table.shape[1])
        return self.outputs if self.deviation is None else self.outputs // 2

    @property
    def can_sample(self) -> bool:
        """True if there is a distribution to draw actions from."""
        if self.kind in CHOOSING:
            return self.kind == "categorical"
        return self.action_std is not None or self.deviation is not None

    def mean_actions(self, outputs: Floats) -> Floats:
        """Return the actions of mode "mean", (..., action) in [-1, 1].

        Args:
            outputs: (..., outputs) of the last layer, which may be overwritten.
        """
        if self.table is not None:
            chosen: Floats = self.table[outputs.argmax(axis=-1)]
            return chosen
        return self._bounded(outputs[..., : self.action_size])

    def drawn_actions(self, outputs: Floats, rng: WorldRng) -> Floats:
        """Return the actions of mode "sample", (n, robots, action) in [-1, 1].

        Args:
            outputs: (n, robots, outputs) of the last layer, which may be overwritten.
            rng: (n,) random streams.

        Raises:
            ValueError: the head has no distribution.
        """
        if not self.can_sample:
            raise ValueError("the head has no distribution to draw actions from")
        if self.table is not None:
            drawn: Floats = self.table[_drawn(outputs, rng.uniform(0.0, 1.0, outputs.shape[1:-1]))]
            return drawn
        size = self.action_size
        actions = outputs[..., :size]
        std = self.action_std
        if self.deviation is not None:
            std = self.deviation.of(outputs[..., size:])
        assert std is not None, "checked above"
        actions += std * rng.normal(actions.shape[1:])
        return self._bounded(actions)

    def _bounded(self, actions: Floats) -> Floats:
        """Actions within [-1, 1], computed in place."""
        if self.kind == "squashed":
            return np.tanh(actions, out=actions)
        return np.clip(actions, -1.0, 1.0, out=actions)


def _drawn(logits: Floats, uniform: Floats) -> Floats:
    """Indices (...) drawn with the softmax of logits (..., c), from numbers (...) in [0, 1)."""
    weights = np.exp(logits - logits.max(axis=-1, keepdims=True))
    sums = np.cumsum(weights, axis=-1, dtype=np.float64)
    indices = (sums <= uniform[..., None] * sums[..., -1:]).sum(axis=-1)
    result: Floats = np.minimum(indices, logits.shape[-1] - 1)  # `uniform` may be rounded to 1
    return result


def _check_parts(head: Head) -> None:
    """Refuse parts that the kind of head does not have."""
    if head.kind not in HEADS:
        raise ValueError(f"head: expected one of {HEADS}, got {head.kind!r}")
    chooses = head.kind in CHOOSING
    if chooses is (head.table is None):
        some = "an" if chooses else "no"
        raise ValueError(
            f"action_table: expected {some} array (choices, action) for the head {head.kind!r}, "
            f"got {'none' if head.table is None else head.table.shape}"
        )
    noise = {"action_std": head.action_std, "deviation": head.deviation}
    given = [name for name, value in noise.items() if value is not None]
    if len(given) > (0 if chooses else 1):
        allowed = "none" if chooses else "one of them"
        raise ValueError(
            f"action_std, deviation: expected {allowed} for the head {head.kind!r}, "
            f"got {' and '.join(given)}"
        )


def _check_outputs(head: Head) -> None:
    """Refuse a last layer of another size."""
    if head.table is not None and head.outputs != len(head.table):
        raise ValueError(
            f"layers: expected a last layer of {len(head.table)} outputs, one for each row of the "
            f"action table, got {head.outputs}"
        )
    if head.deviation is not None and head.outputs % 2:
        raise ValueError(
            "layers: expected a last layer of as many outputs for means as for deviations, "
            f"got {head.outputs}"
        )

"""Reflection of observations, actions and states about the x axis, which swaps left and right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats


class Reflection(NamedTuple):
    """Reflected vectors: each number is one of the original ones, with or without a new sign.

    Example:
        >>> wheels = Reflection.of([1, 1], order=[1, 0])
        >>> wheels.apply(np.array([0.25, 1.0], np.float32)).tolist()
        [1.0, 0.25]
    """

    order: NDArray[np.intp]
    """(k,) index of the original number at each place."""
    signs: Floats
    """(k,) 1 or -1, the factor at each place."""

    @classmethod
    def of(cls, signs: Sequence[int], order: Sequence[int] | None = None) -> Self:
        """Return a reflection.

        Args:
            signs: (k,) 1 or -1, the factor at each place.
            order: (k,) index of the original number at each place; None for the same order.
        """
        indices = range(len(signs)) if order is None else order
        return cls(np.array(indices, np.intp), np.array(signs, np.float32))

    @classmethod
    def join(cls, parts: Iterable[Reflection]) -> Self:
        """Return the reflection of vectors that consist of parts, one after the other.

        Args:
            parts: reflection of each part.
        """
        orders, signs, size = [], [], 0
        for part in parts:
            orders.append(part.order + size)
            signs.append(part.signs)
            size += len(part.order)
        return cls(np.concatenate(orders), np.concatenate(signs))

    def apply(self, vectors: Floats) -> Floats:
        """Return reflected vectors (..., k), a new array.

        Args:
            vectors: (..., k) vectors.
        """
        reflected: Floats = vectors[..., self.order] * self.signs
        return reflected


class Symmetry(NamedTuple):
    """Reflections of a task that is the same with left and right swapped."""

    action: Reflection
    """(action_size,) reflection of an action."""
    blocks: Mapping[str, Reflection]
    """Reflection of the last axis of each observation block, by name."""


def add_blocks(symmetry: Symmetry | None, **blocks: Reflection) -> Symmetry | None:
    """Return a symmetry with the reflections of more observation blocks.

    Args:
        symmetry: the symmetry; None remains None.
        **blocks: reflection of the last axis of each block, by name.
    """
    return None if symmetry is None else Symmetry(symmetry.action, {**symmetry.blocks, **blocks})

"""Observation blocks that the core computes at once, when they are needed."""

from collections import UserDict
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.play import Play

Encode = Callable[[Play, Floats, Floats | None], None]
"""Writes the flat blocks of a state (n, observers, columns) into an array, clipped to bounds
(columns,), or not clipped for None."""


class EncodedBlocks(UserDict[str, Floats]):
    """Blocks by name, computed when one of them is first read.

    As long as none has been read or replaced, all of them can be written at once to the place where
    the flat observation is wanted, which saves a copy.
    """

    def __init__(
        self,
        encode: Encode,
        play: Play,
        layout: tuple[tuple[str, slice, tuple[int, ...]], ...],
    ) -> None:
        """Prepare blocks.

        Args:
            encode: computes all blocks.
            play: state of n worlds.
            layout: name, columns and shape of each block.
        """
        # UserDict's constructor would set `data`.
        self._encode, self._play, self._layout = encode, play, layout

    @cached_property
    def data(self) -> dict[str, Floats]:  # type: ignore[override]  # an attribute of UserDict
        """Blocks (n, observers, ...) by name, views of one array."""
        rows = len(self._play.frame), len(self._play.observers)
        flat = np.empty((*rows, self._layout[-1][1].stop), np.float32)
        self._encode(self._play, flat, None)
        return {
            name: flat[:, :, columns].reshape(*rows, *shape)
            for name, columns, shape in self._layout
        }

    def __or__(self, other: Any) -> Any:  # noqa: ANN401  (overloaded in UserDict)
        """Return a dict of these blocks and others."""
        return {**self.data, **other}

    def __ror__(self, other: Any) -> Any:  # noqa: ANN401  (overloaded in UserDict)
        """Return a dict of other blocks and these."""
        return {**other, **self.data}

    def copy(self) -> Any:  # noqa: ANN401  (UserDict's own type)
        """Return a dict of the same blocks."""
        return dict(self.data)

    def write(self, out: Floats, bounds: Floats) -> bool:
        """Write all blocks in their order, unless one of them has been read.

        Args:
            out: (n, observers, columns) output.
            bounds: (columns,) bounds to which the numbers are clipped.

        Returns:
            Whether they were written.
        """
        if "data" in self.__dict__ or out.shape[-1] != self._layout[-1][1].stop:
            return False
        self._encode(self._play, out, bounds)
        return True

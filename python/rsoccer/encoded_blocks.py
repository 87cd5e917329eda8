"""Observation blocks that the core computes at once, when they are needed."""

import copy
from collections import UserDict
from collections.abc import Callable, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from rsoccer._core import write_clipped
from rsoccer.arrays import Floats
from rsoccer.play import Play

Encode = Callable[[Play, Floats, Floats | None], None]
"""Writes the flat blocks of a state (n, observers, columns) into an array, clipped to bounds
(columns,), or not clipped for None. More columns of the array stay as they are."""


_NONE: Final[Mapping[str, Floats]] = MappingProxyType({})


class EncodedBlocks(UserDict[str, Floats]):
    """Blocks by name, computed when one of them is first read.

    As long as none has been read or replaced, all of them can be written at once to the place where
    the flat observation is wanted, which saves a copy. `|` adds blocks of other names without
    reading these.
    """

    def __init__(
        self,
        encode: Encode,
        play: Play,
        layout: tuple[tuple[str, slice, tuple[int, ...]], ...],
        added: Mapping[str, Floats] = _NONE,
    ) -> None:
        """Prepare blocks.

        Args:
            encode: computes all blocks of the layout.
            play: state of n worlds.
            layout: name, columns and shape of each block.
            added: further blocks (n, observers, ...), of other names.
        """
        # UserDict's constructor would set `data`.
        self._encode, self._play, self._layout, self._added = encode, play, layout, added

    @cached_property
    def data(self) -> dict[str, Floats]:  # type: ignore[override]  # an attribute of UserDict
        """Blocks (n, observers, ...) by name; those of the layout are views of one array."""
        flat = self._flat()
        rows = flat.shape[:2]
        blocks = {
            name: flat[:, :, columns].reshape(*rows, *shape)
            for name, columns, shape in self._layout
        }
        return {**blocks, **self._added}

    def __or__(self, other: Any) -> Any:  # noqa: ANN401  (overloaded in UserDict)
        """Return these blocks and others: not yet computed, or a dict where one is replaced."""
        names = [name for name, _, _ in self._layout]
        if "data" in self.__dict__ or not other.keys().isdisjoint(names):
            return {**self.data, **other}
        added = {**self._added, **other}
        return EncodedBlocks(self._encode, self._play, self._layout, added)

    def __ror__(self, other: Any) -> Any:  # noqa: ANN401  (overloaded in UserDict)
        """Return a dict of other blocks and these."""
        return {**other, **self.data}

    def copy(self) -> Any:  # noqa: ANN401  (UserDict's own type)
        """Return a dict of the same blocks."""
        return dict(self.data)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> dict[str, Floats]:
        """Return a dict of copies of the blocks."""
        return copy.deepcopy(self.data, memo)

    def write(self, out: Floats, bounds: Floats) -> bool:
        """Write all blocks in their order, unless one of them has been read.

        Args:
            out: (n, observers, columns) output.
            bounds: (columns,) bounds to which the numbers are clipped.

        Returns:
            Whether they were written.
        """
        if "data" in self.__dict__:
            return False
        if self._added:
            return self._write_with_added(out, bounds)
        if out.shape[-1] != self._size:
            return False
        self._encode(self._play, out, bounds)
        return True

    def _write_with_added(self, out: Floats, bounds: Floats) -> bool:
        """Write the blocks of the layout and the added ones, if their sizes are those of `out`."""
        rows = out.shape[:2]
        for block in self._added.values():
            if not isinstance(block, np.ndarray) or block.shape[:2] != rows:
                return False
        added = [block.reshape(*rows, -1) for block in self._added.values()]
        if out.shape[-1] != self._size + sum(block.shape[-1] for block in added):
            return False
        first = self._size
        self._encode(self._play, out, bounds[:first])
        for block in added:
            last = first + block.shape[-1]
            # Task authors' blocks may have other types.
            values = np.asarray(block, np.float32)
            write_clipped(values, bounds[first:last], out, first)
            first = last
        return True

    @property
    def _size(self) -> int:
        """Numbers in the blocks of the layout."""
        last: int = self._layout[-1][1].stop
        return last

    def _flat(self) -> Floats:
        """The blocks of the layout as (n, observers, columns), a new array."""
        flat = np.empty((len(self._play.frame), len(self._play.observers), self._size), np.float32)
        self._encode(self._play, flat, None)
        return flat

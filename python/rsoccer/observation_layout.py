"""Layout of the flat observation: its blocks, their bounds and their reflection."""

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from rsoccer import task_checks
from rsoccer._core import clip_in_place
from rsoccer.arrays import Floats
from rsoccer.encoded_blocks import EncodedBlocks
from rsoccer.new_play import sample_play
from rsoccer.play import Play
from rsoccer.reflection import Reflection
from rsoccer.task_definition import TaskDefinition

DEFAULT_LIMIT: Final = 10.0
"""Bound of observation blocks without a bound of their own."""


class Block(NamedTuple):
    """Shape and position of one named block of the observation."""

    shape: tuple[int, ...]
    """Shape of the block of one observer."""
    columns: slice
    """Columns of the flat observation that hold the block."""

    @property
    def size(self) -> int:
        """Number of columns."""
        return math.prod(self.shape)


class ObservationLayout:
    """Layout of the flat observation of one robot, and its computation.

    Attributes:
        blocks: blocks by name, in the order of their columns.
        size: numbers in the observation, o.
        high: (o,) upper bounds.
        low: (o,) lower bounds, the negative upper bounds.
        text: blocks, their shapes, and `action_meaning` as text. Networks save it, and fit only
            tasks with the same.
    """

    def __init__(self, task: TaskDefinition) -> None:
        """Find the blocks by computing one observation.

        Args:
            task: the task.

        Raises:
            TypeError: the task defines something of another type, see `rsoccer.task_checks`.
            ValueError: numbers out of range, or results of other sizes.
        """
        task_checks.definition(task)
        self._task = task
        arrays = task.frame_to_observations(sample_play(task))
        self.blocks = _blocks(task_checks.blocks(task, arrays, (1, 1)))
        self._shapes = {name: block.shape for name, block in self.blocks.items()}
        self.size = sum(block.size for block in self.blocks.values())
        self.high = np.empty(self.size, np.float32)
        limits = task_checks.limits(task, self.blocks)
        for name, block in self.blocks.items():
            self.high[block.columns] = limits.get(name, DEFAULT_LIMIT)
        self.low: Floats = -self.high
        sizes = {name: "x".join(map(str, block.shape)) for name, block in self.blocks.items()}
        blocks, meaning = ", ".join(f"{n} {size}" for n, size in sizes.items()), task.action_meaning
        self.text = f"{blocks}; {meaning}" if meaning else blocks

    def observe(self, play: Play, out: Floats | None = None) -> Floats:
        """Compute the flat observation of each observer, clipped to the bounds.

        Args:
            play: state of n worlds.
            out: (n, observers, o) float32 output; None for a new array.

        Returns:
            The output (n, observers, o).

        Raises:
            TypeError: the task returned no arrays by name.
            ValueError: other blocks than at first, or blocks of other shapes.
        """
        if out is None:
            out = np.empty((len(play.frame), len(play.observers), self.size), np.float32)
        if not out.shape[1]:
            return out
        blocks = self._task.frame_to_observations(play)
        if isinstance(blocks, EncodedBlocks) and blocks.write(out, self.high):
            return out
        rows = out.shape[:2]
        checked = task_checks.blocks(self._task, blocks, rows, self._shapes)
        parts = [b if b.ndim == 3 else b.reshape(*rows, -1) for b in checked.values()]
        np.concatenate(parts, axis=-1, out=out, casting="same_kind")
        clip_in_place(out, self.high)
        return out

    @cached_property
    def reflection(self) -> Reflection | None:
        """Reflection of the flat observation, (o,); None if a block's is not known."""
        symmetry = self._task.symmetry
        if symmetry is None or not set(self.blocks) <= set(symmetry.blocks):
            return None
        return Reflection.join(
            symmetry.blocks[name]
            for name, block in self.blocks.items()
            for _ in range(math.prod(block.shape[:-1]))
        )


def _blocks(arrays: Mapping[str, Floats]) -> dict[str, Block]:
    """Blocks by name, of arrays (n, observers, ...)."""
    blocks, first = {}, 0
    for name, array in arrays.items():
        shape = array.shape[2:]
        blocks[name] = Block(shape, slice(first, first + math.prod(shape)))
        first += math.prod(shape)
    return blocks

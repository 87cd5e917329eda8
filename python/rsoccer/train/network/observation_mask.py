"""Masks of observations: parts that the networks of an ablation do not read."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.task import Task


def observation_mask(task: Task, parts: Iterable[str]) -> Floats:
    """Return a mask of the flat observation, (o,): 0 for the numbers in `parts`, 1 for others.

    Args:
        task: the task, which defines the blocks.
        parts: names of blocks, such as "shot", or of numbers of a block by their indices along its
            last axis, such as "opponents:2,3".

    Raises:
        ValueError: a block or an index that the task's observation does not have.

    Example:
        >>> from rsoccer import make_task
        >>> mask = observation_mask(make_task("VSS-v0"), ["opponents:2,3", "shot"])
        >>> int((mask == 0).sum())
        10
    """
    mask = np.ones(task.layout.size, np.float32)
    for part in parts:
        name, _, indices = part.partition(":")
        if name not in task.layout.blocks:
            raise ValueError(
                f"network.masked_observations: expected blocks of {list(task.layout.blocks)}, "
                f"got {name!r}"
            )
        block = task.layout.blocks[name]
        columns = mask[block.columns].reshape(block.shape)  # a view
        columns[..., _indices(part, indices, block.shape[-1])] = 0.0
    return mask


def _indices(part: str, text: str, size: int) -> list[int]:
    """Indices along an axis of a size; all of them for an empty text."""
    names = [str(index) for index in range(size)]
    chosen = text.split(",") if text else names
    if not set(chosen) <= set(names):
        raise ValueError(
            f"network.masked_observations: expected indices from 0 to {size - 1} in {part!r}"
        )
    return [int(index) for index in chosen]

"""Tactics: the numbers by which a script plays, and which `rsoccer evolve` changes."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rsoccer.arrays import Floats
from rsoccer.policies.base import Policy
from rsoccer.task import Task


class Tactic(NamedTuple):
    """A number of a script."""

    name: str
    """name of the number"""
    default: float
    """value that was set by hand"""
    least: float
    """least value"""
    most: float
    """greatest value"""


class TacticalPolicy(Policy):
    """A script whose numbers can be other ones than those that were set by hand."""

    TACTICS: ClassVar[Sequence[Tactic]]
    """The numbers, in the order of an array of tactics."""

    @classmethod
    @abstractmethod
    def with_tactics(cls, task: Task, tactics: Floats) -> TacticalPolicy:
        """Return the script with other numbers.

        Args:
            task: the task that is played.
            tactics: (tactics,) numbers in their ranges, or (n, tactics), one row for each of the n
                matches that are played at once.

        Raises:
            ValueError: a task that the script cannot play.
        """


def rows_of(tactics: Floats, matches: int) -> Floats:
    """Return the tactics of each match, (matches, tactics).

    Args:
        tactics: (tactics,) or (n, tactics) numbers.
        matches: number of matches: n, or 1 for a match that stands for all, which has the first
            row.

    Raises:
        ValueError: another number of matches.
    """
    if tactics.ndim == 1:
        return np.repeat(tactics[None], matches, axis=0)
    if matches not in (1, len(tactics)):
        raise ValueError(
            f"tactics: expected a row for each of {matches} matches, got {len(tactics)}"
        )
    return tactics[:matches]


def checked(tactics: ArrayLike, known: Sequence[Tactic]) -> Floats:
    """Return tactics as an array, each number in its range.

    Args:
        tactics: (tactics,) or (n, tactics) numbers.
        known: what the script has.

    Raises:
        ValueError: another shape, or a number out of its range.
    """
    array = np.array(tactics, np.float32)
    if array.ndim not in (1, 2) or array.shape[-1] != len(known):
        raise ValueError(f"tactics: expected {len(known)} numbers, got shape {array.shape}")
    for index, (name, _, least, most) in enumerate(known):
        values = array[..., index]
        # Bounds are rounded as the numbers are.
        outside = ~((values >= np.float32(least)) & (values <= np.float32(most)))
        if outside.any():
            got = float(values[outside].flat[0])
            raise ValueError(f"tactics: expected {name} from {least:g} to {most:g}, got {got:g}")
    return array

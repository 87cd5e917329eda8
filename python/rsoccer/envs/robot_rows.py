"""Rows of robots: the form in which libraries of arrays see the robots that learn in many matches.

With k robots that learn in a match, row `i * k + j` is robot j of match i. All robots of a match
begin and end together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats
from rsoccer.envs.env_matches import EnvMatches, PublicMatches
from rsoccer.envs.viewer import Image, Viewer
from rsoccer.matches import Matches
from rsoccer.task import Task

A = TypeVar("A", bound=Array)


@dataclass(frozen=True)
class RobotRows:
    """Conversion between arrays by match and robot, and arrays of rows."""

    worlds: int
    """Number of matches, n."""
    robots: tuple[str, ...]
    """Names of the k robots that learn in a match, in the order of their rows."""

    @classmethod
    def of(cls, matches: Matches) -> RobotRows:
        """Return the rows of some matches.

        Args:
            matches: the matches.
        """
        return cls(matches.worlds, matches.agents)

    def __len__(self) -> int:
        """Return the number of rows, n * k."""
        return self.worlds * len(self.robots)

    def world(self, row: int) -> int:
        """Return the index of a row's match.

        Args:
            row: index of the row.
        """
        return row // len(self.robots)

    def flat(self, values: Array) -> Array:
        """Return values by row.

        Args:
            values: (n, k, ...) values by match and robot.

        Returns:
            (rows, ...) the same memory, where it is contiguous.
        """
        return values.reshape(len(self), *values.shape[2:])

    def by_match(self, values: Array) -> Array:
        """Return values by match and robot.

        Args:
            values: (rows, ...) values by row.

        Returns:
            (n, k, ...) the same memory, where it is contiguous.
        """
        return values.reshape(self.worlds, len(self.robots), *values.shape[1:])

    def repeated(self, values: A) -> A:
        """Return values of matches for each of their robots.

        Args:
            values: (n, ...) values by match.

        Returns:
            (rows, ...); the argument itself where one robot learns.
        """
        k = len(self.robots)
        return values if k == 1 else values.repeat(k, axis=0)  # type: ignore[return-value]

    def scattered(self, worlds: NDArray[np.intp], values: Array) -> Array:
        """Return values of some matches by row, with zeros in the others.

        Args:
            worlds: (m,) indices of the matches.
            values: (m, k) values, or (m, 1) that the robots of a match share.

        Returns:
            (rows,) of the type of the values.
        """
        every = np.zeros((self.worlds, len(self.robots)), values.dtype)
        every[worlds] = values
        return every.reshape(-1)


class RobotRowsEnv(PublicMatches):
    """Properties, states and images of environments with a row for each robot.

    Attributes:
        render_mode: "rgb_array" or None.
    """

    _matches: EnvMatches
    _rows: RobotRows
    _viewer: Viewer
    render_mode: str | None

    @property
    def task(self) -> Task:
        """Task that is played."""
        return self._matches.task

    @property
    def worlds(self) -> int:
        """Number of matches, n."""
        return self._matches.worlds

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of the robots that learn in a match, in the order of their rows."""
        return self._matches.agents

    def states(self) -> Floats:
        """Return the global state of each row's match, for centralized critics.

        Returns:
            (rows, state) float32, as `Matches.states` returns it, repeated for the robots of a
            match.
        """
        return self._rows.repeated(self._matches.states())

    def final_states(self) -> Floats:
        """Return the global states that belong to the last observations of episodes that ended.

        Returns:
            (rows, state) float32, as `Matches.final_states` returns it, repeated for the robots of
            a match; equal to `states` elsewhere.
        """
        return self._rows.repeated(self._matches.final_states())

    def _images(self) -> list[Image]:
        """An image of each match."""
        return [self._viewer.image(self._matches, world) for world in range(self.worlds)]

    def _repr_png_(self) -> bytes | None:
        """An image of the first match, for notebooks."""
        return self._viewer.png(self._matches)

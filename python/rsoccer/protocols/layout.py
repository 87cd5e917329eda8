"""Sides, numbers of robots and units: the boundary between the wire and the package.

In the package blue attacks +x, teams are indices, and robots are slots of a state row in SI units.
On the wire blue's goal may be at either end, and robots have uniform numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np

from rsoccer import checks
from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Doubles
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, MessageError

MILLIMETERS: Final = 1000.0
"""Millimeters in a meter."""
MICROSECONDS: Final = 1_000_000
"""Microseconds in a second."""
TEAMS: Final = (BLUE, YELLOW)
"""Indices of the teams, in the order of a state row."""
TEAM_NAMES: Final = ("blue", "yellow")
"""Names of the teams by index."""
MAX_ROBOT_ID: Final = 2**32 - 1
"""Greatest uniform number that the wire can carry."""


@dataclass(frozen=True)
class WireLayout:
    """Knowledge of a match that messages need besides its state.

    Attributes:
        config: configuration of the simulator: field, ball, robots.
        blue_ids: uniform numbers of the blue robots by slot; None for 0, 1, ...
        yellow_ids: uniform numbers of the yellow robots by slot; None for 0, 1, ...
        blue_on_positive_half: whether blue's goal is at +x on the wire. In the package it is at -x,
            so then positions and directions are rotated by 180 degrees.
        colors_exchanged: whether the robots that are blue in the package are yellow on the wire, so
            that a policy of blue drives a yellow team. The attributes of teams are those of the
            package, and `blue_on_positive_half` is about blue on the wire.

    Example:
        >>> from rsoccer import SimConfig
        >>> from rsoccer.protocols.layout import WireLayout
        >>> layout = WireLayout(SimConfig("ssl_b", 6, 6), yellow_ids=(1, 3, 5, 7, 9, 11))
        >>> layout.slot(1, 3), layout.identity(7)
        (7, (1, 3))
    """

    config: SimConfig
    blue_ids: tuple[int, ...] | None = None
    yellow_ids: tuple[int, ...] | None = None
    blue_on_positive_half: bool = False
    colors_exchanged: bool = False
    ids: tuple[tuple[int, ...], tuple[int, ...]] = field(init=False, repr=False)
    """Uniform numbers of blue and of yellow, by slot within the team."""

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            TypeError: numbers that are not integers, or a side that is no bool.
            ValueError: another count than that of the robots, a repeated number, or one that is
                negative or too large.
        """
        checks.boolean("blue_on_positive_half", self.blue_on_positive_half)
        checks.boolean("colors_exchanged", self.colors_exchanged)
        given = (self.blue_ids, self.yellow_ids)
        counts = (self.config.n_blue, self.config.n_yellow)
        ids = tuple(
            _checked_ids(f"{team}_ids", numbers, count)
            for team, numbers, count in zip(TEAM_NAMES, given, counts, strict=True)
        )
        object.__setattr__(self, "ids", ids)

    @property
    def sign(self) -> float:
        """Factor of x and y between the wire and the package: -1 if they are rotated, else 1."""
        return -1.0 if self.blue_on_positive_half != self.colors_exchanged else 1.0

    @cached_property
    def _slots(self) -> dict[tuple[int, int], int]:
        return {self.identity(slot): slot for slot in range(self.config.n_robots)}

    def identity(self, slot: int) -> tuple[int, int]:
        """Return team on the wire and uniform number of a robot.

        Args:
            slot: index of the robot in a state row.
        """
        n_blue = self.config.n_blue
        team = BLUE if slot < n_blue else YELLOW
        return self.exchanged(team), self.ids[team][slot - n_blue * team]

    def exchanged(self, team: int) -> int:
        """Return a team of the package on the wire, or the reverse.

        Args:
            team: `BLUE` or `YELLOW`.
        """
        return TEAMS[1 - team] if self.colors_exchanged else team

    def slot(self, team: int, robot_id: int) -> int:
        """Return the index of a robot in a state row.

        Args:
            team: `BLUE` or `YELLOW`, on the wire.
            robot_id: uniform number.

        Raises:
            MessageError: the team has no robot of this number.
        """
        slot = self._slots.get((team, robot_id))
        if slot is None:
            ids = self.ids[self.exchanged(team)]
            numbers = f"{list(ids)} for {TEAM_NAMES[team]}"
            raise MessageError(Code.UNKNOWN_ROBOT, f"id: expected one of {numbers}, got {robot_id}")
        return slot

    def slots(self, team: int) -> range:
        """Return the indices of a team's robots in a state row.

        Args:
            team: `BLUE` or `YELLOW`, on the wire.
        """
        n_blue = self.config.n_blue
        is_blue = self.exchanged(team) == BLUE
        return range(n_blue) if is_blue else range(n_blue, self.config.n_robots)

    def rotated(self, vectors: Array) -> Doubles:
        """Convert vectors x, y from the package to the wire or back.

        Args:
            vectors: (..., 2) positions or velocities.

        Returns:
            (..., 2), in the same unit.
        """
        turned: Doubles = np.asarray(vectors, np.float64) * self.sign
        return turned

    def angle_to_wire(self, headings: Array) -> Doubles:
        """Convert headings to angles on the wire.

        Args:
            headings: (..., 2) cosine and sine, in the package.

        Returns:
            (...) angles in rad, from -pi to pi.
        """
        headings = np.asarray(headings, np.float64) * self.sign
        angles: Doubles = np.arctan2(headings[..., 1], headings[..., 0])
        return angles

    def heading_from_wire(self, angles: Array | float) -> Doubles:
        """Convert angles on the wire to headings.

        Args:
            angles: (...) angles in rad.

        Returns:
            (..., 2) cosine and sine, in the package.
        """
        angles = np.asarray(angles, np.float64)
        headings: Doubles = np.stack([np.cos(angles), np.sin(angles)], axis=-1) * self.sign
        return headings

    def check_frame(self, frame: Frame, world: int) -> None:
        """Refuse a frame of other teams, or a world that it does not have.

        Args:
            frame: the frame.
            world: index of the world.

        Raises:
            ValueError: other numbers of robots, or no such world.
        """
        expected, got = (self.config.n_blue, self.config.n_yellow), (frame.n_blue, frame.n_yellow)
        if got != expected:
            raise ValueError(f"frame: expected {expected} blue and yellow robots, got {got}")
        checks.integer_in_range("world", world, 0, len(frame) - 1)


def _checked_ids(name: str, ids: tuple[int, ...] | None, count: int) -> tuple[int, ...]:
    """Uniform numbers of a team."""
    if ids is None:
        return tuple(range(count))
    numbers = tuple(checks.integer_in_range(name, number, 0, MAX_ROBOT_ID) for number in ids)
    if len(numbers) != count or len(set(numbers)) != count:
        raise ValueError(f"{name}: expected {count} different numbers, got {list(numbers)}")
    return numbers

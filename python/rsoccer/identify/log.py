"""Logs of commands and poses: CSV files that a team writes in ten lines, and their content.

A row says what was sent to a robot, or where a body was seen, or both; empty cells say nothing.

| column | meaning | unit |
| --- | --- | --- |
| `time` | when the command was sent, or the pose arrived; one clock for all rows | s |
| `robot` | name of the robot, such as `blue_0`; `ball` for the ball | |
| `x`, `y` | position | m |
| `theta` | heading, counterclockwise from +x; empty for the ball | rad |
| `captured` | when the camera saw the pose, by the same clock; may be left out | s |
| `v_x`, `v_y`, `v_theta` | velocity forward and to the left, angular velocity | m/s, rad/s |
| `kick_v_x` | speed of a kick; may be left out | m/s |
| `left`, `right` | wheel speeds of robots with two wheels, in place of velocities | rad/s |

A command holds until the next one of its robot. Files need no order of robots, but the times of a
robot's commands, and those of a body's poses, increase.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Mask

BALL: Final = "ball"
"""Name of the ball in the column `robot`."""
POSE: Final = ("x", "y", "theta")
"""Columns of a pose."""
DRIVES: Final = {"omni": ("v_x", "v_y", "v_theta"), "differential": ("left", "right")}
"""Columns of a command for the wheels, by kind of drive."""
KICK: Final = "kick_v_x"
"""Column of a commanded kick."""
KEYS: Final = ("time", "robot")
"""Columns of every row."""
NUMBERS: Final = (*POSE, "captured", *(name for names in DRIVES.values() for name in names), KICK)
"""Columns of which a row has some."""
_REST: Final = 4.0  # frames without a change after which a body is at rest
_NEXT: Final = 0.9  # frames from one pose of a body at rest to the next


@dataclass(frozen=True)
class Commands:
    """Commands of one robot, in the order of their times."""

    times: Doubles
    """(n,) when they were sent, s."""
    wheels: Doubles
    """(n, columns) columns of `DRIVES`."""
    kicks: Doubles
    """(n,) commanded speeds of kicks, m/s; 0 for none."""


@dataclass(frozen=True)
class Track:
    """Poses of one body, in the order of their times."""

    times: Doubles
    """(n,) when they arrived, s."""
    positions: Doubles
    """(n, 2) m."""
    headings: Doubles
    """(n,) rad, as logged; zeros for the ball."""
    captured: Doubles
    """(n,) when the camera saw them, s; NaN where the log does not say so."""

    def __len__(self) -> int:
        """Return the number of poses."""
        return len(self.times)


@dataclass(frozen=True)
class Log:
    """Commands and poses of robots, and positions of the ball."""

    drive: str | None
    """Kind of the commands, a key of `DRIVES`; None without commands."""
    commands: Mapping[str, Commands]
    """Commands by the name of their robot."""
    poses: Mapping[str, Track]
    """Poses by the name of their robot."""
    ball: Track
    """Positions of the ball."""

    @classmethod
    def of_rows(cls, rows: Iterable[Mapping[str, object]]) -> Log:
        """Return the log of some rows.

        Args:
            rows: rows with the columns above, numbers or text; empty text, None and missing columns
                say nothing.

        Raises:
            ValueError: a row without time or robot, or with half a pose or command; a cell that is
                no finite number; times that do not increase; commands of two kinds of drive; no
                poses.
        """
        return Reader().read([("row", number, row) for number, row in enumerate(rows, 1)])


class Reader:
    """Sorts rows into commands and poses."""

    def __init__(self) -> None:
        """Begin without any rows."""
        self.commands: dict[str, list[list[float]]] = {}
        self.poses: dict[str, list[list[float]]] = {}
        self.drive: str | None = None

    def read(self, rows: Sequence[tuple[str, int, Mapping[str, object]]]) -> Log:
        """Return the log of rows.

        Args:
            rows: words and number that name the place of each row, and the row.

        Raises:
            ValueError: see `Log.of_rows`.
        """
        for words, number, row in rows:
            self._add(f"{words} {number}", row)
        if not self.poses:
            raise ValueError("log: no poses; expected rows with x, y and theta")
        poses = {name: _track(name, found) for name, found in self.poses.items()}
        ball = poses.pop(BALL, _track(BALL, []))
        commands = {name: _commands(name, found) for name, found in self.commands.items()}
        return Log(self.drive, commands, poses, ball)

    def _add(self, place: str, row: Mapping[str, object]) -> None:
        """Take in a row."""
        numbers = {name: _number(place, name, row.get(name)) for name in ("time", *NUMBERS)}
        time, robot = numbers["time"], str(row.get("robot") or "").strip()
        if time is None or not robot:
            raise ValueError(f"{place}: expected a time and the name of a robot or 'ball'")
        pose = ("x", "y") if robot == BALL else POSE
        seen = _all_or_none(place, f"a pose of {robot}", pose, numbers)
        if seen is not None:
            captured = numbers["captured"]
            values = [time, *seen, *([0.0] if robot == BALL else [])]
            values.append(math.nan if captured is None else captured)
            self.poses.setdefault(robot, []).append(values)
        for drive, names in DRIVES.items():
            sent = _all_or_none(place, f"a command of {robot}", names, numbers)
            if sent is None:
                continue
            if robot == BALL or self.drive not in (None, drive):
                wrong = "the ball" if robot == BALL else f"both {self.drive} and {drive}"
                raise ValueError(f"{place}: a command for {wrong}")
            self.drive = drive
            self.commands.setdefault(robot, []).append([time, *sent, numbers[KICK] or 0.0])


def _number(place: str, name: str, cell: object) -> float | None:
    """A cell as a number; None if it is empty."""
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return None
    try:
        number = float(cell)  # type: ignore[arg-type]  # refused if it is none
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{place}: {name}: expected a finite number, got {cell!r}")
    return number


def _all_or_none(
    place: str, what: str, names: Sequence[str], numbers: Mapping[str, float | None]
) -> list[float] | None:
    """Numbers of some columns; None if all of them are empty."""
    found = [numbers[name] for name in names]
    present = [number for number in found if number is not None]
    if present and len(present) < len(found):
        empty = [name for name in names if numbers[name] is None]
        raise ValueError(f"{place}: {what} needs {', '.join(names)}; no {', '.join(empty)}")
    return present or None


def _in_order(what: str, rows: Sequence[Sequence[float]], columns: int) -> Doubles:
    """Rows as an array, after a check of their times."""
    table = np.array(rows, np.float64).reshape(len(rows), columns)
    backward = np.flatnonzero(np.diff(table[:, 0]) < 0)
    if len(backward):
        before, after = table[backward[0] : backward[0] + 2, 0]
        raise ValueError(f"time: {what} go back from {before:.6f} to {after:.6f} s; sort the rows")
    return table


def _commands(robot: str, rows: Sequence[Sequence[float]]) -> Commands:
    table = _in_order(f"the commands of {robot}", rows, len(rows[0]))
    return Commands(table[:, 0], table[:, 1:-1], table[:, -1])


def _track(name: str, rows: Sequence[Sequence[float]]) -> Track:
    """Poses without those that only repeat the last: a loop that is faster than its camera."""
    table = _in_order(f"the poses of {name}", rows, 5)
    table = table[_is_new(table[:, 0], table[:, 1:4])]
    return Track(table[:, 0], table[:, 1:3], table[:, 3], table[:, 4])


def _is_new(times: Doubles, poses: Doubles) -> Mask:
    """Mask (n,) of poses that a camera saw anew.

    They differ from the last one, or a body rests: then one a frame is new.
    """
    moved = np.ones(len(times), np.bool_)
    moved[1:] = (np.diff(poses, axis=0) != 0).any(axis=1) & (np.diff(times) > 0)
    begins = np.flatnonzero(moved)
    if len(begins) < 2:
        return moved  # nothing tells of frames
    frame = float(np.median(np.diff(times[begins])))
    for begin, end in itertools.pairwise([*begins.tolist(), len(times)]):
        if times[end - 1] - times[begin] < _REST * frame:
            continue
        last = begin
        for index in range(begin + 1, end):
            if times[index] - times[last] >= _NEXT * frame:
                moved[index], last = True, index
    return moved

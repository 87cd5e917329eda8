"""State as everyone sees it: rows of named columns, one row a world.

A frame is absolute: origin at the field's centre, x towards yellow's goal, y to the left of
that, SI units, blue attacks +x. A heading is `(cos, sin)`, so nothing wraps and a half turn is
a sign flip. Column names exist once, in the core; everything here is derived from them.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
Array = NDArray[Any]

# What `crossed` may say, as numbers that can be compared with the column.
NOTHING = CROSSINGS.index("none")
GOAL_RIGHT = CROSSINGS.index("goal_right")  # the goal at +x: yellow's, so blue scored
GOAL_LEFT = CROSSINGS.index("goal_left")


def span(columns: tuple[str, ...], *names: str) -> slice:
    """Where neighbouring columns lie, as a slice, so that reading them copies nothing."""
    first = columns.index(names[0])
    if columns[first : first + len(names)] != names:
        raise ImportError(f"the core's columns {columns} do not keep {names} side by side")
    return slice(first, first + len(names))


class BallColumns:
    """Named views onto ball columns, `data` (..., ball column). Nothing is copied."""

    __slots__ = ("data",)

    _POSITION = span(BALL_COLUMNS, "x", "y")
    _VELOCITY = span(BALL_COLUMNS, "v_x", "v_y")
    _HEIGHT = BALL_COLUMNS.index("z")
    _RISE = BALL_COLUMNS.index("v_z")
    _SPIN = span(BALL_COLUMNS, "spin_x", "spin_y", "spin_z")
    _LAST_TOUCH = BALL_COLUMNS.index("last_touch")
    _CROSSED = BALL_COLUMNS.index("crossed")
    _CROSSED_AT = span(BALL_COLUMNS, "crossed_x", "crossed_y")

    def __init__(self, data: Floats) -> None:
        """Name the columns of `data` (..., ball column)."""
        self.data = data

    @property
    def position(self) -> Floats:
        """(..., 2) metres."""
        return self.data[..., self._POSITION]

    @property
    def velocity(self) -> Floats:
        """(..., 2) metres per second."""
        return self.data[..., self._VELOCITY]

    @property
    def height(self) -> Floats:
        """(...) metres, of its lowest point; 0 on the floor."""
        return self.data[..., self._HEIGHT]

    @property
    def rise(self) -> Floats:
        """(...) metres per second upward."""
        return self.data[..., self._RISE]

    @property
    def spin(self) -> Floats:
        """(..., 3) radians per second about the field's axes."""
        return self.data[..., self._SPIN]

    @property
    def last_touch(self) -> Floats:
        """(...) the robot that touched it last, by its place in the frame; -1 for none."""
        return self.data[..., self._LAST_TOUCH]

    @property
    def crossed(self) -> Floats:
        """(...) what its centre crossed in the last step, a position in `CROSSINGS`."""
        return self.data[..., self._CROSSED]

    @property
    def crossed_at(self) -> Floats:
        """(..., 2) metres; where it crossed, if it did."""
        return self.data[..., self._CROSSED_AT]


class RobotColumns:
    """Named views onto robot columns, `data` (..., robot column). Nothing is copied."""

    __slots__ = ("data",)

    _POSITION = span(ROBOT_COLUMNS, "x", "y")
    _HEADING = span(ROBOT_COLUMNS, "cos", "sin")
    _VELOCITY = span(ROBOT_COLUMNS, "v_x", "v_y")
    _SPIN = ROBOT_COLUMNS.index("v_theta")
    _INFRARED = ROBOT_COLUMNS.index("infrared")
    _TOUCHED_BALL = ROBOT_COLUMNS.index("touched_ball")
    _TOUCHED_FOE = ROBOT_COLUMNS.index("touched_foe")
    _CRASH_SPEED = ROBOT_COLUMNS.index("crash_speed")

    def __init__(self, data: Floats) -> None:
        """Name the columns of `data` (..., robot column)."""
        self.data = data

    @property
    def position(self) -> Floats:
        """(..., 2) metres."""
        return self.data[..., self._POSITION]

    @property
    def heading(self) -> Floats:
        """(..., 2) cosine and sine of where it faces."""
        return self.data[..., self._HEADING]

    @property
    def velocity(self) -> Floats:
        """(..., 2) metres per second."""
        return self.data[..., self._VELOCITY]

    @property
    def spin(self) -> Floats:
        """(...) radians per second, positive to the left."""
        return self.data[..., self._SPIN]

    @property
    def infrared(self) -> Floats:
        """(...) 1 where the ball cuts its break beam, else 0."""
        return self.data[..., self._INFRARED]

    @property
    def touched_ball(self) -> Floats:
        """(...) 1 where it touched the ball in the last step, else 0."""
        return self.data[..., self._TOUCHED_BALL]

    @property
    def touched_foe(self) -> Floats:
        """(...) 1 where it touched a robot of the other side in the last step, else 0."""
        return self.data[..., self._TOUCHED_FOE]

    @property
    def crash_speed(self) -> Floats:
        """(...) m/s, closing speed of its hardest contact with a robot in the last step."""
        return self.data[..., self._CRASH_SPEED]


class Frame:
    """One moment in each of n worlds, absolute; named views onto `rows` (n, row)."""

    __slots__ = ("ball", "blue", "n_blue", "n_yellow", "robots", "rows", "yellow")

    def __init__(self, rows: Floats, n_blue: int, n_yellow: int) -> None:
        """View `rows` (n, row), C-contiguous float32, as ball, blue robots, yellow robots."""
        _check_rows(rows, row_size(n_blue, n_yellow))
        self.rows = rows
        self.n_blue = n_blue
        self.n_yellow = n_yellow
        robots = rows[:, len(BALL_COLUMNS) :].reshape(
            len(rows), n_blue + n_yellow, len(ROBOT_COLUMNS)
        )
        self.ball = BallColumns(rows[:, : len(BALL_COLUMNS)])  # (n, ...)
        self.robots = RobotColumns(robots)  # (n, robots, ...) blue first
        self.blue = RobotColumns(robots[:, :n_blue])  # (n, n_blue, ...)
        self.yellow = RobotColumns(robots[:, n_blue:])  # (n, n_yellow, ...)

    @classmethod
    def empty(cls, n: int, n_blue: int, n_yellow: int) -> "Frame":
        """A frame of zeros, nobody on the ball yet, all robots facing +x, to be filled in."""
        frame = cls(np.zeros((n, row_size(n_blue, n_yellow)), np.float32), n_blue, n_yellow)
        frame.robots.heading[..., 0] = 1.0
        frame.ball.last_touch[:] = -1.0
        return frame

    def copy(self) -> "Frame":
        """Return the same state in new memory."""
        return Frame(self.rows.copy(), self.n_blue, self.n_yellow)

    def take(self, worlds: NDArray[np.intp]) -> "Frame":
        """Return a copy of some worlds; `worlds` (k,) are their indices."""
        return Frame(self.rows[worlds], self.n_blue, self.n_yellow)

    def put(self, worlds: NDArray[np.intp], part: "Frame") -> None:
        """Overwrite the worlds with indices `worlds` (k,) by those of `part`."""
        self.rows[worlds] = part.rows

    def __reduce__(self) -> tuple[type["Frame"], tuple[Floats, int, int]]:
        # Pickled piece by piece, the names would become copies of the rows.
        return Frame, (self.rows, self.n_blue, self.n_yellow)

    def __len__(self) -> int:
        return len(self.rows)


def length(x: Floats, y: Floats) -> Floats:
    """Lengths of vectors (x, y). The same in every batch, and faster than hypot or a norm."""
    lengths: Floats = np.sqrt(x * x + y * y)
    return lengths


def row_size(n_blue: int, n_yellow: int) -> int:
    """Columns of one row: the ball's, then each robot's."""
    return len(BALL_COLUMNS) + (n_blue + n_yellow) * len(ROBOT_COLUMNS)


def robot_names(n_blue: int, n_yellow: int) -> tuple[str, ...]:
    """`blue_0`, ..., `yellow_0`, ...: names in the order of a row."""
    blue = tuple(f"blue_{i}" for i in range(n_blue))
    return blue + tuple(f"yellow_{i}" for i in range(n_yellow))


def _check_rows(rows: Array, size: int) -> None:
    if rows.ndim != 2 or rows.shape[1] != size:
        raise ValueError(f"rows: expected shape (n, {size}), got {rows.shape}")
    if rows.dtype != np.float32 or not rows.flags.c_contiguous:
        raise ValueError(f"rows: expected C-contiguous float32, got {rows.dtype}")

"""State rows with named columns: ball and robots of n worlds in absolute coordinates.

The origin is the field's center, x points at yellow's goal and y to the left of x, so blue attacks
toward +x. Units are SI. A heading is stored as (cos, sin), so it never wraps, and half a turn is a
change of sign. The core defines the columns; this module derives everything from their names.
"""

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.arrays import Array, Floats, read_only

# Values of `BallColumns.crossed`.
NO_CROSSING = CROSSINGS.index("none")
GOAL_RIGHT = CROSSINGS.index("goal_right")  # the goal at +x, yellow's: blue scored
GOAL_LEFT = CROSSINGS.index("goal_left")  # the goal at -x, blue's: yellow scored


def column_slice(columns: tuple[str, ...], *names: str) -> slice:
    """Return the slice of neighboring columns, so that reading them copies nothing.

    Args:
        columns: names of all columns.
        *names: names of the neighboring columns, in order.

    Raises:
        ImportError: the columns are not neighbors in this order.
    """
    first = columns.index(names[0])
    if columns[first : first + len(names)] != names:
        raise ImportError(f"the core's columns {columns} do not keep {names} side by side")
    return slice(first, first + len(names))


class BallColumns:
    """Ball state by name. All properties are views that share the memory of `data`.

    Attributes:
        data: (..., ball column) columns in the order of `BALL_COLUMNS`.
    """

    __slots__ = ("data",)

    _POSITION = column_slice(BALL_COLUMNS, "x", "y")
    _VELOCITY = column_slice(BALL_COLUMNS, "v_x", "v_y")
    _HEIGHT = BALL_COLUMNS.index("z")
    _VERTICAL_VELOCITY = BALL_COLUMNS.index("v_z")
    _SPIN = column_slice(BALL_COLUMNS, "spin_x", "spin_y", "spin_z")
    _LAST_TOUCH = BALL_COLUMNS.index("last_touch")
    _CROSSED = BALL_COLUMNS.index("crossed")
    _CROSSED_AT = column_slice(BALL_COLUMNS, "crossed_x", "crossed_y")
    _SECONDS_SINCE_TOUCH = BALL_COLUMNS.index("seconds_since_touch")
    _SPEED_AFTER_TOUCH = BALL_COLUMNS.index("speed_after_touch")
    _HEIGHT_SINCE_TOUCH = BALL_COLUMNS.index("height_since_touch")

    def __init__(self, data: Floats) -> None:
        """Name the columns of an array.

        Args:
            data: (..., ball column) float32; not copied.
        """
        self.data = data

    @property
    def position(self) -> Floats:
        """(..., 2) position x, y in meters."""
        return self.data[..., self._POSITION]

    @property
    def velocity(self) -> Floats:
        """(..., 2) velocity along x, y in m/s."""
        return self.data[..., self._VELOCITY]

    @property
    def height(self) -> Floats:
        """(...) height of the ball's lowest point in meters; 0 on the floor."""
        return self.data[..., self._HEIGHT]

    @property
    def vertical_velocity(self) -> Floats:
        """(...) velocity upward in m/s."""
        return self.data[..., self._VERTICAL_VELOCITY]

    @property
    def spin(self) -> Floats:
        """(..., 3) angular velocity about the field's axes x, y, z in rad/s."""
        return self.data[..., self._SPIN]

    @property
    def last_touch(self) -> Floats:
        """(...) index of the last robot that touched the ball, blue first; -1 for none."""
        return self.data[..., self._LAST_TOUCH]

    @property
    def crossed(self) -> Floats:
        """(...) line or goal that the ball's center crossed in the last step.

        An index into `CROSSINGS`: compare with `NO_CROSSING`, `GOAL_RIGHT` and `GOAL_LEFT`.
        """
        return self.data[..., self._CROSSED]

    @property
    def crossed_at(self) -> Floats:
        """(..., 2) position x, y of the crossing in meters; valid if there was one."""
        return self.data[..., self._CROSSED_AT]

    @property
    def seconds_since_touch(self) -> Floats:
        """(...) time since a robot touched the ball last in seconds; 0 if none has."""
        return self.data[..., self._SECONDS_SINCE_TOUCH]

    @property
    def speed_after_touch(self) -> Floats:
        """(...) speed of the ball right after its last touch in m/s, upward too; 0 if none."""
        return self.data[..., self._SPEED_AFTER_TOUCH]

    @property
    def height_since_touch(self) -> Floats:
        """(...) maximum of `height` since the last touch in meters; 0 if none."""
        return self.data[..., self._HEIGHT_SINCE_TOUCH]


class RobotColumns:
    """Robot state by name. All properties are views that share the memory of `data`.

    Attributes:
        data: (..., robot column) columns in the order of `ROBOT_COLUMNS`.
    """

    __slots__ = ("data",)

    _POSITION = column_slice(ROBOT_COLUMNS, "x", "y")
    _HEADING = column_slice(ROBOT_COLUMNS, "cos", "sin")
    _VELOCITY = column_slice(ROBOT_COLUMNS, "v_x", "v_y")
    _ANGULAR_VELOCITY = ROBOT_COLUMNS.index("v_theta")
    _INFRARED = ROBOT_COLUMNS.index("infrared")
    _TOUCHED_BALL = ROBOT_COLUMNS.index("touched_ball")
    _TOUCHED_OPPONENT = ROBOT_COLUMNS.index("touched_opponent")
    _COLLISION_SPEED = ROBOT_COLUMNS.index("collision_speed")
    _ABSENT = ROBOT_COLUMNS.index("absent")

    def __init__(self, data: Floats) -> None:
        """Name the columns of an array.

        Args:
            data: (..., robot column) float32; not copied.
        """
        self.data = data

    @property
    def position(self) -> Floats:
        """(..., 2) position x, y in meters."""
        return self.data[..., self._POSITION]

    @property
    def heading(self) -> Floats:
        """(..., 2) cosine and sine of the heading."""
        return self.data[..., self._HEADING]

    @property
    def velocity(self) -> Floats:
        """(..., 2) velocity along x, y in m/s."""
        return self.data[..., self._VELOCITY]

    @property
    def angular_velocity(self) -> Floats:
        """(...) angular velocity in rad/s, counterclockwise."""
        return self.data[..., self._ANGULAR_VELOCITY]

    @property
    def infrared(self) -> Floats:
        """(...) 1 if the ball interrupts the robot's break beam, else 0."""
        return self.data[..., self._INFRARED]

    @property
    def touched_ball(self) -> Floats:
        """(...) 1 if the robot touched the ball in the last step, else 0."""
        return self.data[..., self._TOUCHED_BALL]

    @property
    def touched_opponent(self) -> Floats:
        """(...) 1 if the robot touched a robot of the other team in the last step, else 0."""
        return self.data[..., self._TOUCHED_OPPONENT]

    @property
    def collision_speed(self) -> Floats:
        """(...) closing speed of the hardest contact with a robot in the last step, m/s."""
        return self.data[..., self._COLLISION_SPEED]

    @property
    def absent(self) -> Floats:
        """(...) 1 if the robot is not on the field, else 0.

        An absent robot rests behind its own goal, beyond all walls. In a view all its other columns
        are 0.
        """
        return self.data[..., self._ABSENT]


class Frame:
    """Absolute state of n worlds at one time, by name.

    The parts are views: a write to one of them changes `rows`.

    Attributes:
        rows: (n, row) state rows: the ball's columns, then each robot's, blue first.
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.
        ball: ball columns, (n, ...).
        robots: columns of all robots, (n, robots, ...), blue first.
        blue: columns of the blue robots, (n, n_blue, ...).
        yellow: columns of the yellow robots, (n, n_yellow, ...).

    Example:
        >>> from rsoccer import Frame
        >>> frame = Frame.empty(4, n_blue=3, n_yellow=3)
        >>> frame.ball.position[:] = (0.5, 0.0)
        >>> frame.robots.position.shape
        (4, 6, 2)
    """

    __slots__ = ("_read_only", "ball", "blue", "n_blue", "n_yellow", "robots", "rows", "yellow")

    def __init__(self, rows: Floats, n_blue: int, n_yellow: int) -> None:
        """View state rows as ball, blue robots and yellow robots.

        Args:
            rows: (n, row) C-contiguous float32; not copied.
            n_blue: number of blue robots.
            n_yellow: number of yellow robots.

        Raises:
            ValueError: rows of another shape, type or memory layout.
        """
        _check_rows(rows, row_size(n_blue, n_yellow))
        self._read_only: Frame | None = None
        self.rows = rows
        self.n_blue = n_blue
        self.n_yellow = n_yellow
        robots = rows[:, len(BALL_COLUMNS) :].reshape(
            len(rows), n_blue + n_yellow, len(ROBOT_COLUMNS)
        )
        self.ball = BallColumns(rows[:, : len(BALL_COLUMNS)])
        self.robots = RobotColumns(robots)
        self.blue = RobotColumns(robots[:, :n_blue])
        self.yellow = RobotColumns(robots[:, n_blue:])

    @classmethod
    def empty(cls, n: int, n_blue: int, n_yellow: int) -> "Frame":
        """Return a frame to be filled in: zeros, no last touch, all robots facing +x.

        Args:
            n: number of worlds.
            n_blue: number of blue robots.
            n_yellow: number of yellow robots.
        """
        frame = cls(np.zeros((n, row_size(n_blue, n_yellow)), np.float32), n_blue, n_yellow)
        frame.robots.heading[..., 0] = 1.0
        frame.ball.last_touch[:] = -1.0
        return frame

    @property
    def read_only(self) -> "Frame":
        """The same state in the same memory, which cannot be written through it."""
        found = self._read_only
        if found is None:
            if not self.rows.flags.writeable:
                return self
            rows = read_only(self.rows)
            found = self._read_only = Frame(rows, self.n_blue, self.n_yellow)
        return found

    def copy(self) -> "Frame":
        """Return the same state in new memory."""
        return Frame(self.rows.copy(), self.n_blue, self.n_yellow)

    def take(self, worlds: NDArray[np.intp]) -> "Frame":
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        return Frame(self.rows[worlds], self.n_blue, self.n_yellow)

    def put(self, worlds: NDArray[np.intp], part: "Frame") -> None:
        """Overwrite some worlds.

        Args:
            worlds: (k,) indices of worlds.
            part: frame of k worlds.
        """
        self.rows[worlds] = part.rows

    def __reduce__(self) -> tuple[type["Frame"], tuple[Floats, int, int]]:
        # Pickled attribute by attribute, the views would become copies of the rows.
        return Frame, (self.rows, self.n_blue, self.n_yellow)

    def __len__(self) -> int:
        return len(self.rows)


def row_size(n_blue: int, n_yellow: int) -> int:
    """Return the number of columns of a state row: the ball's, then each robot's.

    Args:
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.
    """
    return len(BALL_COLUMNS) + (n_blue + n_yellow) * len(ROBOT_COLUMNS)


def robot_names(n_blue: int, n_yellow: int) -> tuple[str, ...]:
    """Return the robots' names in the order of a row: `blue_0`, ..., `yellow_0`, ...

    Args:
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.
    """
    blue = tuple(f"blue_{i}" for i in range(n_blue))
    return blue + tuple(f"yellow_{i}" for i in range(n_yellow))


def team_of(robot: str) -> str:
    """Return the team of a robot, "blue" or "yellow".

    Args:
        robot: name of the robot, such as "blue_0".
    """
    return robot.rsplit("_", 1)[0]


def _check_rows(rows: Array, size: int) -> None:
    if rows.ndim != 2 or rows.shape[1] != size:
        raise ValueError(f"rows: expected shape (n, {size}), got {rows.shape}")
    if rows.dtype != np.float32 or not rows.flags.c_contiguous:
        order = "" if rows.flags.c_contiguous else ", not C-contiguous"
        raise ValueError(f"rows: expected C-contiguous float32, got {rows.dtype}{order}")

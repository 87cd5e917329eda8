"""Physics of robot soccer: the compiled half of rsoccer.

A state row is the ball's columns, then each robot's, blue first; a column's place follows from
its name. Positions in metres, velocities in m/s, angles in radians; the origin is the centre of the
field, x points at yellow's goal, y to the left, and blue attacks towards +x.
"""

from typing import final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BALL_COLUMNS",
    "COMMAND_COLUMNS",
    "CROSSINGS",
    "ROBOT_COLUMNS",
    "BallModel",
    "Field",
    "RobotModel",
    "SimConfig",
    "Simulator",
    "build_info",
]

BALL_COLUMNS: tuple[str, ...]
"""Names of the ball's columns. `crossed` is a position in `CROSSINGS`: what the ball's centre
crossed during the last control step, at `crossed_x`, `crossed_y`."""
ROBOT_COLUMNS: tuple[str, ...]
"""Names of a robot's columns: position, heading as `cos` and `sin`, velocity, turn rate."""
COMMAND_COLUMNS: dict[str, tuple[str, ...]]
"""Names of a command's columns, by kind of drive. `differential`: wheel speeds, rad/s."""
CROSSINGS: tuple[str, ...]
"""Meanings of the ball's `crossed` column."""

def build_info() -> dict[str, str | int]:
    """How this module was built: `version`, `profile` ("release", "debug"), `physics` number."""

@final
class Field:
    """A walled field, its lines and marks. Metres; goals are pockets behind the goal lines."""

    @property
    def name(self) -> str: ...
    @property
    def length(self) -> float: ...
    @property
    def width(self) -> float: ...
    @property
    def half_length(self) -> float: ...
    @property
    def half_width(self) -> float: ...
    @property
    def goal_width(self) -> float: ...
    @property
    def goal_depth(self) -> float: ...
    @property
    def corner(self) -> float:
        """Leg of the 45-degree block in each corner."""

    @property
    def wall_height(self) -> float: ...
    @property
    def center_radius(self) -> float: ...
    @property
    def goal_area_width(self) -> float:
        """Along y."""

    @property
    def goal_area_depth(self) -> float:
        """Along x."""

    @property
    def penalty_mark(self) -> float:
        """Distance from the centre, along x."""

    @property
    def free_ball_x(self) -> float: ...
    @property
    def free_ball_y(self) -> float: ...
    @property
    def line_width(self) -> float: ...
    @property
    def max_robots(self) -> int:
        """Most robots that the league lets a side field."""

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class RobotModel:
    """A robot as data. SI units."""

    @property
    def name(self) -> str: ...
    @property
    def drive(self) -> str:
        """Kind of drive: a key of `COMMAND_COLUMNS`."""

    @property
    def size(self) -> float:
        """Side of the square."""

    @property
    def bounding_radius(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def wheel_radius(self) -> float: ...
    @property
    def track(self) -> float: ...
    @property
    def max_wheel_speed(self) -> float: ...
    @property
    def top_speed(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class BallModel:
    """A ball as data. SI units."""

    @property
    def name(self) -> str: ...
    @property
    def radius(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def rolling_deceleration(self) -> float: ...
    @property
    def robot_restitution(self) -> float: ...
    @property
    def wall_restitution(self) -> float: ...
    @property
    def robot_friction(self) -> float: ...
    @property
    def wall_friction(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class SimConfig:
    """What is fixed for the life of a simulator: field, models, team sizes, time steps.

    Raises:
        ValueError: a name that is no preset, more robots than the league allows, or times (s) that
            are not positive or not whole multiples of each other.
    """

    def __new__(
        cls,
        field: str = "vss_3v3",
        n_blue: int = 3,
        n_yellow: int = 3,
        *,
        robot: str = "vss_440rpm",
        ball: str = "vss_rsim",
        time_step: float = 0.025,
        tick: float = 0.005,
    ) -> SimConfig: ...
    @property
    def field(self) -> Field: ...
    @property
    def robot(self) -> RobotModel: ...
    @property
    def ball(self) -> BallModel: ...
    @property
    def n_blue(self) -> int: ...
    @property
    def n_yellow(self) -> int: ...
    @property
    def n_robots(self) -> int: ...
    @property
    def time_step(self) -> float:
        """Length of a control step."""

    @property
    def tick(self) -> float:
        """Length of a physics tick."""

    @property
    def ticks_per_step(self) -> int: ...
    @property
    def row_size(self) -> int:
        """Length of a state row."""

    @property
    def command_columns(self) -> tuple[str, ...]: ...
    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str) -> SimConfig: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class Simulator:
    """`worlds` independent matches of one configuration, stepped on `threads` threads.

    World `i` computes what it would compute alone: neither the number of worlds nor of threads
    changes a bit of it. Usable after a fork. Pickles with its state.

    Raises:
        ValueError: no worlds or no threads.
    """

    def __new__(cls, config: SimConfig, worlds: int = 1, threads: int = 1) -> Simulator: ...
    @property
    def config(self) -> SimConfig: ...
    @property
    def worlds(self) -> int: ...
    @property
    def threads(self) -> int: ...
    def place(
        self, worlds: NDArray[np.bool_], rows: NDArray[np.float32], out: NDArray[np.float32]
    ) -> None:
        """Start new matches in the worlds of a mask (n,).

        `rows` (number of True, row) says where; positions, headings and velocities count. The rows
        of the placed worlds, as they now read, are written into `out` (n, row).

        Raises:
            ValueError: bodies in each other or outside, wrong shapes. Nothing has changed.
            TypeError: wrong types.
        """

    def step(
        self,
        commands: NDArray[np.float32],
        out: NDArray[np.float32],
        active: NDArray[np.bool_] | None = None,
    ) -> None:
        """One control step; releases the GIL.

        `commands` (n, robots, command) are finite; beyond what a robot can do they count as the
        most that it can. Rows go into `out` (n, row); those of worlds outside the mask `active`
        (n,) stay as they are.

        Raises:
            ValueError: wrong shapes or values that are not finite. Nothing has moved.
            TypeError: wrong types.
            RuntimeError: a world's state became non-finite; the others have stepped.
        """

    def read(self, out: NDArray[np.float32]) -> None:
        """Write the rows of all worlds into `out` (n, row)."""

    def snapshot(self) -> bytes:
        """Everything that the matches' futures depend on."""

    def restore(self, snapshot: bytes) -> None:
        """Put the matches back where they were when the snapshot was taken.

        Raises:
            ValueError: foreign or damaged bytes, or another configuration. Nothing has changed.
        """

    def __getnewargs__(self) -> tuple[SimConfig, int, int]: ...
    def __getstate__(self) -> bytes: ...
    def __setstate__(self, state: bytes) -> None: ...

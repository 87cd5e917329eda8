"""Physics of robot soccer: the compiled half of rsoccer.

A state row is the ball's columns, then each robot's, blue first; a column's place follows from
its name. Positions in metres, velocities in m/s, angles in radians; the origin is the centre of the
field, x points at yellow's goal, y to the left, and blue attacks towards +x.
"""

from collections.abc import Sequence
from typing import ClassVar, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BALL_COLUMNS",
    "BALL_PARAMETERS",
    "COMMAND_COLUMNS",
    "CROSSINGS",
    "FASTEST",
    "ROBOT_COLUMNS",
    "ROBOT_PARAMETERS",
    "BallModel",
    "Field",
    "Potential",
    "RobotModel",
    "Sight",
    "SimConfig",
    "Simulator",
    "Steering",
    "Viewpoint",
    "build_info",
    "clipped",
    "efforts",
    "limit",
    "nearest",
]

FASTEST: float
"""Fastest that a body may be placed with, m/s."""

BALL_COLUMNS: tuple[str, ...]
"""Names of the ball's columns.

Position (`z` is the height of its lowest point, 0 on the floor), velocity, `spin_x`, `spin_y`,
`spin_z` (rad/s), `last_touch` (place of the robot in the row, or -1), and `crossed` (a position in
`CROSSINGS`): what its centre crossed first during the last control step, at `crossed_x`,
`crossed_y`, `crossed_z`."""
ROBOT_COLUMNS: tuple[str, ...]
"""Names of a robot's columns.

Position, heading as `cos` and `sin`, velocity, turn rate, `infrared` (1 if the ball cuts its beam),
and of the last control step: `touched_ball` and `touched_foe` (1 or 0) and `crash_speed`, the
closing speed of its hardest contact with a robot."""
COMMAND_COLUMNS: dict[str, tuple[str, ...]]
"""Names of a command's columns, by kind of drive.

`differential`: wheel speeds (rad/s). `omni`: velocity forward and left (m/s), turn rate (rad/s),
kick forward and upward (m/s, relative to the front; 0 is none), share of the dribbler's speed.
`omni_wheels`: four wheel speeds (rad/s) in place of the first three."""
CROSSINGS: tuple[str, ...]
"""Meanings of the ball's `crossed` column: goals at +x (right) and -x (left), the goal lines beside
or over them, touch lines at +y (left) and -y (right)."""
BALL_PARAMETERS: tuple[str, ...]
"""Factors on the ball's numbers that a world may have of its own."""
ROBOT_PARAMETERS: tuple[str, ...]
"""Factors on each robot's numbers that a world may have of its own."""

def build_info() -> dict[str, str | int]:
    """How this module was built: `version`, `profile` ("release", "debug"), `physics` number."""

@final
class Field:
    """A field: play area, goals, walls, lines and marks. Metres, to the middle of lines.

    `Field("ssl_b", width=5.0)` is the preset with some numbers replaced. What a league does not
    have is 0.

    Raises:
        ValueError: no such preset or number, or numbers that make no field.
    """

    PRESETS: ClassVar[tuple[str, ...]]

    def __new__(cls, name: str, **numbers: float) -> Field: ...
    @property
    def name(self) -> str: ...
    @property
    def length(self) -> float: ...
    @property
    def width(self) -> float: ...
    @property
    def goal_line_margin(self) -> float:
        """From a goal line to the wall behind it; 0 where the line is at the wall."""

    @property
    def touch_line_margin(self) -> float: ...
    @property
    def goal_width(self) -> float: ...
    @property
    def goal_depth(self) -> float: ...
    @property
    def goal_height(self) -> float:
        """Under which the ball is in the goal; SSL: under the bar."""

    @property
    def goal_wall(self) -> float:
        """Thickness of a goal's own walls; 0: a gap in the table's wall."""

    @property
    def corner(self) -> float:
        """Leg of the 45-degree block in each corner."""

    @property
    def wall_height(self) -> float:
        """0: nothing flies over the walls."""

    @property
    def center_radius(self) -> float: ...
    @property
    def goal_area_width(self) -> float:
        """Along y."""

    @property
    def goal_area_depth(self) -> float:
        """Along x."""

    @property
    def inner_area_width(self) -> float:
        """Of the smaller area inside, along y."""

    @property
    def inner_area_depth(self) -> float: ...
    @property
    def area_arc_width(self) -> float:
        """Chord of the arc on the area's front."""

    @property
    def area_arc_depth(self) -> float: ...
    @property
    def penalty_mark(self) -> float:
        """Distance from the goal line that is shot at."""

    @property
    def free_ball_x(self) -> float: ...
    @property
    def free_ball_y(self) -> float: ...
    @property
    def line_width(self) -> float: ...
    @property
    def half_length(self) -> float: ...
    @property
    def half_width(self) -> float: ...
    @property
    def reach_x(self) -> float:
        """How far from the centre anything gets along x."""

    @property
    def reach_y(self) -> float: ...
    @property
    def max_robots(self) -> int:
        """Most robots that the league lets a side field."""

    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str) -> Field: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class BallModel:
    """A ball and what it rolls on and hits. SI units.

    `BallModel("ssl_tigers", rolling_deceleration=0.3)` is the preset with some numbers replaced.

    Raises:
        ValueError: no such preset or number, or numbers that make no ball.
    """

    PRESETS: ClassVar[tuple[str, ...]]

    def __new__(cls, name: str, **numbers: float) -> BallModel: ...
    @property
    def name(self) -> str: ...
    @property
    def radius(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def sliding_deceleration(self) -> float:
        """While its lowest point slips."""

    @property
    def rolling_deceleration(self) -> float: ...
    @property
    def rolling_share(self) -> float:
        """Share of a kick's speed at which it comes to roll."""

    @property
    def spin_deceleration(self) -> float:
        """rad/s², about the vertical axis."""

    @property
    def hop_first(self) -> float:
        """Share of the speed along the floor kept by the first touch-down."""

    @property
    def hop_later(self) -> float: ...
    @property
    def hop_up(self) -> float:
        """Share of the vertical speed kept."""

    @property
    def robot_restitution(self) -> float: ...
    @property
    def robot_friction(self) -> float: ...
    @property
    def wall_restitution(self) -> float: ...
    @property
    def wall_friction(self) -> float: ...
    @property
    def goal_back_restitution(self) -> float: ...
    @property
    def goal_back_friction(self) -> float: ...
    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str) -> BallModel: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class RobotModel:
    """A robot as data. SI units. A number that its kind does not have raises `AttributeError`.

    `RobotModel("ssl_generic", max_kick=6.5)` is the preset with some numbers replaced.

    Raises:
        ValueError: no such preset or number, or numbers that make no robot.
    """

    PRESETS: ClassVar[tuple[str, ...]]

    def __new__(cls, name: str, **numbers: float) -> RobotModel: ...
    @property
    def name(self) -> str: ...
    @property
    def side(self) -> float:
        """Of a square body."""

    @property
    def radius(self) -> float:
        """Of a round body."""

    @property
    def front(self) -> float:
        """From the centre of a round body to its flat front."""

    @property
    def height(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def wheel_radius(self) -> float: ...
    @property
    def max_wheel_speed(self) -> float: ...
    @property
    def track(self) -> float:
        """Effective distance of two wheels."""

    @property
    def motor_torque(self) -> float: ...
    @property
    def forward_grip(self) -> float: ...
    @property
    def side_grip(self) -> float: ...
    @property
    def wheel_distance(self) -> float:
        """From the centre to each of four wheels."""

    @property
    def max_speed(self) -> float: ...
    @property
    def max_turn_rate(self) -> float: ...
    @property
    def speed_up(self) -> float: ...
    @property
    def brake(self) -> float: ...
    @property
    def turn_speed_up(self) -> float: ...
    @property
    def turn_brake(self) -> float: ...
    @property
    def traction(self) -> float:
        """Most acceleration that the wheels transmit."""

    @property
    def jerk(self) -> float:
        """Most change of its acceleration, m/s³; 0 for no limit."""

    @property
    def mouth_width(self) -> float: ...
    @property
    def beam_distance(self) -> float: ...
    @property
    def beam_height(self) -> float: ...
    @property
    def max_kick(self) -> float: ...
    @property
    def max_chip(self) -> float: ...
    @property
    def recharge(self) -> float: ...
    @property
    def kick_keeps(self) -> float:
        """Share of the ball's speed across the front that a kick leaves."""

    @property
    def grip(self) -> float:
        """Strongest force of the dribbler, N."""

    @property
    def bar_force(self) -> float:
        """Force of the running bar on the ball, N."""

    @property
    def bar_speed(self) -> float:
        """Surface speed of the dribbler's bar."""

    @property
    def bar_restitution(self) -> float: ...
    @property
    def bar_friction(self) -> float: ...
    @property
    def bounding_radius(self) -> float: ...
    @property
    def top_speed(self) -> float: ...
    @property
    def top_turn_rate(self) -> float: ...
    @property
    def has_mouth(self) -> bool:
        """Whether it has beam, kicker and dribbler."""

    @property
    def drive(self) -> str:
        """Kind of drive: a key of `COMMAND_COLUMNS`."""

    @property
    def wheel_angles(self) -> list[float]:
        """Places of four wheels, degrees from the front, counter-clockwise."""

    @property
    def command_columns(self) -> tuple[str, ...]: ...
    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str) -> RobotModel: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class SimConfig:
    """What is fixed for the life of a simulator: field, models, team sizes, time steps.

    `robot` is one model for all, or one for each robot, blue first. Robot and ball default to those
    of the league that has a field of that name, whatever its numbers: `vss_440rpm` and `vss_rsim`,
    `ssl_generic` and `ssl_tigers`.

    Raises:
        ValueError: a name that is no preset, more robots than the league allows, or times (s) that
            are not positive or not whole multiples of each other.
    """

    def __new__(
        cls,
        field: str | Field = "vss_3v3",
        n_blue: int = 3,
        n_yellow: int = 3,
        *,
        robot: str | RobotModel | Sequence[str | RobotModel] | None = None,
        ball: str | BallModel | None = None,
        time_step: float = 0.025,
        tick: float = 0.005,
    ) -> SimConfig: ...
    @property
    def field(self) -> Field: ...
    @property
    def robots(self) -> tuple[RobotModel, ...]:
        """Models of all robots, blue first."""

    @property
    def robot(self) -> RobotModel:
        """The model that all robots share; ValueError if they do not."""

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
    def parameters_size(self) -> int:
        """Length of a world's row of parameters: the ball's, then each robot's."""

    @property
    def command_columns(self) -> tuple[str, ...]:
        """Names of a command's columns; of the longest, where robots differ."""

    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str) -> SimConfig: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class Steering:
    """What actions, five numbers in [-1, 1], ask of robots that are told their body's velocity.

    `scales` are what a 1 asks for: velocity along two axes (m/s), turn rate (rad/s), speed of a
    kick (m/s; none below 0), dribbler (share of its speed; off up to 0). Velocities are along the
    axes of the field as the robot's side sees it, if `along_field`, else along the robot's own.
    Robots from `n_blue` on see the field turned half round.

    Raises:
        ValueError: not five scales, one that is not finite, or `n_blue` below 0.
    """

    def __new__(cls, scales: Sequence[float], along_field: bool, n_blue: int) -> Steering: ...
    def commands(
        self, actions: NDArray[np.float32], rows: NDArray[np.float32]
    ) -> NDArray[np.float32]:
        """Commands (n, robots, 6) for actions (n, robots, 5) of the robots in rows (n, row).

        The columns are `COMMAND_COLUMNS["omni"]`.

        Raises:
            TypeError: an array that is not float32.
            ValueError: an array of another shape.
        """

    def __reduce__(self) -> tuple[object, tuple[list[float], bool, int]]: ...

@final
class Viewpoint:
    """Who looks, and what each has where: turns rows of `robots` robots into views.

    Each of `slots` has the robots that one seer sees, by their place in a row: itself, mates, foes;
    None where a slot is empty. Who is `turned` sees the field turned half round.

    Raises:
        ValueError: rows of different length, or a robot that there is not.
        OverflowError: a robot below 0.
    """

    def __new__(
        cls, robots: int, slots: Sequence[Sequence[int | None]], turned: Sequence[bool]
    ) -> Viewpoint: ...
    def fill(
        self, rows: NDArray[np.float32], ball: NDArray[np.float32], robots: NDArray[np.float32]
    ) -> None:
        """Write what all see of `rows` (n, row), attacking +x.

        Into `ball` (n, seers, ball column) and `robots` (n, seers, slots, robot column); zeros
        where nobody is.

        Raises:
            TypeError: an array that is not float32.
            ValueError: an array of another shape, or one that cannot be written into.
        """

@final
class Potential:
    """What a robot is to raise, in metres. By its differences a way there and back pays nothing."""

    @staticmethod
    def ball_to_goal(field: Field) -> Potential:
        """How much nearer the ball is to the goal attacked than to the own one, halved."""

    @staticmethod
    def behind_ball(field: Field, behind: float) -> Potential:
        """How near the robot is to the point so far behind the ball, seen from the goal attacked.

        That point is kept as far from the walls: a ball at the wall has no room behind it.

        Raises:
            ValueError: a distance that is not above 0.
        """

    @staticmethod
    def at_mouth(robot: RobotModel, ball: BallModel) -> Potential:
        """How near the ball is to where it would be in the robot's mouth.

        Raises:
            ValueError: a robot that has none.
        """

    def gained(
        self,
        last_ball: NDArray[np.float32],
        last_robots: NDArray[np.float32],
        ball: NDArray[np.float32],
        robots: NDArray[np.float32],
    ) -> NDArray[np.float32]:
        """What each seer gained from one view to the next, (n, seers) metres.

        Views as `Viewpoint.fill` writes them.

        Raises:
            TypeError: an array that is not float32.
            ValueError: an array of another shape.
        """

def nearest(rows: NDArray[np.float32], n_blue: int, seers: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether each seer is its team's nearest to the ball, (n, seers).

    Of `rows` (n, row), whose first `n_blue` robots are a team; `seers` are robots by their place.

    Raises:
        TypeError: rows that are not float32, or seers that are no places.
        ValueError: arrays of other shapes, or a seer that there is not.
    """

def efforts(actions: NDArray[np.float32], seers: NDArray[np.intp]) -> NDArray[np.float32]:
    """Mean magnitude of the action of each seer, (n, seers); of `actions` (n, robots, action).

    Raises:
        TypeError: actions that are not float32, or seers that are no places.
        ValueError: arrays of other shapes, or a seer that there is not.
    """

def limit(numbers: NDArray[np.float32], most: NDArray[np.float32]) -> None:
    """Clip `numbers` (n, seers, o) to [-most, most] in place; `most` (o,).

    Raises:
        TypeError: an array that is not float32.
        ValueError: arrays of other shapes, one that cannot be written into, or a bound below 0.
    """

def clipped(value: object, shape: tuple[int, ...]) -> NDArray[np.float32] | None:
    """A copy clipped to [-1, 1], if `value` is a finite float32 array of that shape; else None."""

@final
class Sight:
    """What robots like `robot` see on `field`, of a side with room for so many mates and foes.

    In half lengths of the field and top speeds of a robot. `ball`: place and velocity, in the plane
    or, for robots with a break beam, in space. `me`, `mates`, `foes`: x, y, cos, sin, velocity,
    turn rate, and the beam where there is one. `ball_from_me`, `goal_from_me`: distance, cosine and
    sine of the bearing. `shot`: bearing of the goal from the ball; how near the ball is, 1 falling
    to 0; the latter times 1 where ball and goal lie in one direction, -1 where in opposite ones.
    `motion_from_me`: own velocity and the ball's, ahead and left. `places_from_me`: ball, mates,
    foes, likewise.

    Raises:
        ValueError: a number of mates or foes below 0.
    """

    def __new__(cls, field: Field, robot: RobotModel, n_mates: int, n_foes: int) -> Sight: ...
    @property
    def blocks(self) -> tuple[tuple[str, tuple[int, ...]], ...]:
        """Name and shape of each block, in order."""

    def look(
        self, ball: NDArray[np.float32], robots: NDArray[np.float32], room: int = 0
    ) -> NDArray[np.float32]:
        """All blocks side by side, a new array (n, seers, numbers + room).

        Of views: `ball` (n, seers, ball column) and `robots` (n, seers, slots, robot column) of me,
        mates and foes, attacking +x; zeros where nobody is. The last `room` numbers are zero, for
        the caller to write.

        Raises:
            TypeError: an array that is not float32.
            ValueError: an array of another shape, or a room below 0.
        """

    def __reduce__(self) -> tuple[object, tuple[Field, RobotModel, int, int]]: ...

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
        self,
        worlds: NDArray[np.bool_],
        rows: NDArray[np.float32],
        out: NDArray[np.float32],
        params: NDArray[np.float32] | None = None,
    ) -> None:
        """Start new matches in the worlds of a mask (n,).

        `rows` (number of True, row) says where; positions, headings, velocities and the ball's spin
        count. The rows of the placed worlds, as they now read, are written into `out` (n, row).
        `params` (number of True, parameters) are factors on the models' numbers for these worlds:
        `BALL_PARAMETERS`, then `ROBOT_PARAMETERS` of each robot. Without them the models count.

        Raises:
            ValueError: bodies in each other or outside, wrong shapes. Nothing has changed.
            TypeError: wrong types.
        """

    def reposition_balls(
        self,
        worlds: NDArray[np.bool_],
        balls: NDArray[np.float32],
        out: NDArray[np.float32],
    ) -> None:
        """Put the balls of the worlds of a mask (n,) elsewhere; all else of their matches goes on.

        `balls` (number of True, ball columns) says where; position, velocity and spin count. Nobody
        has touched them there, and they have crossed nothing. The rows of these worlds, as they now
        read, are written into `out` (n, row).

        Raises:
            ValueError: a ball in a robot or outside, or a world that became non-finite before; the
                world is named. Wrong shapes. Nothing has changed.
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
        most that it can. A robot with a shorter command reads the first columns. Rows go into
        `out` (n, row); those of worlds outside the mask `active` (n,) stay as they are.

        Raises:
            ValueError: wrong shapes or values that are not finite. Nothing has moved.
            TypeError: wrong types.
            RuntimeError: the states of some worlds, which are named, became non-finite, or had
                before. They are lost until `place`; the others have stepped, and their rows are
                written.
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

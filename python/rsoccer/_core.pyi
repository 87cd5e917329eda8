"""Compiled core of rsoccer: physics of robot soccer, and features of robots for tasks.

A state row has the ball's columns, then each robot's, blue first; the column names give every
position in a row. Positions are in meters, velocities in m/s, angles in radians. The origin is the
center of the field, x points at yellow's goal, y to the left, and blue attacks toward +x.
"""

from collections.abc import Sequence
from os import PathLike
from typing import ClassVar, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BALL_COLUMNS",
    "BALL_PARAMETERS",
    "COMMANDS",
    "COMMAND_COLUMNS",
    "CROSSINGS",
    "EVENT_KINDS",
    "GAME_COLUMNS",
    "GAME_FEATURES",
    "HAND_ERROR",
    "MAX_EVENTS",
    "MAX_PLACED_ANGULAR_VELOCITY",
    "MAX_PLACED_HEIGHT",
    "MAX_PLACED_SPEED",
    "MAX_PLACED_SPIN",
    "OFFENSES",
    "ROBOT_COLUMNS",
    "ROBOT_PARAMETERS",
    "SENSING_NUMBERS",
    "STAGES",
    "STATISTICS_COLUMNS",
    "TACTICS",
    "AreaShield",
    "AttackShield",
    "BallModel",
    "EgoFeatures",
    "Field",
    "Forecaster",
    "Potential",
    "Referee",
    "RobotModel",
    "ScriptedTeam",
    "Sensing",
    "SimConfig",
    "Simulator",
    "Steering",
    "Threads",
    "Viewpoint",
    "VisionTracker",
    "add_rewards",
    "build_info",
    "clip_actions",
    "clip_in_place",
    "golden_hashes",
    "mean_action_magnitude",
    "nearest_to_ball",
    "normal_inputs",
    "normalized",
    "pooled_moments",
    "random_words",
    "referee_preset",
    "referee_rules",
    "referee_values",
    "uniform",
    "write_clipped",
]

COMMANDS: dict[str, int]
"""Numbers of the referee's commands by name; below 100 those of the SSL game controller."""

STAGES: dict[str, int]
"""Numbers of the parts of a match by name, those of the SSL game controller."""

EVENT_KINDS: dict[str, int]
"""Numbers of the kinds of events by name, those of the SSL game controller."""

OFFENSES: tuple[int, ...]
"""Kinds of events that are offenses, in the order of the columns `offenses` of the statistics."""

HAND_ERROR: float
"""Error of the places of VSSS robots at the restarts of match tasks, m: assumed for robots that
people put there by eye."""

MAX_EVENTS: int
"""Greatest number of events that are listed for one match in one step."""

GAME_COLUMNS: tuple[str, ...]
"""Names of the columns of a match's state under a referee. Times are in control steps."""

TACTICS: tuple[tuple[str, float, float, float], ...]
"""Numbers by which the scripted SSL side plays: name, default, least and greatest value of each.
`crates/rsim-teams/src/tactics.rs` describes them."""

STATISTICS_COLUMNS: tuple[str, ...]
"""Names of the columns of a match's statistics, since it began."""

GAME_FEATURES: tuple[str, ...]
"""Names of the numbers that a robot observes of a match's state."""

MAX_PLACED_ANGULAR_VELOCITY: float
"""Maximum angular velocity with which a robot can be placed, rad/s."""

MAX_PLACED_HEIGHT: float
"""Maximum height at which the ball can be placed, m."""

MAX_PLACED_SPEED: float
"""Maximum speed with which a body can be placed, m/s."""

MAX_PLACED_SPIN: float
"""Maximum spin with which the ball can be placed, rad/s."""

BALL_COLUMNS: tuple[str, ...]
"""Names of the ball's columns in a state row.

| column | meaning | unit | range |
| --- | --- | --- | --- |
| `x`, `y` | position of the center | m | within the walls |
| `z` | height of the lowest point | m | 0 or above |
| `v_x`, `v_y`, `v_z` | velocity | m/s | any |
| `spin_x`, `spin_y`, `spin_z` | spin about the field's axes | rad/s | any |
| `last_touch` | index of the last robot that touched the ball | 1 | -1 for none |
| `crossed` | first line crossed in the last control step | 1 | index in `CROSSINGS` |
| `crossed_x`, `crossed_y`, `crossed_z` | point of that crossing | m | 0 for none |
| `seconds_since_touch` | time since the last touch by a robot | s | 0 or above |
| `speed_after_touch` | speed of the ball right after it, in three dimensions | m/s | 0 or above |
| `height_since_touch` | greatest `z` since it | m | 0 or above |

The last three are 0 where no robot has touched the ball since it was placed. The time is 0 while a
robot keeps the ball; the speed of a kick is that at the end of its physics tick.
"""
ROBOT_COLUMNS: tuple[str, ...]
"""Names of a robot's columns in a state row.

| column | meaning | unit | range |
| --- | --- | --- | --- |
| `x`, `y` | position of the center | m | within the walls if not absent |
| `cos`, `sin` | heading, counterclockwise from +x | 1 | -1 to 1 |
| `v_x`, `v_y` | velocity | m/s | any |
| `v_theta` | angular velocity, counterclockwise | rad/s | any |
| `infrared` | whether the ball cuts the break beam | 1 | 0 or 1 |
| `touched_ball` | whether it touched the ball in the last control step | 1 | 0 or 1 |
| `touched_opponent` | whether it touched an opponent in that step | 1 | 0 or 1 |
| `collision_speed` | closing speed of its hardest robot contact in that step | m/s | 0 or above |
| `absent` | whether it is not on the field | 1 | 0 or 1 |

`v_theta` is the name of the column of the angular velocity only, beside `v_x` and `v_y`.

An absent robot rests behind its own goal, beyond all walls. It meets nothing, and its commands are
ignored. `Simulator.place`, `restart` and `reposition_robots` take robots off the field and put them
on it.
"""
COMMAND_COLUMNS: dict[str, tuple[str, ...]]
"""Names of a command's columns, by kind of drive. Values beyond a robot's limits are clipped.

| drive | columns | meaning | unit |
| --- | --- | --- | --- |
| `differential` | `left`, `right` | wheel speeds, positive is forward | rad/s |
| `omni` | `v_x`, `v_y` | velocity forward and to the left | m/s |
| | `v_theta` | angular velocity, counterclockwise | rad/s |
| `omni_wheels` | `wheel_0` to `wheel_3` | wheel speeds, positive turns counterclockwise | rad/s |
| both omni | `kick_v_x`, `kick_v_z` | kick forward and upward from the front; 0: none | m/s |
| both omni | `dribbler` | dribbler speed by its maximum, 0 to 1 | 1 |
"""
CROSSINGS: tuple[str, ...]
"""Names of the values of the ball's `crossed` column: `none`, the goals at +x (right) and -x
(left), the goal lines beside or above the goals, the touch lines at +y (left) and -y (right)."""
BALL_PARAMETERS: tuple[str, ...]
"""Names of the factors on the ball's numbers that each world can have of its own.

`hop` applies to `vertical_restitution`, `wall_restitution` and `wall_friction` also to the back of
a goal, the others to the numbers of their names. Restitutions are capped at 1. Factors
are 0 or above, that of `mass` above 0."""
SENSING_NUMBERS: tuple[str, ...]
"""Names of the numbers of `Sensing`, in the order of `Simulator.begin_senses`."""
ROBOT_PARAMETERS: tuple[str, ...]
"""Names of the factors on each robot's numbers that each world can have of its own.

`acceleration` applies to all accelerations and decelerations; `traction` to the maximum force of
the wheels in every direction (omnidirectional) or along the axle (differential); `kick` to the
speed of kicks; `grip` to the dribbler's; `speed` to the maximum speeds. Factors are above 0."""

def build_info() -> dict[str, str | int]:
    """Return information about this build.

    Returns:
        `version` of the package, `profile` ("release" or "debug"), `physics` version (int).
    """

def golden_hashes() -> dict[str, str]:
    """Play the golden scenes, and return the hashes of their states.

    All builds of a physics version on all platforms have the hashes of
    `crates/rsim-core/tests/golden.txt`.

    Returns:
        Hash by name of scene and engine, 16 hexadecimal digits.
    """

@final
class Field:
    """A field: play area, goals, walls, and the lines and marks on the floor.

    All lengths are in meters, measured to the middle of lines. The origin is the center, x is along
    the length. A number that a league does not use is 0.

    Example:
        `Field("ssl_b", width=5.0)` is the preset with one number replaced.

    Args:
        name: Name of a preset, one of `PRESETS`, or path of a .json file for `from_json`, each also
            with numbers behind it, as in "NAME, number=0.1".
        **numbers: Numbers that replace those of the preset, by the names of the properties.

    Raises:
        FileNotFoundError: no such file.
        TypeError: a name or a number of another type.
        ValueError: `name` is no preset, a number has no such name, or it is out of its range; the
            message names it.
    """

    PRESETS: ClassVar[tuple[str, ...]]
    """Names of the presets."""

    def __new__(cls, name: str | PathLike[str], **numbers: float) -> Field: ...
    @property
    def name(self) -> str:
        """Name of the preset."""

    @property
    def length(self) -> float:
        """Distance between the goal lines, along x (m, above 0)."""

    @property
    def width(self) -> float:
        """Distance between the touch lines, along y (m, above 0)."""

    @property
    def goal_line_margin(self) -> float:
        """Distance from a goal line to the wall behind it; 0 at the wall (m, 0 or above)."""

    @property
    def touch_line_margin(self) -> float:
        """Distance from a touch line to the wall beside it; 0 at the wall (m, 0 or above)."""

    @property
    def goal_width(self) -> float:
        """Inner width of a goal, along y (m, above 0)."""

    @property
    def goal_depth(self) -> float:
        """Depth of a goal behind its line, along x (m, above 0)."""

    @property
    def goal_height(self) -> float:
        """Height of a goal, below its crossbar if it has one (m, above 0)."""

    @property
    def goal_wall_thickness(self) -> float:
        """Thickness of a goal's own walls and crossbar; 0 without them (m, 0 or above)."""

    @property
    def corner_leg(self) -> float:
        """Leg of the 45-degree block in each corner; 0 for none (m, 0 or above)."""

    @property
    def wall_height(self) -> float:
        """Height of the outer walls; 0 for walls that no ball can fly over (m, 0 or above)."""

    @property
    def center_circle_radius(self) -> float:
        """Radius of the center circle (m, 0 or above)."""

    @property
    def goal_area_width(self) -> float:
        """Width of the goal area (SSL: defense area), along y (m, 0 or above)."""

    @property
    def goal_area_depth(self) -> float:
        """Depth of the goal area, along x (m, 0 or above)."""

    @property
    def inner_area_width(self) -> float:
        """Width of the smaller area inside the goal area, along y (m, 0 or above)."""

    @property
    def inner_area_depth(self) -> float:
        """Depth of the smaller area inside the goal area, along x (m, 0 or above)."""

    @property
    def area_arc_width(self) -> float:
        """Chord of the arc on the front of the goal area, along y (m, 0 or above)."""

    @property
    def area_arc_depth(self) -> float:
        """Depth of the arc beyond the front of the goal area, along x (m, 0 or above)."""

    @property
    def penalty_mark_distance(self) -> float:
        """Distance of a penalty mark from the attacked goal line (m, 0 or above)."""

    @property
    def free_ball_x(self) -> float:
        """Distance of the free-ball marks from the center, along x (m, 0 or above)."""

    @property
    def free_ball_y(self) -> float:
        """Distance of the free-ball marks from the center, along y (m, 0 or above)."""

    @property
    def line_width(self) -> float:
        """Width of the painted lines (m, 0 or above)."""

    @property
    def half_length(self) -> float:
        """Distance of a goal line from the center (m, above 0)."""

    @property
    def half_width(self) -> float:
        """Distance of a touch line from the center (m, above 0)."""

    @property
    def max_x(self) -> float:
        """Maximum distance of a body from the center along x (m, above 0)."""

    @property
    def max_y(self) -> float:
        """Maximum distance of a body from the center along y (m, above 0)."""

    @property
    def max_robots(self) -> int:
        """Maximum number of robots per team that the league allows on any of its fields."""

    def to_json(self) -> str:
        """Return the model as JSON, for `from_json`."""

    @classmethod
    def from_json(cls, text: str) -> Field:
        """Return the model of a JSON text.

        Args:
            text: Result of `to_json`; a preset with the numbers that differ, such as
                `{"preset": "NAME", "mass": 0.2}`; or an object that has one of these as `field`.

        Returns:
            An equal model.

        Raises:
            ValueError: `text` is not JSON of such a model, or a number is out of its range.
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class BallModel:
    """A ball with the floor that it rolls on and the surfaces that it hits.

    SI units. The numbers describe a venue as much as a ball.

    Example:
        `BallModel("ssl_tigers", rolling_deceleration=0.3)` is the preset with one number replaced.

    Args:
        name: Name of a preset, one of `PRESETS`, or path of a .json file for `from_json`, each also
            with numbers behind it, as in "NAME, number=0.1".
        **numbers: Numbers that replace those of the preset, by the names of the properties.

    Raises:
        FileNotFoundError: no such file.
        TypeError: a name or a number of another type.
        ValueError: `name` is no preset, a number has no such name, or it is out of its range; the
            message names it.
    """

    PRESETS: ClassVar[tuple[str, ...]]
    """Names of the presets."""

    def __new__(cls, name: str | PathLike[str], **numbers: float) -> BallModel: ...
    @property
    def name(self) -> str:
        """Name of the preset."""

    @property
    def radius(self) -> float:
        """Radius (m, above 0)."""

    @property
    def mass(self) -> float:
        """Mass (kg, above 0)."""

    @property
    def sliding_deceleration(self) -> float:
        """Deceleration while the lowest point slips over the floor (m/s², 0 or above)."""

    @property
    def rolling_deceleration(self) -> float:
        """Deceleration of a rolling ball; without drag, 0 never stops it (m/s², 0 or above)."""

    @property
    def rolling_drag(self) -> float:
        """Further deceleration of a rolling ball by its speed (1/s, 0 or above)."""

    @property
    def slide_to_roll_ratio(self) -> float:
        """First rolling speed by the speed of the kick; 5/7 for a solid sphere (0.5 to below 1)."""

    @property
    def spin_deceleration(self) -> float:
        """Deceleration of the spin about the vertical axis (rad/s², 0 or above)."""

    @property
    def first_hop_factor(self) -> float:
        """Part of the horizontal speed kept at the first touch-down of a chip (0 to 1)."""

    @property
    def later_hop_factor(self) -> float:
        """Part of the horizontal speed kept at each later touch-down (0 to 1)."""

    @property
    def vertical_restitution(self) -> float:
        """Restitution of the vertical speed at a touch-down (0 to 1)."""

    @property
    def robot_restitution(self) -> float:
        """Restitution against robots (0 to 1)."""

    @property
    def robot_friction(self) -> float:
        """Coulomb friction against robots (0 or above)."""

    @property
    def wall_restitution(self) -> float:
        """Restitution against walls and the sides of goals (0 to 1)."""

    @property
    def wall_friction(self) -> float:
        """Coulomb friction against walls and the sides of goals (0 or above)."""

    @property
    def goal_back_restitution(self) -> float:
        """Restitution against the padded back of a goal (0 to 1)."""

    @property
    def goal_back_friction(self) -> float:
        """Coulomb friction against the back of a goal (0 or above)."""

    def to_json(self) -> str:
        """Return the model as JSON, for `from_json`."""

    @classmethod
    def from_json(cls, text: str) -> BallModel:
        """Return the model of a JSON text.

        Args:
            text: Result of `to_json`; a preset with the numbers that differ, such as
                `{"preset": "NAME", "mass": 0.2}`; or an object that has one of these as `ball`.

        Returns:
            An equal model.

        Raises:
            ValueError: `text` is not JSON of such a model, or a number is out of its range.
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class RobotModel:
    """A robot: body, drive, and mouth if it has one.

    SI units. A number that this kind of robot does not have raises `AttributeError`: square bodies
    have a `side_length`, round ones a `radius` and a `front_distance`; each kind of drive has its
    own numbers; only robots with a mouth have a break beam, a kicker and a dribbler.

    Example:
        `RobotModel("ssl_generic", max_kick_speed=6.5)` is the preset with one number replaced.

    Args:
        name: Name of a preset, one of `PRESETS`, or path of a .json file for `from_json`, each also
            with numbers behind it, as in "NAME, number=0.1".
        **numbers: Numbers that replace those of the preset, by the names of the properties.

    Raises:
        FileNotFoundError: no such file.
        TypeError: a name or a number of another type.
        ValueError: `name` is no preset, a number has no such name, or it is out of its range; the
            message names it.
    """

    PRESETS: ClassVar[tuple[str, ...]]
    """Names of the presets."""

    def __new__(cls, name: str | PathLike[str], **numbers: float) -> RobotModel: ...
    @property
    def name(self) -> str:
        """Name of the preset."""

    @property
    def height(self) -> float:
        """Height of the body; a ball that flies higher passes over it (m, above 0)."""

    @property
    def mass(self) -> float:
        """Mass with wheels; heavier robots win shoving matches (kg, above 0)."""

    @property
    def restitution(self) -> float:
        """Restitution against robots or walls (0.2), as the mean of both (0 to 1)."""

    @property
    def friction(self) -> float:
        """Coulomb friction against robots or walls (0.2), as the mean of both (0 or above)."""

    @property
    def side_length(self) -> float:
        """Side of a square body (m, above 0)."""

    @property
    def radius(self) -> float:
        """Radius of a round body (m, above 0)."""

    @property
    def front_distance(self) -> float:
        """Distance of a round body's flat front from the center (m, above 0)."""

    @property
    def wheel_radius(self) -> float:
        """Radius of a wheel (m, above 0)."""

    @property
    def max_wheel_speed(self) -> float:
        """Maximum speed of a wheel, free of load (rad/s, above 0)."""

    @property
    def track_width(self) -> float:
        """Effective distance between the two wheels (m, above 0)."""

    @property
    def motor_torque(self) -> float:
        """Torque of a motor at its wheel (N m, above 0)."""

    @property
    def longitudinal_grip(self) -> float:
        """Maximum acceleration that the tires transmit along the wheels (m/s², above 0)."""

    @property
    def lateral_grip(self) -> float:
        """Maximum acceleration that the tires transmit along the axle (m/s², above 0)."""

    @property
    def tipping_friction(self) -> float:
        """Friction of a tipping body, divided by that of its tires; 0 for none (0 to 1)."""

    @property
    def skid_slip(self) -> float:
        """Slip of both braking tires beyond which a robot skids; 0: never (m/s, 0 or above)."""

    @property
    def wheel_distance(self) -> float:
        """Distance from the center to the point where a wheel meets the floor (m, above 0)."""

    @property
    def max_speed(self) -> float:
        """Maximum speed in every direction (m/s, above 0)."""

    @property
    def max_angular_velocity(self) -> float:
        """Maximum angular velocity (rad/s, above 0)."""

    @property
    def max_acceleration(self) -> float:
        """Maximum acceleration when the robot gets faster or turns aside (m/s², above 0)."""

    @property
    def max_deceleration(self) -> float:
        """Maximum deceleration when the robot gets slower (m/s², above 0)."""

    @property
    def max_angular_acceleration(self) -> float:
        """Maximum angular acceleration when the robot turns faster (rad/s², above 0)."""

    @property
    def max_angular_deceleration(self) -> float:
        """Maximum angular deceleration when the robot turns more slowly (rad/s², above 0)."""

    @property
    def max_traction(self) -> float:
        """Maximum acceleration that the wheels transmit, also in pushing (m/s², above 0)."""

    @property
    def max_jerk(self) -> float:
        """Maximum change of the acceleration along the path; 0 for no limit (m/s³, 0 or above)."""

    @property
    def mouth_width(self) -> float:
        """Width of the opening; the ball's center must be within it (m, above 0)."""

    @property
    def beam_distance(self) -> float:
        """Distance of the break beam before the front (m, above 0)."""

    @property
    def beam_height(self) -> float:
        """Height of the break beam over the floor (m, above 0)."""

    @property
    def max_kick_speed(self) -> float:
        """Maximum speed of a kick along the floor; rules may allow less (m/s, 0 or above)."""

    @property
    def max_chip_speed(self) -> float:
        """Maximum speed of a chip; rules may allow less (m/s, 0 or above)."""

    @property
    def kicker_recharge_time(self) -> float:
        """Minimum time between two kicks (s, 0 or above)."""

    @property
    def kicker_reach(self) -> float:
        """Gap between front and ball up to which the kicker reaches it (m, 0 or above)."""

    @property
    def kick_lateral_factor(self) -> float:
        """Part of the ball's speed across the front kept in a kick (0 to 1)."""

    @property
    def dribbler_grip(self) -> float:
        """Maximum force of the dribbler; beyond it the ball is lost (N, 0 or above)."""

    @property
    def dribbler_force(self) -> float:
        """Force of the dribbler bar on the ball; its friction gives back-spin (N, 0 or above)."""

    @property
    def dribbler_speed(self) -> float:
        """Surface speed of the dribbler bar, the target of the back-spin (m/s, 0 or above)."""

    @property
    def dribbler_restitution(self) -> float:
        """Restitution of the mouth while the dribbler runs (0 to 1)."""

    @property
    def dribbler_friction(self) -> float:
        """Coulomb friction of the dribbler bar (0 or above)."""

    @property
    def bounding_radius(self) -> float:
        """Radius of the circle around the body (m, above 0)."""

    @property
    def top_speed(self) -> float:
        """Maximum driving speed (m/s, above 0)."""

    @property
    def top_angular_velocity(self) -> float:
        """Maximum angular velocity on the spot (rad/s, above 0)."""

    @property
    def has_mouth(self) -> bool:
        """Whether the robot has break beam, kicker and dribbler."""

    @property
    def drive(self) -> str:
        """Kind of drive, a key of `COMMAND_COLUMNS`."""

    @property
    def wheel_angles(self) -> list[float]:
        """Positions of four wheels (degrees from the front, counterclockwise, 0 to 360)."""

    @property
    def command_columns(self) -> tuple[str, ...]:
        """Names of the columns of a command."""

    def to_json(self) -> str:
        """Return the model as JSON, for `from_json`."""

    @classmethod
    def from_json(cls, text: str) -> RobotModel:
        """Return the model of a JSON text.

        Args:
            text: Result of `to_json`; a preset with the numbers that differ, such as
                `{"preset": "NAME", "mass": 0.2}`; or an object that has one of these as `robot`.

        Returns:
            An equal model.

        Raises:
            ValueError: `text` is not JSON of such a model, or a number is out of its range.
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class Sensing:
    """Senses and commands of robots: noise, delay and loss of what they know and do.

    Cameras above the field see all robots and the ball; a frame of theirs arrives after a delay,
    and a tracker estimates positions and velocities. Errors named noise are drawn for each
    detection, those named error once for an episode. All are normal distributions, whose standard
    deviations are given, unless a number says otherwise. A camera at a height sees a flying ball
    where its ray meets the floor, and no ball that a robot hides. SI units. Both teams know the
    same.

    Robots know no touches, collisions and lines crossed, and a camera at a height tells no height
    of the ball. Presets: "none", ER-Force's "friendly", "rc2021" and "realistic", and "vsss".

    Example:
        `Sensing("rc2021", delay=0.1)` is the preset with one number replaced; `Sensing(delay=0.1)`
        is exact but late.

    Args:
        name: Name of a preset, one of `PRESETS`, or path of a .json file for `from_json`, each also
            with numbers behind it, as in "rc2021, delay=0.1"; "none" by default, and before numbers
            alone.
        **numbers: Numbers that replace those of the preset, by the names of the properties;
            `position_noise` and `missing` are those of the ball and of robots together.

    Raises:
        FileNotFoundError: no such file.
        TypeError: a name or a number of another type.
        ValueError: `name` is no preset, a number has no such name, or it is out of its range; the
            message names it.
    """

    PRESETS: ClassVar[tuple[str, ...]]
    """Names of the presets."""

    def __new__(cls, name: str | PathLike[str] | None = None, **numbers: float) -> Sensing: ...
    @classmethod
    def preset(cls, name: str) -> Sensing:
        """Return the preset of a name.

        Args:
            name: One of `PRESETS`.

        Raises:
            ValueError: An unknown name.
        """

    @property
    def name(self) -> str:
        """Name of the preset."""

    @property
    def is_off(self) -> bool:
        """Whether robots know the true state and obey exactly."""

    @property
    def frame_rate(self) -> float:
        """Frame rate of the cameras; 0 for a frame in each control step (Hz, 0 or above)."""

    @property
    def delay(self) -> float:
        """Time from the exposure of a frame to its arrival (s, 0 or above)."""

    @property
    def delay_jitter(self) -> float:
        """Maximum deviation, at most that time. Frames keep their order (s, 0 or above)."""

    @property
    def frame_loss(self) -> float:
        """Probability that a frame is lost (0 to 1)."""

    @property
    def ball_position_noise(self) -> float:
        """Noise of the ball's detected position, in each direction (m, 0 or above)."""

    @property
    def robot_position_noise(self) -> float:
        """Noise of a robot's detected position, in each direction (m, 0 or above)."""

    @property
    def heading_noise(self) -> float:
        """Noise of a robot's detected heading (rad, 0 or above)."""

    @property
    def misread_headings(self) -> float:
        """Probability that a heading is misread by 90 degrees (0 to 1)."""

    @property
    def missing_balls(self) -> float:
        """Probability that a camera misses the ball in a frame (0 to 1)."""

    @property
    def missing_robots(self) -> float:
        """Probability that a camera misses a robot in a frame (0 to 1)."""

    @property
    def ghost_balls(self) -> float:
        """Rate of balls that a camera wrongly sees at a robot's mouth (1/s, 0 or above)."""

    @property
    def camera_height(self) -> float:
        """Height of the cameras; 0 for one that looks straight down everywhere (m, 0 or above)."""

    @property
    def visible_part(self) -> float:
        """Part of the ball that a camera must see to detect it (0 to 1)."""

    @property
    def cameras_along(self) -> float:
        """Number of cameras along the field; 0 is 1 (0 or above)."""

    @property
    def cameras_across(self) -> float:
        """Number of cameras across the field; 0 is 1 (0 or above)."""

    @property
    def camera_overlap(self) -> float:
        """Width of the strip that two neighboring cameras both see (m, 0 or above)."""

    @property
    def camera_offset_error(self) -> float:
        """Error of all positions of a camera, in each direction (m, 0 or above)."""

    @property
    def own_cameras(self) -> float:
        """1 for cameras of each team's own, 0 for the same that both teams see by (0 to 1)."""

    @property
    def tracker(self) -> float:
        """1 to filter detections, 0 to take each with its true velocity (0 to 1)."""

    @property
    def feedback_delay(self) -> float:
        """Time from a robot's own measurement to its arrival (s, 0 or above)."""

    @property
    def feedback_loss(self) -> float:
        """Probability that a report of a robot's own sensors is lost (0 to 1)."""

    @property
    def beam_misses(self) -> float:
        """Probability in a control step that a break beam misses the ball (0 to 1)."""

    @property
    def beam_false_alarms(self) -> float:
        """Probability in a control step of a break beam's false alarm (0 to 1)."""

    @property
    def odometry(self) -> float:
        """1 to know velocities from wheels and gyroscopes, 0 from cameras (0 to 1)."""

    @property
    def odometry_noise(self) -> float:
        """Noise of a robot's own velocity by its wheels, in each direction (m/s, 0 or above)."""

    @property
    def gyroscope_noise(self) -> float:
        """Noise of a robot's own angular velocity by its gyroscope (rad/s, 0 or above)."""

    @property
    def gyroscope_error(self) -> float:
        """Error of the gyroscope's zero (rad/s, 0 or above)."""

    @property
    def command_delay(self) -> float:
        """Mean time from a command to its arrival, at the start of a tick (s, 0 or above)."""

    @property
    def command_jitter(self) -> float:
        """Maximum deviation, at most that time. Commands keep their order (s, 0 or above)."""

    @property
    def command_loss(self) -> float:
        """Probability that a robot misses a command, and keeps the last (0 to 1)."""

    @property
    def command_timeout(self) -> float:
        """Time after which a robot that has heard no command stops; 0 for never (s, 0 or above)."""

    @property
    def wheel_error(self) -> float:
        """Error of the speed of each wheel, as a part of it (0 to 1)."""

    @property
    def wheel_dead_zone(self) -> float:
        """Commanded speed of a wheel's rim below which the wheel stands (m/s, 0 or above)."""

    @property
    def kick_speed_noise(self) -> float:
        """Noise of the speed of a kick, as a part of it (0 to 1)."""

    @property
    def kick_direction_noise(self) -> float:
        """Noise of the direction of a kick (rad, 0 or above)."""

    @property
    def kick_failures(self) -> float:
        """Probability that a kicker does not obey a command (0 to 1)."""

    @property
    def dribbler_failures(self) -> float:
        """Probability that a dribbler does not obey a command (0 to 1)."""

    @property
    def battery_sag(self) -> float:
        """Part of top and kick speeds lost in a second, down to half (1/s, 0 or above)."""

    @property
    def forecast(self) -> float:
        """1 to know the state in which the next commands act, by a forecast (0 to 1)."""

    @property
    def forecast_others(self) -> float:
        """1 if a forecast knows the commands of both teams, 0 for a team's own (0 to 1)."""

    def to_json(self) -> str:
        """Return name and numbers as JSON."""

    @classmethod
    def from_json(cls, text: str) -> Sensing:
        """Return the senses of a JSON text.

        Args:
            text: Result of `to_json`; a preset's name with the numbers that differ, such as
                `{"preset": "rc2021", "delay": 0.1}`; or an object that has one of these as
                `sensing`.

        Raises:
            ValueError: Another text, or a number out of its range.
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class SimConfig:
    """Configuration of a simulator: field, models, team sizes, time steps. Immutable and hashable.

    Robot and ball default to those of the league that has a field of that name, whatever its
    numbers: `vss_440rpm` and `vss_rsim`, or `ssl_generic` and `ssl_tigers`.

    Args:
        field: Field, the name of its preset, or the path of a .json file.
        n_blue: Number of blue robots, from 0 to the field's `max_robots`.
        n_yellow: Number of yellow robots, from 0 to the field's `max_robots`.
        robot: Model of all robots, or a sequence with one model for each robot, blue first; models,
            names of presets, or paths of .json files. None for the league's default.
        ball: Ball, the name of its preset, or the path of a .json file. None for the league's
            default.
        time_step: Length of a control step, s; a whole multiple of `tick`, 1 to 1000 ticks.
        tick: Length of a physics tick, s; above 0 and at most 0.005.
        engine: Solver of contacts: "compact" is made for few bodies, "rapier" is the slower
            reference.
        sensing: What robots know and how they obey, the name of its preset, or the path of a .json
            file. None if they know the true state and obey exactly.

    Raises:
        FileNotFoundError: No such file.
        TypeError: An argument of another type.
        ValueError: A name is no preset or no engine, there are more robots than the league allows,
            a sequence of robots has another length, a time is out of its range, or a field of no
            known league needs a default.
    """

    def __new__(
        cls,
        field: str | PathLike[str] | Field = "vss_3v3",
        n_blue: int = 3,
        n_yellow: int = 3,
        *,
        robot: str
        | PathLike[str]
        | RobotModel
        | Sequence[str | PathLike[str] | RobotModel]
        | None = None,
        ball: str | PathLike[str] | BallModel | None = None,
        time_step: float = 0.025,
        tick: float = 0.005,
        engine: str = "compact",
        sensing: str | PathLike[str] | Sensing | None = None,
    ) -> SimConfig: ...
    @property
    def field(self) -> Field:
        """The field."""

    @property
    def robots(self) -> tuple[RobotModel, ...]:
        """Models of all robots, blue first."""

    @property
    def robot(self) -> RobotModel:
        """Model of all robots; raises `ValueError` if they differ or there are none."""

    @property
    def ball(self) -> BallModel:
        """The ball."""

    @property
    def n_blue(self) -> int:
        """Number of blue robots."""

    @property
    def n_yellow(self) -> int:
        """Number of yellow robots."""

    @property
    def n_robots(self) -> int:
        """Number of robots of both teams."""

    @property
    def time_step(self) -> float:
        """Length of a control step (s, above 0)."""

    @property
    def tick(self) -> float:
        """Length of a physics tick (s, above 0, at most 0.005)."""

    @property
    def engine(self) -> str:
        """Solver of contacts, "rapier" or "compact"."""

    @property
    def sensing(self) -> Sensing | None:
        """Senses of the robots; None if they know the true state and obey exactly."""

    def with_sensing(self, sensing: Sensing | None) -> SimConfig:
        """Return the same configuration with other senses.

        Args:
            sensing: The senses; None for none.
        """

    @property
    def ticks_per_step(self) -> int:
        """Number of physics ticks in a control step (1 to 1000)."""

    @property
    def row_size(self) -> int:
        """Length of a state row."""

    @property
    def parameters_size(self) -> int:
        """Length of a world's row of parameters: the ball's, then each robot's."""

    @property
    def command_columns(self) -> tuple[str, ...]:
        """Names of a command's columns, of the longest command if robots differ."""

    def to_json(self) -> str:
        """Return the configuration as JSON, for `from_json`."""

    @classmethod
    def from_json(cls, text: str) -> SimConfig:
        """Return the configuration of a JSON text.

        Args:
            text: Result of `to_json`.

        Returns:
            An equal configuration.

        Raises:
            ValueError: `text` is not JSON of a configuration, or a value is out of its range.
        """

    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[object, tuple[str]]: ...

@final
class Referee:
    """Referee of matches with the same rules, field and robots.

    A match is a row of numbers with the columns `GAME_COLUMNS`. `matches` is a tuple of arrays of n
    matches that methods change in place: state (n, game) and statistics (n, statistics) float32,
    score (n, 2) int64, playing time left in the stage (n,) float32 in seconds, and whether each
    robot may touch the ball (n, robots) bool.

    Args:
        config: Field, ball, robots and time step.
        rules: Numbers and switches of the rules as JSON, such as `referee_preset` returns.

    Raises:
        ValueError: `rules` is no JSON of a configuration, has a number that is not finite or below
            0, or names a rule that does not exist.
    """

    def __new__(cls, config: SimConfig, rules: str) -> Referee: ...
    @staticmethod
    def new_game(kickoff: int) -> NDArray[np.float32]:
        """Return the state of a match that begins.

        Args:
            kickoff: Team with the first kick-off: 0 for blue, 1 for yellow.

        Returns:
            (game,) numbers.

        Raises:
            ValueError: `kickoff` is neither 0 nor 1.
        """

    def line_up(self, rows: NDArray[np.float32], seeds: Sequence[int]) -> None:
        """Put the ball, and all robots that are not absent, where matches begin.

        Args:
            rows: (n, row) state rows, changed in place.
            seeds: (n,) seeds of the errors of places, see `placement_error` of the rules; their
                lowest 24 bits count.

        Raises:
            TypeError: `rows` has another type.
            ValueError: `rows` has another shape, or `seeds` another length.
        """

    def begin(self, rows: NDArray[np.float32], matches: tuple[NDArray[np.generic], ...]) -> None:
        """Fit matches to the states from which play begins or goes on.

        Args:
            rows: (n, row) state rows.
            matches: Arrays of the matches, changed in place.

        Raises:
            TypeError: An array has another type.
            ValueError: An array has another shape, or a number that its column cannot have.
        """

    def judge(
        self,
        before: NDArray[np.float32],
        after: NDArray[np.float32],
        matches: tuple[NDArray[np.generic], ...],
        restart: NDArray[np.float32],
        threads: Threads | None = None,
    ) -> tuple[NDArray[np.bool_] | None, NDArray[np.float32] | None]:
        """Judge a step of each match.

        Args:
            before: (n, row) state rows before the step.
            after: (n, row) state rows after it.
            matches: Arrays of the matches, changed in place.
            restart: (n, row) output: state rows from which play goes on where it restarts.
            threads: Threads that share the work; None for the caller's alone.

        Returns:
            Matches in which play restarts, (n,), and events (k, 6) in the order of matches: match,
            kind, team, robot (-1 for none), position x and y in meters. None where there are none.

        Raises:
            TypeError: An array has another type.
            ValueError: An array has another shape, or a number that its column cannot have.
        """

    def features(
        self,
        game: NDArray[np.float32],
        rows: NDArray[np.float32],
        observers: Sequence[int],
        threads: Threads | None = None,
    ) -> NDArray[np.float32]:
        """Return what robots observe of the state of their matches.

        Args:
            game: (n, game) states of matches.
            rows: (n, row) state rows.
            observers: Indices of robots.
            threads: Threads that share the work; None for the caller's alone.

        Returns:
            (n, observers, features), with the names `GAME_FEATURES`.

        Raises:
            TypeError: An array has another type.
            ValueError: An array has another shape or a wrong number, or there is no such robot.
        """

@final
class AreaShield:
    """Shield that keeps VSSS robots out of goal areas in which the referee allows no more.

    With the ball in a goal area two robots of a team there are a foul, at either end, and a goal
    does not count after it. Where a robot would be one too many, the shield stops it before the
    area, or has it leave. On a field with two areas it is the smaller one, and the larger one has
    limits of its own. The limits are those of the league's presets, "vsss_3v3" and "vsss_5v5",
    whatever the rules of a match say.

    Args:
        config: Field and robots.

    Raises:
        ValueError: Robots without a differential drive.
    """

    def __new__(cls, config: SimConfig) -> AreaShield: ...
    def apply(
        self,
        rows: NDArray[np.float32],
        robots: Sequence[int],
        actions: NDArray[np.float32],
        threads: Threads | None = None,
    ) -> None:
        """Change the actions of robots that would be one too many in a goal area.

        Args:
            rows: (n, row) states as the robots know them.
            robots: (k,) indices of the robots in a state row.
            actions: (n, k, 2) speeds of the left and the right wheel, -1 to 1; changed in place.
            threads: Threads that share the work.

        Raises:
            TypeError: Arrays of other types.
            ValueError: Arrays of other shapes, or an index without a robot.
        """

@final
class AttackShield:
    """Shield that brakes SSL robots before what ends an episode of the attack challenges.

    These are opponents, the goal area that the team attacks, the lines of the field, and the
    robot's own half from 0.15 m behind the center line. The shield takes from a commanded velocity
    the part toward each of them from which the robot could not stop 0.02 m in front of it, with 0.7
    of its deceleration and 50 ms until the velocity acts. A robot that is too fast brakes before it
    turns aside; one that is too near leaves with up to 0.5 m/s. Opponents count as discs at rest.

    Args:
        config: Field and robots.

    Raises:
        ValueError: Robots without an omnidirectional drive, or more than a referee can see.
    """

    def __new__(cls, config: SimConfig) -> AttackShield: ...
    def apply(
        self,
        rows: NDArray[np.float32],
        robots: Sequence[int],
        actions: NDArray[np.float32],
        threads: Threads | None = None,
    ) -> None:
        """Change the velocities of robots that could not stop in time.

        Args:
            rows: (n, row) states as the robots know them.
            robots: (k,) indices of the robots in a state row.
            actions: (n, k, action) actions with at least two numbers, the velocity toward the
                attacked goal and to the left, -1 to 1; changed in place.
            threads: Threads that share the work.

        Raises:
            TypeError: Arrays of other types.
            ValueError: Arrays of other shapes, or an index without a robot.
        """

@final
class ScriptedTeam:
    """Scripted side of SSL matches with the same field, robots and ball.

    Args:
        config: Field, ball, robots and time step. The numbers of the first robot hold for all.
        skill: How well the side plays, 0 to 1.

    Raises:
        ValueError: Robots without an omnidirectional drive or a mouth, more than 11 a side, or a
            skill out of range.
    """

    def __new__(cls, config: SimConfig, skill: float) -> ScriptedTeam: ...
    @property
    def memory_size(self) -> int:
        """Numbers in a team's memory."""

    def begin(
        self,
        memory: NDArray[np.float32],
        seeds: Sequence[int],
        tactics: NDArray[np.float32] | None = None,
    ) -> None:
        """Set the memories of teams before their first step.

        Args:
            memory: (n, memory) memories, changed in place.
            seeds: n seeds of the sides' random numbers, 0 to 2**32 - 1.
            tactics: (n, tactics) numbers by which each side plays, in the order of `TACTICS`, which
                has name, default, least and greatest value of each; None for the defaults.

        Raises:
            OverflowError: A seed is out of range.
            TypeError: An array has another type.
            ValueError: An array has another shape, or a number of tactics is out of its range.
                Nothing has changed.
        """

    def commands(
        self,
        rows: NDArray[np.float32],
        game: NDArray[np.float32],
        memory: NDArray[np.float32],
        team: int,
        threads: Threads | None = None,
    ) -> NDArray[np.float32]:
        """Return the commands of a team's robots, and bring its memory up to date.

        Args:
            rows: (n, row) state rows.
            game: (n, game) states of matches, with the columns `GAME_COLUMNS`.
            memory: (n, memory) memories of the team, changed in place.
            team: 0 for blue, 1 for yellow.
            threads: Threads that share the work; None for the caller's alone.

        Returns:
            (n, robots, 6) commands of the team's robots, with the columns of `COMMAND_COLUMNS`
            for "omni"; zeros for absent robots.

        Raises:
            TypeError: An array has another type.
            ValueError: An array has another shape or a wrong number, or there is no such team.
        """

@final
class Steering:
    """Commands of omnidirectional robots from actions.

    | index | action, -1 to 1 | command at 1 |
    | --- | --- | --- |
    | 0, 1 | velocity along x and y of the chosen frame | `scales[0]`, `scales[1]` m/s |
    | 2 | angular velocity, counterclockwise | `scales[2]` rad/s |
    | 3 | kick along the floor; none up to 0 | `scales[3]` m/s |
    | 4 | dribbler; off up to 0, else on | dribbler speed `scales[4]`, 0 to 1 |

    Args:
        scales: Five commands at an action of 1, as in the table.
        field_frame: Whether velocities are along the axes of the field in the view of the robot's
            team; otherwise they are forward and to the left of the robot.
        n_blue: Number of robots of the first team; the others view the field rotated by 180
            degrees.

    Raises:
        ValueError: `scales` does not have five finite numbers, or `n_blue` is below 0.
    """

    def __new__(cls, scales: Sequence[float], field_frame: bool, n_blue: int) -> Steering: ...
    def commands(
        self,
        actions: NDArray[np.float32],
        rows: NDArray[np.float32],
        threads: Threads | None = None,
    ) -> NDArray[np.float32]:
        """Return the commands of actions.

        Args:
            actions: Actions (n, robots, 5), float32, each from -1 to 1.
            rows: State rows (n, row), float32, for the robots' headings.
            threads: Threads that share the work; None for the caller's alone.

        Returns:
            Commands (n, robots, 6), float32, with the columns `COMMAND_COLUMNS["omni"]`.

        Raises:
            TypeError: An array is not float32.
            ValueError: An array has another shape.
        """

    def __reduce__(self) -> tuple[object, tuple[list[float], bool, int]]: ...

@final
class Threads:
    """The caller's thread and its helpers, which share work on the rows of many worlds.

    Results do not depend on the number of threads. Threads work after a fork, and pickle as their
    number.

    Args:
        count: Number of threads, including the caller's, 1 to 1024.

    Raises:
        ValueError: `count` is out of its range.
    """

    def __new__(cls, count: int = 1) -> Threads: ...
    @property
    def count(self) -> int:
        """Number of threads, including the caller's."""

    def copy(self, source: NDArray[np.float32], out: NDArray[np.float32]) -> None:
        """Copy an array.

        Args:
            source: Values, float32.
            out: Output of the same shape, float32.

        Raises:
            TypeError: An array is not float32.
            ValueError: The shapes differ, or the output is not writeable or not C-contiguous.
        """

    def __reduce__(self) -> tuple[object, tuple[int]]: ...

@final
class Viewpoint:
    """Observers of a match: turns state rows into the views of robots, which attack toward +x.

    Args:
        n_robots: Number of robots in a row.
        slots: For each observer, indices of robots in a row, by slot: itself, teammates, opponents;
            None for an empty slot. All observers have equal numbers of slots.
        rotated: For each observer, whether its view is the field rotated by 180 degrees.

    Raises:
        ValueError: `slots` and `rotated` have different lengths, the observers have different
            numbers of slots, or an index is not below `n_robots`.
        OverflowError: An index or `n_robots` is below 0.
    """

    def __new__(
        cls, n_robots: int, slots: Sequence[Sequence[int | None]], rotated: Sequence[bool]
    ) -> Viewpoint: ...
    def fill(
        self,
        rows: NDArray[np.float32],
        ball: NDArray[np.float32],
        robots: NDArray[np.float32],
        rotated: NDArray[np.float32] | None = None,
    ) -> None:
        """Write the views of all observers.

        Args:
            rows: State rows (n, row), float32.
            ball: Output (n, observers, ball columns), float32.
            robots: Output (n, observers, slots, robot columns), float32. Columns of an empty slot
                and of an absent robot are 0, but for `absent`, which is 1.
            rotated: State rows as the observers on the rotated field know them, as `rows`. None for
                the same.

        Raises:
            TypeError: An array is not float32.
            ValueError: An array has another shape, or an output is not writeable or not
                C-contiguous.
        """

@final
class Potential:
    """A potential function for reward shaping, in meters.

    Rewards by differences of a potential do not change which policy is optimal: going back and
    forth gains nothing.
    """

    @staticmethod
    def ball_to_goal(field: Field) -> Potential:
        """Return the potential of the ball's position between the goals.

        Args:
            field: The field.

        Returns:
            Half the difference of the ball's distances to the own and to the attacked goal.
        """

    @staticmethod
    def behind_ball(field: Field, distance: float) -> Potential:
        """Return the potential of a robot's way to the point behind the ball.

        Args:
            field: The field. The point is kept `distance` away from its lines: a ball at the wall
                has no space behind it.
            distance: Distance of the point from the ball, opposite to the attacked goal, m, above
                0.

        Returns:
            The negative distance of the robot to that point.

        Raises:
            ValueError: `distance` is not above 0.
        """

    @staticmethod
    def at_mouth(robot: RobotModel, ball: BallModel) -> Potential:
        """Return the potential of the ball's distance to a robot's mouth.

        It is maximal only with the ball directly in front, so it pulls the robot close and turns it
        to face the ball.

        Args:
            robot: Model of the robot, with a mouth.
            ball: Model of the ball.

        Returns:
            The negative distance of the ball to its place in the mouth.

        Raises:
            ValueError: `robot` has no mouth.
        """

    def difference(
        self,
        viewpoint: Viewpoint,
        last_rows: NDArray[np.float32],
        rows: NDArray[np.float32],
        threads: Threads | None = None,
    ) -> NDArray[np.float32]:
        """Return the increase of the potential between two states, in the view of each observer.

        Args:
            viewpoint: The observers.
            last_rows: State rows of the earlier state (n, row), float32.
            rows: State rows of the later state (n, row), float32.
            threads: Threads that share the work; None for the caller's alone.

        Returns:
            Later minus earlier value (n, observers), float32, m; a new array.

        Raises:
            TypeError: An array is not float32.
            ValueError: An array has another shape.
        """

def nearest_to_ball(
    rows: NDArray[np.float32],
    n_blue: int,
    observers: NDArray[np.intp],
    threads: Threads | None = None,
) -> NDArray[np.bool_]:
    """Return whether each observer is its team's nearest robot to the ball.

    Args:
        rows: State rows (n, row), float32.
        n_blue: Number of robots of the first team in a row.
        observers: Indices of robots in a row (observers,).
        threads: Threads that share the work; None for the caller's alone.

    Returns:
        Flags (n, observers).

    Raises:
        TypeError: `rows` is not float32, or `observers` are not indices.
        ValueError: An array has another shape, or an index is not that of a robot.
    """

def mean_action_magnitude(
    actions: NDArray[np.float32],
    observers: NDArray[np.intp],
    threads: Threads | None = None,
) -> NDArray[np.float32]:
    """Return the mean magnitude of each observer's action.

    Args:
        actions: Actions (n, robots, action), float32.
        observers: Indices of robots (observers,).
        threads: Threads that share the work; None for the caller's alone.

    Returns:
        Means of absolute values (n, observers), float32.

    Raises:
        TypeError: `actions` is not float32, or `observers` are not indices.
        ValueError: An array has another shape, or an index is not that of a robot.
    """

def clip_in_place(values: NDArray[np.float32], bounds: NDArray[np.float32]) -> None:
    """Clip values to [-bounds, bounds] in place.

    Args:
        values: Values (n, observers, o), float32, C-contiguous and writeable.
        bounds: Bounds (o,), float32, each 0 or above.

    Raises:
        TypeError: An array is not float32.
        ValueError: An array has another shape, `values` is not writeable, or a bound is below 0.
    """

def write_clipped(
    values: NDArray[np.float32],
    bounds: NDArray[np.float32],
    out: NDArray[np.float32],
    first: int,
) -> None:
    """Write values, clipped to [-bounds, bounds], to some columns of an array.

    Args:
        values: Values (n, observers, k), float32.
        bounds: Bounds (k,), float32, each 0 or above.
        out: Output (n, observers, o), float32, C-contiguous and writeable. Other columns stay as
            they are.
        first: First of the k columns, 0 to o - k.

    Raises:
        TypeError: An array is not float32.
        ValueError: An array has another shape, `out` is not writeable or not C-contiguous, a bound
            is below 0, or `first` leaves too few columns.
    """

def clip_actions(value: object, shape: tuple[int, ...]) -> NDArray[np.float32] | None:
    """Return a copy of an array, clipped to [-1, 1].

    Args:
        value: Any object.
        shape: Expected shape.

    Returns:
        A new float32 array, or None if `value` is not a finite float32 array of that shape.
    """

def pooled_moments(
    rows: NDArray[np.float32],
    mean: NDArray[np.float64],
    variance: NDArray[np.float64],
    count: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean and variance of earlier rows and of further ones together.

    Args:
        rows: Further rows (n, o), float32; n may be 0.
        mean: Mean (o,) of the earlier rows, float64.
        variance: Variance (o,) of the earlier rows, float64.
        count: Number of the earlier rows, 0 or above; above 0 where n is 0.

    Returns:
        Mean and variance (o,) of all rows, float64.

    Raises:
        TypeError: An array has another element type.
        ValueError: An array has another shape, or `count` is out of range.
    """

def add_rewards(
    returns: NDArray[np.float64],
    rewards: NDArray[np.float32],
    discount: float,
    mean: float,
    variance: float,
    count: float,
) -> tuple[float, float]:
    """Discount returns and add rewards to them, in place.

    Args:
        returns: Discounted returns (n,), float64, C-contiguous and writeable.
        rewards: Rewards (n,), float32.
        discount: Factor of the returns.
        mean: Mean of earlier returns.
        variance: Variance of earlier returns.
        count: Number of earlier returns, 0 or above; above 0 where n is 0.

    Returns:
        Mean and variance of the earlier returns and the new ones together.

    Raises:
        TypeError: An array has another element type or, of `returns`, another memory order.
        ValueError: An array has another shape, or `count` is out of range.
        RuntimeError: `returns` is not writeable.
    """

def normalized(
    rows: NDArray[np.float32],
    mean: NDArray[np.float64],
    variance: NDArray[np.float64],
    epsilon: float,
    limit: float,
) -> NDArray[np.float32]:
    """Return rows less a mean, divided by a standard deviation and clipped.

    Args:
        rows: Rows (n, o), float32.
        mean: Mean (o,), float64.
        variance: Variance (o,), float64.
        epsilon: Number added to the variance before its square root is taken.
        limit: Bound of the results' magnitude, 0 or above.

    Returns:
        Normalized rows (n, o), float32, computed in float64. NaN stays.

    Raises:
        TypeError: An array has another element type.
        ValueError: An array has another shape, or `limit` is below 0.
    """

@final
class EgoFeatures:
    """Egocentric features of robots, scaled for a network.

    Positions are in half lengths of the field, velocities in top speeds and angular velocities in
    top angular velocities of a robot, so most numbers are within -1 to 1; the table has the range
    of those that are bounded. The blocks, in order:

    | block | shape | meaning | unit |
    | --- | --- | --- | --- |
    | `ball` | (4,) or (6,) | position (in space with a mouth) | half length |
    | | | velocity (in space with a mouth) | top speed |
    | `ego` | (7,) or (8,) | x, y | half length |
    | | | cos, sin of the heading, -1 to 1 | 1 |
    | | | v_x, v_y | top speed |
    | | | angular velocity | top angular velocity |
    | | | break beam, 0 or 1, with a mouth | 1 |
    | `teammates` | (n_teammates, 7 or 8) | as `ego`; zeros for an empty slot | as `ego` |
    | `opponents` | (n_opponents, 7 or 8) | as `ego`; zeros for an empty slot | as `ego` |
    | `ball_polar` | (3,) | distance of the ball, 0 or above | half length |
    | | | cosine and sine of its bearing, -1 to 1 | 1 |
    | `goal_polar` | (3,) | distance of the attacked goal, 0 or above | half length |
    | | | cosine and sine of its bearing, -1 to 1 | 1 |
    | `shot` | (4,) | cosine and sine of the bearing from ball to goal, -1 to 1 | 1 |
    | | | nearness of the ball, exp(-8 d) at d meters, 0 to 1 | 1 |
    | | | nearness times alignment, -1 to 1 | 1 |
    | `own_goal_polar` | (3,) | `goal_polar` of the defended goal, without a mouth | as there |
    | `own_goal_shot` | (3,) | `shot` at it, less the nearness alone, without a mouth | 1 |
    | `body_velocities` | (2, 2) | own velocity and the ball's, forward and left | top speed |
    | `body_positions` | (slots, 2) | offsets of ball, teammates, opponents | half length |
    | `presence` | (slots,) | 1 if the robot itself, a teammate, an opponent is on the field | 1 |

    The block `presence` is there only on demand. Numbers of an absent robot are zeros, and so are
    all those of an absent observer, except for its last action. Alignment is the cosine of the
    angle between the directions from robot to ball and from ball to goal. Offsets are forward and
    left; slots are 1 + n_teammates + n_opponents.

    Args:
        field: The field.
        robot: Model of the observing robots; its top speeds are the units.
        n_teammates: Number of teammates in a view, 0 or above.
        n_opponents: Number of opponents in a view, 0 or above.
        presence: Whether there is a block `presence`.

    Raises:
        ValueError: A number of robots is below 0.
    """

    def __new__(
        cls,
        field: Field,
        robot: RobotModel,
        n_teammates: int,
        n_opponents: int,
        presence: bool = False,
    ) -> EgoFeatures: ...
    @property
    def blocks(self) -> tuple[tuple[str, tuple[int, ...]], ...]:
        """Name and shape of each block, in order."""

    def encode(
        self,
        viewpoint: Viewpoint,
        rows: NDArray[np.float32],
        actions: NDArray[np.float32],
        out: NDArray[np.float32],
        bounds: NDArray[np.float32] | None = None,
        threads: Threads | None = None,
        rotated: NDArray[np.float32] | None = None,
    ) -> None:
        """Write the features of each observer, all blocks side by side, and its action after them.

        Args:
            viewpoint: The observers, each with 1 + n_teammates + n_opponents slots.
            rows: State rows (n, row), float32.
            actions: Last actions (n, robots, action), float32.
            out: Output (n, observers, features + action), float32, or with more columns, which stay
                as they are.
            bounds: Bounds (features + action,), float32, each 0 or above: values are clipped to
                [-bounds, bounds]. None clips nothing.
            threads: Threads that share the work; None for the caller's alone.
            rotated: State rows as the observers on the rotated field know them, as `rows`. None for
                the same.

        Raises:
            TypeError: An array is not float32.
            ValueError: An array has another shape, the output is not writeable or not C-contiguous,
                a bound is below 0, or the viewpoint has another number of slots.
        """

    def __reduce__(self) -> tuple[object, tuple[Field, RobotModel, int, int, bool]]: ...

@final
class Forecaster:
    """Forecasts of many matches: from what is known of a past time to when the next commands act.

    The physics of the models run from a sensed row through the commands that are on their way. A
    command acts `config.sensing.command_delay` after it was sent, at once without senses. Robots
    whose commands are unknown keep their velocities. The forecast of a world follows from its row,
    its times and its commands alone, whatever the numbers of worlds and threads. A forecaster
    pickles with its commands.

    Example:
        >>> import numpy as np
        >>> from rsoccer import Forecaster, Sensing, SimConfig, Simulator
        >>> config = SimConfig("vss_3v3", 1, 0, sensing=Sensing(command_delay=0.05))
        >>> forecaster, row = Forecaster(config), np.zeros((1, config.row_size), np.float32)
        >>> Simulator(config).read(row)
        >>> forecaster.send(np.full((1, 1, 2), 20.0, np.float32), np.array([0.0]))
        >>> out = np.empty_like(row)
        >>> forecaster.forecast(row, seen=np.array([0.0]), now=np.array([0.1]), out=out)
        >>> bool(out[0, 17] > row[0, 17] + 0.01)  # the robot's x after 100 ms at 20 rad/s
        True

    Args:
        config: Models of field, ball and robots, and the delay of commands.
        worlds: Number of matches, 1 or above.
        threads: Number of threads, 1 to 1024, or `Threads` that do other work too.
        known: Robots whose commands are known: "blue", "yellow" or "all".

    Raises:
        ValueError: `worlds`, `threads` or `known` is out of its range, or the teams do not fit on
            the field.
        TypeError: An argument has another type.
    """

    def __new__(
        cls,
        config: SimConfig,
        worlds: int = 1,
        threads: int | Threads = 1,
        known: str = "all",
    ) -> Forecaster: ...
    @property
    def config(self) -> SimConfig:
        """Models, and the delay of commands."""

    @property
    def worlds(self) -> int:
        """Number of matches."""

    @property
    def threads(self) -> int:
        """Number of threads that `forecast` uses."""

    @property
    def known(self) -> str:
        """Robots whose commands are known: "blue", "yellow" or "all"."""

    def send(
        self,
        commands: NDArray[np.float32],
        times: NDArray[np.float64],
        active: NDArray[np.bool_] | None = None,
    ) -> None:
        """Take note of commands that were sent.

        With `known="all"`, the commands of robots of others may be those of a policy that is their
        model. Commands that act no more 2 s before these are forgotten.

        Args:
            commands: Commands (n, robots, command), float32, SI units; those of robots that are not
                `known` are ignored.
            times: Times at which they were sent (n,), float64, s, on any clock that runs evenly;
                not before those of the last ones.
            active: Mask of the worlds that sent them (n,), bool. None for all.

        Raises:
            ValueError: A number is not finite, a time is before the last one, or an array has
                another shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def forecast(
        self,
        rows: NDArray[np.float32],
        seen: NDArray[np.float64],
        now: NDArray[np.float64],
        out: NDArray[np.float32],
    ) -> None:
        """Write the states in which commands that are sent now will act.

        Bodies of the rows may overlap each other or walls, as those of `Simulator.place_estimates`
        may. Touches, collisions and crossings are those of the last control step of the forecast.
        A row that is not older than the effect of the commands is written as it is. Commands that
        act no more at `seen` are forgotten, so a later call refuses rows that are of earlier times.

        Args:
            rows: State rows of what is known (n, row), float32.
            seen: Times at which they were so (n,), float64, s, on the clock of `send`.
            now: Times at which the next commands will be sent (n,), float64, s.
            out: Output (n, row), float32; may be `rows`.

        Raises:
            ValueError: A row is not finite, more than 2 s older than its forecast or of a time
                whose commands are forgotten, or an array has another shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def reset(self, worlds: NDArray[np.bool_]) -> None:
        """Forget the commands of some worlds: their robots stand until commands act.

        Args:
            worlds: Mask of these worlds (n,), bool.

        Raises:
            ValueError: The mask has another shape. Nothing has changed.
            TypeError: The mask has another type. Nothing has changed.
        """

    def snapshot(self) -> bytes:
        """Return the commands of all worlds: everything that later forecasts depend on."""

    def restore(self, snapshot: bytes) -> None:
        """Restore the commands of a snapshot.

        Args:
            snapshot: Result of `snapshot` of a forecaster with the same configuration and number of
                worlds.

        Raises:
            ValueError: The bytes are damaged, or of another forecaster. Nothing has changed.
        """

@final
class Simulator:
    """Independent matches of one configuration, stepped on several threads.

    World `i` gives the same bits as a single match, whatever the numbers of worlds and threads. A
    simulator works after a fork, and pickles with its state.

    Args:
        config: Configuration of the matches.
        worlds: Number of matches, 1 or above.
        threads: Number of threads that `step` uses, 1 to 1024, or `Threads` that do other work too.

    Raises:
        ValueError: `worlds` or `threads` is out of its range, or the teams do not fit on the field.
    """

    def __new__(
        cls, config: SimConfig, worlds: int = 1, threads: int | Threads = 1
    ) -> Simulator: ...
    @property
    def config(self) -> SimConfig:
        """Configuration of the matches."""

    @property
    def worlds(self) -> int:
        """Number of matches."""

    @property
    def threads(self) -> int:
        """Number of threads that `step` uses."""

    def place(
        self,
        worlds: NDArray[np.bool_],
        rows: NDArray[np.float32],
        out: NDArray[np.float32],
        parameters: NDArray[np.float32] | None = None,
    ) -> None:
        """Start new matches in some worlds.

        Args:
            worlds: Mask of these worlds (n,), bool.
            rows: State rows of the starts (number of True, row), float32; positions, headings,
                velocities, the ball's spin and `absent` are used, of an absent robot nothing else.
                Speeds are at most `MAX_PLACED_SPEED`, angular velocities
                `MAX_PLACED_ANGULAR_VELOCITY`, the ball's spin `MAX_PLACED_SPIN` and its height
                `MAX_PLACED_HEIGHT`.
            out: Output (n, row), float32; the rows of these worlds are written. It may share memory
                with `rows`.
            parameters: Factors on the models' numbers in these worlds (number of True, parameter),
                float32: `BALL_PARAMETERS`, then `ROBOT_PARAMETERS` of each robot; from 0.001 to
                1000, and 0 for the ball, except its mass. None for factors of 1.

        Raises:
            ValueError: A start is invalid (bodies overlap, are outside the field or beyond a limit,
                whose column the message names), a factor is out of its range, or an array has
                another shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def restart(
        self, worlds: NDArray[np.bool_], rows: NDArray[np.float32], out: NDArray[np.float32]
    ) -> None:
        """Restart play in some worlds: all bodies get a new state, as a referee puts them.

        Worlds keep their own factors on the models' numbers. Nothing else of the old state remains:
        kickers are charged, and touches, crossings and collisions are cleared.

        Args:
            worlds: Mask of these worlds (n,), bool.
            rows: State rows (number of True, row), float32, as for `place`.
            out: Output (n, row), float32; the rows of these worlds are written. It may share memory
                with `rows`.

        Raises:
            ValueError: A row is invalid (bodies overlap, are outside the field or too fast), or an
                array has another shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def place_estimates(
        self, worlds: NDArray[np.bool_], rows: NDArray[np.float32], out: NDArray[np.float32]
    ) -> NDArray[np.float32]:
        """Restart play in some worlds from the valid states that are nearest to estimates.

        An estimate from noisy senses may have bodies that overlap each other or walls, are outside
        the field or too fast, and headings of any length. Bodies that overlap by more than a state
        may have are moved apart, each half of the way; a row that `restart` accepts is taken as it
        is. All else is as in `restart`.

        Args:
            worlds: Mask of these worlds (n,), bool.
            rows: State rows (number of True, row), float32 and finite.
            out: Output (n, row), float32; the rows of these worlds are written. It may share memory
                with `rows`.

        Returns:
            By how much the ball and each robot were moved (number of True, 1 + robots), m, float32.

        Raises:
            ValueError: A row is not finite, `absent` is neither 0 nor 1, or an array has another
                shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def reposition_robots(
        self,
        worlds: NDArray[np.bool_],
        robots: NDArray[np.bool_],
        rows: NDArray[np.float32],
        out: NDArray[np.float32],
    ) -> None:
        """Move robots of some worlds, or take them off the field; all else continues.

        Kickers of the moved robots are charged, and their touches and collisions are cleared.

        Args:
            worlds: Mask of these worlds (n,), bool.
            robots: Mask of the robots to move (number of True, robots), bool.
            rows: State rows (number of True, row), float32; of the robots to move, positions,
                headings, velocities and `absent` are used.
            out: Output (n, row), float32; the rows of these worlds are written. It may share memory
                with `rows`.

        Raises:
            ValueError: A robot is in another body or outside the field, a world became non-finite
                before (the message names it), or an array has another shape. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def reposition_balls(
        self,
        worlds: NDArray[np.bool_],
        balls: NDArray[np.float32],
        out: NDArray[np.float32],
    ) -> None:
        """Move the balls of some worlds; everything else of their matches continues.

        The last touch and the crossing of these balls are cleared.

        Args:
            worlds: Mask of these worlds (n,), bool.
            balls: Ball columns (number of True, ball columns), float32; position, velocity and spin
                are used, within the limits of `place`.
            out: Output (n, row), float32; the rows of these worlds are written. It may share memory
                with `balls`.

        Raises:
            ValueError: A ball is in a robot, outside the field or beyond a limit, a world became
                non-finite before (the message names it), or an array has another shape. Nothing has
                changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def step(
        self,
        commands: NDArray[np.float32],
        out: NDArray[np.float32],
        active: NDArray[np.bool_] | None = None,
        sensed: NDArray[np.float32] | None = None,
    ) -> None:
        """Advance matches by one control step; releases the GIL.

        Args:
            commands: Commands (n, robots, command columns), float32 and finite; values beyond a
                robot's limits are clipped. A robot with a shorter command reads the first columns.
            out: Output (n, row), float32; the rows of stepped worlds are written.
            active: Mask of the worlds to step (n,), bool. None for all.
            sensed: Second output (n, row), float32; the rows of stepped worlds are written, as
                `sense` writes them by default. None for none. Rows cost less here than in a call
                of `sense`, as the states are in the processor's cache.

        Raises:
            ValueError: An array has another shape, or a command is not finite. Nothing has changed.
            TypeError: An array has another type. Nothing has changed.
            RuntimeError: The states of some worlds, which the message names, are non-finite, now or
                since an earlier step. They are lost until `place` or `restart`; the others have
                stepped, and their rows are written.
        """

    def read(self, out: NDArray[np.float32]) -> None:
        """Write the rows of all worlds.

        Args:
            out: Output (n, row), float32.

        Raises:
            ValueError: `out` has another shape or is not writeable.
            TypeError: `out` is not float32.
        """

    def sense(
        self,
        out: NDArray[np.float32],
        active: NDArray[np.bool_] | None = None,
        known: str | None = "blue",
    ) -> None:
        """Write what the robots know; the state rows without `config.sensing`.

        Args:
            out: Output (n, row), float32; the rows of active worlds are written.
            active: Mask of the worlds to write (n,), bool. None for all.
            known: Robots whose commands on their way a forecast knows, and whose cameras they see
                by if each team has its own: "blue", "yellow" or "all", by those of blue; None for
                what blue knows without a forecast. Otherwise all know the same.

        Raises:
            ValueError: An array has another shape, `out` is not writeable, or another `known`.
            TypeError: An array has another type.
        """

    def camera_frames(
        self, world: int = 0
    ) -> list[tuple[float, NDArray[np.float32], NDArray[np.float32]]]:
        """Return the frames of the cameras that arrived in the last control step of a world.

        Args:
            world: Index of the world.

        Returns:
            For each frame, in the order of arrival: time of the exposure since the senses began, s;
            detected balls (k, 4), index of the camera, position x, y and height, m; detected robots
            (m, 6), index of the camera, index in a state row, position x and y (m), and cosine and
            sine of the heading. Nothing is left out and nothing added: a body may be missing, or be
            seen by several cameras. Empty without `config.sensing`.

        Raises:
            ValueError: There is no such world.
        """

    def begin_senses(
        self,
        worlds: NDArray[np.bool_],
        keys: NDArray[np.uint64],
        numbers: NDArray[np.float32] | None = None,
    ) -> None:
        """Begin the senses of some worlds, which have just been placed.

        Without this call the senses of a world have the key 0. Without `config.sensing` nothing
        happens.

        Args:
            worlds: Mask of these worlds (n,), bool.
            keys: Keys of the random numbers of these worlds (number of True,), uint64.
            numbers: Numbers of the senses of these worlds (number of True, `SENSING_NUMBERS`),
                float32. None for those of the configuration.

        Raises:
            ValueError: A number is out of its range, or an array has another shape. Nothing has
                changed.
            TypeError: An array has another type. Nothing has changed.
        """

    def snapshot(self) -> bytes:
        """Return the states of all matches: everything that their futures depend on."""

    def restore(self, snapshot: bytes) -> None:
        """Restore the states of a snapshot.

        Args:
            snapshot: Result of `snapshot` of a simulator with the same configuration and number of
                worlds.

        Raises:
            ValueError: The bytes are foreign or damaged, or of another configuration or physics
                version. Nothing has changed.
        """

    def __getnewargs__(self) -> tuple[SimConfig, int, int]: ...
    def __getstate__(self) -> bytes: ...
    def __setstate__(self, state: bytes) -> None: ...

@final
class VisionTracker:
    """Estimates of all bodies from detections of cameras, by the tracker of the senses.

    It filters what cameras of other simulators and of real fields see, as the tracker of `Sensing`
    filters what simulated ones do: positions and velocities, balls that are none, headings that are
    misread. Its filters are those for noise and frame rate of `config.sensing`; numbers that are 0
    there are those of "rc2021", at 60 Hz.

    Example:
        >>> import numpy as np
        >>> from rsoccer import SimConfig
        >>> from rsoccer._core import VisionTracker
        >>> tracker, robots = VisionTracker(SimConfig("ssl_b", 1, 0)), np.zeros((0, 5), np.float32)
        >>> for frame in range(30):
        ...     ball = np.array([[0.02 * frame, 0.0]], np.float32)
        ...     _ = tracker.take(frame / 60, ball, robots)
        >>> row = np.empty((1, 29), np.float32)
        >>> tracker.read(row)
        >>> round(float(row[0, 3]), 2)
        1.2

    Args:
        config: Field, ball and robots.

    Raises:
        TypeError: The argument has another type.
        ValueError: The teams do not fit on the field.
    """

    def __new__(cls, config: SimConfig) -> VisionTracker: ...
    @property
    def config(self) -> SimConfig:
        """Configuration of the match."""

    @property
    def time(self) -> float | None:
        """Time of the last frame (s); None before the first."""

    @property
    def has_ball(self) -> bool:
        """Whether a ball has been seen."""

    @property
    def robots_in_sight(self) -> list[int]:
        """Indices of the robots that were seen in the last half second."""

    def send(self, time: float, commands: NDArray[np.float32], robots: list[int]) -> bool:
        """Take note of commands that were sent.

        From the first on, the drives of the models carry the robots that get them from one frame to
        the next, where others keep their velocities. So the noise of cameras is averaged over a
        longer time. Commands act `command_delay` of `config.sensing` after they were sent.

        Args:
            time: Time at which they were sent, s, on the clock of the frames.
            commands: (m, command) commands of all robots, float32.
            robots: Indices of the robots to which they were sent.

        Returns:
            False if they are older than the last ones; then nothing has changed.

        Raises:
            ValueError: A number is not finite, an index that no robot has, or an array of another
                shape. Nothing has changed.
            TypeError: An array of another type. Nothing has changed.
            OverflowError: A negative index.
        """

    def take(
        self,
        time: float,
        balls: NDArray[np.float32],
        robots: NDArray[np.float32],
        cut: list[int] | None = None,
        camera: int = 0,
    ) -> bool:
        """Take in the detections of a camera.

        Cameras see a body at places that differ by their errors, so that it is followed by one of
        them until that one has missed it for one and a half periods. A ball that was seen before
        the mouth of a robot whose break beam is cut moves with it, also while no camera sees it.

        Args:
            time: Time of the exposure, s, on any clock that runs evenly.
            balls: Positions of balls (k, 2), float32, m, the likeliest first; one of them, at most,
                is real.
            robots: Index in a state row, position (m) and cosine and sine of the heading of each
                robot (m, 5), float32.
            cut: Indices of the robots whose break beam is cut; None where robots report nothing.
            camera: Index of the camera, 0 to 255.

        Returns:
            False if the frame is older than the last one; then nothing has changed.

        Raises:
            ValueError: A number is not finite, an index that no robot has, a heading without a
                length, or an array of another shape. Nothing has changed.
            TypeError: An array of another type. Nothing has changed.
            OverflowError: A negative index of `cut`.
        """

    def read(self, out: NDArray[np.float32], robots: list[int] | None = None) -> None:
        """Write the state at the last frame.

        Touches, crossings and beams are those of a match that begins. Robots that were not seen for
        half a second are absent, where they were seen last.

        Args:
            out: Output (1, row), float32.
            robots: Indices of the robots whose commands the reader knows, of those that were sent;
                None for all.

        Raises:
            ValueError: The array has another shape or cannot be written, or an index that no robot
                has.
            TypeError: The array has another type.
            OverflowError: A negative index.
        """

def referee_preset(name: str) -> str:
    """Return the numbers and switches of a preset of the rules, as JSON.

    Args:
        name: "ssl_2026_a", "ssl_2026_b", "vsss_3v3" or "vsss_5v5".

    Raises:
        KeyError: There is no such preset.
    """

def referee_rules(league: str) -> list[list[str]]:
    """Return the rules of a league in the order in which they are judged.

    Args:
        league: "ssl" or "vsss".

    Returns:
        For each rule the name of its event, the paragraph of its source, what it says, and its
        function.

    Raises:
        ValueError: There is no such league.
    """

def referee_values() -> list[list[str]]:
    """Return the choices and numbers of the rules' configuration, in the order of a preset's.

    Returns:
        For each value its name, its unit (empty for a choice), and its meaning.
    """

def random_words(states: NDArray[np.uint64], count: int) -> NDArray[np.uint64]:
    """Return the next words of random streams (SplitMix64), which do not advance.

    Args:
        states: State of each stream (n,), uint64.
        count: Number of words of each stream.

    Returns:
        Words (n, count), uint64, a new array.

    Raises:
        TypeError: `states` is not an array of uint64.
        ValueError: `states` has another number of axes.
    """

def uniform(
    states: NDArray[np.uint64], count: int, low: float, width: float
) -> NDArray[np.float32]:
    """Return uniform numbers of random streams, which do not advance.

    Args:
        states: State of each stream (n,), uint64.
        count: Number of numbers of each stream, each of one word.
        low: Lower bound, included.
        width: Upper bound, excluded except by rounding, minus the lower one.

    Returns:
        Numbers (n, count), float32 with 24 random bits each, a new array.

    Raises:
        TypeError: `states` is not an array of uint64.
        ValueError: `states` has another number of axes.
    """

def normal_inputs(
    states: NDArray[np.uint64], count: int
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return inputs of the Box-Muller transform of random streams, which do not advance.

    Args:
        states: State of each stream (n,), uint64.
        count: Number of words of each stream, of which each gives two normal numbers.

    Returns:
        Numbers (n, count) above 0 and up to 1 for the logarithm, and angles (n, count) from 0 to
        below 2 pi, rad, both float32 and new arrays.

    Raises:
        TypeError: `states` is not an array of uint64.
        ValueError: `states` has another number of axes.
    """

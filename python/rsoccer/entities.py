"""The paper's entities: one world at one instant as plain objects, for people and printing.

    >>> import rsoccer
    >>> from rsoccer import entities
    >>> matches = rsoccer.Matches("VSSSelfPlay-v0")
    >>> observations = matches.reset()
    >>> state = entities.from_frame(matches.frame, 0)
    >>> degrees = state.robots_blue[0].theta
    >>> state.ball.x = 0.1
    >>> row = entities.to_row(state, n_blue=3, n_yellow=3)  # an initial state for a match

Positions are meters from the field's center; a robot's angles are degrees, as in the paper. The
objects are too slow for many worlds or every step: there `Frame` gives arrays.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Final

import numpy as np

from rsoccer._core import COMMAND_COLUMNS, SimConfig
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.frame import Frame, RobotColumns


@dataclass
class Ball:
    """Position and velocity of the ball.

    Attributes:
        x: position toward yellow's goal, meters.
        y: position to the left of that, meters.
        z: height of the ball's lowest point, 0 on the floor, meters.
        v_x: velocity along x, m/s.
        v_y: velocity along y, m/s.
        v_z: velocity upwards, m/s.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    v_x: float = 0.0
    v_y: float = 0.0
    v_z: float = 0.0

    def __str__(self) -> str:
        return (
            f"ball at ({self.x:.3f}, {self.y:.3f}, {self.z:.3f}) m, "
            f"moving ({self.v_x:.2f}, {self.v_y:.2f}, {self.v_z:.2f}) m/s"
        )


@dataclass
class Robot:
    """State or command of a robot.

    A state uses the fields up to `absent`, with velocities along the field's axes. A command uses
    `v_x`, `v_y` (forward and to the left), `v_theta` and the fields after `absent`, as far as the
    robot's drive has them.

    Attributes:
        yellow: the robot is yellow, not blue.
        id: number of the robot in its team.
        x: position toward yellow's goal, meters.
        y: position to the left of that, meters.
        theta: heading, degrees from +x toward +y; (-180, 180] when read from a frame.
        v_x: velocity along x, or forward in a command, m/s.
        v_y: velocity along y, or to the left in a command, m/s.
        v_theta: angular velocity, counterclockwise, degrees per second.
        infrared: the ball cuts the beam.
        absent: the robot is not on the field.
        v_wheel0: wheel speed, rad/s; of two wheels the left one.
        v_wheel1: wheel speed, rad/s; of two wheels the right one.
        v_wheel2: wheel speed, rad/s.
        v_wheel3: wheel speed, rad/s.
        kick_v_x: kick forward, m/s.
        kick_v_z: kick upward, m/s.
        dribbler: share of the dribbler's speed, 0 to 1, or a bool.
    """

    yellow: bool = False
    id: int = 0
    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0
    v_x: float = 0.0
    v_y: float = 0.0
    v_theta: float = 0.0
    infrared: bool = False
    absent: bool = False
    v_wheel0: float = 0.0
    v_wheel1: float = 0.0
    v_wheel2: float = 0.0
    v_wheel3: float = 0.0
    kick_v_x: float = 0.0
    kick_v_z: float = 0.0
    dribbler: float = 0.0

    def __str__(self) -> str:
        ball = ", ball in its beam" if self.infrared else ""
        name = f"{'yellow' if self.yellow else 'blue'} {self.id}"
        if self.absent:
            return f"{name} absent"
        return (
            f"{name} at ({self.x:.3f}, {self.y:.3f}) m "
            f"facing {self.theta:.1f} deg, moving ({self.v_x:.2f}, {self.v_y:.2f}) m/s, "
            f"turning {self.v_theta:.1f} deg/s{ball}"
        )


@dataclass
class Entities:
    """Ball and robots of one world: the paper's `Frame`.

    Attributes:
        ball: the ball.
        robots_blue: blue robots by their number in the team.
        robots_yellow: yellow robots by their number in the team.
    """

    ball: Ball = field(default_factory=Ball)
    robots_blue: dict[int, Robot] = field(default_factory=dict)
    robots_yellow: dict[int, Robot] = field(default_factory=dict)

    def __str__(self) -> str:
        robots = [*self.robots_blue.values(), *self.robots_yellow.values()]
        return "\n".join(map(str, [self.ball, *robots]))


@dataclass(frozen=True)
class FieldParameters:
    """Dimensions of the field, the ball and the robots: the paper's `Field`.

    Attributes:
        length: length of the field, meters.
        width: width of the field, meters.
        penalty_length: size of a goal area along x, meters.
        penalty_width: size of a goal area along y, meters.
        goal_width: width of a goal, meters.
        goal_depth: depth of a goal, meters.
        ball_radius: radius of the ball, meters.
        robot_radius: radius of a round robot, half the side of a square one, meters.
        robot_front: distance from the center to the middle of the front, meters.
        wheel_radius: radius of a wheel, meters.
        wheel_angles: directions of the wheels from the center, degrees from the front.
        max_wheel_speed: largest speed of a wheel, rad/s.
    """

    length: float
    width: float
    penalty_length: float
    penalty_width: float
    goal_width: float
    goal_depth: float
    ball_radius: float
    robot_radius: float
    robot_front: float
    wheel_radius: float
    wheel_angles: tuple[float, ...]
    max_wheel_speed: float

    @classmethod
    def from_config(cls, config: SimConfig) -> "FieldParameters":
        """Read the dimensions of a configuration.

        Args:
            config: a configuration whose robots are all of one model.

        Returns:
            Its dimensions.
        """
        field, robot = config.field, config.robot
        two_wheels = robot.drive == "differential"
        return cls(
            length=field.length,
            width=field.width,
            penalty_length=field.goal_area_depth,
            penalty_width=field.goal_area_width,
            goal_width=field.goal_width,
            goal_depth=field.goal_depth,
            ball_radius=config.ball.radius,
            robot_radius=robot.side_length / 2 if two_wheels else robot.radius,
            robot_front=robot.side_length / 2 if two_wheels else robot.front_distance,
            wheel_radius=robot.wheel_radius,
            wheel_angles=(90.0, 270.0) if two_wheels else tuple(robot.wheel_angles),
            max_wheel_speed=robot.max_wheel_speed,
        )


# Fields of a Robot by names of command columns, where the two differ.
_ROBOT_FIELDS: Final = {
    "left": "v_wheel0",
    "right": "v_wheel1",
    **{f"wheel_{i}": f"v_wheel{i}" for i in range(4)},
}


def from_frame(frame: Frame, world: int) -> Entities:
    """Read one world of a frame.

    Args:
        frame: states of worlds.
        world: index of the world.

    Returns:
        A copy of its ball and robots.
    """
    position, velocity = frame.ball.position[world], frame.ball.velocity[world]
    (x, y), (v_x, v_y) = position.tolist(), velocity.tolist()
    ball = Ball(
        x, y, float(frame.ball.height[world]), v_x, v_y, float(frame.ball.vertical_velocity[world])
    )
    return Entities(ball, _robots(frame.blue, world, False), _robots(frame.yellow, world, True))


def to_row(entities: Entities, n_blue: int, n_yellow: int) -> Floats:
    """Return the state row of entities, such as for `Matches.reset`.

    Columns that entities do not have are as in `Frame.empty`. The ball's spin is one of them, so a
    moving ball slides before it rolls; `spawn.set_rolling_spin` gives it the spin of rolling.

    Args:
        entities: ball and robots. The keys of the dictionaries count, not `id` and `yellow`.
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.

    Returns:
        A row (row,), float32.

    Raises:
        ValueError: the robots are not those of the two numbers, or a number is not finite.
    """
    robots = [
        *_in_order("robots_blue", entities.robots_blue, n_blue),
        *_in_order("robots_yellow", entities.robots_yellow, n_yellow),
    ]
    frame, ball = Frame.empty(1, n_blue, n_yellow), entities.ball
    frame.ball.position[0] = ball.x, ball.y
    frame.ball.velocity[0] = ball.v_x, ball.v_y
    frame.ball.height[0], frame.ball.vertical_velocity[0] = ball.z, ball.v_z
    for i, robot in enumerate(robots):
        frame.robots.position[0, i] = robot.x, robot.y
        frame.robots.heading[0, i] = headings(robot.theta)
        frame.robots.velocity[0, i] = robot.v_x, robot.v_y
        frame.robots.angular_velocity[0, i] = np.radians(robot.v_theta)
        frame.robots.infrared[0, i] = robot.infrared
        frame.robots.absent[0, i] = robot.absent
    if not np.isfinite(frame.rows).all():
        raise ValueError(f"entities: expected finite numbers, got\n{entities}")
    row: Floats = frame.rows[0]
    return row


def to_command(robot: Robot, drive: str) -> Floats:
    """Return the command of a robot.

    Args:
        robot: the robot.
        drive: kind of drive: a key of `COMMAND_COLUMNS`.

    Returns:
        The columns of the command (command,), float32; the angular velocity in rad/s.
    """
    numbers = {part.name: getattr(robot, part.name) for part in fields(robot)}
    numbers["v_theta"] = np.radians(robot.v_theta)
    columns = COMMAND_COLUMNS[drive]
    return np.array([numbers[_ROBOT_FIELDS.get(name, name)] for name in columns], np.float32)


def degrees(heading: Array) -> Doubles:
    """Convert headings to angles.

    Args:
        heading: headings (..., 2), cosine and sine.

    Returns:
        Angles (...), degrees, in (-180, 180].
    """
    heading = np.asarray(heading, np.float64)
    angles = np.degrees(np.arctan2(heading[..., 1], heading[..., 0]))
    return np.where(angles <= -180.0, 180.0, angles) + 0.0  # -0.0 becomes 0.0


def headings(angles: float | Array) -> Doubles:
    """Convert angles to headings, exactly for multiples of 90 degrees.

    Args:
        angles: angles (...), degrees.

    Returns:
        Headings (..., 2), cosine and sine; not finite where an angle is not.
    """
    with np.errstate(invalid="ignore"):  # NaN and infinity stay NaN
        angles = np.mod(np.asarray(angles, np.float64), 360.0)
        quarters = np.round(angles / 90.0)
        turns = quarters.astype(np.int64) % 4
    rest = np.radians(angles - 90.0 * quarters)
    cos, sin = np.cos(rest), np.sin(rest)
    x, y = np.choose(turns, [cos, -sin, -cos, sin]), np.choose(turns, [sin, cos, -sin, -cos])
    return np.stack([x, y], axis=-1) + 0.0


def _robots(columns: RobotColumns, world: int, yellow: bool) -> dict[int, Robot]:
    """Robots of a team in one world, by their number."""
    thetas = degrees(columns.heading[world])
    angular_velocities = np.degrees(columns.angular_velocity[world], dtype=np.float64)
    return {
        i: Robot(
            yellow,
            i,
            x=float(columns.position[world, i, 0]),
            y=float(columns.position[world, i, 1]),
            theta=float(theta),
            v_x=float(columns.velocity[world, i, 0]),
            v_y=float(columns.velocity[world, i, 1]),
            v_theta=float(angular_velocity),
            infrared=bool(columns.infrared[world, i]),
            absent=bool(columns.absent[world, i]),
        )
        for i, (theta, angular_velocity) in enumerate(zip(thetas, angular_velocities, strict=True))
    }


def _in_order(name: str, robots: Mapping[int, Robot], n: int) -> list[Robot]:
    """Robots 0 to n - 1, or ValueError if the numbers are others."""
    if set(robots) != set(range(n)):
        raise ValueError(f"{name}: expected robots {list(range(n))}, got {sorted(robots)}")
    return [robots[i] for i in range(n)]

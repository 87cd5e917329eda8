"""The paper's entities: one moment of one match as plain objects, for people and printing.

    >>> moment = entities.of(matches.play.frame, 0)
    >>> moment.robots_blue[0].theta  # degrees
    >>> moment.ball.x = 0.1
    >>> row = entities.to_row(moment, n_blue=3, n_yellow=3)  # where a match can start

Metres and seconds from the field's centre; a robot's angles are degrees, as in the paper. Nothing
that runs often uses them: reading many worlds is what `Frame` is for.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import COMMAND_COLUMNS, SimConfig
from rsoccer.frame import Array, Floats, Frame, RobotColumns

Doubles = NDArray[np.float64]


@dataclass
class Ball:
    """Where the ball is and how it moves. `z` is the height of its lowest point, 0 on the floor."""

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
    """A robot as it is, as it should be placed, or as it is told to move.

    The velocity of a state is along the field's axes, that of a command forward and to the left.
    From `infrared` on, a state knows the beam only, and a command all but the beam.
    """

    yellow: bool = False
    id: int = 0
    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0  # degrees from +x to +y, read in (-180, 180]
    v_x: float = 0.0
    v_y: float = 0.0
    v_theta: float = 0.0  # degrees per second
    infrared: bool = False  # the ball cuts its beam
    v_wheel0: float = 0.0  # rad/s; the left one of two
    v_wheel1: float = 0.0  # the right one of two
    v_wheel2: float = 0.0
    v_wheel3: float = 0.0
    kick_v_x: float = 0.0  # forward
    kick_v_z: float = 0.0  # upward
    dribbler: float = 0.0  # share of its speed; True and False do

    def __str__(self) -> str:
        ball = ", ball in its beam" if self.infrared else ""
        return (
            f"{'yellow' if self.yellow else 'blue'} {self.id} at ({self.x:.3f}, {self.y:.3f}) m "
            f"facing {self.theta:.1f} deg, moving ({self.v_x:.2f}, {self.v_y:.2f}) m/s, "
            f"turning {self.v_theta:.1f} deg/s{ball}"
        )


@dataclass
class Entities:
    """The paper's `Frame`: the ball and each side's robots by their number in the side."""

    ball: Ball = field(default_factory=Ball)
    robots_blue: dict[int, Robot] = field(default_factory=dict)
    robots_yellow: dict[int, Robot] = field(default_factory=dict)

    def __str__(self) -> str:
        robots = [*self.robots_blue.values(), *self.robots_yellow.values()]
        return "\n".join(map(str, [self.ball, *robots]))


@dataclass(frozen=True)
class Field:
    """The paper's `Field`: numbers of the field, the ball and the robots, metres and rad/s."""

    length: float
    width: float
    penalty_length: float  # of the area before a goal, along x
    penalty_width: float
    goal_width: float
    goal_depth: float
    ball_radius: float
    robot_radius: float  # half the side of a square one
    robot_front: float  # from the centre to the middle of the front
    wheel_radius: float
    wheel_angles: tuple[float, ...]  # degrees from the front, where each wheel is
    max_wheel_speed: float

    @classmethod
    def of(cls, config: SimConfig) -> "Field":
        """Numbers of a configuration whose robots are of one model."""
        place, robot = config.field, config.robot
        two_wheels = robot.drive == "differential"
        return cls(
            length=place.length,
            width=place.width,
            penalty_length=place.goal_area_depth,
            penalty_width=place.goal_area_width,
            goal_width=place.goal_width,
            goal_depth=place.goal_depth,
            ball_radius=config.ball.radius,
            robot_radius=robot.side / 2 if two_wheels else robot.radius,
            robot_front=robot.side / 2 if two_wheels else robot.front,
            wheel_radius=robot.wheel_radius,
            wheel_angles=(90.0, 270.0) if two_wheels else tuple(robot.wheel_angles),
            max_wheel_speed=robot.max_wheel_speed,
        )


# What a drive calls the numbers that a Robot carries under other names, or in other units.
COMMAND_NAMES: Final = {
    "left": "v_wheel0",
    "right": "v_wheel1",
    **{f"wheel_{i}": f"v_wheel{i}" for i in range(4)},
}


def of(frame: Frame, world: int) -> Entities:
    """The moment that a world of a frame shows."""
    position, velocity = frame.ball.position[world], frame.ball.velocity[world]
    (x, y), (v_x, v_y) = position.tolist(), velocity.tolist()
    ball = Ball(x, y, float(frame.ball.height[world]), v_x, v_y, float(frame.ball.vertical_velocity[world]))
    return Entities(ball, _robots(frame.blue, world, False), _robots(frame.yellow, world, True))


def to_row(entities: Entities, n_blue: int, n_yellow: int) -> Floats:
    """The row (row,) that says the same; a robot is who its place in the dictionary says.

    What entities do not tell is as in `Frame.empty`: the ball's spin, for one, so that a ball that
    moves slides before it rolls (`spawn.roll` gives it the spin of rolling).
    """
    robots = [
        *_listed("robots_blue", entities.robots_blue, n_blue),
        *_listed("robots_yellow", entities.robots_yellow, n_yellow),
    ]
    frame, ball = Frame.empty(1, n_blue, n_yellow), entities.ball
    frame.ball.position[0] = ball.x, ball.y
    frame.ball.velocity[0] = ball.v_x, ball.v_y
    frame.ball.height[0], frame.ball.vertical_velocity[0] = ball.z, ball.v_z
    for i, robot in enumerate(robots):
        frame.robots.position[0, i] = robot.x, robot.y
        frame.robots.heading[0, i] = headings(robot.theta)
        frame.robots.velocity[0, i] = robot.v_x, robot.v_y
        frame.robots.spin[0, i] = np.radians(robot.v_theta)
        frame.robots.infrared[0, i] = robot.infrared
    if not np.isfinite(frame.rows).all():
        raise ValueError(f"entities: expected finite numbers, got\n{entities}")
    row: Floats = frame.rows[0]
    return row


def to_command(robot: Robot, drive: str) -> Floats:
    """A robot's command (command,) for a drive: a key of `COMMAND_COLUMNS`."""
    numbers = {part.name: getattr(robot, part.name) for part in fields(robot)}
    numbers["v_theta"] = np.radians(robot.v_theta)
    columns = COMMAND_COLUMNS[drive]
    return np.array([numbers[COMMAND_NAMES.get(name, name)] for name in columns], np.float32)


def degrees(heading: Array) -> Doubles:
    """Angles (...) in (-180, 180] of headings (..., 2) as cosine and sine."""
    heading = np.asarray(heading, np.float64)
    turned = np.degrees(np.arctan2(heading[..., 1], heading[..., 0]))
    return np.where(turned <= -180.0, 180.0, turned) + 0.0  # no minus before a zero


def headings(angles: float | Array) -> Doubles:
    """Headings (..., 2) of angles (...), degrees; exact where they are multiples of 90."""
    with np.errstate(invalid="ignore"):  # what is not finite stays so
        angles = np.mod(np.asarray(angles, np.float64), 360.0)
        quarters = np.round(angles / 90.0)
        turns = quarters.astype(np.int64) % 4
    rest = np.radians(angles - 90.0 * quarters)
    cos, sin = np.cos(rest), np.sin(rest)
    x, y = np.choose(turns, [cos, -sin, -cos, sin]), np.choose(turns, [sin, cos, -sin, -cos])
    return np.stack([x, y], axis=-1) + 0.0


def _robots(columns: RobotColumns, world: int, yellow: bool) -> dict[int, Robot]:
    thetas = degrees(columns.heading[world])
    turns = np.degrees(columns.spin[world], dtype=np.float64)
    return {
        i: Robot(
            yellow,
            i,
            x=float(columns.position[world, i, 0]),
            y=float(columns.position[world, i, 1]),
            theta=float(theta),
            v_x=float(columns.velocity[world, i, 0]),
            v_y=float(columns.velocity[world, i, 1]),
            v_theta=float(turn),
            infrared=bool(columns.infrared[world, i]),
        )
        for i, (theta, turn) in enumerate(zip(thetas, turns, strict=True))
    }


def _listed(name: str, robots: Mapping[int, Robot], n: int) -> list[Robot]:
    if set(robots) != set(range(n)):
        raise ValueError(f"{name}: expected robots {list(range(n))}, got {sorted(robots)}")
    return [robots[i] for i in range(n)]

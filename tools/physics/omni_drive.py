"""SSL robots: acceleration, braking, top speed, saturation and wheel kinematics."""

from math import hypot, sqrt

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import GENERIC, JERK, SSL_ROBOTS
from tools.physics.scene import TICK, Scene, Trajectory, first_true, make_config

TOPIC = "omni_drive"
DIRECTIONS = np.array([0.0, 30.0, 45.0, 90.0, 135.0, 180.0, 200.0, 270.0])  # degrees
BODIES = ((1.0, 0.0, 0.0), (0.0, 0.8, 0.0), (0.7, -0.5, 2.0))  # m/s, m/s, rad/s

SPECS = "closed form, `robot-specs.yaml`"
SPEED_UP = Criterion(
    TOPIC, "time from 0 to 3 m/s at 4.7 m/s², eight directions", "s", absolute(0.01), SPECS
)
BRAKE = Criterion(
    TOPIC, "time from 3 m/s to 0 at 5.9 m/s², eight directions", "s", absolute(0.01), SPECS
)
TURN = Criterion(TOPIC, "time from 0 to 20 rad/s at 50.8 rad/s²", "s", absolute(0.01), SPECS)
STOP_TURN = Criterion(TOPIC, "time from 20 rad/s to 0 at 51.6 rad/s²", "s", absolute(0.01), SPECS)
TOP_SPEED = Criterion(TOPIC, "top speed of each preset", "m/s", percent(0.1), "`robot-specs.yaml`")
TOP_ANGULAR_VELOCITY = Criterion(
    TOPIC, "top angular velocity of each preset", "rad/s", percent(0.1), "`robot-specs.yaml`"
)
BY_WHEELS = Criterion(TOPIC, "speed for four wheel speeds", "m/s", percent(0.1), "wheel kinematics")
WHEELS_ANGULAR_VELOCITY = Criterion(
    TOPIC, "angular velocity for four wheel speeds", "rad/s", absolute(0.001), "wheel kinematics"
)
AGREE = Criterion(
    TOPIC,
    "wheel commands against body commands: distance between positions after 1 s",
    "m",
    absolute(0.001),
    "same motion",
)
SATURATED = Criterion(
    TOPIC, "command above the top speed: direction of motion", "degrees", absolute(0.1), "command"
)
JERKED_UP = Criterion(
    TOPIC, "acceleration time with a jerk limit of 20 m/s³", "s", absolute(0.01), "S-curve"
)
JERKED_DOWN = Criterion(
    TOPIC, "braking time with a jerk limit of 20 m/s³", "s", absolute(0.01), "S-curve"
)
MAX_JERK = Criterion(TOPIC, "maximum jerk with that limit", "m/s³", percent(1), "limit")


def checks() -> Checks:
    """Yield all checks of omnidirectional robots."""
    yield from _acceleration()
    yield from _turning()
    yield from _top_speeds()
    yield from _wheels()
    yield from _saturation()
    yield from _jerk_limit()


def lone_robot(
    robot: str | RobotModel = "ssl_generic", worlds: int = 1, time_step: float = TICK
) -> Scene:
    """Return a scene with one robot at rest at the center and the ball far away."""
    scene = Scene(make_config("ssl_a", 1, 0, robot=robot, time_step=time_step), worlds)
    scene.ball.position[:] = (0.0, 4.0)
    return scene


def speeds(trajectory: Trajectory) -> Array:
    """Return the speed of robot 0, m/s, shape (steps, worlds)."""
    velocity = trajectory.robots.velocity[:, :, 0]
    return norm(velocity[..., 0], velocity[..., 1])


def _acceleration() -> Checks:
    radians = np.radians(DIRECTIONS)
    forward, left = 3.0 * np.cos(radians), 3.0 * np.sin(radians)
    starting = lone_robot(worlds=len(DIRECTIONS))
    starting.command(0, v_x=forward, v_y=left)
    trajectory = starting.play(1.0)
    reached = trajectory.times[first_true(speeds(trajectory) >= 2.999)]
    stopping = lone_robot(worlds=len(DIRECTIONS))
    stopping.robots.velocity[:, 0] = np.stack([forward, left], axis=-1)
    trajectory = stopping.play(1.0)
    stopped = trajectory.times[first_true(speeds(trajectory) < 0.001)]
    for world, degrees in enumerate(DIRECTIONS):
        yield SPEED_UP(f"{degrees:g} degrees", 3.0 / GENERIC.max_acceleration, reached[world])
        yield BRAKE(f"{degrees:g} degrees", 3.0 / GENERIC.max_deceleration, stopped[world])


def _turning() -> Checks:
    scene = lone_robot(worlds=2)
    scene.command(0, v_theta=np.array([20.0, -20.0]))
    trajectory = scene.play(1.0)
    reached = trajectory.times[
        first_true(abs(trajectory.robots.angular_velocity[:, :, 0]) >= 19.99)
    ]
    scene = lone_robot(worlds=2)
    scene.robots.angular_velocity[:, 0] = [20.0, -20.0]
    trajectory = scene.play(1.0)
    stopped = trajectory.times[first_true(abs(trajectory.robots.angular_velocity[:, :, 0]) < 0.01)]
    for world, direction in enumerate(("counterclockwise", "clockwise")):
        yield TURN(direction, 20.0 / GENERIC.max_angular_acceleration, reached[world])
        yield STOP_TURN(direction, 20.0 / GENERIC.max_angular_deceleration, stopped[world])


def _top_speeds() -> Checks:
    """Command more than the limits allow; robots with wheel commands have no such command."""
    for name, robot in SSL_ROBOTS.items():
        if RobotModel(name).drive != "omni":
            continue
        scene = lone_robot(name, worlds=2)
        scene.command(0, v_y=np.array([-9.0, 0.0]), v_theta=np.array([0.0, 99.0]))
        last = scene.play(1.2).robots
        yield TOP_SPEED(f"`{name}`", robot.max_speed, -last.velocity[-1, 0, 0, 1])
        yield TOP_ANGULAR_VELOCITY(
            f"`{name}`", robot.max_angular_velocity, last.angular_velocity[-1, 1, 0]
        )


def wheel_speeds(v_x: float, v_y: float, v_theta: float) -> dict[str, float]:
    """Return wheel speeds (rad/s) for a body velocity (m/s, m/s, rad/s).

    The wheels of 24.75 mm radius sit at 60, 135, 225 and 300 degrees, 90 mm from the center.
    """
    angles = np.radians([60.0, 135.0, 225.0, 300.0])
    rims = -v_x * np.sin(angles) + v_y * np.cos(angles) + 0.09 * v_theta
    return {f"wheel_{index}": rim / 0.02475 for index, rim in enumerate(rims)}


def _wheels() -> Checks:
    for v_x, v_y, v_theta in BODIES:
        by_wheels, by_body = lone_robot("ssl_generic_wheels"), lone_robot()
        by_wheels.command(0, **wheel_speeds(v_x, v_y, v_theta))
        by_body.command(0, v_x=v_x, v_y=v_y, v_theta=v_theta)
        a, b = (scene.play(1.0).robots for scene in (by_wheels, by_body))
        case = f"{v_x:g} m/s, {v_y:g} m/s, {v_theta:g} rad/s"
        yield BY_WHEELS(case, hypot(v_x, v_y), norm(*a.velocity[-1, 0, 0]))
        yield WHEELS_ANGULAR_VELOCITY(case, v_theta, a.angular_velocity[-1, 0, 0])
        yield AGREE(case, 0.0, norm(*(a.position[-1, 0, 0] - b.position[-1, 0, 0])))


def _saturation() -> Checks:
    scene = lone_robot(worlds=2)
    scene.command(0, v_x=np.array([3.7, -5.0]), v_y=np.array([1.0, 9.0]))
    for world, position in enumerate(scene.play(1.0).robots.position[-1, :, 0]):
        command = scene.commands[world, 0]
        expected = np.degrees(np.arctan2(command[1], command[0]))
        case = f"({command[0]:g}, {command[1]:g}) m/s"
        yield SATURATED(case, expected, np.degrees(np.arctan2(position[1], position[0])))


def s_curve_time(change: float, max_acceleration: float, jerk: float) -> float:
    """Return the time (s) of a speed change (m/s) with limits of acceleration and jerk (SI)."""
    if change > max_acceleration**2 / jerk:
        return change / max_acceleration + max_acceleration / jerk
    return 2 * sqrt(change / jerk)


def _jerk_limit() -> Checks:
    robot = RobotModel("ssl_generic", max_jerk=JERK)
    for speed in (0.5, 1.0, 3.0):
        for criterion, start, target, limit in (
            (JERKED_UP, 0.0, speed, GENERIC.max_acceleration),
            (JERKED_DOWN, speed, 0.0, GENERIC.max_deceleration),
        ):
            scene = lone_robot(robot)
            scene.robots.velocity[:, 0, 0] = start
            scene.command(0, v_x=target)
            trajectory = scene.play(1.5)
            speed_x = trajectory.robots.velocity[:, 0, 0, 0].astype(np.float64)
            reached = trajectory.times[first_true(abs(speed_x - target) < 1e-4)]
            case = f"{start:g} to {target:g} m/s"
            yield criterion(case, s_curve_time(speed, limit, JERK), reached)
            jerks = np.diff(np.diff(speed_x, prepend=start), prepend=0.0) / TICK**2
            yield MAX_JERK(case, JERK, abs(jerks).max())

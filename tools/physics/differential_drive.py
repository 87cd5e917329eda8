"""VSSS robots: top speed, acceleration, arcs and skids of two-wheel kinematics."""

from math import pi

import numpy as np

from rsoccer._core import Field
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import VSS_ROBOTS, VssRobot
from tools.physics.scene import STEP, TICK, Scene, first_true, make_config

TOPIC = "differential_drive"
WIDE = Field("vss_3v3", length=8.0, width=8.0)
MISMATCH = 0.02

MEASURED = "measured on rSim"
TOP_SPEED = Criterion(TOPIC, "top speed", "m/s", percent(0.5), "rpm times wheel radius")
RSIM_SPEED = Criterion(TOPIC, "rSim's robot: top speed", "m/s", percent(0.5), MEASURED)
RSIM_ANGULAR_VELOCITY = Criterion(
    TOPIC, "rSim's robot: angular velocity, wheels at ±40 rad/s", "rad/s", percent(1), MEASURED
)
RSIM_STEP = Criterion(
    TOPIC, "rSim's robot: acceleration in the first 0.1 s", "m/s²", percent(1), MEASURED
)
SPEED_UP = Criterion(TOPIC, "acceleration in the first 0.1 s", "m/s²", percent(1), "tire grip")
TO_TOP = Criterion(
    TOPIC, "time to 90% of the top speed", "s", absolute(0.01), "closed form, tire grip"
)
TOP_ANGULAR_VELOCITY = Criterion(
    TOPIC, "top angular velocity on the spot", "rad/s", percent(0.5), "rim speed by half the track"
)
TURN_UP = Criterion(
    TOPIC, "angular acceleration on the spot", "rad/s²", percent(1), "tire grip, inertia of a plate"
)
DRIFT = Criterion(
    TOPIC, "equal wheel speeds: lateral drift after 1 m", "mm", absolute(0.01), "straight line"
)
ARC = Criterion(
    TOPIC, "wheel speeds 2% apart: radius of the arc", "m", percent(1), "wheel kinematics"
)
ARC_ANGULAR_VELOCITY = Criterion(
    TOPIC, "wheel speeds 2% apart: angular velocity", "rad/s", percent(1), "wheel kinematics"
)
SKID = Criterion(
    TOPIC, "sideways skid from 1 m/s: distance", "m", absolute(0.003), "closed form, side grip"
)
SPOT = Criterion(
    TOPIC, "turning on the spot: displacement after 1 s", "mm", absolute(0.1), "opposite wheels"
)


def checks() -> Checks:
    """Yield all checks of differential-drive robots."""
    for name, robot in VSS_ROBOTS.items():
        yield from _forward(name, robot)
        yield from _on_the_spot(name, robot)
        yield from _arc(name, robot)
        yield from _skid(name, robot)
    yield from _rsim_reference()


def top_rim_speed(robot: VssRobot) -> float:
    """Return the wheels' rim speed at the motors' free speed, m/s."""
    return robot.rpm / 60 * 2 * pi * robot.wheel_radius


def lone_robot(name: str, time_step: float = TICK) -> Scene:
    """Return a scene with one robot at rest on a wide table and the ball far away."""
    scene = Scene(make_config(WIDE, 1, 0, robot=name, time_step=time_step))
    scene.ball.position[:] = (0.0, 3.0)
    return scene


def _forward(name: str, robot: VssRobot) -> Checks:
    scene = lone_robot(name)
    scene.command(0, left=1e3, right=1e3)
    trajectory = scene.play(1.2)
    speed = trajectory.robots.velocity[:, 0, 0, 0]
    yield TOP_SPEED(f"`{name}`", top_rim_speed(robot), speed[-1])
    yield SPEED_UP(f"`{name}`", robot.longitudinal_grip, speed[round(0.1 / TICK) - 1] / 0.1)
    reached = trajectory.times[first_true(speed >= 0.9 * top_rim_speed(robot))]
    yield TO_TOP(f"`{name}`", 0.9 * top_rim_speed(robot) / robot.longitudinal_grip, reached)
    yield DRIFT(f"`{name}`", 0.0, 1000 * trajectory.robots.position[-1, 0, 0, 1])


def _on_the_spot(name: str, robot: VssRobot) -> Checks:
    scene = lone_robot(name)
    scene.command(0, left=-1e3, right=1e3)
    trajectory = scene.play(1.0)
    angular_velocity = trajectory.robots.angular_velocity[:, 0, 0]
    yield TOP_ANGULAR_VELOCITY(
        f"`{name}`", 2 * top_rim_speed(robot) / robot.track_width, angular_velocity[-1]
    )
    # Both tires push with their full grip on a lever of half the track; inertia of a square plate.
    inertia = robot.side_length**2 / 6
    yield TURN_UP(
        f"`{name}`",
        robot.longitudinal_grip * robot.track_width / 2 / inertia,
        angular_velocity[3] / (4 * TICK),
    )
    yield SPOT(f"`{name}`", 0.0, 1000 * norm(*trajectory.robots.position[-1, 0, 0]))


def _arc(name: str, robot: VssRobot) -> Checks:
    left, right = 20.0, 20.0 * (1 + MISMATCH)
    scene = lone_robot(name, STEP)
    scene.command(0, left=left, right=right)
    robots = scene.play(4.0).robots
    radius = robot.track_width / 2 * (right + left) / (right - left)
    yield ARC(f"`{name}`", radius, radius_of(robots.position[40::30, 0, 0]))
    turn = robot.wheel_radius * (right - left) / robot.track_width
    yield ARC_ANGULAR_VELOCITY(f"`{name}`", turn, robots.angular_velocity[-1, 0, 0])


def radius_of(points: Array) -> float:
    """Return the radius of the circle through the first three points, m."""
    a, b, c = points[:3].astype(np.float64)
    area = abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2
    return float(norm(*(b - a)) * norm(*(c - b)) * norm(*(a - c)) / (4 * area))


def _skid(name: str, robot: VssRobot) -> Checks:
    scene = lone_robot(name)
    scene.robots.velocity[:, 0, 1] = 1.0
    robots = scene.play(1.0).robots
    distance = robots.position[-1, 0, 0, 1] if robots.velocity[-1, 0, 0, 1] < 1e-4 else np.nan
    yield SKID(f"`{name}`", 1.0 / (2 * robot.lateral_grip), distance)


def _rsim_reference() -> Checks:
    """Compare with black-box measurements of rSim's VSS robot."""
    scene = lone_robot("vss_440rpm")
    scene.command(0, left=100.0, right=100.0)
    speed = scene.play(0.5).robots.velocity[:, 0, 0, 0]
    yield RSIM_SPEED("440 rpm", 1.199, speed[-1])
    yield RSIM_STEP("440 rpm", 6.85, speed[round(0.1 / TICK) - 1] / 0.1)
    scene = lone_robot("vss_440rpm")
    scene.command(0, left=-40.0, right=40.0)
    yield RSIM_ANGULAR_VELOCITY("440 rpm", 26.6, scene.play(0.5).robots.angular_velocity[-1, 0, 0])

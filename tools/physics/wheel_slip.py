"""VSSS robots with sliding tires, under Coulomb friction: turns, skids and locked wheels."""

from math import cos, pi, sin

import numpy as np

from rsoccer._core import Field
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import VSS_ROBOTS, VssRobot
from tools.physics.differential_drive import WIDE, lone_robot, top_rim_speed
from tools.physics.scene import TICK, Scene, first_true, make_config
from tools.physics.tire_friction import Motion, motion_after, straightening_time

TOPIC = "wheel_slip"
ANGULAR_VELOCITIES = {"vss_440rpm": (7.0, 15.0, 30.0), "vss_650rpm": (7.0, 15.0)}  # rad/s
SHORT_TICK = 0.001  # s
SLOW = 1.0  # rad/s
MOMENTS = (0.05, 0.1)  # s
ENDLESS = Field("vss_3v3", length=200.0, width=200.0)
REVERSAL_WORLDS = 100

FRICTION = "friction opposes slip"
STRAIGHT = Criterion(
    TOPIC,
    "spinning robot, full speed ahead commanded: time to 1 rad/s",
    "s",
    percent(10),
    FRICTION,
)
STRAIGHT_SHORT = Criterion(TOPIC, "the same with ticks of 1 ms", "s", percent(2), FRICTION)
LATERAL = Criterion(
    TOPIC,
    "1 m/s sideways, full speed ahead commanded: lateral speed",
    "m/s",
    absolute(0.01),
    FRICTION,
)
FORWARD = Criterion(
    TOPIC,
    "1 m/s sideways, full speed ahead commanded: forward speed",
    "m/s",
    absolute(0.01),
    FRICTION,
)
LOCKED_FORWARD = Criterion(
    TOPIC, "1 m/s at 45 degrees, locked wheels: forward speed", "m/s", absolute(0.01), FRICTION
)
LOCKED_LATERAL = Criterion(
    TOPIC, "1 m/s at 45 degrees, locked wheels: lateral speed", "m/s", absolute(0.01), FRICTION
)
RIM = Criterion(
    TOPIC,
    "random full-speed reversals: maximum tire speed along the wheel",
    "m/s",
    percent(1),
    "rim speed",
)
FASTEST = Criterion(
    TOPIC,
    "random full-speed reversals: excess of the center over the top speed",
    "m/s",
    absolute(0.01),
    "at most top speed",
)


def checks() -> Checks:
    """Yield all checks of sliding tires."""
    for name, robot in VSS_ROBOTS.items():
        for angular_velocity in ANGULAR_VELOCITIES[name]:
            case = f"`{name}`, {angular_velocity:g} rad/s"
            expected = straightening_time(robot, top_rim_speed(robot), angular_velocity, SLOW)
            yield STRAIGHT(case, expected, _straight(name, angular_velocity, TICK))
            yield STRAIGHT_SHORT(case, expected, _straight(name, angular_velocity, SHORT_TICK))
        yield from _skids(name, robot)
        yield from _reversals(name, robot)


def _straight(name: str, angular_velocity: float, tick: float) -> float:
    """Return the time until the robot turns slower than SLOW, s; NaN if it never does."""
    scene = Scene(make_config(WIDE, 1, 0, robot=name, tick=tick, time_step=tick))
    scene.ball.position[:] = (0.0, 3.0)
    scene.robots.angular_velocity[:] = angular_velocity
    scene.command(0, left=1e3, right=1e3)
    trajectory = scene.play(3.0)
    step = first_true(trajectory.robots.angular_velocity[:, 0, 0] < SLOW)
    return float(trajectory.times[step]) if step >= 0 else np.nan


def _skids(name: str, robot: VssRobot) -> Checks:
    diagonal = Motion(cos(pi / 4), sin(pi / 4))
    for wheel_speed, start, criteria in (
        (1e3, Motion(left=1.0), (FORWARD, LATERAL)),
        (0.0, diagonal, (LOCKED_FORWARD, LOCKED_LATERAL)),
    ):
        scene = lone_robot(name)
        scene.robots.velocity[:, 0] = (start.forward, start.left)
        scene.command(0, left=wheel_speed, right=wheel_speed)
        velocity = scene.play(max(MOMENTS)).robots.velocity[:, 0, 0]
        for moment in MOMENTS:
            expected = motion_after(
                robot, top_rim_speed(robot) if wheel_speed else 0.0, start, moment
            )
            got = velocity[round(moment / TICK) - 1]
            case = f"`{name}`, {moment:g} s"
            yield criteria[0](case, expected.forward, got[0])
            yield criteria[1](case, expected.left, got[1])


def _reversals(name: str, robot: VssRobot) -> Checks:
    """Command each wheel full forward or full back at random in each step."""
    scene = Scene(make_config(ENDLESS, 1, 0, robot=name), REVERSAL_WORLDS)
    scene.ball.position[:] = (0.0, 90.0)
    match, rng = scene.begin(), np.random.default_rng(3)
    max_tire = max_center = 0.0
    for _ in range(200):
        scene.commands[:] = rng.choice([-1e3, 1e3], scene.commands.shape)
        robots = match.run(scene.config.time_step).robots
        velocity, heading = robots.velocity[-1, :, 0], robots.heading[-1, :, 0]
        turning = abs(robots.angular_velocity[-1, :, 0]) * robot.track_width / 2
        max_tire = max(max_tire, float((abs((velocity * heading).sum(axis=-1)) + turning).max()))
        max_center = max(max_center, float(np.hypot(*velocity.T).max()))
    yield RIM(f"`{name}`, 5 s", top_rim_speed(robot), max_tire)
    yield FASTEST(f"`{name}`, 5 s", 0.0, max(max_center - top_rim_speed(robot), 0.0))

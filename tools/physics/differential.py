"""VSSS robots against the closed form of two wheels: speeds, accelerations, arcs, skids."""

from math import pi

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import Field
from rsoccer.frame import Array, length
from tools.physics.check import Checks, Line, percent, within
from tools.physics.cited import VSS_ROBOTS, VssRobot
from tools.physics.scene import STEP, TICK, Scene, first

TOPIC = "differential"
WIDE = Field("vss_3v3", length=8.0, width=8.0)
MISMATCH = 0.02

MEASURED = "measured on rSim"
TOP_SPEED = Line(TOPIC, "top speed", "m/s", percent(0.5), "rpm times wheel radius")
RSIM_SPEED = Line(TOPIC, "top speed of rSim's robot", "m/s", percent(0.5), MEASURED)
RSIM_TURN = Line(
    TOPIC, "turn rate of rSim's robot, wheels at +-40 rad/s", "rad/s", percent(1), MEASURED
)
RSIM_STEP = Line(TOPIC, "speed-up of rSim's robot, first 0.1 s", "m/s²", percent(1), MEASURED)
SPEED_UP = Line(TOPIC, "speed-up, first 0.1 s", "m/s²", percent(1), "tyres' grip")
TO_TOP = Line(TOPIC, "time to 0.9 of the top speed", "s", within(0.01), "closed form, grip")
TOP_TURN = Line(
    TOPIC, "top turn rate on the spot", "rad/s", percent(0.5), "rim speed by half track"
)
TURN_UP = Line(TOPIC, "turning speed-up", "rad/s²", percent(1), "grip, inertia of a plate")
DRIFT = Line(TOPIC, "aside after 1 m with equal wheels", "mm", within(0.01), "straight on")
ARC = Line(TOPIC, "radius of the arc with wheels 2% apart", "m", percent(1), "kinematics")
ARC_TURN = Line(TOPIC, "turn rate on that arc", "rad/s", percent(1), "kinematics")
SKID = Line(TOPIC, "skid sideways from 1 m/s", "m", within(0.003), "closed form, side grip")
SPOT = Line(TOPIC, "off its place after 1 s of turning", "mm", within(0.1), "opposite wheels")


def checks() -> Checks:
    """Every line of the acceptance about robots on two wheels."""
    for name, robot in VSS_ROBOTS.items():
        yield from _forward(name, robot)
        yield from _on_the_spot(name, robot)
        yield from _arc(name, robot)
        yield from _skid(name, robot)
    yield from _like_rsim()


def top(robot: VssRobot) -> float:
    """Free speed of its wheels' rims, m/s."""
    return robot.rpm / 60 * 2 * pi * robot.wheel_radius


def alone(name: str, time_step: float = TICK) -> Scene:
    """A robot at rest on a wide table, the ball far off."""
    scene = Scene(SimConfig(WIDE, 1, 0, robot=name, time_step=time_step))
    scene.ball.position[:] = (0.0, 3.0)
    return scene


def _forward(name: str, robot: VssRobot) -> Checks:
    scene = alone(name)
    scene.tell(0, left=1e3, right=1e3)
    track = scene.play(1.2)
    speed = track.robots.velocity[:, 0, 0, 0]
    yield TOP_SPEED(f"`{name}`", top(robot), speed[-1])
    yield SPEED_UP(f"`{name}`", robot.forward_grip, speed[round(0.1 / TICK) - 1] / 0.1)
    there = track.times[first(speed >= 0.9 * top(robot))]
    yield TO_TOP(f"`{name}`", 0.9 * top(robot) / robot.forward_grip, there)
    yield DRIFT(f"`{name}`", 0.0, 1000 * track.robots.position[-1, 0, 0, 1])


def _on_the_spot(name: str, robot: VssRobot) -> Checks:
    scene = alone(name)
    scene.tell(0, left=-1e3, right=1e3)
    track = scene.play(1.0)
    spin = track.robots.spin[:, 0, 0]
    yield TOP_TURN(f"`{name}`", 2 * top(robot) / robot.track, spin[-1])
    # Both wheels at their tyres' grip, on a lever of half the track; a plate's inertia.
    inertia = robot.side**2 / 6
    yield TURN_UP(f"`{name}`", robot.forward_grip * robot.track / 2 / inertia, spin[3] / (4 * TICK))
    yield SPOT(f"`{name}`", 0.0, 1000 * length(*track.robots.position[-1, 0, 0]))


def _arc(name: str, robot: VssRobot) -> Checks:
    left, right = 20.0, 20.0 * (1 + MISMATCH)
    scene = alone(name, STEP)
    scene.tell(0, left=left, right=right)
    robots = scene.play(4.0).robots
    radius = robot.track / 2 * (right + left) / (right - left)
    yield ARC(f"`{name}`", radius, radius_of(robots.position[40::30, 0, 0]))
    turn = robot.wheel_radius * (right - left) / robot.track
    yield ARC_TURN(f"`{name}`", turn, robots.spin[-1, 0, 0])


def radius_of(points: Array) -> float:
    """Radius of the circle through the first three points."""
    a, b, c = points[:3].astype(np.float64)
    area = abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2
    return float(length(*(b - a)) * length(*(c - b)) * length(*(a - c)) / (4 * area))


def _skid(name: str, robot: VssRobot) -> Checks:
    scene = alone(name)
    scene.robots.velocity[:, 0, 1] = 1.0
    robots = scene.play(1.0).robots
    slid = robots.position[-1, 0, 0, 1] if robots.velocity[-1, 0, 0, 1] < 1e-4 else np.nan
    yield SKID(f"`{name}`", 1.0 / (2 * robot.side_grip), slid)


def _like_rsim() -> Checks:
    """What was measured black-box on the old simulator's robot."""
    scene = alone("vss_440rpm")
    scene.tell(0, left=100.0, right=100.0)
    speed = scene.play(0.5).robots.velocity[:, 0, 0, 0]
    yield RSIM_SPEED("440 rpm", 1.199, speed[-1])
    yield RSIM_STEP("440 rpm", 6.85, speed[round(0.1 / TICK) - 1] / 0.1)
    scene = alone("vss_440rpm")
    scene.tell(0, left=-40.0, right=40.0)
    yield RSIM_TURN("440 rpm", 26.6, scene.play(0.5).robots.spin[-1, 0, 0])

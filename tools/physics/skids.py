"""VSSS robots whose tyres slide: spins, skids and locked wheels, against Coulomb's friction."""

from math import cos, pi, sin

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import Field
from tools.physics.check import Checks, Line, percent, within
from tools.physics.cited import VSS_ROBOTS, VssRobot
from tools.physics.differential import WIDE, alone, top
from tools.physics.scene import TICK, Scene, first
from tools.physics.tyres import Motion, slid, straight_after

TOPIC = "skids"
SPINS = {"vss_440rpm": (7.0, 15.0, 30.0), "vss_650rpm": (7.0, 15.0)}  # rad/s
SHORT_TICK = 0.001  # s
SLOW = 1.0  # rad/s
MOMENTS = (0.05, 0.1)  # s
ENDLESS = Field("vss_3v3", length=200.0, width=200.0)
SEESAWS = 100

FRICTION = "friction against the slip"
STRAIGHT = Line(
    TOPIC, "a spin told full speed straight on: time to 1 rad/s", "s", percent(10), FRICTION
)
STRAIGHT_SHORT = Line(TOPIC, "the same in ticks of 1 ms", "s", percent(2), FRICTION)
ASIDE = Line(TOPIC, "and still sideways", "m/s", within(0.01), FRICTION)
AHEAD = Line(
    TOPIC, "told full speed from 1 m/s sideways: speed forward", "m/s", within(0.01), FRICTION
)
LOCKED_AHEAD = Line(
    TOPIC, "1 m/s at 45 degrees, wheels locked: still forward", "m/s", within(0.01), FRICTION
)
LOCKED_ASIDE = Line(TOPIC, "and with locked wheels sideways", "m/s", within(0.01), FRICTION)
RIM = Line(
    TOPIC, "fastest tyre along its wheel, full speed to and fro at random", "m/s", percent(1), "rim"
)
FASTEST = Line(TOPIC, "centre beyond the top speed there", "m/s", within(0.01), "at most top speed")


def checks() -> Checks:
    """Every line of the acceptance about tyres that slide."""
    for name, robot in VSS_ROBOTS.items():
        for spin in SPINS[name]:
            case = f"`{name}`, {spin:g} rad/s"
            expected = straight_after(robot, top(robot), spin, SLOW)
            yield STRAIGHT(case, expected, _straight(name, spin, TICK))
            yield STRAIGHT_SHORT(case, expected, _straight(name, spin, SHORT_TICK))
        yield from _skids(name, robot)
        yield from _seesaw(name, robot)


def _straight(name: str, spin: float, tick: float) -> float:
    """When it turns slower than that, s."""
    scene = Scene(SimConfig(WIDE, 1, 0, robot=name, tick=tick, time_step=tick))
    scene.ball.position[:] = (0.0, 3.0)
    scene.robots.spin[:] = spin
    scene.tell(0, left=1e3, right=1e3)
    track = scene.play(3.0)
    step = first(track.robots.spin[:, 0, 0] < SLOW)
    return float(track.times[step]) if step >= 0 else np.nan


def _skids(name: str, robot: VssRobot) -> Checks:
    diagonal = Motion(cos(pi / 4), sin(pi / 4))
    for told, start, lines in (
        (1e3, Motion(left=1.0), (AHEAD, ASIDE)),
        (0.0, diagonal, (LOCKED_AHEAD, LOCKED_ASIDE)),
    ):
        scene = alone(name)
        scene.robots.velocity[:, 0] = (start.forward, start.left)
        scene.tell(0, left=told, right=told)
        velocity = scene.play(max(MOMENTS)).robots.velocity[:, 0, 0]
        for moment in MOMENTS:
            expected = slid(robot, top(robot) if told else 0.0, start, moment)
            got = velocity[round(moment / TICK) - 1]
            case = f"`{name}`, {moment:g} s"
            yield lines[0](case, expected.forward, got[0])
            yield lines[1](case, expected.left, got[1])


def _seesaw(name: str, robot: VssRobot) -> Checks:
    """Each wheel full forward or full back, as drawn, a step at a time."""
    scene = Scene(SimConfig(ENDLESS, 1, 0, robot=name), SEESAWS)
    scene.ball.position[:] = (0.0, 90.0)
    match, rng = scene.begin(), np.random.default_rng(3)
    tyre = centre = 0.0
    for _ in range(200):
        scene.commands[:] = rng.choice([-1e3, 1e3], scene.commands.shape)
        robots = match.run(scene.config.time_step).robots
        velocity, heading = robots.velocity[-1, :, 0], robots.heading[-1, :, 0]
        turning = abs(robots.spin[-1, :, 0]) * robot.track / 2
        tyre = max(tyre, float((abs((velocity * heading).sum(axis=-1)) + turning).max()))
        centre = max(centre, float(np.hypot(*velocity.T).max()))
    yield RIM(f"`{name}`, 5 s", top(robot), tyre)
    yield FASTEST(f"`{name}`, 5 s", 0.0, max(centre - top(robot), 0.0))

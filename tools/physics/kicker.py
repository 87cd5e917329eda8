"""Beam and kicker: when a robot sees the ball, and what a kick does to it."""

from math import radians, sin, sqrt

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import RobotModel
from rsoccer.frame import Array, length
from tools.physics.check import EXACT, Checks, Line, percent, within
from tools.physics.cited import BALLS, GENERIC, SSL_ROBOTS, G
from tools.physics.scene import TICK, Scene

TOPIC = "kicker"
BALL = BALLS["ssl_tigers"]
HEADINGS = (0.0, 50.0, 180.0, 290.0)  # degrees
KICKS = (1.0, 4.0, 6.5)  # m/s
BEAM = 0.010  # m before the front: rSim's robot
RECHARGE = 0.1  # s: ER-Force's simulator
TOGETHER = (82.0, 90.0, 110.0, 130.0)  # degrees between two robots that kick one ball

BEAM_DEPTH = Line(
    TOPIC, "farthest ball before the front that the beam sees", "mm", within(0.2), "rSim"
)
BEAM_WIDTH = Line(TOPIC, "farthest off the middle that it sees", "mm", within(0.2), "mouth's width")
BEAM_HEIGHT = Line(TOPIC, "height up to which it sees", "mm", within(0.2), "section of the ball")
SPEED = Line(TOPIC, "speed of a kick one tick later, four headings", "m/s", percent(2), "command")
ASIDE = Line(TOPIC, "its direction off the robot's", "degrees", within(0.5), "command")
CHIP_ALONG = Line(TOPIC, "chip of 3 m/s forward and up: forward", "m/s", percent(2), "command")
CHIP_UP = Line(TOPIC, "and up after 0.1 s", "m/s", percent(3), "command, gravity")
MOVING = Line(TOPIC, "kick of 4 m/s from a robot at 1 m/s", "m/s", percent(2), "sum of both")
MOST = Line(TOPIC, "hardest kick of each preset", "m/s", percent(2), "`robot-specs.yaml`")
MOST_CHIP = Line(TOPIC, "hardest chip of each preset", "m/s", percent(2), "`robot-specs.yaml`")
MISSES = Line(TOPIC, "kicks at a ball that is not in the mouth", "of 4", EXACT, "no beam is cut")
TWO = Line(TOPIC, "two kick one ball with 8 m/s: its speed", "m/s", percent(2), "two plates")
TWO_ASIDE = Line(TOPIC, "its direction off the middle", "degrees", within(0.5), "symmetry")
RECHARGES = Line(TOPIC, "least time between two kicks", "s", within(0.0051), "ER-Force")


def checks() -> Checks:
    """Every line of the acceptance about beam and kicker."""
    yield from _beam()
    yield from _headings()
    yield from _chip()
    yield from _moving()
    yield from _hardest()
    yield from _misses()
    yield from _recharging()
    yield from _together()


def reach(robot: str = "ssl_generic") -> float:
    """From a robot's centre to that of a ball at its front, m."""
    return SSL_ROBOTS[robot].front + BALL.radius


def with_ball(
    robot: str | RobotModel = "ssl_generic", worlds: int = 1, time_step: float = TICK
) -> Scene:
    """A robot at the centre with the ball at its front."""
    scene = Scene(SimConfig("ssl_b", 1, 0, robot=robot, time_step=time_step), worlds)
    name = robot if isinstance(robot, str) else robot.name
    scene.ball.position[:] = (reach(name), 0.0)
    return scene


def _seen(offsets: Array, axis: str) -> float:
    """The farthest of these offsets of the ball (m) from its place in the mouth that is seen."""
    scene = with_ball(worlds=len(offsets))
    if axis == "z":
        scene.ball.height[:] = offsets
    else:
        scene.ball.position[:, "xy".index(axis)] += offsets
    seen = scene.begin().frame.robots.infrared[:, 0] == 1.0
    return float(offsets[seen].max())


def _beam() -> Checks:
    offsets = np.arange(0.0, 0.05, 1e-4)
    yield BEAM_DEPTH("on the floor", 1000 * BEAM, 1000 * _seen(offsets, "x"))
    yield BEAM_WIDTH("on the floor", 500 * GENERIC.mouth_width, 1000 * _seen(offsets, "y"))
    # It runs as high as a ball's middle, and in its way is less of a ball the higher it is.
    beside = BALL.radius - BEAM
    highest = sqrt(BALL.radius**2 - beside**2)
    yield BEAM_HEIGHT("at the front", 1000 * highest, 1000 * _seen(offsets, "z"))


def _headings() -> Checks:
    for degrees in HEADINGS:
        scene = with_ball(worlds=len(KICKS))
        scene.face(0, degrees)
        forward = np.array([np.cos(radians(degrees)), sin(radians(degrees))])
        scene.ball.position[:] = reach() * forward
        scene.tell(0, kick_v_x=np.array(KICKS))
        velocity = scene.play(TICK).ball.velocity[-1]
        for (x, y), kick in zip(velocity, KICKS, strict=True):
            case = f"{kick:g} m/s at {degrees:g} degrees"
            along, across = x * forward[0] + y * forward[1], y * forward[0] - x * forward[1]
            yield SPEED(case, kick, along)
            yield ASIDE(case, 0.0, np.degrees(np.arctan2(across, along)))


def _chip() -> Checks:
    scene = with_ball()
    scene.tell(0, kick_v_x=3.0, kick_v_z=3.0)
    ball = scene.play(0.1).ball
    yield CHIP_ALONG("45 degrees", 3.0, ball.velocity[-1, 0, 0])
    yield CHIP_UP("45 degrees", 3.0 - 0.1 * G, ball.vertical_velocity[-1, 0])


def _moving() -> Checks:
    scene = with_ball()
    scene.robots.velocity[:, 0, 0] = scene.ball.velocity[:, 0] = 1.0
    scene.tell(0, v_x=1.0, kick_v_x=4.0)
    yield MOVING("forwards", 5.0, scene.play(TICK).ball.velocity[-1, 0, 0])


def _hardest() -> Checks:
    for name, robot in SSL_ROBOTS.items():
        scene = with_ball(name, worlds=2)
        scene.tell(0, kick_v_x=20.0, kick_v_z=np.array([0.0, 20.0]))
        ball = scene.play(TICK).ball
        speed = length(ball.velocity[-1, :, 0], ball.vertical_velocity[-1])
        yield MOST(f"`{name}`", robot.max_kick, speed[0])
        yield MOST_CHIP(f"`{name}`", robot.max_chip, speed[1])


def _misses() -> Checks:
    scene = with_ball(worlds=4)
    # Too far before it, beside its mouth, behind it, beside it.
    scene.ball.position[:] = [[reach() + 0.012, 0], [reach(), 0.034], [-0.12, 0], [0, 0.12]]
    scene.tell(0, kick_v_x=5.0)
    ball = scene.play(0.05).ball
    moved = (ball.velocity[-1] != 0.0).any(axis=-1) | (ball.last_touch[-1] != -1.0)
    yield MISSES("before, beside, behind", 0, moved.sum())


def _recharging() -> Checks:
    """The back of a goal right before the mouth sends the ball back before it is charged."""
    scene = with_ball()
    scene.robots.position[:, 0] = (4.52, 0.0)
    scene.ball.position[:] = (4.52 + reach(), 0.0)
    scene.tell(0, kick_v_x=6.0)
    track = scene.play(0.6)
    fast = np.append([False], track.ball.velocity[:, 0, 0] > 4.0)
    kicks = track.times[np.flatnonzero(fast[1:] & ~fast[:-1])]
    yield RECHARGES(f"{len(kicks)} kicks", RECHARGE, np.diff(kicks).min(initial=np.inf))


def _together() -> Checks:
    """Each with the ball at the outer edge of its mouth, so that there is room for both.

    A plate pushes until the ball is as fast as the plate along the plate's direction, and gives no
    more than alone: up to 90 degrees the first is the bound, beyond it the second.
    """
    for degrees in TOGETHER:
        scene = Scene(SimConfig("ssl_b", 2, 0, time_step=TICK))
        for index, turned in enumerate((degrees / 2, -degrees / 2)):
            x, y = np.cos(radians(turned)), sin(radians(turned))
            off = 0.03 if turned < 0 else -0.03
            depth = reach() + 0.009
            scene.robots.position[:, index] = (off * -y - depth * x, off * x - depth * y)
            scene.face(index, turned)
            scene.tell(index, kick_v_x=8.0)
        velocity = scene.play(TICK).ball.velocity[-1, 0]
        aslant, case = np.cos(radians(degrees / 2)), f"{degrees:g} degrees apart"
        yield TWO(case, 8.0 * min(1 / aslant, 2 * aslant), length(*velocity))
        yield TWO_ASIDE(case, 0.0, np.degrees(np.arctan2(velocity[1], velocity[0])))

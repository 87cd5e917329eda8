"""Break beam and kicker: detection range, kick speed and direction, chips, recharge time."""

from math import radians, sin, sqrt

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, SSL_ROBOTS, G
from tools.physics.scene import TICK, Scene, make_config

TOPIC = "kicker"
BALL = BALLS["ssl_tigers"]
HEADINGS = (0.0, 50.0, 180.0, 290.0)  # degrees
KICKS = (1.0, 4.0, 6.5)  # m/s
BEAM = 0.010  # m before the front: rSim's robot
RECHARGE = 0.1  # s: ER-Force's simulator
ANGLES_APART = (82.0, 90.0, 110.0, 130.0)  # degrees between two robots that kick one ball

BEAM_DEPTH = Criterion(
    TOPIC, "break beam: maximum detected distance to the front", "mm", absolute(0.2), "rSim"
)
BEAM_WIDTH = Criterion(
    TOPIC, "break beam: maximum detected lateral offset", "mm", absolute(0.2), "mouth width"
)
BEAM_HEIGHT = Criterion(
    TOPIC, "break beam: maximum detected height", "mm", absolute(0.2), "section of the ball"
)
SPEED = Criterion(TOPIC, "kick speed one tick later, four headings", "m/s", percent(2), "command")
DIRECTION = Criterion(
    TOPIC, "kick direction relative to the heading", "degrees", absolute(0.5), "command"
)
CHIP_ALONG = Criterion(
    TOPIC, "chip of 3 m/s forward and 3 m/s up: forward speed", "m/s", percent(2), "command"
)
CHIP_UP = Criterion(
    TOPIC,
    "chip of 3 m/s forward and 3 m/s up: vertical speed after 0.1 s",
    "m/s",
    percent(3),
    "command, gravity",
)
MOVING = Criterion(
    TOPIC,
    "kick of 4 m/s from a robot driving at 1 m/s: ball speed",
    "m/s",
    percent(2),
    "sum of both speeds",
)
MAX_KICK = Criterion(
    TOPIC, "maximum kick speed of each preset", "m/s", percent(2), "`robot-specs.yaml`"
)
MAX_CHIP = Criterion(
    TOPIC, "maximum chip speed of each preset", "m/s", percent(2), "`robot-specs.yaml`"
)
MISSES = Criterion(
    TOPIC, "kicks without the ball in the mouth: ball moved", "of 4", EXACT, "beam not broken"
)
TWO_KICKERS = Criterion(
    TOPIC, "two robots kick one ball at 8 m/s: ball speed", "m/s", percent(2), "two kicker plates"
)
TWO_KICKERS_DIRECTION = Criterion(
    TOPIC,
    "two robots kick one ball at 8 m/s: direction off the bisector",
    "degrees",
    absolute(0.5),
    "symmetry",
)
RECHARGES = Criterion(TOPIC, "minimum time between two kicks", "s", absolute(0.0051), "ER-Force")


def checks() -> Checks:
    """Yield all checks of break beam and kicker."""
    yield from _beam()
    yield from _headings()
    yield from _chip()
    yield from _moving()
    yield from _limits()
    yield from _misses()
    yield from _recharging()
    yield from _two_kickers()


def front_offset(robot: str = "ssl_generic") -> float:
    """Return the distance from a robot's center to the center of a ball at its front, m."""
    return SSL_ROBOTS[robot].front_distance + BALL.radius


def with_ball(
    robot: str | RobotModel = "ssl_generic", worlds: int = 1, time_step: float = TICK
) -> Scene:
    """Return a scene with one robot at the center and the ball at its front."""
    scene = Scene(make_config("ssl_b", 1, 0, robot=robot, time_step=time_step), worlds)
    name = robot if isinstance(robot, str) else robot.name
    scene.ball.position[:] = (front_offset(name), 0.0)
    return scene


def _max_detected(offsets: Array, axis: str) -> float:
    """Return the largest ball offset (m) along an axis at which the break beam detects the ball."""
    scene = with_ball(worlds=len(offsets))
    if axis == "z":
        scene.ball.height[:] = offsets
    else:
        scene.ball.position[:, "xy".index(axis)] += offsets
    detected = scene.begin().frame.robots.infrared[:, 0] == 1.0
    return float(offsets[detected].max())


def _beam() -> Checks:
    offsets = np.arange(0.0, 0.05, 1e-4)
    yield BEAM_DEPTH("on the floor", 1000 * BEAM, 1000 * _max_detected(offsets, "x"))
    yield BEAM_WIDTH("on the floor", 500 * GENERIC.mouth_width, 1000 * _max_detected(offsets, "y"))
    # The beam runs at the height of a resting ball's center; a higher ball covers less of it.
    beside = BALL.radius - BEAM
    highest = sqrt(BALL.radius**2 - beside**2)
    yield BEAM_HEIGHT("at the front", 1000 * highest, 1000 * _max_detected(offsets, "z"))


def _headings() -> Checks:
    for degrees in HEADINGS:
        scene = with_ball(worlds=len(KICKS))
        scene.face(0, degrees)
        forward = np.array([np.cos(radians(degrees)), sin(radians(degrees))])
        scene.ball.position[:] = front_offset() * forward
        scene.command(0, kick_v_x=np.array(KICKS))
        velocity = scene.play(TICK).ball.velocity[-1]
        for (x, y), kick in zip(velocity, KICKS, strict=True):
            case = f"{kick:g} m/s at {degrees:g} degrees"
            along, across = x * forward[0] + y * forward[1], y * forward[0] - x * forward[1]
            yield SPEED(case, kick, along)
            yield DIRECTION(case, 0.0, np.degrees(np.arctan2(across, along)))


def _chip() -> Checks:
    scene = with_ball()
    scene.command(0, kick_v_x=3.0, kick_v_z=3.0)
    ball = scene.play(0.1).ball
    yield CHIP_ALONG("45 degrees", 3.0, ball.velocity[-1, 0, 0])
    yield CHIP_UP("45 degrees", 3.0 - 0.1 * G, ball.vertical_velocity[-1, 0])


def _moving() -> Checks:
    scene = with_ball()
    scene.robots.velocity[:, 0, 0] = scene.ball.velocity[:, 0] = 1.0
    scene.command(0, v_x=1.0, kick_v_x=4.0)
    yield MOVING("forwards", 5.0, scene.play(TICK).ball.velocity[-1, 0, 0])


def _limits() -> Checks:
    for name, robot in SSL_ROBOTS.items():
        scene = with_ball(name, worlds=2)
        scene.command(0, kick_v_x=20.0, kick_v_z=np.array([0.0, 20.0]))
        ball = scene.play(TICK).ball
        speed = norm(ball.velocity[-1, :, 0], ball.vertical_velocity[-1])
        yield MAX_KICK(f"`{name}`", robot.max_kick_speed, speed[0])
        yield MAX_CHIP(f"`{name}`", robot.max_chip_speed, speed[1])


def _misses() -> Checks:
    scene = with_ball(worlds=4)
    # Too far in front, beside the mouth, behind the robot, beside the robot.
    scene.ball.position[:] = [
        [front_offset() + 0.012, 0],
        [front_offset(), 0.034],
        [-0.12, 0],
        [0, 0.12],
    ]
    scene.command(0, kick_v_x=5.0)
    ball = scene.play(0.05).ball
    moved = (ball.velocity[-1] != 0.0).any(axis=-1) | (ball.last_touch[-1] != -1.0)
    yield MISSES("in front, beside, behind", 0, moved.sum())


def _recharging() -> Checks:
    """Kick at the back of a goal: the ball returns to the mouth before the kicker has recharged."""
    scene = with_ball()
    scene.robots.position[:, 0] = (4.52, 0.0)
    scene.ball.position[:] = (4.52 + front_offset(), 0.0)
    scene.command(0, kick_v_x=6.0)
    trajectory = scene.play(0.6)
    fast = np.append([False], trajectory.ball.velocity[:, 0, 0] > 4.0)
    kicks = trajectory.times[np.flatnonzero(fast[1:] & ~fast[:-1])]
    yield RECHARGES(f"{len(kicks)} kicks", RECHARGE, np.diff(kicks).min(initial=np.inf))


def _two_kickers() -> Checks:
    """Kick with two robots that both have the ball at the outer edge of their mouths.

    A plate pushes until the ball is as fast as the plate along the plate's direction, with at most
    the impulse of a single kick. Up to 90 degrees the speed is the bound, beyond it the impulse.
    """
    for degrees in ANGLES_APART:
        scene = Scene(make_config("ssl_b", 2, 0, time_step=TICK))
        for index, turned in enumerate((degrees / 2, -degrees / 2)):
            x, y = np.cos(radians(turned)), sin(radians(turned))
            offset = 0.03 if turned < 0 else -0.03
            depth = front_offset() + 0.009
            scene.robots.position[:, index] = (offset * -y - depth * x, offset * x - depth * y)
            scene.face(index, turned)
            scene.command(index, kick_v_x=8.0)
        velocity = scene.play(TICK).ball.velocity[-1, 0]
        cosine, case = np.cos(radians(degrees / 2)), f"{degrees:g} degrees apart"
        yield TWO_KICKERS(case, 8.0 * min(1 / cosine, 2 * cosine), norm(*velocity))
        yield TWO_KICKERS_DIRECTION(case, 0.0, np.degrees(np.arctan2(velocity[1], velocity[0])))

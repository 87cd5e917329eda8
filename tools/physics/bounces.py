"""The ball off walls and robots: restitution along the normal, Coulomb's friction across it."""

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import BallModel
from rsoccer.frame import Array
from tools.physics import closed_form
from tools.physics.check import Checks, Line, percent, within
from tools.physics.cited import BALLS, GENERIC, Ball
from tools.physics.closed_form import Surface
from tools.physics.scene import STEP, Scene, Track, first

TOPIC = "bounces"
SPEEDS = np.array([0.5, 1.0, 2.0, 4.0, 8.0])  # m/s
TICKS = (0.001, 0.0025, 0.005)  # s
SIDES = {"front": 0.0, "left side": 90.0, "back": 180.0, "right side": -100.0}
SLANTS = ((2.0, 45.0), (6.0, 45.0), (4.0, 15.0), (4.0, 75.0))  # m/s, degrees to the wall

COULOMB = "Coulomb's law, preset"
WALL = Line(TOPIC, "restitution of a wall, 0.5 to 8 m/s, three ticks", "", within(0.01), "preset")
ROBOT = Line(TOPIC, "restitution of a robot, front, sides, back", "", within(0.01), "preset")
BACK = Line(TOPIC, "off a wall at 15, 45 and 75 degrees: speed back", "m/s", percent(5), COULOMB)
ALONG = Line(TOPIC, "off that wall: speed along it", "m/s", percent(5), COULOMB)
SPIN = Line(TOPIC, "off that wall: spin about the vertical axis", "rad/s", percent(5), COULOMB)
FRONT_BACK = Line(
    TOPIC, "off a robot's front at 45 degrees: speed back", "m/s", percent(5), COULOMB
)
FRONT_ALONG = Line(TOPIC, "off that front: speed along it", "m/s", percent(5), COULOMB)
FRONT_SPIN = Line(
    TOPIC, "off that front: spin about the vertical axis", "rad/s", percent(5), COULOMB
)
ROLLING = Line(TOPIC, "rolling spin that a wall leaves at 2 m/s", "rad/s", percent(5), COULOMB)
FADES = Line(TOPIC, "spin about the vertical axis lost in 1 s", "rad/s", percent(1), "preset")


def checks() -> Checks:
    """Every line of the acceptance about bounces."""
    for name, ball in BALLS.items():
        yield from _walls(name, ball)
        yield from _robots(name, ball)
        yield from _slants(name, ball)
        yield from _front(name, ball)
        yield from _rolling(name, ball)
        yield from _fading(name, ball)


def slippery(name: str) -> BallModel:
    """The ball on a floor that does nothing, so that only the bounce changes it."""
    return BallModel(name, sliding_deceleration=0, rolling_deceleration=0, spin_deceleration=0)


def at_wall(name: str, towards: Array, along: Array, tick: float = 0.005) -> Track:
    """Balls against the wall at y = 3.3, a world each."""
    scene = Scene(SimConfig("ssl_b", 0, 0, ball=slippery(name), tick=tick), len(towards))
    scene.ball.position[:] = (-2.0, 3.1)
    scene.ball.velocity[:] = np.stack([along, towards], axis=-1)
    return scene.play(0.5)


def off_wall(ball: Ball, towards: float, along: float, rolling: float = 0.0) -> tuple[Array, Array]:
    """What Coulomb's law makes of that: velocity and spin."""
    surface = Surface(ball.wall_restitution, ball.wall_friction)
    velocity, spin = np.array([along, towards, 0.0]), np.array([rolling, 0.0, 0.0])
    return closed_form.bounce(ball, surface, velocity, spin, np.array([0.0, -1.0, 0.0]))


def _walls(name: str, ball: Ball) -> Checks:
    for tick in TICKS:
        back = -at_wall(name, SPEEDS, 0 * SPEEDS, tick).ball.velocity[-1, :, 1] / SPEEDS
        for speed, got in zip(SPEEDS, back, strict=True):
            yield WALL(f"`{name}`, {speed:g} m/s, {1000 * tick:g} ms", ball.wall_restitution, got)


def at_robot(name: str, degrees: float, velocities: Array) -> Track:
    """Balls from 0.3 m in a direction of a resting robot, a world for each velocity."""
    config = SimConfig("ssl_b", 1, 0, ball=slippery(name), time_step=0.005)
    scene = Scene(config, len(velocities))
    radians = np.radians(degrees)
    scene.ball.velocity[:] = velocities
    scene.ball.position[:] = 0.3 * np.array([np.cos(radians), np.sin(radians)])
    return scene.play(1.0)


def _robots(name: str, ball: Ball) -> Checks:
    for side, degrees in SIDES.items():
        radians = np.radians(degrees)
        outward = np.array([np.cos(radians), np.sin(radians)])
        track = at_robot(name, degrees, -SPEEDS[:, None] * outward)
        leaving = track.ball.velocity @ outward
        step = first(leaving > 0)
        speeds = leaving[step, range(len(SPEEDS))]
        # It is the closing speed that counts. Momentum tells how fast the robot gave way.
        given = ball.mass * (SPEEDS + speeds) / GENERIC.mass
        for speed, back in zip(SPEEDS, (speeds + given) / SPEEDS, strict=True):
            yield ROBOT(f"`{name}`, {side}, {speed:g} m/s", ball.robot_restitution, back)


def _slants(name: str, ball: Ball) -> Checks:
    speed, radians = np.array([s for s, _ in SLANTS]), np.radians([d for _, d in SLANTS])
    towards, along = speed * np.sin(radians), speed * np.cos(radians)
    after = at_wall(name, towards, along).ball
    for world, (speed_there, degrees) in enumerate(SLANTS):
        case = f"`{name}`, {speed_there:g} m/s at {degrees:g} degrees"
        velocity, spin = off_wall(ball, towards[world], along[world])
        yield BACK(case, -velocity[1], -after.velocity[-1, world, 1])
        yield ALONG(case, velocity[0], after.velocity[-1, world, 0])
        yield SPIN(case, spin[2], after.spin[-1, world, 2])


def _front(name: str, ball: Ball) -> Checks:
    """At the middle of a front; the robot gives way and turns, and then has no part in it."""
    config = SimConfig("ssl_b", 1, 0, ball=slippery(name))
    scene = Scene(config)
    velocity = np.array([-2.0, 2.0, 0.0])
    reach = GENERIC.front + ball.radius
    scene.ball.position[:] = (reach + 0.1, -0.1)
    scene.ball.velocity[:] = velocity[:2]
    after = scene.play(4 * STEP).ball
    inertia = GENERIC.mass * GENERIC.radius**2 / 2  # a plate's
    gives = 1 / GENERIC.mass
    surface = Surface(
        ball.robot_restitution, ball.robot_friction, gives, gives + GENERIC.front**2 / inertia
    )
    velocity, spin = closed_form.bounce(
        ball, surface, velocity, np.zeros(3), np.array([1.0, 0.0, 0.0])
    )
    yield FRONT_BACK(f"`{name}`", velocity[0], after.velocity[-1, 0, 0])
    yield FRONT_ALONG(f"`{name}`", velocity[1], after.velocity[-1, 0, 1])
    yield FRONT_SPIN(f"`{name}`", spin[2], after.spin[-1, 0, 2])


def _rolling(name: str, ball: Ball) -> Checks:
    """Its front goes down the wall: there is slip though it comes straight on."""
    scene = Scene(SimConfig("ssl_b", 0, 0, ball=slippery(name)))
    scene.ball.position[:], scene.ball.velocity[:] = (0.0, 3.1), (0.0, 2.0)
    rolling = -2.0 / ball.radius
    scene.ball.spin[:, 0] = rolling
    _, spin = off_wall(ball, 2.0, 0.0, rolling)
    yield ROLLING(f"`{name}`", spin[0], scene.play(0.2).ball.spin[-1, 0, 0])


def _fading(name: str, ball: Ball) -> Checks:
    scene = Scene(SimConfig("ssl_b", 0, 0, ball=name))
    scene.ball.spin[:, 2] = 40.0
    spin = scene.play(1.0).ball.spin[-1, 0, 2]
    yield FADES(f"`{name}`", ball.spin_deceleration, 40.0 - spin)

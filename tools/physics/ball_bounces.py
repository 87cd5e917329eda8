"""Bounces of the ball off walls and robots: normal restitution and tangential Coulomb friction."""

import numpy as np

from rsoccer._core import BallModel
from rsoccer.arrays import Array
from tools.physics import closed_form
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, Ball
from tools.physics.closed_form import Surface
from tools.physics.scene import STEP, Scene, Trajectory, first_true, make_config

TOPIC = "ball_bounces"
SPEEDS = np.array([0.5, 1.0, 2.0, 4.0, 8.0])  # m/s
TICKS = (0.001, 0.0025, 0.005)  # s
SIDES = {"front": 0.0, "left side": 90.0, "back": 180.0, "right side": -100.0}
SLANTS = ((2.0, 45.0), (6.0, 45.0), (4.0, 15.0), (4.0, 75.0))  # m/s, degrees to the wall

COULOMB = "Coulomb friction, preset"
WALL = Criterion(
    TOPIC, "wall: restitution, 0.5 to 8 m/s, three ticks", "", absolute(0.01), "preset"
)
ROBOT = Criterion(
    TOPIC, "robot: restitution at front, sides and back", "", absolute(0.01), "preset"
)
NORMAL = Criterion(
    TOPIC, "wall at 15, 45 and 75 degrees: normal speed after", "m/s", percent(5), COULOMB
)
TANGENTIAL = Criterion(
    TOPIC, "wall at 15, 45 and 75 degrees: tangential speed after", "m/s", percent(5), COULOMB
)
SPIN = Criterion(
    TOPIC, "wall at 15, 45 and 75 degrees: vertical spin after", "rad/s", percent(5), COULOMB
)
FRONT_NORMAL = Criterion(
    TOPIC, "robot's front at 45 degrees: normal speed after", "m/s", percent(5), COULOMB
)
FRONT_TANGENTIAL = Criterion(
    TOPIC, "robot's front at 45 degrees: tangential speed after", "m/s", percent(5), COULOMB
)
FRONT_SPIN = Criterion(
    TOPIC, "robot's front at 45 degrees: vertical spin after", "rad/s", percent(5), COULOMB
)
ROLLING = Criterion(
    TOPIC, "wall at 90 degrees, 2 m/s: rolling spin after", "rad/s", percent(5), COULOMB
)
SPIN_DECAY = Criterion(TOPIC, "loss of vertical spin in 1 s", "rad/s", percent(1), "preset")


def checks() -> Checks:
    """Yield all checks of bounces."""
    for name, ball in BALLS.items():
        yield from _walls(name, ball)
        yield from _robots(name, ball)
        yield from _slants(name, ball)
        yield from _front(name, ball)
        yield from _rolling_spin(name, ball)
        yield from _spin_decay(name, ball)


def frictionless_floor(name: str) -> BallModel:
    """Return the ball model without floor friction, so that only the bounce changes its motion."""
    none = ("sliding_deceleration", "rolling_deceleration", "rolling_drag", "spin_deceleration")
    return BallModel(name, **dict.fromkeys(none, 0.0))


def at_wall(name: str, toward: Array, along: Array, tick: float = 0.005) -> Trajectory:
    """Simulate balls against the wall at y = 3.3 m, one world per velocity.

    Args:
        name: Ball preset.
        toward: Speeds toward the wall, m/s, shape (worlds,).
        along: Speeds along the wall, m/s, shape (worlds,).
        tick: Physics tick, s.
    """
    config = make_config("ssl_b", 0, 0, ball=frictionless_floor(name), tick=tick)
    scene = Scene(config, len(toward))
    scene.ball.position[:] = (-2.0, 3.1)
    scene.ball.velocity[:] = np.stack([along, toward], axis=-1)
    return scene.play(0.5)


def off_wall(ball: Ball, toward: float, along: float, rolling: float = 0.0) -> tuple[Array, Array]:
    """Return velocity (m/s) and spin (rad/s) after a wall bounce by Coulomb friction."""
    surface = Surface(ball.wall_restitution, ball.wall_friction)
    velocity, spin = np.array([along, toward, 0.0]), np.array([rolling, 0.0, 0.0])
    return closed_form.bounce(ball, surface, velocity, spin, np.array([0.0, -1.0, 0.0]))


def _walls(name: str, ball: Ball) -> Checks:
    for tick in TICKS:
        back = -at_wall(name, SPEEDS, 0 * SPEEDS, tick).ball.velocity[-1, :, 1] / SPEEDS
        for speed, got in zip(SPEEDS, back, strict=True):
            yield WALL(f"`{name}`, {speed:g} m/s, {1000 * tick:g} ms", ball.wall_restitution, got)


def at_robot(name: str, degrees: float, velocities: Array) -> Trajectory:
    """Simulate balls that start 0.3 m from a resting robot, one world per velocity (m/s).

    The start lies at `degrees` from the robot's heading.
    """
    config = make_config("ssl_b", 1, 0, ball=frictionless_floor(name), time_step=0.005)
    scene = Scene(config, len(velocities))
    radians = np.radians(degrees)
    scene.ball.velocity[:] = velocities
    scene.ball.position[:] = 0.3 * np.array([np.cos(radians), np.sin(radians)])
    return scene.play(1.0)


def _robots(name: str, ball: Ball) -> Checks:
    for side, degrees in SIDES.items():
        radians = np.radians(degrees)
        outward = np.array([np.cos(radians), np.sin(radians)])
        trajectory = at_robot(name, degrees, -SPEEDS[:, None] * outward)
        leaving = trajectory.ball.velocity @ outward
        step = first_true(leaving > 0)
        speeds = leaving[step, range(len(SPEEDS))]
        # Restitution refers to the relative speed; the recoil of the robot follows from momentum.
        recoil = ball.mass * (SPEEDS + speeds) / GENERIC.mass
        for speed, back in zip(SPEEDS, (speeds + recoil) / SPEEDS, strict=True):
            yield ROBOT(f"`{name}`, {side}, {speed:g} m/s", ball.robot_restitution, back)


def _slants(name: str, ball: Ball) -> Checks:
    speed, radians = np.array([s for s, _ in SLANTS]), np.radians([d for _, d in SLANTS])
    toward, along = speed * np.sin(radians), speed * np.cos(radians)
    after = at_wall(name, toward, along).ball
    for world, (impact_speed, degrees) in enumerate(SLANTS):
        case = f"`{name}`, {impact_speed:g} m/s at {degrees:g} degrees"
        velocity, spin = off_wall(ball, toward[world], along[world])
        yield NORMAL(case, -velocity[1], -after.velocity[-1, world, 1])
        yield TANGENTIAL(case, velocity[0], after.velocity[-1, world, 0])
        yield SPIN(case, spin[2], after.spin[-1, world, 2])


def _front(name: str, ball: Ball) -> Checks:
    """Hit the middle of a robot's front; the robot recoils and turns during the impact only."""
    config = make_config("ssl_b", 1, 0, ball=frictionless_floor(name))
    scene = Scene(config)
    velocity = np.array([-2.0, 2.0, 0.0])
    distance = GENERIC.front_distance + ball.radius
    scene.ball.position[:] = (distance + 0.1, -0.1)
    scene.ball.velocity[:] = velocity[:2]
    after = scene.play(4 * STEP).ball
    inertia = GENERIC.mass * GENERIC.radius**2 / 2  # of a uniform disc
    inverse_mass = 1 / GENERIC.mass
    surface = Surface(
        ball.robot_restitution,
        ball.robot_friction,
        inverse_mass,
        inverse_mass + GENERIC.front_distance**2 / inertia,
    )
    velocity, spin = closed_form.bounce(
        ball, surface, velocity, np.zeros(3), np.array([1.0, 0.0, 0.0])
    )
    yield FRONT_NORMAL(f"`{name}`", velocity[0], after.velocity[-1, 0, 0])
    yield FRONT_TANGENTIAL(f"`{name}`", velocity[1], after.velocity[-1, 0, 1])
    yield FRONT_SPIN(f"`{name}`", spin[2], after.spin[-1, 0, 2])


def _rolling_spin(name: str, ball: Ball) -> Checks:
    """Roll straight at a wall: the contact point slips because the ball's front moves down."""
    scene = Scene(make_config("ssl_b", 0, 0, ball=frictionless_floor(name)))
    scene.ball.position[:], scene.ball.velocity[:] = (0.0, 3.1), (0.0, 2.0)
    rolling = -2.0 / ball.radius
    scene.ball.spin[:, 0] = rolling
    _, spin = off_wall(ball, 2.0, 0.0, rolling)
    yield ROLLING(f"`{name}`", spin[0], scene.play(0.2).ball.spin[-1, 0, 0])


def _spin_decay(name: str, ball: Ball) -> Checks:
    scene = Scene(make_config("ssl_b", 0, 0, ball=name))
    scene.ball.spin[:, 2] = 40.0
    spin = scene.play(1.0).ball.spin[-1, 0, 2]
    yield SPIN_DECAY(f"`{name}`", ball.spin_deceleration, 40.0 - spin)

"""Collisions of robots: restitution, symmetry and energy."""

import numpy as np

from rsoccer.arrays import Array
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.cited import GENERIC, SSL_SHARED, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, Trajectory, make_config

TOPIC = "robot_collisions"
COLLISIONS = 300

RESTITUTION = Criterion(
    TOPIC, "head-on collision: separation speed by closing speed", "", absolute(0.02)
)
OFF_CENTER = Criterion(
    TOPIC,
    "two SSL robots, 30 degrees off the line of their centers: angular velocities",
    "rad/s",
    percent(5),
    "closed form, Coulomb friction",
)
TURNS = Criterion(
    TOPIC, "squares face to face: angular velocity", "rad/s", absolute(0.01), "symmetry"
)
LATERAL = Criterion(
    TOPIC,
    "squares face to face: lateral displacement after 2 s of pushing",
    "mm",
    absolute(0.1),
    "symmetry",
)
ENERGY = Criterion(
    TOPIC,
    "random collisions, zero wheel commands: collisions with an energy gain in some tick",
    "",
    EXACT,
    "friction",
)
CONTACT = Criterion(TOPIC, "random collisions: more than half made contact", "", EXACT, "aim")


def checks() -> Checks:
    """Yield all checks of collisions between robots."""
    for blue_speed, yellow_speed in ((1.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 3.0)):
        yield from _head_on(blue_speed, yellow_speed)
    for speed in (1.0, 3.0):
        yield from _off_center(speed)
    for name in VSS_ROBOTS:
        for speed in (0.3, 0.6, 1.1):
            yield from _squares(name, speed)
    for name in ("ssl_generic", *VSS_ROBOTS):
        yield from _random_collisions(name)


def _head_on(blue_speed: float, yellow_speed: float) -> Checks:
    scene = Scene(make_config("ssl_b", 1, 1, time_step=TICK))
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, :, 0] = (-0.2, 0.2)
    scene.robots.velocity[0, :, 0] = (blue_speed, -yellow_speed)
    scene.face(1, 180.0)
    scene.command(0, v_x=blue_speed)
    scene.command(1, v_x=yellow_speed)
    blue, yellow = scene.play(0.5).robots.velocity[:, 0, :, 0].T
    separation = float((yellow - blue).max()) / (blue_speed + yellow_speed)
    case = f"{blue_speed:g} and {yellow_speed:g} m/s"
    yield RESTITUTION(case, SSL_SHARED["restitution"].value, separation)


def _off_center(speed: float) -> Checks:
    """Hit a robot at rest off its center: friction stops the slip and turns both equally."""
    scene, radius = Scene(make_config("ssl_b", 1, 1, time_step=TICK)), GENERIC.radius
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, 1] = (np.sqrt(3) * radius + 0.02, radius)
    scene.robots.velocity[0, 0, 0] = speed
    scene.command(0, v_x=speed)
    highest = abs(scene.play(0.1).robots.angular_velocity[:, 0]).max(axis=0)
    # A sixth of a robot's mass stops the slip of half the speed, at one radius from both centers.
    expected = speed / 2 / (3 * radius)
    for robot, got in zip(("the moving robot", "the robot at rest"), highest, strict=True):
        yield OFF_CENTER(f"{speed:g} m/s, {robot}", expected, got)


def _squares(name: str, speed: float) -> Checks:
    rim = speed / VSS_ROBOTS[name].wheel_radius
    scene = Scene(make_config("vss_3v3", 1, 1, robot=name, time_step=TICK))
    scene.ball.position[:] = (0.0, 0.6)
    scene.robots.position[0, :, 0] = (-0.2, 0.2)
    scene.robots.velocity[0, :, 0] = (speed, -speed)
    scene.face(1, 180.0)
    for index in (0, 1):
        scene.command(index, left=rim, right=rim)
    robots = scene.play(2.0).robots
    case = f"`{name}`, {speed:g} m/s each"
    yield TURNS(case, 0.0, abs(robots.angular_velocity).max())
    yield LATERAL(case, 0.0, 1000 * abs(robots.position[-1, ..., 1]).max())


def _random_collisions(name: str) -> Checks:
    """Let one turning robot run into another; all wheel commands are zero."""
    vss, rng = VSS_ROBOTS.get(name), np.random.default_rng(5)
    field, size = ("vss_3v3", vss.side_length) if vss else ("ssl_b", 2 * GENERIC.radius)
    scene = Scene(make_config(field, 1, 1, robot=name, time_step=TICK), COLLISIONS)
    scene.ball.position[:] = (0.0, 0.6)
    scene.robots.position[:, :, 0] = (-size, size)
    scene.robots.position[:, 0, 1] = rng.uniform(-0.6 * size, 0.6 * size, COLLISIONS)
    scene.robots.velocity[:] = rng.uniform(-1, 1, (COLLISIONS, 2, 2))
    scene.robots.velocity[:, 0, 0] += 2.0
    scene.robots.angular_velocity[:] = rng.uniform(-15, 15, (COLLISIONS, 2))
    for index in (0, 1):
        scene.face(index, rng.uniform(-180, 180, COLLISIONS))
    trajectory = scene.play(0.5)
    mass, inertia = (
        (vss.mass, vss.side_length**2 / 6) if vss else (GENERIC.mass, GENERIC.radius**2 / 2)
    )
    energy = np.concatenate(
        [_energy(scene, mass, inertia)[None], _energy(trajectory, mass, inertia)]
    )
    gains = (np.diff(energy, axis=0) > 1e-3 * energy[0]).any(axis=0)
    yield ENERGY(f"`{name}`, {COLLISIONS} collisions", 0, gains.sum())
    met = (trajectory.robots.touched_opponent > 0).any(axis=(0, 2)).sum()
    yield CONTACT(f"`{name}`", 1, met > COLLISIONS / 2)


def _energy(source: Scene | Trajectory, mass: float, inertia: float) -> Array:
    """Return the kinetic energy, J; `inertia` is that of a plate divided by its mass, m²."""
    velocity, angular_velocity = (
        source.robots.velocity.astype(np.float64),
        source.robots.angular_velocity.astype(np.float64),
    )
    energy: Array = (
        mass / 2 * ((velocity**2).sum(axis=-1) + inertia * angular_velocity**2).sum(axis=-1)
    )
    return energy

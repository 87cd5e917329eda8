"""Squeezed ball: between a robot and a wall, between two robots, in a corner."""

import numpy as np

from rsoccer.arrays import Array
from tools.physics.check import EXACT, Checks, Criterion, absolute
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, Trajectory, make_config

TOPIC = "squeezed_ball"
BALL = BALLS["ssl_tigers"]
TICKS = (0.0025, 0.005)  # s
GAP = 1e-4  # m, between ball and wall
ROUND_SIDES = (120.0, 300.0)  # degrees: headings whose round sides meet along x
COLLISIONS = 1000
PUSH_SPEED = 2.0  # m/s

SOLID = "bound: solid bodies"
NO_GAIN = "no energy gain"
WALL_DEPTH = Criterion(
    TOPIC,
    "ball between robot and wall, up to 1.2 m/s: penetration depth",
    "mm",
    absolute(2),
    SOLID,
)
WALL_FAST = Criterion(
    TOPIC, "ball between robot and wall, 3.7 m/s: penetration depth", "mm", absolute(5), SOLID
)
WALL_REBOUND = Criterion(
    TOPIC,
    "ball between robot and wall: rebound speed of the robot by its impact speed",
    "",
    absolute(0.25),
    "bound: at most 0.25",
)
WALL_ENERGY = Criterion(
    TOPIC,
    "ball between robot and wall: ticks with more than the initial energy",
    "ticks",
    EXACT,
    NO_GAIN,
)
MEET_DEPTH = Criterion(
    TOPIC, "ball between two SSL robots: penetration depth", "mm", absolute(3), SOLID
)
MEET_REBOUND = Criterion(
    TOPIC,
    "ball between two SSL robots: rebound speed by impact speed",
    "",
    absolute(0.25),
    "bound: at most 0.25",
)
MEET_ENERGY = Criterion(
    TOPIC,
    "ball between two SSL robots: ticks with more than the initial energy",
    "ticks",
    EXACT,
    NO_GAIN,
)
RANDOM_DEPTH = Criterion(
    TOPIC,
    "random collisions with the ball in between: 95th percentile of penetration depth",
    "mm",
    absolute(3),
    SOLID,
)
CORNER_ROBOTS = Criterion(
    TOPIC,
    "ball squeezed in a corner: penetration depth between robots",
    "mm",
    absolute(1),
    SOLID,
)
CORNER_BALL = Criterion(
    TOPIC,
    "ball squeezed in a corner: penetration depth of the ball",
    "mm",
    absolute(1),
    SOLID,
)
CORNER_SPEED = Criterion(
    TOPIC,
    "ball squeezed in a corner: reported ball speed after 1 s",
    "m/s",
    absolute(0.001),
    "at rest",
)


def checks() -> Checks:
    """Yield all checks of a squeezed ball."""
    for tick in TICKS:
        for speed in (0.5, 1.2, 3.7):
            yield from _at_wall("ssl_generic", speed, tick)
        for speed in (0.5, 1.19):
            yield from _at_wall("vss_440rpm", speed, tick)
        for speed in (1.0, 2.5, 3.7):
            yield from _collision(speed, tick)
    for speed in (1.0, 2.5, 3.7):
        yield from _random_collisions(speed)
    for robots in (1, 3, 4):
        yield from _in_corner(robots)


def gaps(trajectory: Trajectory) -> Array:
    """Return the gap between ball and SSL robots, m, shape (steps, worlds, robots).

    The outline of a robot is a disc with a flat front. Negative gaps are penetration.
    """
    away = trajectory.ball.position[:, :, None].astype(np.float64) - trajectory.robots.position
    cos, sin = np.moveaxis(trajectory.robots.heading.astype(np.float64), -1, 0)
    x = away[..., 0] * cos + away[..., 1] * sin
    y = abs(away[..., 1] * cos - away[..., 0] * sin)
    half = np.sqrt(GENERIC.radius**2 - GENERIC.front_distance**2)
    front = np.where(
        y < half, x - GENERIC.front_distance, np.hypot(x - GENERIC.front_distance, y - half)
    )
    before_front = (x > 0) & (y * GENERIC.front_distance < x * half)
    found: Array = np.where(before_front, front, np.hypot(x, y) - GENERIC.radius) - BALL.radius
    return found


def _penetration(*distances: Array) -> float:
    """Return the largest penetration depth, mm; 0 without penetration."""
    return max(0.0, *(-1000 * float(distance.min()) for distance in distances))


def _energy(trajectory: Trajectory, start: Scene, mass: float, ball: float) -> Array:
    """Return the kinetic energy of horizontal motion relative to the start."""

    def total(robots: Array, velocity: Array) -> Array:
        found: Array = mass * (robots**2).sum(axis=(-2, -1)) + ball * (velocity**2).sum(axis=-1)
        return found

    at_start = total(start.robots.velocity, start.ball.velocity)
    energy: Array = total(trajectory.robots.velocity, trajectory.ball.velocity) / at_start
    return energy


def _at_wall(name: str, speed: float, tick: float) -> Checks:
    """Drive straight at a ball that rests at the wall, and keep driving."""
    vss = VSS_ROBOTS.get(name)
    field, wall, y = ("vss_3v3", 0.75, 0.4) if vss else ("ssl_b", 4.8, 1.2)
    ball = BALLS["vss_rsim" if vss else "ssl_tigers"]
    front, mass = (vss.side_length / 2, vss.mass) if vss else (GENERIC.front_distance, GENERIC.mass)
    scene = Scene(make_config(field, 1, 0, robot=name, tick=tick, time_step=tick))
    scene.ball.position[:] = (wall - GAP - ball.radius, y)
    scene.robots.position[:, 0] = (wall - GAP - 2 * ball.radius - front - 0.02, y)
    scene.robots.velocity[:, 0, 0] = speed
    if vss:
        scene.command(0, left=speed / vss.wheel_radius, right=speed / vss.wheel_radius)
    else:
        scene.command(0, v_x=speed)
    trajectory = scene.play(0.5)
    ball_x, robot_x = trajectory.ball.position[:, 0, 0], trajectory.robots.position[:, 0, 0, 0]
    depth = _penetration(wall - ball_x - ball.radius, ball_x - robot_x - front - ball.radius)
    case = f"`{name}` at {speed:g} m/s, {1000 * tick:g} ms"
    yield (WALL_FAST if speed > 1.2 else WALL_DEPTH)(case, 0.0, depth)
    rebound = -float(trajectory.robots.velocity[:, 0, 0, 0].min()) / speed
    yield WALL_REBOUND(case, 0.0, max(rebound, 0.0))
    gained = _energy(trajectory, scene, mass, ball.mass) > 1.001
    yield WALL_ENERGY(case, 0, gained.sum())


def _approach(speed: float, tick: float, worlds: int = 1) -> Scene:
    """Return two robots 0.6 m apart that drive at each other, with the ball in between."""
    scene = Scene(make_config("ssl_b", 1, 1, tick=tick, time_step=tick), worlds)
    for index, (x, degrees) in enumerate(zip((-0.3, 0.3), ROUND_SIDES, strict=True)):
        scene.robots.position[:, index, 0] = x
        _drive_along_x(scene, index, -np.sign(x) * speed, degrees)
    return scene


def _drive_along_x(scene: Scene, index: int, speed: float, degrees: float | Array) -> None:
    """Set a robot's velocity along x and command the same velocity, whatever its heading."""
    scene.face(index, degrees)
    scene.robots.velocity[:, index, 0] = speed
    heading = np.radians(degrees)
    scene.command(index, v_x=speed * np.cos(heading), v_y=-speed * np.sin(heading))


def _collision(speed: float, tick: float) -> Checks:
    scene = _approach(speed, tick)
    trajectory = scene.play(0.5)
    case = f"{speed:g} m/s each, {1000 * tick:g} ms"
    yield MEET_DEPTH(case, 0.0, _penetration(gaps(trajectory)))
    rebound = -float(trajectory.robots.velocity[:, 0, 0, 0].min()) / speed
    yield MEET_REBOUND(case, 0.0, max(rebound, 0.0))
    gained = _energy(trajectory, scene, GENERIC.mass, BALL.mass) > 1.001
    yield MEET_ENERGY(case, 0, gained.sum())


def _random_collisions(speed: float) -> Checks:
    """Collide robots with random headings and lateral offsets, the ball anywhere in between."""
    scene, rng = _approach(speed, TICK, COLLISIONS), np.random.default_rng(3)
    for index, toward in enumerate((1, -1)):
        scene.robots.position[:, index, 1] = rng.uniform(-0.01, 0.01, COLLISIONS)
        _drive_along_x(scene, index, toward * speed, rng.uniform(-180, 180, COLLISIONS))
    scene.ball.position[:, 0] = rng.uniform(-0.05, 0.05, COLLISIONS)
    smallest = gaps(scene.play(0.5)).min(axis=(0, 2))
    case = f"{speed:g} m/s each, {COLLISIONS} collisions"
    yield RANDOM_DEPTH(case, 0.0, _penetration(np.percentile(smallest, [5])))


def _in_corner(robots: int) -> Checks:
    """Push a ball that falls into a corner with robots in line, one behind the other."""
    scene = Scene(make_config("ssl_b", robots, 0, time_step=TICK))
    corner = np.array([4.8, 3.3]) - BALL.radius - GAP
    scene.ball.position[:], scene.ball.height[:] = corner, 0.05
    for index in range(robots):
        away = GENERIC.radius + BALL.radius + 0.01 + index * (2 * GENERIC.radius + 0.01)
        scene.robots.position[:, index] = corner - away * np.array([1, 1]) / np.sqrt(2)
        scene.face(index, 225.0)
        scene.command(index, v_x=-PUSH_SPEED)
    trajectory = scene.play(1.0)
    case = f"{robots} SSL robots at {PUSH_SPEED:g} m/s"
    positions = trajectory.robots.position[:, 0].astype(np.float64)
    if robots > 1:
        apart = np.linalg.norm(np.diff(positions, axis=1), axis=-1)
        yield CORNER_ROBOTS(case, 0.0, _penetration(apart - 2 * GENERIC.radius))
    walls = np.array([4.8, 3.3]) - trajectory.ball.position - BALL.radius
    yield CORNER_BALL(case, 0.0, _penetration(walls, gaps(trajectory)))
    yield CORNER_SPEED(case, 0.0, np.hypot(*trajectory.ball.velocity[-1, 0]))

"""A ball with no room left: between a robot and a wall, between two robots, in a corner."""

import numpy as np

from rsoccer import SimConfig
from rsoccer.frame import Array
from tools.physics.check import EXACT, Checks, Line, within
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, Track

TOPIC = "squeezes"
BALL = BALLS["ssl_tigers"]
TICKS = (0.0025, 0.005)  # s
GAP = 1e-4  # m, between ball and wall
ROUND = (120.0, 300.0)  # degrees: with these headings round sides meet along x
MEETINGS = 1000
PINNING = 2.0  # m/s

SOLID = "bound: solid"
WALL_DEEP = Line(
    TOPIC, "between robot and wall, to 1.2 m/s: deepest in either", "mm", within(2), SOLID
)
WALL_FAST = Line(TOPIC, "the same at 3.7 m/s", "mm", within(5), SOLID)
WALL_BACK = Line(TOPIC, "robot thrown back, by its speed", "", within(0.25), "bound: at most 0.25")
WALL_ENERGY = Line(
    TOPIC, "ticks with more energy than it came with", "ticks", EXACT, "energy is not gained"
)
MEET_DEEP = Line(TOPIC, "between two SSL robots that meet: deepest", "mm", within(3), SOLID)
MEET_BACK = Line(
    TOPIC, "these thrown back, by their speed", "", within(0.25), "bound: at most 0.25"
)
MEET_ENERGY = Line(
    TOPIC, "ticks with more energy than they came with", "ticks", EXACT, "energy is not gained"
)
DRAWN_DEEP = Line(
    TOPIC, "robots that meet at random: deepest in 19 of 20 meetings", "mm", within(3), SOLID
)
PINNED = Line(
    TOPIC, "ball pinned in a corner: robots' deepest in each other", "mm", within(1), SOLID
)
PINNED_BALL = Line(TOPIC, "the ball's deepest in robot or wall", "mm", within(1), SOLID)
PINNED_SPEED = Line(TOPIC, "speed that it reports after 1 s", "m/s", within(0.001), "at rest")


def checks() -> Checks:
    """Every line of the acceptance about a caught ball."""
    for tick in TICKS:
        for speed in (0.5, 1.2, 3.7):
            yield from _at_wall("ssl_generic", speed, tick)
        for speed in (0.5, 1.19):
            yield from _at_wall("vss_440rpm", speed, tick)
        for speed in (1.0, 2.5, 3.7):
            yield from _meeting(speed, tick)
    for speed in (1.0, 2.5, 3.7):
        yield from _meetings(speed)
    for robots in (1, 3, 4):
        yield from _pinned(robots)


def gaps(track: Track) -> Array:
    """From SSL robots, discs with a flat front, to the ball, m; (steps, worlds, robots)."""
    away = track.ball.position[:, :, None].astype(np.float64) - track.robots.position
    cos, sin = np.moveaxis(track.robots.heading.astype(np.float64), -1, 0)
    x = away[..., 0] * cos + away[..., 1] * sin
    y = abs(away[..., 1] * cos - away[..., 0] * sin)
    half = np.sqrt(GENERIC.radius**2 - GENERIC.front**2)
    front = np.where(y < half, x - GENERIC.front, np.hypot(x - GENERIC.front, y - half))
    before_front = (x > 0) & (y * GENERIC.front < x * half)
    found: Array = np.where(before_front, front, np.hypot(x, y) - GENERIC.radius) - BALL.radius
    return found


def _deepest(*distances: Array) -> float:
    """In mm; 0 if nothing is in anything."""
    return max(0.0, *(-1000 * float(distance.min()) for distance in distances))


def _energy(track: Track, start: Scene, mass: float, ball: float) -> Array:
    """Of motion along the floor, by that at the start."""

    def total(robots: Array, velocity: Array) -> Array:
        found: Array = mass * (robots**2).sum(axis=(-2, -1)) + ball * (velocity**2).sum(axis=-1)
        return found

    at_start = total(start.robots.velocity, start.ball.velocity)
    energy: Array = total(track.robots.velocity, track.ball.velocity) / at_start
    return energy


def _at_wall(name: str, speed: float, tick: float) -> Checks:
    """Straight on at a ball that rests at the wall; the robot is told to go on."""
    vss = VSS_ROBOTS.get(name)
    field, wall, y = ("vss_3v3", 0.75, 0.4) if vss else ("ssl_b", 4.8, 1.2)
    ball = BALLS["vss_rsim" if vss else "ssl_tigers"]
    front, mass = (vss.side / 2, vss.mass) if vss else (GENERIC.front, GENERIC.mass)
    scene = Scene(SimConfig(field, 1, 0, robot=name, tick=tick, time_step=tick))
    scene.ball.position[:] = (wall - GAP - ball.radius, y)
    scene.robots.position[:, 0] = (wall - GAP - 2 * ball.radius - front - 0.02, y)
    scene.robots.velocity[:, 0, 0] = speed
    if vss:
        scene.tell(0, left=speed / vss.wheel_radius, right=speed / vss.wheel_radius)
    else:
        scene.tell(0, v_x=speed)
    track = scene.play(0.5)
    ball_x, robot_x = track.ball.position[:, 0, 0], track.robots.position[:, 0, 0, 0]
    deepest = _deepest(wall - ball_x - ball.radius, ball_x - robot_x - front - ball.radius)
    case = f"`{name}` at {speed:g} m/s, {1000 * tick:g} ms"
    yield (WALL_FAST if speed > 1.2 else WALL_DEEP)(case, 0.0, deepest)
    back = -float(track.robots.velocity[:, 0, 0, 0].min()) / speed
    yield WALL_BACK(case, 0.0, max(back, 0.0))
    gained = _energy(track, scene, mass, ball.mass) > 1.001
    yield WALL_ENERGY(case, 0, gained.sum())


def _meet(speed: float, tick: float, worlds: int = 1) -> Scene:
    """Two robots 0.6 m apart that drive at each other, the ball between them."""
    scene = Scene(SimConfig("ssl_b", 1, 1, tick=tick, time_step=tick), worlds)
    for index, (x, degrees) in enumerate(zip((-0.3, 0.3), ROUND, strict=True)):
        scene.robots.position[:, index, 0] = x
        _send(scene, index, -np.sign(x) * speed, degrees)
    return scene


def _send(scene: Scene, index: int, speed: float, degrees: float | Array) -> None:
    """A robot goes along x at a speed and is told to go on so, whatever its heading."""
    scene.face(index, degrees)
    scene.robots.velocity[:, index, 0] = speed
    around = np.radians(degrees)
    scene.tell(index, v_x=speed * np.cos(around), v_y=-speed * np.sin(around))


def _meeting(speed: float, tick: float) -> Checks:
    scene = _meet(speed, tick)
    track = scene.play(0.5)
    case = f"{speed:g} m/s each, {1000 * tick:g} ms"
    yield MEET_DEEP(case, 0.0, _deepest(gaps(track)))
    back = -float(track.robots.velocity[:, 0, 0, 0].min()) / speed
    yield MEET_BACK(case, 0.0, max(back, 0.0))
    gained = _energy(track, scene, GENERIC.mass, BALL.mass) > 1.001
    yield MEET_ENERGY(case, 0, gained.sum())


def _meetings(speed: float) -> Checks:
    """With any headings, not quite in line, the ball somewhere between them."""
    scene, rng = _meet(speed, TICK, MEETINGS), np.random.default_rng(3)
    for index, towards in enumerate((1, -1)):
        scene.robots.position[:, index, 1] = rng.uniform(-0.01, 0.01, MEETINGS)
        _send(scene, index, towards * speed, rng.uniform(-180, 180, MEETINGS))
    scene.ball.position[:, 0] = rng.uniform(-0.05, 0.05, MEETINGS)
    deepest = gaps(scene.play(0.5)).min(axis=(0, 2))
    case = f"{speed:g} m/s each, {MEETINGS} meetings"
    yield DRAWN_DEEP(case, 0.0, _deepest(np.percentile(deepest, [5])))


def _pinned(robots: int) -> Checks:
    """In line at a ball that falls into a corner, one behind the other, all pushing."""
    scene = Scene(SimConfig("ssl_b", robots, 0, time_step=TICK))
    corner = np.array([4.8, 3.3]) - BALL.radius - GAP
    scene.ball.position[:], scene.ball.height[:] = corner, 0.05
    for index in range(robots):
        away = GENERIC.radius + BALL.radius + 0.01 + index * (2 * GENERIC.radius + 0.01)
        scene.robots.position[:, index] = corner - away * np.array([1, 1]) / np.sqrt(2)
        scene.face(index, 225.0)
        scene.tell(index, v_x=-PINNING)
    track = scene.play(1.0)
    case = f"{robots} SSL robots at {PINNING:g} m/s"
    places = track.robots.position[:, 0].astype(np.float64)
    if robots > 1:
        apart = np.linalg.norm(np.diff(places, axis=1), axis=-1)
        yield PINNED(case, 0.0, _deepest(apart - 2 * GENERIC.radius))
    walls = np.array([4.8, 3.3]) - track.ball.position - BALL.radius
    yield PINNED_BALL(case, 0.0, _deepest(walls, gaps(track)))
    yield PINNED_SPEED(case, 0.0, np.hypot(*track.ball.velocity[-1, 0]))

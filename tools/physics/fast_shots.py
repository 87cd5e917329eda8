"""Fast shots: no tunneling through walls or robots, no contact on a near miss."""

from collections.abc import Sequence

import numpy as np

from rsoccer._core import CROSSINGS
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import EXACT, Checks, Criterion, absolute
from tools.physics.scene import Scene, Trajectory, make_config

TOPIC = "fast_shots"
SPEED = 10.0  # m/s: 50 mm a tick, more than the ball is wide
SHOTS = 1000
GAP = 0.002  # m
FIELDS = {"vss_3v3": (0.85, 0.65), "ssl_b": (4.8, 3.3), "ssl_a": (6.6, 4.8)}  # walls' x and y, m
RADII = {"vss_3v3": 0.0427 / 2, "ssl_b": 0.0215}

CLEAR = "no contact"
SOLID_WALLS, SOLID_ROBOTS = "walls are solid", "robots are solid"
WALLS = Criterion(TOPIC, "shots at 10 m/s through a wall", "of 1000", EXACT, SOLID_WALLS)
SIDES = Criterion(
    TOPIC, "shots through the 20 mm side wall of an SSL goal", "of 500", EXACT, SOLID_WALLS
)
BACKS = Criterion(TOPIC, "shots through the back of an SSL goal", "of 500", EXACT, SOLID_WALLS)
ROBOTS = Criterion(TOPIC, "shots through a robot", "of 1000", EXACT, SOLID_ROBOTS)
TOUCHED = Criterion(TOPIC, "shots aimed at a robot: contacts", "of 1000", EXACT, "aim")
TURNING = Criterion(TOPIC, "shots through a spinning robot", "of 1000", EXACT, SOLID_ROBOTS)
TURNING_TOUCHED = Criterion(
    TOPIC, "shots aimed at a spinning robot: contacts", "of 1000", EXACT, "aim"
)
DEFLECTION = Criterion(TOPIC, "shots 2 mm beside a robot: deflection", "mm", absolute(0.001), CLEAR)
FALSE_CONTACTS = Criterion(TOPIC, "shots 2 mm beside a robot: contacts", "of 1000", EXACT, CLEAR)
WALL_DEFLECTION = Criterion(
    TOPIC, "shots 2 mm beside a goal's side or a wall: deflection", "mm", absolute(0.001), CLEAR
)
CORNER = Criterion(
    TOPIC,
    "shots along a VSSS wall: deflected inward by the corner block",
    "of 4",
    EXACT,
    "45 degrees",
)


def checks() -> Checks:
    """Yield all checks of fast shots."""
    yield from _walls()
    yield from _goal_sides()
    yield from _goal_backs()
    yield from _robots()
    yield from _turning()
    yield from _near_robots()
    yield from _near_walls()
    yield from _corners()


def _shoot(scene: Scene, start: Array, target: Array) -> None:
    offset = target - start
    scene.ball.position[:] = start
    scene.ball.velocity[:] = SPEED * offset / norm(offset[:, 0], offset[:, 1])[:, None]


def _uniform(center: Sequence[float], spread: Sequence[float], count: int = SHOTS) -> Array:
    """Draw numbers (count, columns), each within center ± spread, from a fixed seed."""
    centers, widths = np.array(center), np.array(spread)
    return np.random.default_rng(7).uniform(
        centers - widths, centers + widths, (count, len(centers))
    )


def _walls() -> Checks:
    for field, walls in FIELDS.items():
        scene = Scene(make_config(field, 0, 0), SHOTS)
        half = scene.config.field.half_length, scene.config.field.half_width
        shots = _uniform([0] * 4, [0.8 * half[0], 0.8 * half[1], 2 * half[0], 2 * half[1]])
        _shoot(scene, shots[:, :2], shots[:, 2:])
        outside = (abs(scene.play(0.6).ball.position) > walls).any(axis=(0, 2))
        yield WALLS(f"`{field}`", 0, outside.sum())


def _goal_sides() -> Checks:
    """Shoot at the side of the goal; only 0.1 s, since later a ball may enter around the post."""
    scene = Scene(make_config("ssl_b", 0, 0), SHOTS // 2)
    shots = _uniform([4.65, 0.9, 4.62, 0.0], [0.1, 0.3, 0.1, 0.0], SHOTS // 2)
    _shoot(scene, shots[:, :2], shots[:, 2:])
    x, y = np.moveaxis(scene.play(0.1).ball.position, -1, 0)
    yield SIDES("division B", 0, ((x > 4.52) & (abs(y) < 0.5)).any(axis=0).sum())


def _goal_backs() -> Checks:
    scene = Scene(make_config("ssl_b", 0, 0), SHOTS // 2)
    shots = _uniform([3.4, 0.0, 4.7, 0.0], [1.0, 0.4, 0.0, 0.46], SHOTS // 2)
    _shoot(scene, shots[:, :2], shots[:, 2:])
    ball = scene.play(0.3).ball
    goals = (ball.crossed == CROSSINGS.index("goal_right")).any(axis=0)
    beyond = (ball.position[..., 0] > 4.68).any(axis=0)
    yield BACKS(f"{goals.sum()} goals", 0, beyond.sum())


def _robots() -> Checks:
    """Shoot at robots of any heading from 0.4 m; the ball could travel 0.5 m beyond them."""
    for field, half in (("vss_3v3", 0.0375), ("ssl_b", 0.0715)):
        scene = Scene(make_config(field, 1, 0), SHOTS)
        shots = _uniform([-0.4, 0, 0, 0, 0], [0.1, 0.3, 0.0, 0.8 * half, 180.0])
        scene.face(0, shots[:, 4])
        _shoot(scene, shots[:, :2], shots[:, 2:4])
        ball = scene.play(0.1).ball
        speed = norm(ball.velocity[-1, :, 0], ball.velocity[-1, :, 1])
        beyond = (ball.position[-1] * -shots[:, :2]).sum(axis=-1) > 0.1
        yield ROBOTS(f"`{field}`", 0, (beyond & (speed > 0.95 * SPEED)).sum())
        yield TOUCHED(f"`{field}`", SHOTS, (ball.last_touch[-1] == 0).sum())


def _turning() -> Checks:
    """Shoot at robots that turn fast.

    A ball beyond the robot counts as through if it is hardly deflected: few glance off a corner.
    """
    for field, half, top in (("vss_3v3", 0.0375, 30.0), ("ssl_b", 0.0715, 26.2)):
        scene = Scene(make_config(field, 1, 0), SHOTS)
        shots = _uniform([-0.4, 0, 0, 0, 0], [0.1, 0.3, 0.0, 0.8 * half, 180.0])
        scene.face(0, shots[:, 4])
        angular_velocities = np.where(np.arange(SHOTS) % 2, top, -top)
        scene.robots.angular_velocity[:, 0] = angular_velocities
        if field == "ssl_b":
            scene.command(0, v_theta=angular_velocities)
        else:
            scene.command(
                0, left=-46 * np.sign(angular_velocities), right=46 * np.sign(angular_velocities)
            )
        _shoot(scene, shots[:, :2], shots[:, 2:4])
        ball = scene.play(0.1).ball
        beyond = (ball.position[-1] * -shots[:, :2]).sum(axis=-1) > 0.1
        ahead = (ball.velocity[-1] * scene.ball.velocity).sum(axis=-1)
        straight = ahead > 0.9 * SPEED * norm(*ball.velocity[-1].T)
        yield TURNING(f"`{field}`, {top:g} rad/s", 0, (beyond & straight).sum())
        yield TURNING_TOUCHED(f"`{field}`, {top:g} rad/s", SHOTS, (ball.last_touch[-1] == 0).sum())


def _shoot_along_x(field: str, robots: int, start: Array, seconds: float) -> Trajectory:
    scene = Scene(make_config(field, robots, 0), len(start))
    _shoot(scene, start, start + np.array([1.0, 0.0]))
    return scene.play(seconds)


def _near_robots() -> Checks:
    for field, clear in (("vss_3v3", 0.0375), ("ssl_b", 0.09)):
        start = _uniform([-0.3, clear + RADII[field] + GAP], [0.025, 0.0])
        start[::2, 1] *= -1
        ball = _shoot_along_x(field, 1, start, 0.05).ball
        deflection = abs(ball.position[..., 1] - start.astype(np.float32)[:, 1]).max()
        yield DEFLECTION(f"`{field}`", 0.0, 1000 * deflection)
        yield FALSE_CONTACTS(f"`{field}`", 0, (ball.last_touch[-1] != -1).sum())


def _near_walls() -> Checks:
    for obstacle, y in (("goal's side", 0.52 + 0.0215 + GAP), ("wall", 3.3 - 0.0215 - GAP)):
        start = _uniform([3.9, y], [0.025, 0.0])
        x, across = np.moveaxis(_shoot_along_x("ssl_b", 0, start, 0.075).ball.position, -1, 0)
        deflection = abs(across - np.float32(y))[x < 4.7].max()
        yield WALL_DEFLECTION(obstacle, 0.0, 1000 * deflection)


def _corners() -> Checks:
    """Shoot along a side wall; a corner without a 45-degree block would send the ball back."""
    scene = Scene(make_config("vss_3v3", 0, 0), 4)
    signs = np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)])
    scene.ball.position[:] = signs * (0.4, 0.62)
    scene.ball.velocity[:, 0] = 2.0 * signs[:, 0]
    across = scene.play(0.3).ball.velocity[-1, :, 1] * signs[:, 1]
    yield CORNER("2 m/s", 4, (across < -0.2).sum())

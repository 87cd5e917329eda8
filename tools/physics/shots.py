"""Fast shots: none passes through anything, none comes off what it only passes near."""

from collections.abc import Sequence

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import CROSSINGS
from rsoccer.frame import Array, length
from tools.physics.check import EXACT, Checks, Line, within
from tools.physics.scene import Scene, Track

TOPIC = "shots"
SPEED = 10.0  # m/s: 50 mm a tick, more than the ball is wide
SHOTS = 1000
GAP = 0.002  # m
FIELDS = {"vss_3v3": (0.85, 0.65), "ssl_b": (4.8, 3.3), "ssl_a": (6.6, 4.8)}  # where walls are, m
RADII = {"vss_3v3": 0.0427 / 2, "ssl_b": 0.0215}

CLEAR = "no contact"
WALLS = Line(TOPIC, "shots at 10 m/s that pass a wall", "of 1000", EXACT, "walls are solid")
SIDES = Line(TOPIC, "that pass the 20 mm side of an SSL goal", "of 500", EXACT, "walls are solid")
BACKS = Line(TOPIC, "that pass its back", "of 500", EXACT, "walls are solid")
ROBOTS = Line(TOPIC, "that pass a robot", "of 1000", EXACT, "robots are solid")
TOUCHED = Line(TOPIC, "that touch the robot that they are aimed at", "of 1000", EXACT, "aim")
SPINNING = Line(TOPIC, "that pass a robot that spins", "of 1000", EXACT, "robots are solid")
SPIN_TOUCHED = Line(
    TOPIC, "that touch the spinning robot that they are aimed at", "of 1000", EXACT, "aim"
)
BENT = Line(TOPIC, "bent when they pass a robot at 2 mm", "mm", within(0.001), CLEAR)
GHOSTS = Line(TOPIC, "that touch when they pass at 2 mm", "of 1000", EXACT, CLEAR)
WALL_BENT = Line(TOPIC, "bent 2 mm from a goal's side or a wall", "mm", within(0.001), CLEAR)
CORNER = Line(TOPIC, "along a VSSS wall: sent inward by the corner", "of 4", EXACT, "45 degrees")


def checks() -> Checks:
    """Every line of the acceptance about fast shots."""
    yield from _walls()
    yield from _goal_sides()
    yield from _goal_backs()
    yield from _robots()
    yield from _spinning()
    yield from _near_robots()
    yield from _near_walls()
    yield from _corners()


def _shoot(scene: Scene, start: Array, target: Array) -> None:
    way = target - start
    scene.ball.position[:] = start
    scene.ball.velocity[:] = SPEED * way / length(way[:, 0], way[:, 1])[:, None]


def _drawn(middle: Sequence[float], spread: Sequence[float], shots: int = SHOTS) -> Array:
    """Numbers (shots, ...) within a spread of the middle of each; always the same."""
    around, widths = np.array(middle), np.array(spread)
    return np.random.default_rng(7).uniform(around - widths, around + widths, (shots, len(around)))


def _walls() -> Checks:
    for field, reach in FIELDS.items():
        scene = Scene(SimConfig(field, 0, 0), SHOTS)
        half = scene.config.field.half_length, scene.config.field.half_width
        drawn = _drawn([0] * 4, [0.8 * half[0], 0.8 * half[1], 2 * half[0], 2 * half[1]])
        _shoot(scene, drawn[:, :2], drawn[:, 2:])
        outside = (abs(scene.play(0.6).ball.position) > reach).any(axis=(0, 2))
        yield WALLS(f"`{field}`", 0, outside.sum())


def _goal_sides() -> Checks:
    """At the side from beside the goal; later one may come round the post, which is no fault."""
    scene = Scene(SimConfig("ssl_b", 0, 0), SHOTS // 2)
    drawn = _drawn([4.65, 0.9, 4.62, 0.0], [0.1, 0.3, 0.1, 0.0], SHOTS // 2)
    _shoot(scene, drawn[:, :2], drawn[:, 2:])
    x, y = np.moveaxis(scene.play(0.1).ball.position, -1, 0)
    yield SIDES("division B", 0, ((x > 4.52) & (abs(y) < 0.5)).any(axis=0).sum())


def _goal_backs() -> Checks:
    scene = Scene(SimConfig("ssl_b", 0, 0), SHOTS // 2)
    drawn = _drawn([3.4, 0.0, 4.7, 0.0], [1.0, 0.4, 0.0, 0.46], SHOTS // 2)
    _shoot(scene, drawn[:, :2], drawn[:, 2:])
    ball = scene.play(0.3).ball
    goals = (ball.crossed == CROSSINGS.index("goal_right")).any(axis=0)
    beyond = (ball.position[..., 0] > 4.68).any(axis=0)
    yield BACKS(f"{goals.sum()} goals", 0, beyond.sum())


def _robots() -> Checks:
    """At robots of any heading, from 0.4 m; undisturbed it would be half a metre beyond."""
    for field, half in (("vss_3v3", 0.0375), ("ssl_b", 0.0715)):
        scene = Scene(SimConfig(field, 1, 0), SHOTS)
        drawn = _drawn([-0.4, 0, 0, 0, 0], [0.1, 0.3, 0.0, 0.8 * half, 180.0])
        scene.face(0, drawn[:, 4])
        _shoot(scene, drawn[:, :2], drawn[:, 2:4])
        ball = scene.play(0.1).ball
        speed = length(ball.velocity[-1, :, 0], ball.velocity[-1, :, 1])
        beyond = (ball.position[-1] * -drawn[:, :2]).sum(axis=-1) > 0.1
        yield ROBOTS(f"`{field}`", 0, (beyond & (speed > 0.95 * SPEED)).sum())
        yield TOUCHED(f"`{field}`", SHOTS, (ball.last_touch[-1] == 0).sum())


def _spinning() -> Checks:
    """At robots that turn fast. Few glance off a corner; one that hardly bends has passed."""
    for field, half, spin in (("vss_3v3", 0.0375, 30.0), ("ssl_b", 0.0715, 26.2)):
        scene = Scene(SimConfig(field, 1, 0), SHOTS)
        drawn = _drawn([-0.4, 0, 0, 0, 0], [0.1, 0.3, 0.0, 0.8 * half, 180.0])
        scene.face(0, drawn[:, 4])
        spins = np.where(np.arange(SHOTS) % 2, spin, -spin)
        scene.robots.spin[:, 0] = spins
        if field == "ssl_b":
            scene.tell(0, v_theta=spins)
        else:
            scene.tell(0, left=-46 * np.sign(spins), right=46 * np.sign(spins))
        _shoot(scene, drawn[:, :2], drawn[:, 2:4])
        ball = scene.play(0.1).ball
        beyond = (ball.position[-1] * -drawn[:, :2]).sum(axis=-1) > 0.1
        ahead = (ball.velocity[-1] * scene.ball.velocity).sum(axis=-1)
        straight = ahead > 0.9 * SPEED * length(*ball.velocity[-1].T)
        yield SPINNING(f"`{field}`, {spin:g} rad/s", 0, (beyond & straight).sum())
        yield SPIN_TOUCHED(f"`{field}`, {spin:g} rad/s", SHOTS, (ball.last_touch[-1] == 0).sum())


def _past(field: str, robots: int, start: Array, seconds: float) -> Track:
    scene = Scene(SimConfig(field, robots, 0), len(start))
    _shoot(scene, start, start + np.array([1.0, 0.0]))
    return scene.play(seconds)


def _near_robots() -> Checks:
    for field, clear in (("vss_3v3", 0.0375), ("ssl_b", 0.09)):
        start = _drawn([-0.3, clear + RADII[field] + GAP], [0.025, 0.0])
        start[::2, 1] *= -1
        ball = _past(field, 1, start, 0.05).ball
        bent = abs(ball.position[..., 1] - start.astype(np.float32)[:, 1]).max()
        yield BENT(f"`{field}`", 0.0, 1000 * bent)
        yield GHOSTS(f"`{field}`", 0, (ball.last_touch[-1] != -1).sum())


def _near_walls() -> Checks:
    for what, y in (("goal's side", 0.52 + 0.0215 + GAP), ("wall", 3.3 - 0.0215 - GAP)):
        start = _drawn([3.9, y], [0.025, 0.0])
        x, across = np.moveaxis(_past("ssl_b", 0, start, 0.075).ball.position, -1, 0)
        bent = abs(across - np.float32(y))[x < 4.7].max()
        yield WALL_BENT(what, 0.0, 1000 * bent)


def _corners() -> Checks:
    """Along a side wall: a right corner would send it straight back."""
    scene = Scene(SimConfig("vss_3v3", 0, 0), 4)
    signs = np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)])
    scene.ball.position[:] = signs * (0.4, 0.62)
    scene.ball.velocity[:, 0] = 2.0 * signs[:, 0]
    across = scene.play(0.3).ball.velocity[-1, :, 1] * signs[:, 1]
    yield CORNER("2 m/s", 4, (across < -0.2).sum())

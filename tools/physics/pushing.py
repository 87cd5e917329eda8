"""Robots that push: each other, a wall, a ball."""

import numpy as np

from rsoccer import SimConfig
from rsoccer.frame import length
from tools.physics.check import EXACT, Checks, Line, percent, within
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import Scene, Track

TOPIC = "pushing"
TRACTION = 6.9 * GENERIC.mass  # N: a wheel on carpet, SSL-A-Team
WEAK, STRONG = 8.0, 24.0  # N

EQUAL = "equally strong"
STALL = Line(TOPIC, "two SSL robots head on: middle of the two after 5 s", "mm", within(2), EQUAL)
APART = Line(TOPIC, "distance of their centres", "mm", within(1), "two radii")
HOLD = Line(TOPIC, "standing robot pushed with 8 N for 5 s has moved", "mm", within(2), "traction")
SLIDE = Line(
    TOPIC, "pushed with 24 N it slides: way in 1.5 s", "m", percent(5), "24 N less traction"
)
VSS_STALL = Line(
    TOPIC, "two VSSS robots head on: middle of the two after 5 s", "mm", within(1), EQUAL
)
VSS_APART = Line(TOPIC, "distance of these centres", "mm", within(1), "a side")
VSS_WALL = Line(
    TOPIC, "VSSS robot driving at a wall for 5 s: centre to wall", "mm", within(0.5), "half a side"
)
VSS_SPEED = Line(TOPIC, "its speed there", "m/s", within(0.001), "at rest")
SQUEEZE = Line(TOPIC, "ball squeezed between two robots: deepest", "mm", within(1), "solid")
SQUEEZED = Line(
    TOPIC, "robots that touch it all through the last half second", "of 2", EXACT, "drive"
)


def checks() -> Checks:
    """Every line of the acceptance about pushing."""
    yield from _head_on()
    yield from _standing()
    yield from _vss()
    yield from _squeezed()


def _pushing(push: float, hold: float, force: float = TRACTION) -> Scene:
    """Two generic robots nose to nose; blue's wheels transmit so much."""
    scene = Scene(SimConfig("ssl_a", 1, 1))
    scene.robots.position[0, :, 0] = (-0.0901, 0.0901)
    scene.face(1, 180.0)
    scene.ball.position[:] = (0.0, 3.0)
    scene.tell(0, v_x=push)
    scene.tell(1, v_x=hold)
    scene.vary_robot(0, "traction", force / TRACTION)
    return scene


def _places(track: Track) -> tuple[float, float]:
    blue, yellow = track.robots.position[-1, 0, :, 0]
    return float(blue), float(yellow)


def _head_on() -> Checks:
    blue, yellow = _places(_pushing(2.0, 2.0).play(5.0))
    yield STALL("both at 2 m/s", 0.0, 1000 * (blue + yellow) / 2)
    yield APART("both at 2 m/s", 2000 * GENERIC.radius, 1000 * (yellow - blue))


def _standing() -> Checks:
    _, held = _places(_pushing(2.0, 0.0, WEAK).play(5.0))
    yield HOLD(f"traction {TRACTION:.1f} N", 0.0, 1000 * (held - 0.0901))
    _, slid = _places(_pushing(3.7, 0.0, STRONG).play(1.5))
    acceleration = (STRONG - TRACTION) / (2 * GENERIC.mass)
    yield SLIDE(f"traction {TRACTION:.1f} N", acceleration * 1.5**2 / 2, slid - 0.0901)


def _vss() -> Checks:
    for name, robot in VSS_ROBOTS.items():
        scene = Scene(SimConfig("vss_3v3", 1, 1, robot=name))
        scene.robots.position[0, :, 0] = (-0.2, 0.2)
        scene.face(1, 180.0)
        scene.ball.position[:] = (0.0, 0.6)
        for index in (0, 1):
            scene.tell(index, left=46.0, right=46.0)
        blue, yellow = _places(scene.play(5.0))
        yield VSS_STALL(f"`{name}`", 0.0, 1000 * (blue + yellow) / 2)
        yield VSS_APART(f"`{name}`", 1000 * robot.side, 1000 * (yellow - blue))
        scene = Scene(SimConfig("vss_3v3", 1, 0, robot=name))
        scene.robots.position[0, 0] = (0.4, -0.3)
        scene.tell(0, left=46.0, right=46.0)
        robots = scene.play(5.0).robots
        gap = 1000 * (0.75 - robots.position[-1, 0, 0, 0])
        yield VSS_WALL(f"`{name}`", 1000 * robot.side / 2, gap)
        yield VSS_SPEED(f"`{name}`", 0.0, length(*robots.velocity[-1, 0, 0]))


def _squeezed() -> Checks:
    """Backs to the ball: round against round, both driving with all they have."""
    ball = BALLS["ssl_tigers"]
    scene = Scene(SimConfig("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (-0.1125, 0.1125)
    scene.face(0, 180.0)
    for index in (0, 1):
        scene.tell(index, v_x=-2.0)
    track = scene.play(1.0)
    away = track.robots.position - track.ball.position[:, :, None]
    gaps = length(away[..., 0], away[..., 1])[:, 0] - GENERIC.radius - ball.radius
    yield SQUEEZE("1 s", 0.0, 1000 * max(-float(gaps.min()), 0.0))
    yield SQUEEZED("gap below 0.1 mm", 2, np.sum((gaps[20:] < 1e-4).all(axis=0)))

"""Pushing: robot against robot, robot against wall, ball between two robots."""

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.vectors import norm
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import Scene, Trajectory, make_config

TOPIC = "pushing"
TRACTION = 6.9 * GENERIC.mass  # N: a wheel on carpet, SSL-A-Team
WEAK, STRONG = 8.0, 24.0  # N

EQUAL = "equal traction"
STALL = Criterion(
    TOPIC,
    "two SSL robots head on: displacement of their midpoint after 5 s",
    "mm",
    absolute(2),
    EQUAL,
)
APART = Criterion(
    TOPIC, "two SSL robots head on: distance of their centers", "mm", absolute(1), "two radii"
)
HOLD = Criterion(
    TOPIC, "standing robot pushed with 8 N for 5 s: displacement", "mm", absolute(2), "traction"
)
SLIDE = Criterion(
    TOPIC,
    "standing robot pushed with 24 N for 1.5 s: displacement",
    "m",
    percent(5),
    "24 N minus traction",
)
VSS_STALL = Criterion(
    TOPIC,
    "two VSSS robots head on: displacement of their midpoint after 5 s",
    "mm",
    absolute(1),
    EQUAL,
)
VSS_APART = Criterion(
    TOPIC, "two VSSS robots head on: distance of their centers", "mm", absolute(1), "one side"
)
VSS_WALL = Criterion(
    TOPIC,
    "VSSS robot driving at a wall for 5 s: center to wall",
    "mm",
    absolute(0.5),
    "half a side",
)
VSS_SPEED = Criterion(
    TOPIC, "VSSS robot driving at a wall for 5 s: speed", "m/s", absolute(0.001), "at rest"
)
VSS_HOLD = Criterion(
    TOPIC,
    "standing VSSS robot pushed for 10 s: displacement",
    "mm",
    absolute(2),
    "static friction of tires",
)
SQUEEZE = Criterion(
    TOPIC, "ball between two pushing robots: penetration depth", "mm", absolute(1), "solid bodies"
)
SQUEEZED = Criterion(
    TOPIC,
    "ball between two pushing robots: robots in contact all through the last 0.5 s",
    "of 2",
    EXACT,
    "drive",
)


def checks() -> Checks:
    """Yield all checks of pushing."""
    yield from _head_on()
    yield from _standing()
    yield from _vss()
    yield from _vss_standing()
    yield from _squeezed()


def _front_to_front(blue: float, yellow: float, force: float = TRACTION) -> Scene:
    """Return two generic robots front to front; blue's wheels transmit at most `force` N."""
    scene = Scene(make_config("ssl_a", 1, 1))
    scene.robots.position[0, :, 0] = (-0.0901, 0.0901)
    scene.face(1, 180.0)
    scene.ball.position[:] = (0.0, 3.0)
    scene.command(0, v_x=blue)
    scene.command(1, v_x=yellow)
    scene.vary_robot(0, "traction", force / TRACTION)
    return scene


def _final_x(trajectory: Trajectory) -> tuple[float, float]:
    blue, yellow = trajectory.robots.position[-1, 0, :, 0]
    return float(blue), float(yellow)


def _head_on() -> Checks:
    blue, yellow = _final_x(_front_to_front(2.0, 2.0).play(5.0))
    yield STALL("both at 2 m/s", 0.0, 1000 * (blue + yellow) / 2)
    yield APART("both at 2 m/s", 2000 * GENERIC.radius, 1000 * (yellow - blue))


def _standing() -> Checks:
    _, still = _final_x(_front_to_front(2.0, 0.0, WEAK).play(5.0))
    yield HOLD(f"traction {TRACTION:.1f} N", 0.0, 1000 * (still - 0.0901))
    _, pushed = _final_x(_front_to_front(3.7, 0.0, STRONG).play(1.5))
    acceleration = (STRONG - TRACTION) / (2 * GENERIC.mass)
    yield SLIDE(f"traction {TRACTION:.1f} N", acceleration * 1.5**2 / 2, pushed - 0.0901)


def _vss() -> Checks:
    for name, robot in VSS_ROBOTS.items():
        scene = Scene(make_config("vss_3v3", 1, 1, robot=name))
        scene.robots.position[0, :, 0] = (-0.2, 0.2)
        scene.face(1, 180.0)
        scene.ball.position[:] = (0.0, 0.6)
        for index in (0, 1):
            scene.command(index, left=46.0, right=46.0)
        blue, yellow = _final_x(scene.play(5.0))
        yield VSS_STALL(f"`{name}`", 0.0, 1000 * (blue + yellow) / 2)
        yield VSS_APART(f"`{name}`", 1000 * robot.side_length, 1000 * (yellow - blue))
        scene = Scene(make_config("vss_3v3", 1, 0, robot=name))
        scene.robots.position[0, 0] = (0.4, -0.3)
        scene.command(0, left=46.0, right=46.0)
        robots = scene.play(5.0).robots
        gap = 1000 * (0.75 - robots.position[-1, 0, 0, 0])
        yield VSS_WALL(f"`{name}`", 1000 * robot.side_length / 2, gap)
        yield VSS_SPEED(f"`{name}`", 0.0, norm(*robots.velocity[-1, 0, 0]))


def _vss_standing() -> Checks:
    """Push a standing robot with a share of its grip, from its side and from behind."""
    for name, robot in VSS_ROBOTS.items():
        for degrees, grip in ((90.0, robot.lateral_grip), (0.0, robot.longitudinal_grip)):
            for share in (0.5, 0.8, 0.95):
                pusher = RobotModel(name, longitudinal_grip=share * grip)
                scene = Scene(make_config("vss_5v5", 1, 1, robot=(RobotModel(name), pusher)))
                scene.robots.position[0, 1, 0] = -robot.side_length - 1e-4
                scene.face(0, degrees)
                scene.ball.position[:] = (0.0, 0.8)
                scene.command(1, left=20.0, right=20.0)
                moved = norm(*scene.play(10.0).robots.position[-1, 0, 0])
                yield VSS_HOLD(f"`{name}` at {degrees:g} degrees, {share:g}", 0.0, 1000 * moved)


def _squeezed() -> Checks:
    """Squeeze the ball between the round backs of two robots that drive at full speed."""
    ball = BALLS["ssl_tigers"]
    scene = Scene(make_config("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (-0.1125, 0.1125)
    scene.face(0, 180.0)
    for index in (0, 1):
        scene.command(index, v_x=-2.0)
    trajectory = scene.play(1.0)
    away = trajectory.robots.position - trajectory.ball.position[:, :, None]
    gaps = norm(away[..., 0], away[..., 1])[:, 0] - GENERIC.radius - ball.radius
    yield SQUEEZE("1 s", 0.0, 1000 * max(-float(gaps.min()), 0.0))
    yield SQUEEZED("gap below 0.1 mm", 2, np.sum((gaps[20:] < 1e-4).all(axis=0)))

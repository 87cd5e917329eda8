"""Rows of robots: the ball and robots along them, and robots in line that press against a wall."""

import numpy as np

from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, make_config

TOPIC = "robot_rows"
ROBOTS = 8
HEAVY = 30.0  # masses of the row by the model's, so that nothing moves it
SIDE = VSS_ROBOTS["vss_440rpm"].side_length
RADIUS = BALLS["vss_rsim"].radius
GAPS = (0.0, 0.0003, 0.001)  # m
ANGLES = (0.5, 1.0, 2.0, 5.0)  # degrees

FLUSH = "flush faces are one face"
ACROSS = Criterion(
    TOPIC,
    "ball along eight robots: speed across after the row by that before it",
    "",
    absolute(0.6),
    "bound: at most the restitution",
)
WAY = Criterion(
    TOPIC, "robot along eight heavy robots: way by that without them", "", percent(3), FLUSH
)
TURN = Criterion(
    TOPIC,
    "robot along eight heavy robots: angle by which it is turned",
    "degrees",
    absolute(1),
    FLUSH,
)
REST = Criterion(
    TOPIC,
    "eight robots in line that press against a wall: maximum speed after 6 s",
    "m/s",
    absolute(0.008),
    "at rest",
)


def checks() -> Checks:
    """Yield all checks of rows."""
    for speed in (0.5, 1.0, 2.0, 5.0):
        yield from _ball(speed)
    for speed in (0.2, 0.5, 1.1):
        yield from _robot(speed)
    for name, speeds in (("vss_440rpm", (0.2, 1.1)), ("ssl_generic", (0.3, 3.0))):
        for speed in speeds:
            yield from _pressing(name, speed)


def _row(moving: int) -> tuple[Scene, Array, Array, Array]:
    """Return rows along x with `moving` more robots; gaps, angles and half lengths by world."""
    gaps, angles = (grid.ravel() for grid in np.meshgrid(GAPS, ANGLES))
    robots = ROBOTS + moving
    blue = robots - robots // 2
    scene = Scene(make_config("vss_3v3", blue, robots // 2, time_step=TICK), len(gaps))
    lengths = SIDE + gaps
    for index in range(ROBOTS):
        scene.robots.position[:, index, 0] = (index - (ROBOTS - 1) / 2) * lengths
        scene.vary_robot(index, "mass", HEAVY)
    return scene, gaps, angles, lengths * (ROBOTS - 1) / 2


def _ball(speed: float) -> Checks:
    scene, gaps, angles, half = _row(0)
    radians = np.radians(angles)
    scene.ball.position[:, 0], scene.ball.position[:, 1] = -half, SIDE / 2 + RADIUS + 0.002
    scene.ball.velocity[:, 0] = speed * np.cos(radians)
    scene.ball.velocity[:, 1] = -speed * np.sin(radians)
    ball = scene.play(min(0.6 / speed, 2.0)).ball
    beside = ball.position[..., 0] < half
    leaving = np.where(beside, ball.velocity[..., 1], 0.0).max(axis=0)
    ratios = leaving / (speed * np.sin(radians))
    for gap in GAPS:
        yield ACROSS(f"{speed:g} m/s, gaps of {1000 * gap:g} mm", 0.0, ratios[gaps == gap].max())


def _robot(speed: float) -> Checks:
    scene, gaps, angles, half = _row(1)
    radians = np.radians(angles)
    scene.robots.position[:, ROBOTS, 0] = -half
    scene.robots.position[:, ROBOTS, 1] = SIDE * (1 + np.sin(radians) / 2) + 0.0005
    scene.face(ROBOTS, -angles)
    scene.robots.velocity[:, ROBOTS, 0] = speed * np.cos(radians)
    scene.robots.velocity[:, ROBOTS, 1] = -speed * np.sin(radians)
    scene.ball.position[:] = (0.0, -0.6)
    rim = speed / VSS_ROBOTS["vss_440rpm"].wheel_radius
    scene.command(ROBOTS, left=rim, right=rim)
    robots = scene.play(2 * half.min() / speed).robots
    way = robots.position[-1, :, ROBOTS, 0] + half
    cosines, sines = np.moveaxis(robots.heading[:, :, ROBOTS].astype(np.float64), -1, 0)
    turned = np.degrees(np.arctan2(sines, cosines)) + angles
    for gap in GAPS:
        case = f"{speed:g} m/s, gaps of {1000 * gap:g} mm"
        yield WAY(case, 1.0, (way / (2 * half.min()))[gaps == gap].min())
        # A robot that drives into the row turns until it is flush.
        excess = np.abs(turned).max(axis=0) - angles
        yield TURN(case, 0.0, max(float(excess[gaps == gap].max()), 0.0))


def _pressing(name: str, speed: float) -> Checks:
    """Let robots one behind the other drive at the wall at y > 0."""
    vss = VSS_ROBOTS.get(name)
    field, radius = ("vss_3v3", vss.side_length / 2) if vss else ("ssl_b", GENERIC.radius)
    wall = 0.65 if vss else 3.3
    scene = Scene(make_config(field, ROBOTS // 2, ROBOTS // 2, robot=name, time_step=TICK))
    rng = np.random.default_rng(4)
    scene.ball.position[:] = (-0.4, -0.4)
    for index in range(ROBOTS):
        away = radius + 0.01 + index * (2 * radius + 0.003)
        scene.robots.position[:, index] = (rng.uniform(-0.001, 0.001), wall - away)
        scene.face(index, 90.0 + rng.uniform(-2, 2))
        if vss:
            rim = speed / vss.wheel_radius
            scene.command(index, left=rim, right=rim)
        else:
            scene.command(index, v_x=speed)
    velocity = scene.play(7.0).robots.velocity[round(6.0 / TICK) :]
    yield REST(f"`{name}`, {speed:g} m/s", 0.0, norm(velocity[..., 0], velocity[..., 1]).max())

"""Single contacts under both contact engines: the compact engine compared with rapier."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from rsoccer.arrays import Array
from tools.physics.check import Checks, Criterion, percent
from tools.physics.cited import BALLS, GENERIC, VSS_ROBOTS
from tools.physics.scene import TICK, Scene, Trajectory, contact_engine, make_config

TOPIC = "single_contacts"
REFERENCE, COMPARED = "rapier", "compact"
TOLERANCE = percent(2)
BALL = BALLS["ssl_tigers"]
VSS = VSS_ROBOTS["vss_440rpm"]
VSS_BALL = BALLS["vss_rsim"]
FULL_SPEED = 46.0  # rad/s, of a VSSS wheel

BALL_SPEED = Criterion(TOPIC, "speed of the ball", "m/s", TOLERANCE, REFERENCE)
BALL_DIRECTION = Criterion(TOPIC, "direction of the ball", "degrees", TOLERANCE, REFERENCE)
ROBOT_SPEED = Criterion(TOPIC, "speed of the robot", "m/s", TOLERANCE, REFERENCE)
ANGULAR_VELOCITY = Criterion(TOPIC, "angular velocity of the robot", "rad/s", TOLERANCE, REFERENCE)
STRUCK_SPEED = Criterion(TOPIC, "speed of the struck robot", "m/s", TOLERANCE, REFERENCE)
STRUCK_DIRECTION = Criterion(
    TOPIC, "direction of the struck robot", "degrees", TOLERANCE, REFERENCE
)
STRUCK_ANGULAR_VELOCITY = Criterion(
    TOPIC, "angular velocity of the struck robot", "rad/s", TOLERANCE, REFERENCE
)
PUSHED = Criterion(TOPIC, "displacement of the pushed robot", "m", TOLERANCE, REFERENCE)
CARRIED = Criterion(TOPIC, "displacement of the ball", "m", TOLERANCE, REFERENCE)

Measurement = tuple[Criterion, float]


class Case(NamedTuple):
    """A contact: a scene, the simulated time and the numbers measured after it."""

    name: str
    scene: Callable[[], Scene]
    seconds: float
    measure: Callable[[Trajectory], Iterator[Measurement]]


def checks() -> Checks:
    """Yield a comparison for each quantity of each contact."""
    for case in cases():
        for (criterion, expected), (_, measured) in zip(
            _measured(case, REFERENCE), _measured(case, COMPARED), strict=True
        ):
            yield criterion(case.name, expected, measured)


def _measured(case: Case, engine: str) -> list[Measurement]:
    with contact_engine(engine):
        return list(case.measure(case.scene().play(case.seconds)))


def cases() -> Iterator[Case]:
    """Yield all contacts."""
    for speed in (0.5, 2.0, 8.0):
        yield Case(
            f"ball at {speed:g} m/s, front of an SSL robot",
            _ball_at_front(speed),
            0.15 if speed > 1 else 0.4,
            _ball_and_robot,
        )
        yield Case(
            f"ball at {speed:g} m/s, round side of an SSL robot, 40 mm off the center",
            _ball_at_side(speed),
            0.15 if speed > 1 else 0.4,
            _glanced,
        )
    yield Case("SSL robot at 2 m/s, ball at rest", _robot_at_ball, 0.15, _ball_only)
    yield Case("ball at 1 m/s, VSSS robot, 20 mm off the center", _ball_at_vss, 0.3, _vss_ball)
    for speed in (1.0, 3.0):
        yield Case(
            f"SSL robot at {speed:g} m/s, robot at rest, central",
            _ssl_hits(speed, 0.0),
            0.02 / speed + 0.01,
            _struck_central,
        )
        yield Case(
            f"SSL robot at {speed:g} m/s, robot at rest, 90 mm off the center",
            _ssl_hits(speed, 0.09),
            0.02 / speed + 0.05,
            _struck,
        )
    yield Case(
        "VSSS robot at 1 m/s, robot at rest, central", _vss_hits(0.0, 0.0), 0.03, _struck_central
    )
    yield Case(
        "VSSS robot at 1 m/s, robot at rest, 45 mm off the center",
        _vss_hits(0.045, 0.0),
        0.03,
        _struck,
    )
    yield Case(
        "VSSS robot at 1 m/s, corner ahead, 10 mm off the center",
        _vss_hits(0.01, 45.0),
        0.03,
        _struck,
    )
    yield Case("three SSL robots in line, the first at 2 m/s", _row, 0.1, _last)
    yield Case("SSL robot at 2 m/s, wall at 45 degrees", _ssl_at_wall, 0.05, _speed_after)
    yield Case("VSSS robot at 1 m/s, wall at 60 degrees", _vss_at_wall(60.0), 0.05, _speed_after)
    yield Case(
        "VSSS robot at full speed along a wall at 10 degrees", _vss_at_wall(10.0), 0.5, _robot_after
    )
    yield Case("SSL robot pushes a robot of weaker wheels", _push, 1.5, _pushed)
    yield Case("VSSS robot pushes the side of another", _vss_push, 1.0, _pushed)
    yield Case("VSSS robot pushes the ball", _vss_push_ball, 0.5, _carried)
    for fast, slow in ((0.8, 0.4), (1.0, 0.5)):
        name = f"ball squeezed between two SSL robots at {fast} and {slow} m/s"
        yield Case(name, _squeeze(fast, slow), 0.2, _squeezed)
    yield Case("dribbled ball, bumped by an opponent at 1 m/s", _bump, 0.4, _bumped)


def _ssl(robots: int = 1, yellow: int = 0, worlds: int = 1) -> Scene:
    return Scene(make_config("ssl_b", robots, yellow, time_step=TICK), worlds)


def _vss(robots: int = 1, yellow: int = 0) -> Scene:
    scene = Scene(make_config("vss_3v3", robots, yellow, time_step=TICK))
    scene.ball.position[:] = (0.0, 0.6)
    return scene


def _ball_at_front(speed: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _ssl()
        scene.ball.position[:] = (0.2, 0.0)
        scene.ball.velocity[:, 0] = -speed
        return scene

    return start


def _ball_at_side(speed: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _ssl()
        scene.face(0, 180.0)
        scene.ball.position[:] = (0.2, 0.04)
        scene.ball.velocity[:, 0] = -speed
        return scene

    return start


def _ball_and_robot(of: Trajectory) -> Iterator[Measurement]:
    yield BALL_SPEED, np.hypot(*of.ball.velocity[-1, 0])
    yield STRUCK_SPEED, np.hypot(*of.robots.velocity[:, 0, 0].T).max()


def _direction(velocity: Array) -> float:
    return float(np.degrees(np.arctan2(velocity[1], velocity[0])))


def _glanced(of: Trajectory) -> Iterator[Measurement]:
    yield from _ball_and_robot(of)
    yield BALL_DIRECTION, _direction(of.ball.velocity[-1, 0])


def _robot_at_ball() -> Scene:
    scene = _ssl()
    scene.robots.velocity[:, 0, 0] = 2.0
    scene.command(0, v_x=2.0)
    scene.ball.position[:] = (0.15, 0.0)
    return scene


def _ball_only(of: Trajectory) -> Iterator[Measurement]:
    yield BALL_SPEED, np.hypot(*of.ball.velocity[-1, 0])


def _ball_at_vss() -> Scene:
    scene = _vss()
    scene.ball.position[:] = (0.15, 0.02)
    scene.ball.velocity[:, 0] = -1.0
    return scene


def _vss_ball(of: Trajectory) -> Iterator[Measurement]:
    yield BALL_SPEED, np.hypot(*of.ball.velocity[-1, 0])
    yield STRUCK_ANGULAR_VELOCITY, abs(of.robots.angular_velocity[:, 0, 0]).max()


def _ssl_hits(speed: float, aside: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _ssl(1, 1)
        scene.ball.position[:] = (0.0, 2.0)
        scene.robots.position[0, :, 0] = (0.0, np.sqrt(0.18**2 - aside**2) + 0.02)
        scene.robots.position[0, 1, 1] = aside
        scene.robots.velocity[0, 0, 0] = speed
        scene.command(0, v_x=speed)
        return scene

    return start


def _struck_central(of: Trajectory) -> Iterator[Measurement]:
    yield STRUCK_SPEED, np.hypot(*of.robots.velocity[:, 0, 1].T).max()
    yield ROBOT_SPEED, np.hypot(*of.robots.velocity[:, 0, 0].T).min()


def _struck(of: Trajectory) -> Iterator[Measurement]:
    yield from _struck_central(of)
    first = np.hypot(*of.robots.velocity[:, 0, 1].T).argmax()
    yield STRUCK_DIRECTION, _direction(of.robots.velocity[first, 0, 1])
    yield STRUCK_ANGULAR_VELOCITY, abs(of.robots.angular_velocity[:, 0, 1]).max()


def _vss_hits(aside: float, degrees: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _vss(1, 1)
        half = VSS.side_length / 2
        reach = half * (np.sqrt(2) if degrees else 1.0)
        scene.robots.position[0, :, 0] = (0.0, half + reach + 0.01)
        scene.robots.position[0, 1, 1] = aside
        scene.robots.velocity[0, 0, 0] = 1.0
        scene.face(0, degrees)
        return scene

    return start


def _row() -> Scene:
    scene = _ssl(3)
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, :, 0] = (0.0, 0.2, 0.4)
    scene.robots.velocity[0, 0, 0] = 2.0
    return scene


def _last(of: Trajectory) -> Iterator[Measurement]:
    yield STRUCK_SPEED, np.hypot(*of.robots.velocity[:, 0, 2].T).max()


def _ssl_at_wall() -> Scene:
    scene = _ssl()
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, 0] = (4.8 - 0.09 - 0.01, 1.2)
    scene.robots.velocity[0, 0] = (np.sqrt(2), np.sqrt(2))
    return scene


def _vss_at_wall(degrees: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _vss()
        scene.ball.position[:] = (0.0, 0.0)
        scene.robots.position[0, 0] = (-0.2, -0.65 + 0.06)
        scene.robots.velocity[0, 0] = np.cos(np.radians(degrees)), -np.sin(np.radians(degrees))
        scene.face(0, -degrees)
        scene.command(0, left=1.0 / VSS.wheel_radius, right=1.0 / VSS.wheel_radius)
        return scene

    return start


def _speed_after(of: Trajectory) -> Iterator[Measurement]:
    yield ROBOT_SPEED, np.hypot(*of.robots.velocity[-1, 0, 0])


def _robot_after(of: Trajectory) -> Iterator[Measurement]:
    yield from _speed_after(of)
    yield ANGULAR_VELOCITY, abs(of.robots.angular_velocity[:, 0, 0]).max()


def _push() -> Scene:
    scene = _ssl(1, 1)
    scene.ball.position[:] = (0.0, 2.0)
    scene.robots.position[0, :, 0] = (-0.0901, 0.0901)
    scene.command(0, v_x=3.7)
    scene.vary_robot(1, "traction", 0.5)
    return scene


def _pushed(of: Trajectory) -> Iterator[Measurement]:
    yield PUSHED, np.hypot(*(of.robots.position[-1, 0, 1] - of.robots.position[0, 0, 1]))


def _vss_push() -> Scene:
    scene = _vss(1, 1)
    scene.robots.position[0, :, 0] = (-0.04, 0.04)
    scene.face(1, 90.0)
    scene.command(0, left=FULL_SPEED, right=FULL_SPEED)
    return scene


def _vss_push_ball() -> Scene:
    scene = _vss()
    scene.ball.position[:] = (VSS.side_length / 2 + VSS_BALL.radius + 0.005, 0.0)
    scene.command(0, left=FULL_SPEED, right=FULL_SPEED)
    return scene


def _carried(of: Trajectory) -> Iterator[Measurement]:
    yield CARRIED, np.hypot(*(of.ball.position[-1, 0] - of.ball.position[0, 0]))


def _squeeze(fast: float, slow: float) -> Callable[[], Scene]:
    def start() -> Scene:
        scene = _ssl(1, 1)
        apart = GENERIC.radius + BALL.radius + 0.01
        scene.face(0, 180.0)
        scene.robots.position[0, :, 0] = (-apart, apart)
        scene.robots.velocity[0, :, 0] = (fast, -slow)
        return scene

    return start


def _squeezed(of: Trajectory) -> Iterator[Measurement]:
    yield STRUCK_SPEED, of.robots.velocity[:, 0, 1, 0].max()


def _bump() -> Scene:
    scene = _ssl(1, 1)
    offset = GENERIC.front_distance + BALL.radius
    scene.ball.position[:] = (offset, 0.0)
    scene.robots.position[0, 1] = (2 * offset + 0.1, 0.0)
    scene.robots.velocity[0, 1, 0] = -1.0
    scene.face(1, 180.0)
    scene.command(0, dribbler=1.0)
    scene.command(1, v_x=1.0)
    return scene


def _bumped(of: Trajectory) -> Iterator[Measurement]:
    yield STRUCK_SPEED, np.hypot(*of.robots.velocity[:, 0, 0].T).max()
    yield PUSHED, np.hypot(*(of.robots.position[-1, 0, 0] - of.robots.position[0, 0, 0]))

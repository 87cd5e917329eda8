"""Symmetry: a rotated or mirrored start leads to the rotated or mirrored trajectory."""

from dataclasses import dataclass

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.arrays import Floats
from tools.physics.check import EXACT, Checks, Criterion, absolute
from tools.physics.scene import Scene, make_config

TOPIC = "symmetry"
UNIT = "m, m/s"
FREE = Criterion(TOPIC, "without contact: largest difference", UNIT, EXACT, "symmetry")
CONTACT = Criterion(TOPIC, "with one contact: largest difference", UNIT, absolute(1e-4), "symmetry")
STOPPED = Criterion(TOPIC, "with one contact: ball is stopped", "of 1", EXACT, "hits a robot")


@dataclass(frozen=True)
class Symmetry:
    """Transformation of states and commands: sign flips of columns, and a swap of the teams."""

    name: str
    ball: frozenset[str]  # ball columns that change sign
    robot: frozenset[str]  # robot columns that change sign
    swaps_teams: bool

    def rows(self, rows: Floats, config: SimConfig) -> Floats:
        """Return the image of state rows (..., row)."""
        split = len(BALL_COLUMNS)
        robots = rows[..., split:].reshape(*rows.shape[:-1], config.n_robots, len(ROBOT_COLUMNS))
        robots = robots * np.array([-1.0 if c in self.robot else 1.0 for c in ROBOT_COLUMNS])
        ball = rows[..., :split] * np.array([-1.0 if c in self.ball else 1.0 for c in BALL_COLUMNS])
        if self.swaps_teams:
            robots = np.roll(robots, config.n_blue, axis=-2)
            last = BALL_COLUMNS.index("last_touch")
            swapped = (rows[..., last] + config.n_blue) % config.n_robots
            ball[..., last] = np.where(rows[..., last] < 0, -1.0, swapped)
        image = np.concatenate([ball, robots.reshape(*rows.shape[:-1], -1)], axis=-1)
        return np.ascontiguousarray(image, np.float32)

    def commands(self, commands: Floats, config: SimConfig) -> Floats:
        """Return the image of commands (worlds, robots, command)."""
        if self.swaps_teams:
            return np.roll(commands, config.n_blue, axis=1)
        if config.command_columns == ("left", "right"):
            return np.ascontiguousarray(commands[..., ::-1])
        signs = [-1.0 if c in ("v_y", "v_theta") else 1.0 for c in config.command_columns]
        return commands * np.array(signs, np.float32)


# Spin is an axial vector: a half turn about z flips its x and y components, a reflection the
# components within the mirror plane.
HALF_TURN = Symmetry(
    "half turn",
    frozenset({"x", "y", "v_x", "v_y", "spin_x", "spin_y", "crossed_x", "crossed_y"}),
    frozenset({"x", "y", "cos", "sin", "v_x", "v_y"}),
    swaps_teams=True,
)
REFLECTION = Symmetry(
    "reflection",
    frozenset({"y", "v_y", "spin_x", "spin_z", "crossed_y"}),
    frozenset({"y", "sin", "v_y", "v_theta"}),
    swaps_teams=False,
)


def checks() -> Checks:
    """Yield all checks of symmetry."""
    free = (_drive_vss(), _drive_ssl(), _chip())
    for name, scene in zip(("VSSS drive", "SSL drive", "flight"), free, strict=True):
        for symmetry in (HALF_TURN, REFLECTION):
            yield FREE(f"{name}, {symmetry.name}", 0.0, difference(symmetry, scene, 0.3))
    for name, scene in (("VSSS", _contact("vss_3v3", 1.0)), ("SSL", _contact("ssl_b", 1.5))):
        # Its spin may send it to the robot again.
        yield STOPPED(name, 1, scene.play(0.35).ball.velocity[-1, 0, 0] > -0.1)
        for symmetry in (HALF_TURN, REFLECTION):
            yield CONTACT(f"{name}, {symmetry.name}", 0.0, difference(symmetry, scene, 0.35))


def difference(symmetry: Symmetry, scene: Scene, seconds: float) -> float:
    """Return the largest difference between the trajectory's image and the image's trajectory."""
    image = Scene(scene.config, len(scene.start))
    image.start.rows[:] = symmetry.rows(scene.start.rows, scene.config)
    image.commands[:] = symmetry.commands(scene.commands, scene.config)
    expected = symmetry.rows(scene.play(seconds).rows, scene.config)
    apart = abs(expected - image.play(seconds).rows)
    # Spin is compared as surface speed, so that all columns have similar magnitudes.
    spin = BALL_COLUMNS.index("spin_x")
    apart[..., spin : spin + 3] *= scene.config.ball.radius
    return float(apart.max())


def _posed(field: str, poses: list[tuple[float, float, float]]) -> Scene:
    """Return robots at poses (m, m, degrees); the first half of them is blue."""
    scene = Scene(make_config(field, len(poses) // 2, len(poses) // 2))
    for index, (x, y, degrees) in enumerate(poses):
        scene.robots.position[:, index] = (x, y)
        scene.face(index, degrees)
    return scene


def _drive_vss() -> Scene:
    poses = [(-0.5, 0.1, 10.0), (-0.4, -0.4, 80.0), (0.5, 0.2, 200.0), (0.4, -0.3, 120.0)]
    scene = _posed("vss_3v3", poses)
    scene.commands[0] = [(20, 17), (5, -5), (9, 9.5), (3, 2)]
    _set_rolling_ball(scene)
    return scene


def _drive_ssl() -> Scene:
    poses = [(-2.5, 0.1, 10.0), (-2.0, -2.0, 80.0), (2.5, 0.2, 200.0), (2.0, -1.0, 120.0)]
    scene = _posed("ssl_b", poses)
    scene.commands[0, :, :3] = [(1, 0.5, 2), (-0.5, 0.2, 0), (0.3, -0.8, -3), (3.7, 3.7, 9)]
    _set_rolling_ball(scene)
    return scene


def _set_rolling_ball(scene: Scene) -> None:
    scene.ball.position[:], scene.ball.velocity[:] = (0.05, 0.1), (-0.4, 0.3)
    scene.ball.spin[:, 2] = 3.0


def _chip() -> Scene:
    scene = _posed("ssl_b", [(-2.0, 0.0, 0.0), (2.0, 0.5, 180.0)])
    scene.ball.position[:], scene.ball.velocity[:] = (0.2, -0.3), (-1.0, 0.7)
    scene.ball.vertical_velocity[:] = 3.0
    return scene


def _contact(field: str, speed: float) -> Scene:
    """Return a ball that rolls at a slightly turned robot."""
    scene = _posed(field, [(-0.3, 0.02, 5.0), (0.6, 0.0, 180.0)])
    scene.ball.velocity[:, 0] = -speed
    return scene

import subprocess
import sys
from collections import Counter

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer._core import RobotModel
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.render import palette
from rsoccer.render.ball import drawn_radius
from rsoccer.render.overlay import target_shapes
from rsoccer.render.robot import robot_shapes
from rsoccer.render.scene import background_shapes, foreground_shapes
from rsoccer.render.scoreboard import Board, scene_bounds, score_shapes
from rsoccer.render.shapes import Arc, Circle, Color, Line, Point, Polygon, Pose, Shape, Text

PLAIN = Board()
LABELED = ("ssl_a", "ssl_b")
"""Fields on which a number would be too small on the robot itself."""
MIRRORS = [(-1, 1), (1, -1), (-1, -1)]


def mirrored_row(config: SimConfig, original: Floats, mirror: tuple[int, int]) -> Floats:
    frame = Frame(original[None].copy(), config.n_blue, config.n_yellow)
    ball, robots = frame.ball, frame.robots
    for vectors in (ball.position, ball.velocity, robots.position, robots.heading):
        vectors *= np.array(mirror, np.float32)
    row: Floats = frame.rows[0]
    return row


def appearance(shape: Shape, mirror: tuple[int, int] = (1, 1)) -> tuple[object, Color]:
    """Points and color of a mirrored shape, without the order and orientation of points."""

    def flip(points: tuple[Point, ...]) -> frozenset[Point]:
        i, j = mirror
        return frozenset((round(i * x, 5) + 0.0, round(j * y, 5) + 0.0) for x, y in points)

    match shape:
        case Polygon(points, color):
            return flip(points), color
        case Circle(center, radius, color):
            return (flip((center,)), radius), color
        case Line(start, end, width, color):
            return (flip((start, end)), width), color
        case Arc(center, radius, _, _, _, color):
            return (flip((center,)), radius), color
        case Text(center, height, text, color):
            return (flip((center,)), height, text), color


def bodies(config: SimConfig, row: Floats) -> list[Shape]:
    """Robots and ball, without the highlight, whose light comes from a fixed side."""
    board = score_shapes(config.field, PLAIN)
    play = foreground_shapes(config, row, PLAIN)
    return [s for s in play if s not in board and s.color != palette.HIGHLIGHT]


@pytest.mark.parametrize("mirror", MIRRORS)
def test_a_mirrored_row_gives_mirrored_shapes(
    any_config: SimConfig, any_row: Floats, mirror: tuple[int, int]
) -> None:
    original = bodies(any_config, any_row)
    assert len(original) > 5 * any_config.n_robots
    mirrored = bodies(any_config, mirrored_row(any_config, any_row, mirror))
    expected = Counter(appearance(s, mirror) for s in original)  # left wheels become right ones
    assert Counter(appearance(s) for s in mirrored) == expected
    assert Counter(appearance(s) for s in original) != expected


def test_a_scene_depends_on_its_arguments_only(config: SimConfig, row: Floats) -> None:
    before = row.copy()
    first = background_shapes(config) + foreground_shapes(config, row, PLAIN)
    foreground_shapes(SimConfig("vss_5v5", 1, 2), Frame.empty(1, 1, 2).rows[0], Board((9, 9), 99.0))
    assert background_shapes(config) + foreground_shapes(config, row, PLAIN) == first
    assert hash(first)  # frozen, with all that it holds
    np.testing.assert_array_equal(row, before)


def test_every_robot_is_drawn_with_its_number(any_config: SimConfig, any_row: Floats) -> None:
    config = any_config
    texts = [shape for shape in bodies(config, any_row) if isinstance(shape, Text)]
    assert [text.text for text in texts] == ["0", "1", "2", "0", "1", "2"]
    frame = Frame(any_row[None], config.n_blue, config.n_yellow)
    reach = (3.5 if config.field.name in LABELED else 0.25) * config.robot.bounding_radius
    for text, position in zip(texts, frame.robots.position[0], strict=True):
        assert np.hypot(*(position - text.center)) < reach


def test_robots_too_small_for_a_number_have_a_label_behind_them(any_config: SimConfig) -> None:
    frame = Frame.empty(1, 3, 3)
    frame.robots.position[0, :, 0] = np.arange(6)
    frame.robots.heading[0, :, 1] = 1.0
    play = foreground_shapes(any_config, frame.rows[0], PLAIN)
    plates = [s for s in play if isinstance(s, Polygon) and s.color == palette.LABEL]
    assert len(plates) == (6 if any_config.field.name in LABELED else 0)
    for plate in plates:
        assert all(y < -any_config.robot.bounding_radius for _, y in plate.points)


def test_each_robot_is_drawn_as_its_own_model() -> None:
    names = ["ssl_generic", "vss_440rpm", "ssl_ubc", "ssl_erforce"]
    config = SimConfig("ssl_challenge", 3, 1, robot=names)
    frame = Frame.empty(1, 3, 1)
    poses = [Pose((0.5 * i, 0.0), 1.0, 0.0) for i in range(4)]
    for i, pose in enumerate(poses):
        frame.robots.position[0, i] = pose.center
    play = foreground_shapes(config, frame.rows[0], PLAIN)
    teams = [(palette.BLUE, i) for i in range(3)] + [(palette.YELLOW, 0)]
    for name, pose, (color, number) in zip(names, poses, teams, strict=True):
        has_number = name.startswith("ssl")
        expected = robot_shapes(RobotModel(name), pose, color, number, has_number=has_number)
        assert set(expected) <= set(play), name


def test_the_dribbler_that_has_the_ball_is_lit() -> None:
    config = SimConfig("ssl_b", 2, 2)
    frame = Frame.empty(1, 2, 2)
    frame.robots.position[0, :, 0] = np.arange(4)
    assert not any(
        s.color == palette.DRIBBLER_LIT for s in foreground_shapes(config, frame.rows[0], PLAIN)
    )
    frame.robots.infrared[0, 2] = 1.0
    lit = [
        s
        for s in foreground_shapes(config, frame.rows[0], PLAIN)
        if s.color == palette.DRIBBLER_LIT
    ]
    assert lit
    for shape in lit:
        assert isinstance(shape, Polygon)
        assert all(2.0 < x < 2.1 for x, _ in shape.points)  # ahead of the third robot


def test_a_ball_in_flight_is_drawn_larger(any_config: SimConfig, any_row: Floats) -> None:
    def radii(row: Floats) -> list[float]:
        play = foreground_shapes(any_config, row, PLAIN)
        return [s.radius for s in play if isinstance(s, Circle) and s.color == palette.ORANGE]

    flying = Frame(any_row[None].copy(), any_config.n_blue, any_config.n_yellow)
    flying.ball.height[0] = 0.4
    (low,), (high,) = radii(any_row), radii(flying.rows[0])
    assert low == drawn_radius(any_config.ball, scene_bounds(any_config.field).width) < high


def test_a_shadow_lies_under_the_robots_and_the_ball_above_them() -> None:
    config = SimConfig("ssl_b", 1, 1)
    frame = Frame.empty(1, 1, 1)
    frame.ball.height[0] = 0.4
    play = foreground_shapes(config, frame.rows[0], PLAIN)
    covers = [i for i, s in enumerate(play) if s.color in (palette.BLUE, palette.YELLOW)]
    discs = [(i, s) for i, s in enumerate(play) if isinstance(s, Circle)]
    (shadow,) = (i for i, s in discs if s.color == palette.SHADOW)
    (ball,) = (i for i, s in discs if s.color == palette.ORANGE)
    assert shadow < min(covers) < max(covers) < ball


def test_extras_lie_under_robots_and_ball(any_config: SimConfig, any_row: Floats) -> None:
    extras = [*target_shapes(any_config.field, (0.0, 0.0), 0.1)]
    play = foreground_shapes(any_config, any_row, PLAIN, extras)
    assert play[: len(extras)] == tuple(extras)
    assert play[len(extras) :] == foreground_shapes(any_config, any_row, PLAIN)


def test_teams_of_different_size_are_drawn() -> None:
    config = SimConfig("vss_5v5", 5, 1)
    frame = Frame.empty(1, 5, 1)
    texts = [s.text for s in bodies(config, frame.rows[0]) if isinstance(s, Text)]
    assert texts == ["0", "1", "2", "3", "4", "0"]


def test_a_row_of_another_size_is_refused(config: SimConfig, row: Floats) -> None:
    with pytest.raises(ValueError, match=rf"row: expected shape \({config.row_size},\)"):
        foreground_shapes(config, row[:-1], PLAIN)
    with pytest.raises(ValueError, match="row: expected shape"):
        foreground_shapes(config, row[None], PLAIN)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_row_that_is_not_finite_is_refused(config: SimConfig, row: Floats, value: float) -> None:
    row[3] = value
    with pytest.raises(ValueError, match="row: expected finite values"):
        foreground_shapes(config, row, PLAIN)


def test_a_scene_needs_no_drawing_library() -> None:
    code = "import sys, rsoccer.render.scene; sys.exit('pygame' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

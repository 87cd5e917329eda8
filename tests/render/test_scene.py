import subprocess
import sys
from collections import Counter

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.frame import Floats, Frame
from rsoccer.render import palette
from rsoccer.render.scene import draw_ground, draw_play
from rsoccer.render.scoreboard import Board, draw_score
from rsoccer.render.shapes import Arc, Circle, Color, Line, Point, Polygon, Shape, Text

PLAIN = Board()
MIRRORS = [(-1, 1), (1, -1), (-1, -1)]


def mirrored_row(config: SimConfig, original: Floats, mirror: tuple[int, int]) -> Floats:
    frame = Frame(original[None].copy(), config.n_blue, config.n_yellow)
    ball, robots = frame.ball, frame.robots
    for vectors in (ball.position, ball.velocity, robots.position, robots.heading):
        vectors *= np.array(mirror, np.float32)
    row: Floats = frame.rows[0]
    return row


def looks(shape: Shape, mirror: tuple[int, int] = (1, 1)) -> tuple[object, Color]:
    """What a shape covers once mirrored; the order of points and the way round do not count."""

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
    """What moves; without the highlight, whose light comes from a fixed side."""
    board = draw_score(config.field, PLAIN)
    play = draw_play(config, row, PLAIN)
    return [s for s in play if s not in board and s.color != palette.SHINE]


@pytest.mark.parametrize("mirror", MIRRORS)
def test_a_mirrored_row_gives_mirrored_shapes(
    config: SimConfig, row: Floats, mirror: tuple[int, int]
) -> None:
    original = bodies(config, row)
    assert len(original) > 6 * config.n_robots
    mirrored = bodies(config, mirrored_row(config, row, mirror))
    expected = Counter(looks(s, mirror) for s in original)  # left wheels become right ones
    assert Counter(looks(s) for s in mirrored) == expected
    assert Counter(looks(s) for s in original) != expected


def test_a_scene_depends_on_nothing_but_what_it_is_given(config: SimConfig, row: Floats) -> None:
    before = row.copy()
    first = draw_ground(config) + draw_play(config, row, PLAIN)
    draw_play(SimConfig("vss_5v5", 1, 2), Frame.empty(1, 1, 2).rows[0], Board((9, 9), 99.0))
    assert draw_ground(config) + draw_play(config, row, PLAIN) == first
    assert hash(first)  # frozen all the way down
    np.testing.assert_array_equal(row, before)


def test_every_robot_is_drawn_with_its_number(config: SimConfig, row: Floats) -> None:
    texts = [shape for shape in bodies(config, row) if isinstance(shape, Text)]
    assert [text.text for text in texts] == ["0", "1", "2", "0", "1", "2"]
    frame = Frame(row[None], config.n_blue, config.n_yellow)
    for text, position in zip(texts, frame.robots.position[0], strict=True):
        assert np.hypot(*(position - text.center)) < config.robot.side / 4


def test_teams_of_different_size_are_drawn() -> None:
    config = SimConfig("vss_5v5", 5, 1)
    frame = Frame.empty(1, 5, 1)
    texts = [s.text for s in bodies(config, frame.rows[0]) if isinstance(s, Text)]
    assert texts == ["0", "1", "2", "3", "4", "0"]


def test_a_row_of_another_size_is_refused(config: SimConfig, row: Floats) -> None:
    with pytest.raises(ValueError, match=rf"row: expected shape \({config.row_size},\)"):
        draw_play(config, row[:-1], PLAIN)
    with pytest.raises(ValueError, match="row: expected shape"):
        draw_play(config, row[None], PLAIN)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_row_that_is_not_finite_is_refused(config: SimConfig, row: Floats, value: float) -> None:
    row[3] = value
    with pytest.raises(ValueError, match="row: expected finite values"):
        draw_play(config, row, PLAIN)


def test_a_scene_needs_no_drawing_library() -> None:
    code = "import sys, rsoccer.render.scene; sys.exit('pygame' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

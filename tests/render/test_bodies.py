import math

import pytest

from rsoccer import SimConfig
from rsoccer.render import palette
from rsoccer.render.bodies import TRAIL_LENGTH, TRAIL_SPEED, draw_ball, draw_robot, draw_trail
from rsoccer.render.shapes import Circle, Color, Polygon, Pose, Text

ROBOT, BALL = SimConfig().robot, SimConfig().ball


def test_a_robot_covers_its_square_and_no_more() -> None:
    shapes = draw_robot(ROBOT, Pose((0.0, 0.0), 1.0, 0.0), palette.BLUE, 0)
    points = [p for shape in shapes if isinstance(shape, Polygon) for p in shape.points]
    assert max(abs(x) for x, _ in points) == pytest.approx(ROBOT.side / 2)
    assert max(abs(y) for _, y in points) == pytest.approx(ROBOT.side / 2)


def test_the_arrow_points_where_the_robot_looks() -> None:
    heading = (math.cos(2.0), math.sin(2.0))
    shapes = draw_robot(ROBOT, Pose((0.3, -0.2), *heading), palette.BLUE, 4)
    arrow = [s for s in shapes if isinstance(s, Polygon) and s.color == palette.WHITE]
    assert len(arrow) == 1
    tip = arrow[0].points[0]
    ahead = (tip[0] - 0.3) * heading[0] + (tip[1] + 0.2) * heading[1]
    assert ahead == pytest.approx(math.dist(tip, (0.3, -0.2)))
    assert 0.3 * ROBOT.side < ahead < ROBOT.side / 2


@pytest.mark.parametrize(
    ("color", "ink"), [(palette.BLUE, palette.WHITE), (palette.YELLOW, palette.INK)]
)
def test_the_number_stands_out_from_the_colour_of_the_team(color: Color, ink: Color) -> None:
    shapes = draw_robot(ROBOT, Pose((0.0, 0.0), 1.0, 0.0), color, 7)
    texts = [shape for shape in shapes if isinstance(shape, Text)]
    assert [(text.text, text.color) for text in texts] == [("7", ink)]


def test_the_ball_has_its_true_size() -> None:
    balls = [s for s in draw_ball(BALL, (0.1, 0.2)) if s.color == palette.ORANGE]
    assert balls == [Circle((0.1, 0.2), BALL.radius, palette.ORANGE)]


def test_a_trail_lies_behind_a_fast_ball_and_is_bounded() -> None:
    lengths = []
    for speed in (0.5, 1.0, 100.0):
        trail = draw_trail(BALL, (0.0, 0.0), (0.0, speed))
        points = [p for wedge in trail if isinstance(wedge, Polygon) for p in wedge.points]
        assert max(y for _, y in points) == pytest.approx(0.0)
        lengths.append(-min(y for _, y in points))
    assert lengths[0] < lengths[1] < lengths[2]
    assert lengths[2] == pytest.approx(TRAIL_LENGTH * BALL.radius)


def test_a_slow_ball_has_no_trail() -> None:
    assert draw_trail(BALL, (0.0, 0.0), (0.99 * TRAIL_SPEED, 0.0)) == ()
    assert draw_trail(BALL, (0.0, 0.0), (0.0, 0.0)) == ()

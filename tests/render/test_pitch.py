from collections import Counter
from collections.abc import Iterable

import pytest

from rsoccer import SimConfig
from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds, draw_pitch
from rsoccer.render.shapes import Arc, Circle, Line, Point, Polygon, Shape, Text

FIELDS = ["vss_3v3", "vss_5v5"]


def outline(shape: Shape) -> tuple[Point, ...]:
    match shape:
        case Polygon(points, _):
            return points
        case Line(start, end, _):
            return (start, end)
        case Circle(center, _) | Arc(center, _) | Text(center, _):
            return (center,)


def seen(shapes: Iterable[Shape], sign: int) -> Counter[frozenset[Point]]:
    """What the shapes cover, as they are (1) or turned half round (-1)."""
    return Counter(
        frozenset((round(sign * x, 6) + 0.0, round(sign * y, 6) + 0.0) for x, y in outline(shape))
        for shape in shapes
    )


@pytest.mark.parametrize("name", FIELDS)
def test_a_field_turned_half_round_is_the_same_field(name: str) -> None:
    shapes = draw_pitch(SimConfig(name).field)
    assert len(shapes) > 30
    assert seen(shapes, 1) == seen(shapes, -1)


@pytest.mark.parametrize("name", FIELDS)
def test_everything_lies_within_the_picture(name: str) -> None:
    field = SimConfig(name).field
    bounds = arena_bounds(field)
    for shape in draw_pitch(field):
        for x, y in outline(shape):
            assert bounds.left < x < bounds.right
            assert bounds.bottom < y < bounds.top


@pytest.mark.parametrize("name", FIELDS)
def test_lines_are_where_the_field_says(name: str) -> None:
    field = SimConfig(name).field
    shapes = draw_pitch(field)
    circles = [shape for shape in shapes if isinstance(shape, Arc)]
    assert [(circle.center, circle.radius) for circle in circles] == [
        ((0.0, 0.0), field.center_radius)
    ]
    marks = {shape.center for shape in shapes if isinstance(shape, Circle)}
    x, y = field.free_ball_x, field.free_ball_y
    assert marks == {
        (0.0, 0.0),
        *((side * (field.half_length - field.penalty_mark), 0.0) for side in (-1, 1)),
        *((i * x, j * y) for i in (-1, 1) for j in (-1, 1)),
    }
    white = [s for s in shapes if isinstance(s, Line) and s.color == palette.LINES]
    fronts = {abs(line.start[0]) for line in white if line.start[0] == line.end[0]}
    front = field.half_length - field.goal_area_depth
    assert {0.0, front, field.half_length} == fronts
    assert {line.width for line in white} == {field.line_width}


def test_each_goal_has_the_colour_of_the_team_that_defends_it() -> None:
    field = SimConfig().field
    for side, color in ((-1, palette.BLUE), (1, palette.YELLOW)):
        back = side * (field.half_length + field.goal_depth)
        ends = [
            shape
            for shape in draw_pitch(field)
            if isinstance(shape, Line) and shape.start[0] == shape.end[0] == back
        ]
        assert [line.color for line in ends] == [color]

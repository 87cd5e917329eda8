import math

import pytest

from rsoccer._core import Field
from rsoccer.render.lines import line_shapes
from rsoccer.render.shapes import Arc, Circle, Line

FIELDS = pytest.mark.parametrize(
    "field", [Field(name) for name in Field.PRESETS], ids=Field.PRESETS
)


def straight(field: Field) -> list[Line]:
    return [shape for shape in line_shapes(field) if isinstance(shape, Line)]


def across(field: Field) -> dict[float, float]:
    """Half lengths of the lines across the field, by their distance from its center."""
    return {
        abs(line.start[0]): abs(line.start[1])
        for line in straight(field)
        if line.start[0] == line.end[0]
    }


@FIELDS
def test_lines_across_are_at_the_fields_distances(field: Field) -> None:
    goal_line = field.half_width if field.goal_line_margin else field.goal_width / 2
    expected = {
        0.0: field.half_width,
        field.half_length: goal_line,
        field.half_length - field.goal_area_depth: field.goal_area_width / 2,
    }
    if field.inner_area_depth:
        expected[field.half_length - field.inner_area_depth] = field.inner_area_width / 2
    assert across(field) == pytest.approx(expected)
    assert {line.width for line in straight(field)} == {field.line_width}


@FIELDS
def test_touch_lines_are_drawn_unless_a_wall_stands_on_them(field: Field) -> None:
    touch_lines = {
        line.start[1]
        for line in straight(field)
        if (line.start[0], line.end[0]) == (-field.half_length, field.half_length)
    }
    sides = {-field.half_width, field.half_width}
    assert touch_lines == (sides if field.touch_line_margin else set())


@FIELDS
def test_marks_are_at_the_fields_positions(field: Field) -> None:
    marks = [shape.center for shape in line_shapes(field) if isinstance(shape, Circle)]
    expected = {(0.0, 0.0)}
    if field.penalty_mark_distance:
        expected |= {(s * (field.half_length - field.penalty_mark_distance), 0.0) for s in (-1, 1)}
    x, y = field.free_ball_x, field.free_ball_y
    if x:
        expected |= {(i * x, j * y) for i in (-1, 1) for j in (-1, 1)}
    assert set(marks) == expected
    assert len(marks) == len(expected)


@FIELDS
def test_an_arc_on_an_area_has_the_chord_and_height_of_the_field(field: Field) -> None:
    center, *arcs = (shape for shape in line_shapes(field) if isinstance(shape, Arc))
    assert (center.center, center.radius) == ((0.0, 0.0), field.center_circle_radius)
    assert len(arcs) == (2 if field.area_arc_width else 0)
    front = field.half_length - field.goal_area_depth
    for arc, side in zip(arcs, (-1, 1), strict=False):
        ends = [
            (arc.center[0] + arc.radius * math.cos(a), arc.radius * math.sin(a))
            for a in (arc.start, arc.end)
        ]
        assert [x for x, _ in ends] == pytest.approx([side * front] * 2)
        assert sorted(y for _, y in ends) == pytest.approx(
            [-field.area_arc_width / 2, field.area_arc_width / 2]
        )
        middle = arc.center[0] + arc.radius * math.cos((arc.start + arc.end) / 2)
        assert middle == pytest.approx(side * (front - field.area_arc_depth))


def test_every_part_that_only_some_leagues_have_is_tested() -> None:
    fields = list(map(Field, Field.PRESETS))
    for part in ("inner_area_depth", "area_arc_width", "penalty_mark_distance", "free_ball_x"):
        assert {bool(getattr(field, part)) for field in fields} == {True, False}
    for part in ("goal_line_margin", "touch_line_margin"):
        assert {bool(getattr(field, part)) for field in fields} == {True, False}

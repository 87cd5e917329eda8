from collections import Counter
from collections.abc import Iterable

import pytest

from rsoccer._core import Field
from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds, is_table, pitch_shapes, wall_thickness
from rsoccer.render.shapes import Arc, Circle, Line, Point, Polygon, Shape, Text

FIELDS = pytest.mark.parametrize(
    "field", [Field(name) for name in Field.PRESETS], ids=Field.PRESETS
)


def outline(shape: Shape) -> tuple[Point, ...]:
    match shape:
        case Polygon(points, _):
            return points
        case Line(start, end, _):
            return (start, end)
        case Circle(center, _) | Arc(center, _) | Text(center, _):
            return (center,)


def covered_points(shapes: Iterable[Shape], sign: int) -> Counter[frozenset[Point]]:
    """Points of the shapes, unchanged (1) or turned by 180 degrees (-1)."""
    return Counter(
        frozenset((round(sign * x, 5) + 0.0, round(sign * y, 5) + 0.0) for x, y in outline(shape))
        for shape in shapes
    )


def floor(field: Field) -> Polygon:
    """The surface of the field."""
    surfaces = (palette.TABLE, palette.CARPET)
    (found,) = (s for s in pitch_shapes(field) if isinstance(s, Polygon) and s.color in surfaces)
    return found


def test_tables_and_carpets_are_tested() -> None:
    kinds = {name: is_table(Field(name)) for name in Field.PRESETS}
    assert set(kinds.values()) == {True, False}
    assert kinds == {name: name.startswith("vss") for name in kinds}


@FIELDS
def test_a_field_is_symmetric_under_a_half_turn(field: Field) -> None:
    shapes = pitch_shapes(field)
    assert len(shapes) > 30
    assert covered_points(shapes, 1) == covered_points(shapes, -1)


@FIELDS
def test_everything_lies_within_the_picture(field: Field) -> None:
    bounds = arena_bounds(field)
    for shape in pitch_shapes(field):
        for x, y in outline(shape):
            assert bounds.left < x < bounds.right
            assert bounds.bottom < y < bounds.top


@FIELDS
def test_the_floor_reaches_the_walls(field: Field) -> None:
    ground = floor(field)
    assert ground.color == (palette.TABLE if is_table(field) else palette.CARPET)
    assert max(y for _, y in ground.points) == pytest.approx(field.max_y)
    pocket = field.goal_depth if is_table(field) else 0.0
    assert max(x for x, _ in ground.points) == pytest.approx(field.max_x - pocket)
    assert len(ground.points) == (8 if field.corner_leg else 4)
    margin = max(x for x, _ in ground.points) - field.half_length
    assert margin == pytest.approx(field.goal_line_margin)


@FIELDS
def test_walls_are_visible_with_or_without_a_height(field: Field) -> None:
    assert 0.02 < wall_thickness(field) < 0.1
    slabs = [s for s in pitch_shapes(field) if s.color == palette.WALL]
    assert len(slabs) == (2 if is_table(field) else 1)  # a table's goals have walls around them

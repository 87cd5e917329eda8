from collections import Counter
from collections.abc import Iterable

import pytest

from rsoccer._core import Field
from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds, draw_pitch, is_table, wall_thickness
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


def seen(shapes: Iterable[Shape], sign: int) -> Counter[frozenset[Point]]:
    """What the shapes cover, as they are (1) or turned half round (-1)."""
    return Counter(
        frozenset((round(sign * x, 5) + 0.0, round(sign * y, 5) + 0.0) for x, y in outline(shape))
        for shape in shapes
    )


def floor(field: Field) -> Polygon:
    """The surface that is played on."""
    surfaces = (palette.TABLE, palette.CARPET)
    (found,) = (s for s in draw_pitch(field) if isinstance(s, Polygon) and s.color in surfaces)
    return found


def test_tables_and_carpets_are_looked_at() -> None:
    kinds = {name: is_table(Field(name)) for name in Field.PRESETS}
    assert set(kinds.values()) == {True, False}
    assert kinds == {name: name.startswith("vss") for name in kinds}


@FIELDS
def test_a_field_turned_half_round_is_the_same_field(field: Field) -> None:
    shapes = draw_pitch(field)
    assert len(shapes) > 30
    assert seen(shapes, 1) == seen(shapes, -1)


@FIELDS
def test_everything_lies_within_the_picture(field: Field) -> None:
    bounds = arena_bounds(field)
    for shape in draw_pitch(field):
        for x, y in outline(shape):
            assert bounds.left < x < bounds.right
            assert bounds.bottom < y < bounds.top


@FIELDS
def test_the_floor_reaches_to_where_the_walls_stand(field: Field) -> None:
    ground = floor(field)
    assert ground.color == (palette.TABLE if is_table(field) else palette.CARPET)
    assert max(y for _, y in ground.points) == pytest.approx(field.reach_y)
    pocket = field.goal_depth if is_table(field) else 0.0
    assert max(x for x, _ in ground.points) == pytest.approx(field.reach_x - pocket)
    assert len(ground.points) == (8 if field.corner else 4)
    carpeted = max(x for x, _ in ground.points) - field.half_length
    assert carpeted == pytest.approx(field.goal_line_margin)


@FIELDS
def test_walls_are_seen_whether_or_not_they_have_a_height(field: Field) -> None:
    assert 0.02 < wall_thickness(field) < 0.1
    slabs = [s for s in draw_pitch(field) if s.color == palette.WALL]
    assert len(slabs) == (2 if is_table(field) else 1)  # a table's goals have walls around them

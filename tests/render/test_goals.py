import pytest

from rsoccer._core import Field
from rsoccer.render import palette
from rsoccer.render.goals import goal_shapes
from rsoccer.render.shapes import Line, Polygon

FIELDS = pytest.mark.parametrize(
    "field", [Field(name) for name in Field.PRESETS], ids=Field.PRESETS
)
EDGE = 0.008
ENDS = ((-1, palette.BLUE), (1, palette.YELLOW))


@FIELDS
def test_each_goal_has_the_color_of_the_team_that_defends_it(field: Field) -> None:
    for side, color in ENDS:
        colored = [s for s in goal_shapes(field, EDGE) if s.color == color]
        assert len(colored) == 3  # two sides and a back
        for part in colored:
            xs = [x for x, _ in part.points] if isinstance(part, Polygon) else []
            xs += [part.start[0], part.end[0]] if isinstance(part, Line) else []
            assert xs
            assert all(side * x >= field.half_length for x in xs)


@FIELDS
def test_a_pocket_is_as_wide_and_deep_as_its_goal(field: Field) -> None:
    pockets = [s for s in goal_shapes(field, EDGE) if isinstance(s, Polygon)]
    for side, color in ENDS:
        tint = palette.mix(palette.TABLE, color, 0.38)
        (pocket,) = (p for p in pockets if p.color == tint)
        mouth, back = field.half_length, field.half_length + field.goal_depth
        assert {side * x for x, _ in pocket.points} == {mouth, back}
        assert {y for _, y in pocket.points} == {-field.goal_width / 2, field.goal_width / 2}


@FIELDS
def test_walls_of_a_free_standing_goal_reach_the_wall_behind(field: Field) -> None:
    walls = [s for s in goal_shapes(field, EDGE) if s.color == palette.YELLOW]
    solid = [wall.points for wall in walls if isinstance(wall, Polygon)]
    assert len(solid) == (3 if field.goal_wall_thickness else 0)
    if not solid:
        return
    sides = [points for points in solid if max(x for x, _ in points) == field.max_x]
    assert len(sides) == 2
    inner = field.goal_width / 2
    outer = inner + field.goal_wall_thickness
    spans = sorted(sorted({y for _, y in points}) for points in sides)
    assert spans == [[-outer, -inner], [inner, outer]]
    (back,) = (points for points in solid if points not in sides)
    x = field.half_length + field.goal_depth
    assert {x for x, _ in back} == {x, x + field.goal_wall_thickness}

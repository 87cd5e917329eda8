import json
import math

import pytest

from rsoccer._core import RobotModel
from rsoccer.render import palette
from rsoccer.render.robot import label_shapes, robot_outlines, robot_shapes
from rsoccer.render.shapes import Color, Point, Polygon, Pose, Shape, Text

ORIGIN = Pose((0.0, 0.0), 1.0, 0.0)
SQUARE, ROUND = RobotModel("vss_440rpm"), RobotModel("ssl_generic")
WITHOUT_MOUTH = RobotModel.from_json(json.dumps({**json.loads(ROUND.to_json()), "mouth": None}))
WITH_MOUTH = RobotModel.from_json(
    json.dumps({**json.loads(SQUARE.to_json()), "mouth": json.loads(ROUND.to_json())["mouth"]})
)
MODELS = [*map(RobotModel, RobotModel.PRESETS), WITHOUT_MOUTH, WITH_MOUTH]


def name(model: RobotModel) -> str:
    return f"{model.name}-{'mouth' if model.has_mouth else 'plain'}"


def points(shapes: tuple[Shape, ...]) -> list[Point]:
    return [p for shape in shapes if isinstance(shape, Polygon) for p in shape.points]


def reach(model: RobotModel) -> tuple[float, float, float]:
    """Distances from the center to the back, the front and a side."""
    if hasattr(model, "side_length"):
        return model.side_length / 2, model.side_length / 2, model.side_length / 2
    return model.radius, model.front_distance, model.radius


def test_all_kinds_of_robots_are_tested() -> None:
    assert len(MODELS) > 10
    assert {(hasattr(m, "side_length"), m.has_mouth) for m in MODELS} == {
        (square, mouth) for square in (False, True) for mouth in (False, True)
    }


@pytest.mark.parametrize("model", MODELS, ids=name)
def test_a_robot_covers_its_body_and_no_more(model: RobotModel) -> None:
    drawn = points(robot_shapes(model, ORIGIN, palette.BLUE, 0))
    back, front, side = reach(model)
    assert max(x for x, _ in drawn) == pytest.approx(front)
    # A round outline is drawn by chords; their corners need not lie at its extremes.
    for actual, expected in (
        (-min(x for x, _ in drawn), back),
        (max(y for _, y in drawn), side),
        (-min(y for _, y in drawn), side),
    ):
        assert actual <= expected + 1e-9
        assert actual == pytest.approx(expected, abs=2e-4)
    assert max(math.hypot(*p) for p in drawn) <= model.bounding_radius + 1e-6


@pytest.mark.parametrize("model", MODELS, ids=name)
def test_the_mark_of_the_front_is_ahead(model: RobotModel) -> None:
    center, heading = (0.3, -0.2), (math.cos(2.0), math.sin(2.0))
    shapes = robot_shapes(model, Pose(center, *heading), palette.BLUE, 4)
    marks = [s for s in shapes if s.color in (palette.WHITE, palette.DRIBBLER)]
    fronts = points(tuple(marks))
    assert fronts
    _, front, side = reach(model)
    for x, y in fronts:
        ahead = (x - center[0]) * heading[0] + (y - center[1]) * heading[1]
        assert 0.35 * side < ahead < front + 1e-9


@pytest.mark.parametrize("model", MODELS, ids=name)
def test_a_dribbler_has_the_mouths_width_and_lights_up_with_the_ball(model: RobotModel) -> None:
    unlit = robot_shapes(model, ORIGIN, palette.BLUE, 0)
    lit = robot_shapes(model, ORIGIN, palette.BLUE, 0, has_ball=True)
    bars = [s.points for s in unlit if isinstance(s, Polygon) and s.color == palette.DRIBBLER]
    glowing = [s.points for s in lit if s.color == palette.DRIBBLER_LIT and isinstance(s, Polygon)]
    assert not any(s.color == palette.DRIBBLER_LIT for s in unlit)
    if not model.has_mouth:
        assert bars == glowing == []
        assert lit == unlit
        return
    assert set(glowing) == set(bars) != set()
    assert len(glowing) > len(bars)  # with a glow around it
    _, front, side = reach(model)
    flat = side if hasattr(model, "side_length") else math.sqrt(side**2 - front**2)
    assert max(y for _, y in bars[0]) == pytest.approx(min(model.mouth_width / 2, flat))


@pytest.mark.parametrize("model", MODELS, ids=name)
def test_only_wheels_beside_the_cover_are_visible(model: RobotModel) -> None:
    shapes = robot_shapes(model, ORIGIN, palette.YELLOW, 0)
    wheels = [shape for shape in shapes if shape.color == palette.TIRE]
    assert len(wheels) == (2 if model.drive == "differential" else 0)


@pytest.mark.parametrize("model", MODELS, ids=name)
@pytest.mark.parametrize(
    ("color", "ink"), [(palette.BLUE, palette.WHITE), (palette.YELLOW, palette.INK)]
)
def test_the_number_stands_out_and_fits_on_the_cover(
    model: RobotModel, color: Color, ink: Color
) -> None:
    texts = [s for s in robot_shapes(model, ORIGIN, color, 10) if isinstance(s, Text)]
    assert [(text.text, text.color) for text in texts] == [("10", ink)]
    size = robot_outlines(model).size
    assert 0.3 * size < texts[0].height < texts[0].max_width < 0.7 * size


def test_a_round_robot_contrasts_with_the_carpet() -> None:
    def luminance(color: Color) -> float:
        return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]

    for color in (palette.BLUE, palette.YELLOW):
        _, hull, *_ = robot_shapes(ROUND, ORIGIN, color, 0)
        assert luminance(hull.color) < 0.65 * luminance(palette.CARPET)


def test_a_round_robot_without_a_flat_front_shows_its_heading() -> None:
    blunt = RobotModel("ssl_generic", front_distance=ROUND.radius)
    shapes = robot_shapes(blunt, ORIGIN, palette.BLUE, 0)
    arrows = [s for s in shapes if isinstance(s, Polygon) and s.color == palette.WHITE]
    assert [arrow.points[0] > (0.0, 0.0) for arrow in arrows] == [True]


@pytest.mark.parametrize("model", MODELS, ids=name)
def test_without_a_number_an_arrow_shows_the_heading(model: RobotModel) -> None:
    shapes = robot_shapes(model, ORIGIN, palette.BLUE, 0, has_number=False)
    assert not any(isinstance(s, Text) for s in shapes)
    arrow = shapes[-1]
    assert isinstance(arrow, Polygon)
    assert arrow.color == palette.WHITE
    assert arrow.points[0] == max(arrow.points)
    assert max(math.hypot(*p) for p in arrow.points) < 0.8 * robot_outlines(model).size / 2


@pytest.mark.parametrize("number", [0, 10])
def test_a_label_is_behind_its_robot_and_holds_its_number(number: int) -> None:
    for angle in (0.0, 0.7, 2.0, 4.0):
        pose = Pose((0.3, -0.2), math.cos(angle), math.sin(angle))
        plate, text = label_shapes(ROUND, pose, palette.BLUE, number, 0.12)
        assert isinstance(plate, Polygon)
        assert isinstance(text, Text)
        assert text.text == str(number)
        x, y = text.center[0] - 0.3, text.center[1] + 0.2
        assert x * pose.cos + y * pose.sin < -ROUND.radius
        assert x * pose.sin - y * pose.cos == pytest.approx(0.0)
        assert min(math.dist(p, pose.center) for p in plate.points) > ROUND.radius

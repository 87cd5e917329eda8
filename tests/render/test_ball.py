import math

import pytest

from rsoccer import SimConfig
from rsoccer._core import BallModel, Field
from rsoccer.render import palette
from rsoccer.render.ball import (
    MAX_GROWTH,
    MIN_RADIUS,
    TRAIL_LENGTH,
    TRAIL_SPEED,
    ball_shapes,
    drawn_radius,
    ring_shapes,
    shadow_shapes,
    trail_shapes,
)
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Arc, Circle, Line, Point, Polygon

RADIUS = SimConfig().ball.radius
CENTER = (0.1, 0.2)


def radius_at(height: float) -> float:
    (ball,) = (s for s in ball_shapes(RADIUS, CENTER, height) if s.color == palette.ORANGE)
    assert isinstance(ball, Circle)
    assert ball.center == CENTER
    return ball.radius


def shadow(height: float) -> Circle:
    (disc,) = (s for s in shadow_shapes(RADIUS, CENTER, height) if isinstance(s, Circle))
    return disc


@pytest.mark.parametrize("name", BallModel.PRESETS)
def test_a_ball_has_its_true_size_unless_the_picture_is_large(name: str) -> None:
    model = BallModel(name)
    small, large = 0.5 * model.radius / MIN_RADIUS, 2.0 * model.radius / MIN_RADIUS
    assert drawn_radius(model, small) == model.radius
    assert drawn_radius(model, large) == pytest.approx(2.0 * model.radius)


def test_a_ball_on_the_floor_has_an_outline_and_one_shadow() -> None:
    outline, ball, _ = ball_shapes(RADIUS, CENTER)
    assert ball == Circle(CENTER, RADIUS, palette.ORANGE)
    assert isinstance(outline, Circle)
    assert outline.center == CENTER
    assert outline.radius > RADIUS
    assert len(shadow_shapes(RADIUS, CENTER)) == 1


def test_a_ball_grows_with_its_height_up_to_a_bound() -> None:
    radii = [radius_at(height) for height in (0.0, 0.05, 0.4, 1.0, 50.0)]
    assert radii[0] < radii[1] < radii[2] < radii[3] <= radii[4]
    assert radii[4] == MAX_GROWTH * RADIUS


def test_the_shadow_moves_away_from_a_rising_ball() -> None:
    assert shadow(0.0).center == CENTER
    offsets = [math.dist(shadow(height).center, CENTER) for height in (0.0, 0.05, 0.4, 1.0)]
    assert offsets == sorted(set(offsets))
    blurs = [shadow(height).blur for height in (0.0, 0.05, 0.4, 1.0)]
    assert blurs == sorted(set(blurs))
    assert offsets[2] > radius_at(0.4) + shadow(0.4).radius  # visibly apart


def test_a_line_joins_a_ball_in_flight_and_its_shadow() -> None:
    stems = [s for s in shadow_shapes(RADIUS, CENTER, 0.4) if isinstance(s, Line)]
    assert [(stem.start, stem.end) for stem in stems] == [(shadow(0.4).center, CENTER)]


@pytest.mark.parametrize("name", Field.PRESETS)
def test_a_small_ball_on_a_large_field_has_a_ring(name: str) -> None:
    config = SimConfig(name, 1, 1)
    width = scene_bounds(config.field).width
    shapes = ring_shapes(config.ball, CENTER, width)
    assert bool(shapes) == name.startswith("ssl")
    for shape in shapes:
        assert isinstance(shape, Arc | Circle)
        assert shape.center == CENTER
        assert 1.5 * drawn_radius(config.ball, width) < shape.radius
        assert shape.radius < 2.0 * config.robot.bounding_radius


def extent(trail: tuple[object, ...]) -> tuple[float, float]:
    points: list[Point] = [p for wedge in trail if isinstance(wedge, Polygon) for p in wedge.points]
    return min(y for _, y in points), max(y for _, y in points)


def test_a_trail_lies_behind_a_fast_ball_and_is_bounded() -> None:
    lengths = []
    for speed in (0.5, 1.0, 100.0):
        rear, front = extent(trail_shapes(RADIUS, (0.0, 0.0), (0.0, speed)))
        assert front == pytest.approx(0.0)
        lengths.append(-rear)
    assert lengths[0] < lengths[1] < lengths[2]
    assert lengths[2] == pytest.approx(TRAIL_LENGTH * RADIUS)


def test_a_slow_ball_has_no_trail() -> None:
    assert trail_shapes(RADIUS, (0.0, 0.0), (0.99 * TRAIL_SPEED, 0.0)) == ()
    assert trail_shapes(RADIUS, (0.0, 0.0), (0.0, 0.0)) == ()

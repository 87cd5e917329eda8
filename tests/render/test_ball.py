import math

import pytest

from rsoccer import SimConfig
from rsoccer._core import BallModel, Field
from rsoccer.render import palette
from rsoccer.render.ball import (
    LARGEST,
    TRAIL_LENGTH,
    TRAIL_SPEED,
    draw_ball,
    draw_halo,
    draw_shadow,
    draw_trail,
)
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Circle, Line, Point, Polygon

BALL = SimConfig().ball
HERE = (0.1, 0.2)


def drawn_radius(height: float) -> float:
    (ball,) = (s for s in draw_ball(BALL, HERE, height) if s.color == palette.ORANGE)
    assert isinstance(ball, Circle)
    assert ball.center == HERE
    return ball.radius


def shadow(height: float) -> Circle:
    (disc,) = (s for s in draw_shadow(BALL, HERE, height) if isinstance(s, Circle))
    return disc


@pytest.mark.parametrize("name", BallModel.PRESETS)
def test_a_ball_on_the_floor_has_its_true_size(name: str) -> None:
    model = BallModel(name)
    balls = [s for s in draw_ball(model, HERE) if s.color == palette.ORANGE]
    assert balls == [Circle(HERE, model.radius, palette.ORANGE)]
    assert len(draw_shadow(model, HERE)) == 1


def test_a_ball_grows_as_it_rises_up_to_a_bound() -> None:
    radii = [drawn_radius(height) for height in (0.0, 0.05, 0.4, 1.0, 50.0)]
    assert radii[0] < radii[1] < radii[2] < radii[3] <= radii[4]
    assert radii[4] == LARGEST * BALL.radius


def test_the_shadow_of_a_ball_parts_from_it_as_it_rises() -> None:
    assert shadow(0.0).center == HERE
    ways = [math.dist(shadow(height).center, HERE) for height in (0.0, 0.05, 0.4, 1.0)]
    assert ways == sorted(set(ways))
    blurs = [shadow(height).blur for height in (0.0, 0.05, 0.4, 1.0)]
    assert blurs == sorted(set(blurs))
    assert ways[2] > drawn_radius(0.4) + shadow(0.4).radius  # seen apart


def test_a_stem_ties_a_ball_in_flight_to_its_shadow() -> None:
    stems = [s for s in draw_shadow(BALL, HERE, 0.4) if isinstance(s, Line)]
    assert [(stem.start, stem.end) for stem in stems] == [(shadow(0.4).center, HERE)]


@pytest.mark.parametrize("name", Field.PRESETS)
def test_a_ball_that_would_be_lost_on_a_large_field_has_a_glow(name: str) -> None:
    config = SimConfig(name, 1, 1)
    glow = draw_halo(config.ball, HERE, scene_bounds(config.field).width)
    assert bool(glow) == name.startswith("ssl")
    for disc in glow:
        assert isinstance(disc, Circle)
        assert disc.center == HERE
        assert config.ball.radius < disc.radius <= config.robot.bounding_radius


def extent(trail: tuple[object, ...]) -> tuple[float, float]:
    points: list[Point] = [p for wedge in trail if isinstance(wedge, Polygon) for p in wedge.points]
    return min(y for _, y in points), max(y for _, y in points)


def test_a_trail_lies_behind_a_fast_ball_and_is_bounded() -> None:
    lengths = []
    for speed in (0.5, 1.0, 100.0):
        rear, front = extent(draw_trail(BALL, (0.0, 0.0), (0.0, speed)))
        assert front == pytest.approx(0.0)
        lengths.append(-rear)
    assert lengths[0] < lengths[1] < lengths[2]
    assert lengths[2] == pytest.approx(TRAIL_LENGTH * BALL.radius)


def test_a_slow_ball_has_no_trail() -> None:
    assert draw_trail(BALL, (0.0, 0.0), (0.99 * TRAIL_SPEED, 0.0)) == ()
    assert draw_trail(BALL, (0.0, 0.0), (0.0, 0.0)) == ()

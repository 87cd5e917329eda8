import math
from itertools import pairwise

import numpy as np
import pytest

from rsoccer import Matches, SimConfig
from rsoccer.arrays import Floats
from rsoccer.render import palette
from rsoccer.render.ball import drawn_radius
from rsoccer.render.ghosts import SensedWorld, ghost_shapes, sensed_overlay
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Arc, Line, Polygon
from tests.helpers import zeros


def world(config: SimConfig, **changes: Floats) -> SensedWorld:
    """Robots at x = 0, 0.2, 0.4, ..., that face along x, the ball at (0.1, -0.2)."""
    n = config.n_robots
    robots = np.stack([0.2 * np.arange(n), np.zeros(n)], axis=1).astype(np.float32)
    headings = np.tile(np.array([1.0, 0.0], np.float32), (n, 1))
    ball = np.array([0.1, -0.2], np.float32)
    known = SensedWorld(ball, robots, headings, np.ones(n, np.bool_))
    return known._replace(**changes)  # type: ignore[arg-type]


def centers(config: SimConfig, known: SensedWorld) -> list[tuple[float, float]]:
    """Starts of the lines to the fronts of the robots."""
    return [s.start for s in ghost_shapes(config, known) if isinstance(s, Line)]


def test_each_robot_has_a_ghost_in_the_color_of_its_team(any_config: SimConfig) -> None:
    shapes = ghost_shapes(any_config, world(any_config))
    lines = [shape for shape in shapes if isinstance(shape, Line)]
    assert [line.start for line in lines] == [
        pytest.approx((0.2 * i, 0.0)) for i in range(any_config.n_robots)
    ]
    colors = [line.color for line in lines]
    assert len({*colors[: any_config.n_blue]}) == len({*colors[any_config.n_blue :]}) == 1
    blue, yellow = colors[0], colors[-1]
    assert blue[2] > blue[0], "blue"
    assert yellow[2] < yellow[0], "yellow"


def test_ghosts_let_the_floor_through(any_config: SimConfig) -> None:
    opacities = [shape.color[3] for shape in ghost_shapes(any_config, world(any_config))]
    assert 0 < min(opacities) < 60
    assert max(opacities) < 220


def test_a_ghost_is_as_large_as_its_robot_and_hollow(any_config: SimConfig) -> None:
    surface, outline = ghost_shapes(any_config, world(any_config))[:2]
    assert isinstance(surface, Polygon)
    assert isinstance(outline, Polygon)
    hull = robot_outlines(any_config.robots[0]).hull
    np.testing.assert_allclose(surface.points, hull, atol=1e-6)
    assert abs(area(outline)) < 0.5 * abs(area(surface))


def area(polygon: Polygon) -> float:
    """Area of a polygon by its corners; parts that are run around backward count as holes."""
    closed = [*polygon.points, polygon.points[0]]
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(closed)) / 2


def test_a_line_leads_to_the_front(config: SimConfig) -> None:
    up = np.tile(np.array([0.0, 1.0], np.float32), (config.n_robots, 1))
    for shape in ghost_shapes(config, world(config, headings=up)):
        if isinstance(shape, Line):
            (x, y), (front_x, front_y) = shape.start, shape.end
            assert front_x == pytest.approx(x)
            assert 0.02 < front_y - y < config.robot.side_length / 2


def test_the_ball_has_a_ring_of_its_drawn_size(any_config: SimConfig) -> None:
    (ring,) = (s for s in ghost_shapes(any_config, world(any_config)) if isinstance(s, Arc))
    assert ring.center == pytest.approx((0.1, -0.2))
    assert ring.end - ring.start == pytest.approx(math.tau)
    assert ring.radius == drawn_radius(any_config.ball, scene_bounds(any_config.field).width)
    assert ring.color[0] > palette.ORANGE[2]


def test_robots_that_are_not_on_the_field_have_no_ghost(config: SimConfig) -> None:
    present = np.arange(config.n_robots) != 2
    found = centers(config, world(config)._replace(present=present))
    assert [x for x, _ in found] == pytest.approx([0.0, 0.2, 0.6, 0.8, 1.0])


def test_matches_with_senses_have_ghosts_where_the_robots_believe_the_bodies() -> None:
    matches = Matches("VSSSelfPlay-v0", 2, sensing="vsss", controllers={"all": "chase"})
    matches.reset()
    for _ in range(30):
        matches.step(zeros(matches))
    config, play = matches.task.config, matches.play
    for index in range(2):
        shapes = sensed_overlay(config, play, index)
        found = [shape.start for shape in shapes if isinstance(shape, Line)]
        np.testing.assert_allclose(found, play.sensed.robots.position[index], atol=1e-6)
        assert np.abs(found - play.frame.robots.position[index]).max() > 0.005
    play.frame.robots.absent[1, 4] = 1.0
    lines = [shape for shape in sensed_overlay(config, play, 1) if isinstance(shape, Line)]
    assert len(lines) == config.n_robots - 1


def test_matches_without_senses_have_none() -> None:
    matches = Matches("VSSSelfPlay-v0")
    matches.reset()
    assert sensed_overlay(matches.task.config, matches.play) == ()

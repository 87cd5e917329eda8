"""Ghosts: ball and robots where the robots believe them, as thin outlines under the true ones.

A renderer takes them as `extras`. A match without senses has none.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from rsoccer.render import palette
from rsoccer.render.ball import drawn_radius
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Arc, Color, Line, Polygon, Pose, Shape

if TYPE_CHECKING:
    from rsoccer._core import RobotModel, SimConfig
    from rsoccer.arrays import Floats, Mask
    from rsoccer.play import Play

OPACITY = 0.72
"""Opacity of outlines."""
FILL = 0.16
"""Opacity of the surface of a robot."""
LIGHTNESS = 0.4
"""Share of white in the color of a ghost, which parts it from the floor and from its team."""
WIDTH = 0.0016
"""Width of outlines, as a fraction of the picture's width: 2 of 1280 pixels."""


class SensedWorld(NamedTuple):
    """Poses of ball and robots in one world as the robots know them."""

    ball: Floats
    """(2,) position of the ball, m"""
    robots: Floats
    """(robots, 2) positions, m"""
    headings: Floats
    """(robots, 2) cosines and sines of headings"""
    present: Mask
    """(robots,) whether a robot is on the field"""


def sensed_overlay(config: SimConfig, play: Play, world: int = 0) -> tuple[Shape, ...]:
    """Return the ghosts of one world.

    Args:
        config: the configuration.
        play: state of the matches.
        world: index of the world.

    Returns:
        Shapes for the `extras` of a renderer; none if robots know the true state.
    """
    if play.senses is None:
        return ()
    sensed, robots = play.sensed, play.sensed.robots
    present = play.frame.robots.absent[world] == 0
    return ghost_shapes(
        config,
        SensedWorld(
            sensed.ball.position[world], robots.position[world], robots.heading[world], present
        ),
    )


def ghost_shapes(config: SimConfig, sensed: SensedWorld) -> tuple[Shape, ...]:
    """Return the ghosts of known poses.

    Args:
        config: the configuration.
        sensed: the poses.

    Returns:
        Shapes in the order of drawing: robots, then the ball.
    """
    picture_width = scene_bounds(config.field).width
    width = WIDTH * picture_width
    x, y = sensed.ball.tolist()
    radius = drawn_radius(config.ball, picture_width)
    return (
        *(
            shape
            for index, model in enumerate(config.robots)
            if sensed.present[index]
            for shape in _robot(
                model,
                Pose(_pair(sensed.robots[index]), *_pair(sensed.headings[index])),
                palette.BLUE if index < config.n_blue else palette.YELLOW,
                width,
            )
        ),
        Arc((x, y), radius, 0.0, math.tau, width, _color(palette.ORANGE)),
    )


def _robot(model: RobotModel, pose: Pose, team: Color, width: float) -> tuple[Shape, ...]:
    """Surface and outline of a robot, and a line to its front."""
    outlines, color = robot_outlines(model), _color(team)
    hull = outlines.hull
    share = 1.0 - 2.0 * width / outlines.size
    inner = tuple((share * x, share * y) for x, y in hull)
    front = max(x for x, _ in inner)
    start, end = pose.to_world(((0.0, 0.0), (front - width / 2, 0.0)))
    # Along the outer edge and back along the inner one: lines would show where they meet.
    outline = (*hull, hull[0], inner[0], *inner[::-1])
    return (
        Polygon(pose.to_world(hull), palette.fade(color, FILL / OPACITY)),
        Polygon(pose.to_world(outline), color),
        Line(start, end, width, color),
    )


def _color(color: Color) -> Color:
    """Color of the ghost of a body."""
    return palette.fade(palette.mix(color, palette.WHITE, LIGHTNESS), OPACITY)


def _pair(values: Floats) -> tuple[float, float]:
    """Two Python floats: shapes hold no NumPy numbers."""
    x, y = values.tolist()
    return x, y

"""The field as seen from above: what stays the same in every picture of one configuration."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import (
    Arc,
    Bounds,
    Circle,
    Color,
    Line,
    Point,
    Polygon,
    Shape,
    rectangle,
    rounded_rectangle,
    stroke,
)

if TYPE_CHECKING:
    from rsoccer._core import Field

WALL_SHARE = 0.5
"""Thickness of a wall by its height: the VSS rules ask for 0.025 m by 0.05 m."""
MARGIN = 0.02
"""Empty border around the walls, by the length of the field."""
MARK_RADIUS = 2.2
"""Radius of a penalty or free-ball mark, by the width of a line."""


def wall_thickness(field: Field) -> float:
    """Thickness of the walls as drawn, metres."""
    return WALL_SHARE * field.wall_height


def arena_bounds(field: Field) -> Bounds:
    """The field with its goals, walls and a margin around them."""
    border = wall_thickness(field) + MARGIN * field.length
    x = field.half_length + field.goal_depth + border
    y = field.half_width + border
    return Bounds(-x, -y, x, y)


def draw_pitch(field: Field) -> tuple[Shape, ...]:
    """Walls, carpet, goals and lines, from the lowest to the topmost."""
    return (
        *_walls(field),
        *_goal(field, -1, palette.BLUE),
        *_goal(field, 1, palette.YELLOW),
        *_center(field),
        *_goal_area(field, -1),
        *_goal_area(field, 1),
        *_marks(field),
    )


def _walls(field: Field) -> tuple[Shape, ...]:
    """A slab under everything, then the carpet, whose cut corners are the corner blocks."""
    wall = wall_thickness(field)
    x, y = field.half_length + wall, field.half_width + wall
    goal_x, goal_y = x + field.goal_depth, field.goal_width / 2 + wall
    carpet = _carpet(field)
    edge = wall / 6
    return (
        Polygon(rounded_rectangle(-x, -y, x, y, wall), palette.SHADOW, blur=wall),
        Polygon(rounded_rectangle(-x, -y, x, y, wall), palette.WALL),
        Polygon(rounded_rectangle(-goal_x, -goal_y, goal_x, goal_y, wall), palette.WALL),
        Polygon(carpet, palette.CARPET),
        *stroke((*carpet, carpet[0]), edge, palette.WALL_EDGE),
    )


def _carpet(field: Field) -> tuple[Point, ...]:
    """The floor between the walls: a rectangle less the corner blocks."""
    x, y, leg = field.half_length, field.half_width, field.corner
    return (
        (x, -y + leg),
        (x, y - leg),
        (x - leg, y),
        (-x + leg, y),
        (-x, y - leg),
        (-x, -y + leg),
        (-x + leg, -y),
        (x - leg, -y),
    )


def _goal(field: Field, side: int, color: Color) -> tuple[Shape, ...]:
    """The pocket at the end `side` (-1 or 1), tinted for the team that defends it."""
    mouth, back = side * field.half_length, side * (field.half_length + field.goal_depth)
    y = field.goal_width / 2
    edge = wall_thickness(field) / 3
    pocket = ((mouth, y), (back, y), (back, -y), (mouth, -y))
    return (
        Polygon(pocket, palette.mix(palette.CARPET, color, 0.38)),
        *_net(field, side, palette.fade(color, 0.45)),
        *stroke(pocket, edge, color),
        Line((mouth, -y), (mouth, y), field.line_width, palette.LINES),
    )


def _net(field: Field, side: int, color: Color) -> tuple[Line, ...]:
    """Threads of the net: a square grid with four meshes along the depth."""
    mesh = field.goal_depth / 4
    rows = math.floor(field.goal_width / 2 / mesh)
    front, back = (side * (field.half_length + d) for d in (0.0, field.goal_depth))
    y = field.goal_width / 2
    along = [
        Line((front, i * mesh), (back, i * mesh), mesh / 16, color) for i in range(-rows, rows + 1)
    ]
    across = [
        Line((x, -y), (x, y), mesh / 16, color)
        for x in (front + side * i * mesh for i in range(1, 4))
    ]
    return (*along, *across)


def _center(field: Field) -> tuple[Shape, ...]:
    """Centre line, circle and spot."""
    y, width = field.half_width, field.line_width
    return (
        Line((0.0, -y), (0.0, y), width, palette.LINES),
        Arc((0.0, 0.0), field.center_radius, 0.0, math.tau, width, palette.LINES),
        Circle((0.0, 0.0), MARK_RADIUS * width, palette.LINES),
    )


def _goal_area(field: Field, side: int) -> tuple[Shape, ...]:
    """The three lines before the goal at the end `side`."""
    back = side * field.half_length
    front = back - side * field.goal_area_depth
    y = field.goal_area_width / 2
    corners = ((back, y), (front, y), (front, -y), (back, -y))
    return stroke(corners, field.line_width, palette.LINES)


def _marks(field: Field) -> tuple[Shape, ...]:
    """Penalty marks and the four free-ball marks."""
    x, y = field.free_ball_x, field.free_ball_y
    penalty = ((-field.penalty_mark, 0.0), (field.penalty_mark, 0.0))
    centers = (*penalty, *rectangle(-x, -y, x, y))
    return tuple(Circle(c, MARK_RADIUS * field.line_width, palette.LINES) for c in centers)

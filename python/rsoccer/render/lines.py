"""Field markings: lines, center circle, goal areas and marks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import Arc, Circle, Line, Point, Shape, rectangle, stroke

if TYPE_CHECKING:
    from rsoccer._core import Field

MARK_RADIUS = 2.2
"""Radius of a penalty or free-ball mark, in widths of a line."""


def line_shapes(field: Field) -> tuple[Shape, ...]:
    """Return all markings of a field; markings that a league does not have are left out.

    Args:
        field: the field.

    Returns:
        Boundary lines, center line and circle, goal areas, penalty and free-ball marks.
    """
    return (
        *_boundary(field),
        *_center(field),
        *_areas(field, -1),
        *_areas(field, 1),
        *_marks(field),
    )


def _boundary(field: Field) -> tuple[Shape, ...]:
    """Goal and touch lines; under a wall there is none, except across a goal's mouth."""
    x, y = field.half_length, field.half_width
    half_span = y if field.goal_line_margin > 0 else field.goal_width / 2
    goal_lines = [((end, -half_span), (end, half_span)) for end in (-x, x)]
    touch_lines = [((-x, side), (x, side)) for side in (-y, y) if field.touch_line_margin > 0]
    return tuple(line for ends in (*goal_lines, *touch_lines) for line in _lines(field, ends))


def _center(field: Field) -> tuple[Shape, ...]:
    """Center line, circle and mark."""
    y, width = field.half_width, field.line_width
    return (
        *_lines(field, ((0.0, -y), (0.0, y))),
        Arc((0.0, 0.0), field.center_circle_radius, 0.0, math.tau, width, palette.LINES),
        Circle((0.0, 0.0), MARK_RADIUS * width, palette.LINES),
    )


def _areas(field: Field, side: int) -> tuple[Shape, ...]:
    """Goal area, inner area and arc at the end `side` (-1 or 1)."""
    return (
        *_area(field, side, field.goal_area_depth, field.goal_area_width),
        *_area(field, side, field.inner_area_depth, field.inner_area_width),
        *_area_arc(field, side),
    )


def _area(field: Field, side: int, depth: float, width: float) -> tuple[Shape, ...]:
    """The three lines of an area; nothing if it has no size."""
    if not depth * width:
        return ()
    back = side * field.half_length
    front = back - side * depth
    y = width / 2
    return _lines(field, ((back, y), (front, y), (front, -y), (back, -y)))


def _area_arc(field: Field, side: int) -> tuple[Shape, ...]:
    """The arc on the front of the goal area, from its chord and its height above the chord."""
    half_chord, depth = field.area_arc_width / 2, field.area_arc_depth
    if not half_chord * depth:
        return ()
    radius = (half_chord**2 + depth**2) / (2 * depth)
    half_angle = math.atan2(half_chord, radius - depth)
    x = field.half_length - field.goal_area_depth - depth + radius
    middle = math.pi if side > 0 else 0.0
    start, end = middle - half_angle, middle + half_angle
    return (Arc((side * x, 0.0), radius, start, end, field.line_width, palette.LINES),)


def _marks(field: Field) -> tuple[Shape, ...]:
    """Penalty marks and the four free-ball marks."""
    x, y = field.free_ball_x, field.free_ball_y
    penalty_x = field.half_length - field.penalty_mark_distance
    penalty = ((-penalty_x, 0.0), (penalty_x, 0.0)) if field.penalty_mark_distance else ()
    centers = (*penalty, *(rectangle(-x, -y, x, y) if x * y else ()))
    return tuple(Circle(c, MARK_RADIUS * field.line_width, palette.LINES) for c in centers)


def _lines(field: Field, points: tuple[Point, ...]) -> tuple[Line, ...]:
    """A field line from each point to the next."""
    return stroke(points, field.line_width, palette.LINES)

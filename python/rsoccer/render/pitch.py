"""The field seen from above: walls, floor, goals and markings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.goals import goal_shapes
from rsoccer.render.lines import line_shapes
from rsoccer.render.shapes import Bounds, Point, Polygon, Shape, rounded_rectangle, stroke

if TYPE_CHECKING:
    from rsoccer._core import Field

WALL_SHARE = 0.5
"""Thickness of a wall, as a fraction of its height: the VSS rules ask for 0.025 m by 0.05 m."""
BOARD_THICKNESS = 0.06
"""Thickness of walls without a height, such as the boards around a carpet, meters."""
MARGIN = 0.02
"""Empty border around the walls, as a fraction of the field's length."""


def wall_thickness(field: Field) -> float:
    """Return the thickness of the walls in pictures.

    Args:
        field: the field.

    Returns:
        Meters, from the height of the walls, or `BOARD_THICKNESS` without one.
    """
    return WALL_SHARE * field.wall_height or BOARD_THICKNESS


def arena_bounds(field: Field) -> Bounds:
    """Return the bounds of the field with its goals and walls.

    Args:
        field: the field.

    Returns:
        The rectangle, with a margin around the walls, meters.
    """
    border = wall_thickness(field) + MARGIN * field.length
    x, y = field.max_x + border, field.max_y + border
    return Bounds(-x, -y, x, y)


def pitch_shapes(field: Field) -> tuple[Shape, ...]:
    """Return the field: walls, floor, goals and markings.

    Args:
        field: the field.

    Returns:
        Shapes in the order of drawing, the lowest first.
    """
    return (
        *_walls(field),
        *goal_shapes(field, wall_thickness(field) / 3),
        *line_shapes(field),
    )


def _walls(field: Field) -> tuple[Shape, ...]:
    """A slab under the whole field, then the floor; its cut corners show the corner blocks."""
    wall = wall_thickness(field)
    x, y = _wall_distances(field)
    slab = rounded_rectangle(-x - wall, -y - wall, x + wall, y + wall, wall)
    floor = _floor(field)
    return (
        Polygon(slab, palette.SHADOW, blur=wall),
        Polygon(slab, palette.WALL),
        *_pockets(field),
        Polygon(floor, palette.TABLE if is_table(field) else palette.CARPET),
        *stroke((*floor, floor[0]), wall / 6, palette.WALL_EDGE),
    )


def is_table(field: Field) -> bool:
    """Return whether the field is a table, whose goals are gaps in its walls.

    Args:
        field: the field.

    Returns:
        True for a table, whose walls stand on the lines; False for a carpet.
    """
    return field.goal_wall_thickness == 0


def _pockets(field: Field) -> tuple[Shape, ...]:
    """Walls around the goals of a table."""
    if not is_table(field):
        return ()
    wall = wall_thickness(field)
    x, y = field.half_length + field.goal_depth + wall, field.goal_width / 2 + wall
    return (Polygon(rounded_rectangle(-x, -y, x, y, wall), palette.WALL),)


def _wall_distances(field: Field) -> Point:
    """Distance of the walls from the center along x and y, regardless of the goals."""
    return field.half_length + field.goal_line_margin, field.half_width + field.touch_line_margin


def _floor(field: Field) -> tuple[Point, ...]:
    """Outline of the floor between the walls: a rectangle less the corner blocks."""
    x, y = _wall_distances(field)
    leg = field.corner_leg
    corners = (
        *((x, -y + leg), (x, y - leg), (x - leg, y), (-x + leg, y)),
        *((-x, y - leg), (-x, -y + leg), (-x + leg, -y), (x - leg, -y)),
    )
    return tuple(dict.fromkeys(corners))  # without blocks each corner is listed twice

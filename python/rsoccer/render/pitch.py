"""The field as seen from above: what stays the same in every picture of one configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.goals import draw_goals
from rsoccer.render.lines import draw_lines
from rsoccer.render.shapes import Bounds, Point, Polygon, Shape, rounded_rectangle, stroke

if TYPE_CHECKING:
    from rsoccer._core import Field

WALL_SHARE = 0.5
"""Thickness of a wall by its height: the VSS rules ask for 0.025 m by 0.05 m."""
BOARD_THICKNESS = 0.06
"""Thickness of walls that have no height, such as the boards around a carpet, metres."""
MARGIN = 0.02
"""Empty border around the walls, by the length of the field."""


def wall_thickness(field: Field) -> float:
    """Thickness of the walls as drawn, metres."""
    return WALL_SHARE * field.wall_height or BOARD_THICKNESS


def arena_bounds(field: Field) -> Bounds:
    """The field with its goals, walls and a margin around them."""
    border = wall_thickness(field) + MARGIN * field.length
    x, y = field.reach_x + border, field.reach_y + border
    return Bounds(-x, -y, x, y)


def draw_pitch(field: Field) -> tuple[Shape, ...]:
    """Walls, floor, goals and lines, from the lowest to the topmost."""
    return (
        *_walls(field),
        *draw_goals(field, wall_thickness(field) / 3),
        *draw_lines(field),
    )


def _walls(field: Field) -> tuple[Shape, ...]:
    """A slab under everything, then the floor, whose cut corners are the corner blocks."""
    wall = wall_thickness(field)
    x, y = _inner(field)
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
    """Whether the walls stand on the lines and the goals are gaps in them; else it is a carpet."""
    return field.goal_wall == 0


def _pockets(field: Field) -> tuple[Shape, ...]:
    """The walls around goals that are gaps in a table's wall."""
    if not is_table(field):
        return ()
    wall = wall_thickness(field)
    x, y = field.half_length + field.goal_depth + wall, field.goal_width / 2 + wall
    return (Polygon(rounded_rectangle(-x, -y, x, y, wall), palette.WALL),)


def _inner(field: Field) -> Point:
    """How far from the centre the walls stand, along x and y; goals are behind, or before them."""
    return field.half_length + field.goal_line_margin, field.half_width + field.touch_line_margin


def _floor(field: Field) -> tuple[Point, ...]:
    """The floor between the walls: a rectangle less the corner blocks."""
    x, y = _inner(field)
    leg = field.corner
    corners = (
        *((x, -y + leg), (x, y - leg), (x - leg, y), (-x + leg, y)),
        *((-x, y - leg), (-x, -y + leg), (-x + leg, -y), (x - leg, -y)),
    )
    return tuple(dict.fromkeys(corners))  # without blocks each corner would be there twice

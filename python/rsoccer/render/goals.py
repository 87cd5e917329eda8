"""Goals seen from above: pockets in a table's walls, or boxes that stand on a carpet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import Color, Line, Polygon, Shape, rectangle, stroke

if TYPE_CHECKING:
    from rsoccer._core import Field

TINT = 0.38
"""Share of the team's color in the floor of a goal."""
MAX_ROWS = 100
"""Most meshes between the middle of a goal and a post: a shallow goal has no endless net."""


def goal_shapes(field: Field, edge: float) -> tuple[Shape, ...]:
    """Return both goals: blue's at -x, yellow's at +x.

    Args:
        field: the field.
        edge: width of the rim of a goal that is a pocket in a wall, meters.

    Returns:
        Floor, net and frame of each goal.
    """
    return (
        *_goal(field, -1, palette.BLUE, edge),
        *_goal(field, 1, palette.YELLOW, edge),
    )


def _goal(field: Field, side: int, color: Color, edge: float) -> tuple[Shape, ...]:
    """The goal at the end `side` (-1 or 1), in the color of the team that defends it."""
    mouth, back = side * field.half_length, side * (field.half_length + field.goal_depth)
    y = field.goal_width / 2
    pocket = ((mouth, y), (back, y), (back, -y), (mouth, -y))
    frame = (
        _frame(field, side, color) if field.goal_wall_thickness > 0 else stroke(pocket, edge, color)
    )
    return (
        Polygon(pocket, palette.mix(palette.TABLE, color, TINT)),
        *_net(field, side, palette.fade(color, 0.45)),
        *frame,
    )


def _frame(field: Field, side: int, color: Color) -> tuple[Shape, ...]:
    """Walls of a free-standing goal: its sides reach the wall behind and close the gap."""
    mouth, back = side * field.half_length, side * (field.half_length + field.goal_depth)
    behind = side * (field.half_length + field.goal_line_margin)
    y, wall = field.goal_width / 2, field.goal_wall_thickness
    return (
        Polygon(rectangle(back, -y, behind, y), palette.mix(palette.TABLE, color, 0.08)),
        Polygon(rectangle(mouth, y, behind, y + wall), color),
        Polygon(rectangle(mouth, -y - wall, behind, -y), color),
        Polygon(rectangle(back, -y, back + side * wall, y), color),
    )


def _net(field: Field, side: int, color: Color) -> tuple[Line, ...]:
    """Threads of the net: a square grid with four meshes along the depth."""
    mesh = field.goal_depth / 4
    rows = math.floor(min(field.goal_width / 2 / mesh, MAX_ROWS))
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

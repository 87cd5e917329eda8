"""What a task may show on the floor: targets, gates, areas and segments, as plain shapes.

They go to a picture as `extras`. Strokes are as wide as the field's lines ask for, so the same
calls suit a table and a hall.
"""

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
    Pose,
    Shape,
    rectangle,
    stroke,
)

if TYPE_CHECKING:
    from rsoccer._core import Field

STROKE = 2.0
"""Width of strokes, by the width of the field's lines."""
POST = 3.6
"""Radius of a gate's posts, by the width of the field's lines."""
ARROW = 14.0
"""Length of a gate's arrow, by the width of the field's lines."""
FILL = 0.2
"""Opacity of a surface; the lines under it stay visible."""


def draw_target(
    field: Field, center: Point, radius: float, color: Color = palette.PENDING
) -> tuple[Shape, ...]:
    """A ring around a place to be reached, `radius` metres, with a dot in the middle."""
    stroke_width = STROKE * field.line_width
    return (
        Circle(center, radius, _veil(color)),
        Arc(center, radius, 0.0, math.tau, stroke_width, color),
        Circle(center, stroke_width, color),
    )


def draw_gate(field: Field, left: Point, right: Point, *, done: bool = False) -> tuple[Shape, ...]:
    """A gate between two posts, named as who goes through sees them; `done`: it has been passed."""
    color = palette.DONE if done else palette.PENDING
    unit = field.line_width
    (x_0, y_0), (x_1, y_1) = right, left
    width = math.hypot(x_1 - x_0, y_1 - y_0) or 1.0
    # Who goes through has the left post to the left: a quarter turn back from right to left.
    pose = Pose(((x_0 + x_1) / 2, (y_0 + y_1) / 2), (y_1 - y_0) / width, (x_0 - x_1) / width)
    length, half = ARROW * unit, 0.45 * ARROW * unit
    neck = 0.4 * length
    head = ((length, 0.0), (neck, half), (neck, -half))
    shaft = pose.place(((-0.6 * length, 0.0), (neck, 0.0)))
    return (
        Line(right, left, STROKE * unit, palette.fade(color, 0.6)),
        *stroke(shaft, STROKE * unit, color),
        Polygon(pose.place(head), color),
        *(Circle(post, POST * unit, color) for post in (left, right)),
    )


def draw_area(field: Field, at: Bounds, color: Color = palette.PENDING) -> tuple[Shape, ...]:
    """A rectangle that the play shows through, with an edge."""
    corners = rectangle(at.left, at.bottom, at.right, at.top)
    edge = stroke((*corners, corners[0]), STROKE * field.line_width, palette.fade(color, 0.6))
    return (Polygon(corners, _veil(color)), *edge)


def draw_segment(
    field: Field, start: Point, end: Point, color: Color = palette.PENDING
) -> tuple[Shape, ...]:
    """A straight stroke from one place to another, with a dot at each."""
    stroke_width = STROKE * field.line_width
    dots = (Circle(point, 1.5 * stroke_width, color) for point in (start, end))
    return (Line(start, end, stroke_width, color), *dots)


def _veil(color: Color) -> Color:
    """A colour for surfaces: half white, lest it turn grey over a carpet of the opposite colour."""
    return palette.fade(palette.mix(color, palette.WHITE, 0.5), FILL)

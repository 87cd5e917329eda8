"""Overlays on the floor: a task's targets, gates, areas and ways as shapes.

A renderer takes them as `extras`. Strokes are as wide as the field's line width asks for, so the
same calls suit a table and a hall.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from rsoccer.markers import Area, Gate, Marker, Target
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
    from rsoccer.play import Play
    from rsoccer.task import Task

STROKE = 2.0
"""Width of strokes, in widths of the field's lines."""
POST = 3.6
"""Radius of a gate's posts, in widths of the field's lines."""
ARROW = 14.0
"""Length of a gate's arrow, in widths of the field's lines."""
FILL = 0.2
"""Opacity of a surface; the lines under it stay visible."""


def task_overlay(task: Task, play: Play, world: int = 0) -> tuple[Shape, ...]:
    """Return the shapes of the markers that a task sets in one world.

    Args:
        task: the task that is played.
        play: state of its matches.
        world: index of the world.

    Returns:
        Shapes for the `extras` of a renderer; none for a task without markers.
    """
    return marker_shapes(task.config.field, task.markers(play, world))


def marker_shapes(field: Field, markers: Iterable[Marker]) -> tuple[Shape, ...]:
    """Return the shapes of markers.

    Args:
        field: the field; its line width sets the width of strokes.
        markers: the markers.

    Returns:
        Shapes of all markers, in their order.
    """
    return tuple(shape for marker in markers for shape in _marker(field, marker))


def _marker(field: Field, marker: Marker) -> tuple[Shape, ...]:
    """Shapes of one marker, by its kind."""
    if isinstance(marker, Target):
        return target_shapes(field, marker.center, marker.radius)
    if isinstance(marker, Gate):
        return gate_shapes(field, marker.left, marker.right, done=marker.done)
    if isinstance(marker, Area):
        return area_shapes(field, Bounds(*marker.low, *marker.high))
    return segment_shapes(field, marker.start, marker.end)


def target_shapes(
    field: Field, center: Point, radius: float, color: Color = palette.PENDING
) -> tuple[Shape, ...]:
    """Return a ring around a place to reach, with a dot in the middle.

    Args:
        field: the field; its line width sets the width of strokes.
        center: center of the ring, meters.
        radius: radius of the ring, meters.
        color: color of ring and dot; the surface is a lighter one.

    Returns:
        Surface, ring and dot.
    """
    stroke_width = STROKE * field.line_width
    return (
        Circle(center, radius, _surface_color(color)),
        Arc(center, radius, 0.0, math.tau, stroke_width, color),
        Circle(center, stroke_width, color),
    )


def gate_shapes(
    field: Field, left: Point, right: Point, *, done: bool = False
) -> tuple[Shape, ...]:
    """Return a gate: two posts, the line between them and an arrow through it.

    Args:
        field: the field; its line width sets the width of strokes.
        left: left post as seen by a robot that drives through, meters.
        right: right post, meters.
        done: the gate has been passed, which changes its color.

    Returns:
        Line, arrow and posts.
    """
    color = palette.DONE if done else palette.PENDING
    unit = field.line_width
    (x_0, y_0), (x_1, y_1) = right, left
    width = math.hypot(x_1 - x_0, y_1 - y_0) or 1.0
    # The direction of travel is a quarter turn clockwise from the vector right to left.
    pose = Pose(((x_0 + x_1) / 2, (y_0 + y_1) / 2), (y_1 - y_0) / width, (x_0 - x_1) / width)
    length, half = ARROW * unit, 0.45 * ARROW * unit
    neck = 0.4 * length
    head = ((length, 0.0), (neck, half), (neck, -half))
    shaft = pose.to_world(((-0.6 * length, 0.0), (neck, 0.0)))
    return (
        Line(right, left, STROKE * unit, palette.fade(color, 0.6)),
        *stroke(shaft, STROKE * unit, color),
        Polygon(pose.to_world(head), color),
        *(Circle(post, POST * unit, color) for post in (left, right)),
    )


def area_shapes(field: Field, bounds: Bounds, color: Color = palette.PENDING) -> tuple[Shape, ...]:
    """Return a translucent rectangle with an edge.

    Args:
        field: the field; its line width sets the width of strokes.
        bounds: the rectangle, meters.
        color: color of the edge; the surface is a lighter one.

    Returns:
        Surface and edges.
    """
    corners = rectangle(bounds.left, bounds.bottom, bounds.right, bounds.top)
    edge = stroke((*corners, corners[0]), STROKE * field.line_width, palette.fade(color, 0.6))
    return (Polygon(corners, _surface_color(color)), *edge)


def segment_shapes(
    field: Field, start: Point, end: Point, color: Color = palette.PENDING
) -> tuple[Shape, ...]:
    """Return a straight stroke between two places, with a dot at each.

    Args:
        field: the field; its line width sets the width of strokes.
        start: one end, meters.
        end: the other end, meters.
        color: color of stroke and dots.

    Returns:
        Stroke and dots.
    """
    stroke_width = STROKE * field.line_width
    dots = (Circle(point, 1.5 * stroke_width, color) for point in (start, end))
    return (Line(start, end, stroke_width, color), *dots)


def _surface_color(color: Color) -> Color:
    """A color for surfaces: half white, so that it does not look gray on the opposite color."""
    return palette.fade(palette.mix(color, palette.WHITE, 0.5), FILL)

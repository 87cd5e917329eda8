"""What a task marks on the floor, as shapes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from rsoccer.markers import Area, Gate, Marker, Target
from rsoccer.render.overlay import draw_area, draw_gate, draw_segment, draw_target
from rsoccer.render.shapes import Bounds, Shape

if TYPE_CHECKING:
    from rsoccer._core import Field
    from rsoccer.matches import Matches


def draw_markers(field: Field, markers: Iterable[Marker]) -> tuple[Shape, ...]:
    """Shapes of all markers, in order."""
    return tuple(shape for marker in markers for shape in _draw(field, marker))


def marked(matches: Matches, world: int = 0) -> tuple[Shape, ...]:
    """Shapes of what the task marks in one of its worlds."""
    task = matches.task
    return draw_markers(task.config.field, task.markers(matches.play, world))


def _draw(field: Field, marker: Marker) -> tuple[Shape, ...]:
    if isinstance(marker, Target):
        return draw_target(field, marker.center, marker.radius)
    if isinstance(marker, Gate):
        return draw_gate(field, marker.left, marker.right, done=marker.done)
    if isinstance(marker, Area):
        return draw_area(field, Bounds(*marker.low, *marker.high))
    return draw_segment(field, marker.start, marker.end)

"""Floor markers of a task as plain data; `rsoccer.render.overlay` draws them."""

from dataclasses import dataclass

Point = tuple[float, float]
"""Position x, y on the field, m."""


@dataclass(frozen=True)
class Target:
    """Circle around a target position."""

    center: Point
    """Center x, y, m."""
    radius: float
    """Radius, m."""


@dataclass(frozen=True)
class Gate:
    """Gap between two posts, named from the direction of the crossing."""

    left: Point
    """Left post x, y, m."""
    right: Point
    """Right post x, y, m."""
    done: bool = False
    """Whether no crossing of the gate is left."""


@dataclass(frozen=True)
class Area:
    """Axis-aligned rectangle."""

    low: Point
    """Corner with the least x and y, m."""
    high: Point
    """Corner with the greatest x and y, m."""


@dataclass(frozen=True)
class Segment:
    """Straight line segment, such as the path of a pass."""

    start: Point
    """First end x, y, m."""
    end: Point
    """Second end x, y, m."""


Marker = Target | Gate | Area | Segment
"""Any marker."""

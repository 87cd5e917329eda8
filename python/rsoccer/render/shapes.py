"""What a picture is made of: coloured shapes in metres, x to the right and y upwards.

A new kind of robot or mark needs no new shape, only another function that returns these.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
"""x and y, metres."""

Color: TypeAlias = tuple[int, int, int, int]
"""Red, green, blue and opacity, each 0 to 255."""

ARC_TOLERANCE = 1e-4
"""Metres between a round outline and the chords drawn for it: below a pixel at any sensible size,
and half the points mean half the time."""


@dataclass(frozen=True, slots=True)
class Polygon:
    """A filled polygon; `blur` metres soften its edge, for shadows."""

    points: tuple[Point, ...]
    color: Color
    blur: float = 0.0


@dataclass(frozen=True, slots=True)
class Circle:
    """A filled disc; `blur` metres soften its edge, for shadows."""

    center: Point
    radius: float
    color: Color
    blur: float = 0.0


@dataclass(frozen=True, slots=True)
class Arc:
    """A stroke along a circle, from angle `start` anticlockwise to `end`, in radians."""

    center: Point
    radius: float
    start: float
    end: float
    width: float
    color: Color


@dataclass(frozen=True, slots=True)
class Line:
    """A straight stroke with square ends, as long as its two points are apart."""

    start: Point
    end: Point
    width: float
    color: Color


@dataclass(frozen=True, slots=True)
class Text:
    """Upright text centred on a point; `height` is that of its capitals, `max_width` shrinks it."""

    center: Point
    height: float
    text: str
    color: Color
    max_width: float = math.inf


Shape: TypeAlias = Polygon | Circle | Arc | Line | Text


@dataclass(frozen=True, slots=True)
class Bounds:
    """The rectangle of the world that a picture shows, metres."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """Extent along x, metres."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Extent along y, metres."""
        return self.top - self.bottom


@dataclass(frozen=True, slots=True)
class Pose:
    """Where a body is and where it looks; turns points of the body into points of the world."""

    center: Point
    cos: float
    sin: float

    def place(self, points: tuple[Point, ...]) -> tuple[Point, ...]:
        """The same points, given in the body's frame (x forwards, y to its left), in the world."""
        x_0, y_0 = self.center
        cos, sin = self.cos, self.sin
        return tuple([(x_0 + cos * x - sin * y, y_0 + sin * x + cos * y) for x, y in points])


def arc_points(center: Point, radius: float, start: float, end: float) -> tuple[Point, ...]:
    """Points along a circle, both ends included."""
    chord = 2 * math.acos(max(0.0, 1.0 - ARC_TOLERANCE / max(radius, ARC_TOLERANCE)))
    steps = max(2, math.ceil(abs(end - start) / chord))
    angles = [start + (end - start) * i / steps for i in range(steps + 1)]
    x, y = center
    return tuple([(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles])


def rectangle(left: float, bottom: float, right: float, top: float) -> tuple[Point, ...]:
    """The four corners of an upright rectangle, anticlockwise."""
    return ((left, bottom), (right, bottom), (right, top), (left, top))


def rounded_rectangle(
    left: float, bottom: float, right: float, top: float, radius: float
) -> tuple[Point, ...]:
    """The outline of an upright rectangle with round corners, anticlockwise."""
    radius = min(radius, (right - left) / 2, (top - bottom) / 2)
    quarter = math.pi / 2
    centers = rectangle(left + radius, bottom + radius, right - radius, top - radius)
    return tuple(
        point
        for i, center in enumerate(centers)
        for point in arc_points(center, radius, quarter * (i + 2), quarter * (i + 3))
    )


def stroke(points: tuple[Point, ...], width: float, color: Color) -> tuple[Line, ...]:
    """Lines from each point to the next."""
    return tuple(Line(a, b, width, color) for a, b in pairwise(points))

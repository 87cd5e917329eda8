"""Shapes of a picture: colored, in meters, x to the right and y upwards.

A new kind of robot or mark needs no new shape, only another function that returns these.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
"""x and y, meters."""

Color: TypeAlias = tuple[int, int, int, int]
"""Red, green, blue and opacity, each 0 to 255."""

ARC_TOLERANCE = 1e-4
"""Largest distance between an arc and its chords, meters: below a pixel at any sensible size.

Half the points take half the time."""
MAX_CHORDS = 1000
"""Most chords of an arc: enough for a circle with a radius of 20 m."""


@dataclass(frozen=True, slots=True)
class Polygon:
    """A filled polygon.

    Attributes:
        points: corners, meters.
        color: the color.
        blur: width of the soft edge, meters; for shadows.
    """

    points: tuple[Point, ...]
    color: Color
    blur: float = 0.0


@dataclass(frozen=True, slots=True)
class Circle:
    """A filled disc.

    Attributes:
        center: center, meters.
        radius: radius, meters.
        color: the color.
        blur: width of the soft edge, meters; for shadows.
    """

    center: Point
    radius: float
    color: Color
    blur: float = 0.0


@dataclass(frozen=True, slots=True)
class Arc:
    """A stroke along a circle.

    Attributes:
        center: center of the circle, meters.
        radius: radius of the circle, meters.
        start: first angle, radians from +x.
        end: last angle, counterclockwise from `start`, radians.
        width: width of the stroke, meters.
        color: the color.
    """

    center: Point
    radius: float
    start: float
    end: float
    width: float
    color: Color


@dataclass(frozen=True, slots=True)
class Line:
    """A straight stroke with square caps.

    Attributes:
        start: one end, meters.
        end: the other end, meters.
        width: width of the stroke, meters; each cap adds half of it.
        color: the color.
    """

    start: Point
    end: Point
    width: float
    color: Color


@dataclass(frozen=True, slots=True)
class Text:
    """Upright text, centered on a point unless `align` moves it.

    Attributes:
        center: center of the text, meters.
        height: height of a capital, meters.
        text: the text, one line.
        color: the color.
        max_width: width beyond which the text is shrunk, meters.
        align: share of the text to the left of the point: 0.5 centers it, 0 begins there.
    """

    center: Point
    height: float
    text: str
    color: Color
    max_width: float = math.inf
    align: float = 0.5


Shape: TypeAlias = Polygon | Circle | Arc | Line | Text


@dataclass(frozen=True, slots=True)
class Bounds:
    """A rectangle along the axes.

    Attributes:
        left: smallest x, meters.
        bottom: smallest y, meters.
        right: largest x, meters.
        top: largest y, meters.
    """

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """Extent along x, meters."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Extent along y, meters."""
        return self.top - self.bottom


@dataclass(frozen=True, slots=True)
class Pose:
    """Position and heading of a body.

    Attributes:
        center: position, meters.
        cos: cosine of the heading.
        sin: sine of the heading.
    """

    center: Point
    cos: float
    sin: float

    def to_world(self, points: tuple[Point, ...]) -> tuple[Point, ...]:
        """Transform points from the body frame to the world.

        Args:
            points: points in the body frame, x forward, y left, meters.

        Returns:
            The same points in the world, meters.
        """
        x_0, y_0 = self.center
        cos, sin = self.cos, self.sin
        return tuple([(x_0 + cos * x - sin * y, y_0 + sin * x + cos * y) for x, y in points])


def arc_points(center: Point, radius: float, start: float, end: float) -> tuple[Point, ...]:
    """Return points along an arc, both ends included.

    Args:
        center: center of the circle, meters.
        radius: radius of the circle, meters.
        start: first angle, radians from +x.
        end: last angle, radians; clockwise if below `start`.

    Returns:
        At least three points; their chords are within `ARC_TOLERANCE` of the arc, if `MAX_CHORDS`
        suffice.
    """
    chord = 2 * math.acos(max(0.0, 1.0 - ARC_TOLERANCE / max(radius, ARC_TOLERANCE)))
    steps = max(2, math.ceil(min(abs(end - start) / max(chord, 1e-9), MAX_CHORDS)))
    angles = [start + (end - start) * i / steps for i in range(steps + 1)]
    x, y = center
    return tuple([(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles])


def rectangle(left: float, bottom: float, right: float, top: float) -> tuple[Point, ...]:
    """Return the corners of a rectangle along the axes.

    Args:
        left: smallest x, meters.
        bottom: smallest y, meters.
        right: largest x, meters.
        top: largest y, meters.

    Returns:
        Four points, counterclockwise from the lower left.
    """
    return ((left, bottom), (right, bottom), (right, top), (left, top))


def rounded_rectangle(
    left: float, bottom: float, right: float, top: float, radius: float
) -> tuple[Point, ...]:
    """Return the outline of a rectangle with round corners.

    Args:
        left: smallest x, meters.
        bottom: smallest y, meters.
        right: largest x, meters.
        top: largest y, meters.
        radius: radius of the corners, meters; at most half the shorter side is used.

    Returns:
        Points of the outline, counterclockwise.
    """
    radius = min(radius, (right - left) / 2, (top - bottom) / 2)
    quarter = math.pi / 2
    centers = rectangle(left + radius, bottom + radius, right - radius, top - radius)
    return tuple(
        point
        for i, center in enumerate(centers)
        for point in arc_points(center, radius, quarter * (i + 2), quarter * (i + 3))
    )


def stroke(points: tuple[Point, ...], width: float, color: Color) -> tuple[Line, ...]:
    """Return lines from each point to the next.

    Args:
        points: the points, meters.
        width: width of the lines, meters.
        color: the color.

    Returns:
        One line fewer than there are points.
    """
    return tuple(Line(a, b, width, color) for a, b in pairwise(points))

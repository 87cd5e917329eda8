"""The ball seen from above: ring, shadow, ball and motion trail."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import Arc, Circle, Line, Point, Polygon, Pose, Shape

if TYPE_CHECKING:
    from rsoccer._core import BallModel

SHADOW_OFFSET = 0.4
"""Offset of a shadow to the right and down, per height of the ball; light comes from the left."""
SHADOW_BLUR = 1.0
"""Growth of a shadow's blur, in drawn radii, for each meter of height."""
STEM = 0.4
"""Width of the line between a ball in flight and its shadow, in drawn radii."""
GROWTH = 1.3
"""Growth of a ball's drawn radius for each meter of height, as it nears the camera."""
MAX_GROWTH = 2.5
"""Largest factor on a ball's drawn radius."""
MIN_RADIUS = 0.0042
"""Smallest drawn radius of the ball, as a fraction of the picture's width: 5 of 1280 pixels."""
OUTLINE = 0.2
"""Width of the ball's dark outline, in drawn radii: it parts the ball from a robot beside it."""
RING = 0.011
"""Radius of the ring around an enlarged ball, as a fraction of the picture's width."""
RING_WIDTH = 0.0019
"""Width of the ring, as a fraction of the picture's width."""
TRAIL_SPEED = 0.3
"""Ball speed above which the ball leaves a trail, m/s."""
TRAIL_TIME = 0.12
"""Seconds of motion that a trail shows."""
TRAIL_LENGTH = 20.0
"""Longest trail, in drawn radii: a shot must not draw a line over the whole field."""
TRAIL_LAYERS = 5
"""Wedges of a trail; each is longer than the last, so the trail fades out away from the ball."""


def drawn_radius(model: BallModel, picture_width: float) -> float:
    """Return the radius at which the ball is drawn on the floor.

    Args:
        model: the ball.
        picture_width: width of the part of the world that the picture shows, meters.

    Returns:
        The true radius, or `MIN_RADIUS` of the picture's width if that is more, meters.
    """
    return max(model.radius, MIN_RADIUS * picture_width)


def ring_radius(picture_width: float) -> float:
    """Return the radius of the ring around a small ball.

    Args:
        picture_width: width of the part of the world that the picture shows, meters.

    Returns:
        Meters.
    """
    return RING * picture_width


def ring_shapes(model: BallModel, center: Point, picture_width: float) -> tuple[Shape, ...]:
    """Return a ring with a light surface around a ball too small to find in the picture.

    Args:
        model: the ball.
        center: position of the ball, meters.
        picture_width: width of the part of the world that the picture shows, meters.

    Returns:
        Surface and ring, or nothing where the ball is drawn at its true size.
    """
    if drawn_radius(model, picture_width) == model.radius:
        return ()
    radius = ring_radius(picture_width)
    return (
        Circle(center, radius, palette.HALO),
        Arc(center, radius, 0.0, math.tau, RING_WIDTH * picture_width, palette.RING),
    )


def shadow_shapes(radius: float, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """Return the shadow on the floor, and for a ball in flight a line up to the ball.

    Args:
        radius: drawn radius of the ball on the floor, meters.
        center: position of the ball, meters.
        height: height of the ball's lowest point above the floor, meters.

    Returns:
        The shadow, and the line if `height` is not 0.
    """
    x, y = center
    offset, growth = SHADOW_OFFSET * height, _growth(height)
    on_floor = (x + offset, y - offset)
    blur = (0.3 + SHADOW_BLUR * height) * radius
    shadow = Circle(on_floor, 1.15 * growth * radius, palette.SHADOW, blur=blur)
    if not height:
        return (shadow,)
    stem = Line(on_floor, center, STEM * radius, palette.fade(palette.SHADOW, 0.6))
    return (shadow, stem)


def ball_shapes(radius: float, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """Return the ball with an outline and a highlight, larger in flight.

    Args:
        radius: drawn radius of the ball on the floor, meters.
        center: position of the ball, meters.
        height: height of the ball's lowest point above the floor, meters.

    Returns:
        Three circles: the outline, the ball and the highlight.
    """
    radius *= _growth(height)
    x, y = center
    return (
        Circle(center, (1.0 + OUTLINE) * radius, palette.BALL_OUTLINE),
        Circle(center, radius, palette.ORANGE),
        Circle((x - 0.3 * radius, y + 0.35 * radius), 0.3 * radius, palette.HIGHLIGHT),
    )


def _growth(height: float) -> float:
    """Factor on the drawn radius of a ball at this height."""
    return min(1.0 + GROWTH * height, MAX_GROWTH)


def trail_shapes(radius: float, center: Point, velocity: Point) -> tuple[Shape, ...]:
    """Return the motion trail of a fast ball: wedges that taper off behind the ball.

    Args:
        radius: drawn radius of the ball on the floor, meters.
        center: position of the ball, meters.
        velocity: velocity of the ball, m/s.

    Returns:
        `TRAIL_LAYERS` wedges, or nothing below `TRAIL_SPEED`.
    """
    speed = math.hypot(*velocity)
    if speed < TRAIL_SPEED:
        return ()
    length = min(TRAIL_TIME * speed, TRAIL_LENGTH * radius)
    pose = Pose(center, velocity[0] / speed, velocity[1] / speed)
    return tuple(
        Polygon(
            pose.to_world(((0.0, radius), (-length * layer / TRAIL_LAYERS, 0.0), (0.0, -radius))),
            palette.TRAIL,
        )
        for layer in range(1, TRAIL_LAYERS + 1)
    )

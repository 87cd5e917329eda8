"""The ball seen from above: halo, shadow, ball and motion trail."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import Circle, Line, Point, Polygon, Pose, Shape

if TYPE_CHECKING:
    from rsoccer._core import BallModel

SHADOW_OFFSET = 0.4
"""Offset of a shadow to the right and down, per height of the ball; light comes from the left."""
SHADOW_BLUR = 1.0
"""Growth of a shadow's blur, in radii of the ball, for each metre of height."""
STEM = 0.4
"""Width of the line between a ball in flight and its shadow, in radii of the ball."""
GROWTH = 1.3
"""Growth of a ball's drawn radius for each metre of height, as it nears the camera."""
MAX_GROWTH = 2.5
"""Largest factor on a ball's drawn radius."""
HALO = 0.0065
"""Radius of the halo around the ball, as a fraction of the picture's width."""
MIN_HALO = 1.5
"""Smallest radius of a halo, in radii of the ball: below it the ball is large enough without."""
TRAIL_SPEED = 0.3
"""Ball speed above which the ball leaves a trail, m/s."""
TRAIL_TIME = 0.12
"""Seconds of motion that a trail shows."""
TRAIL_LENGTH = 20.0
"""Longest trail, in radii of the ball: a shot must not draw a line over the whole field."""
TRAIL_LAYERS = 5
"""Wedges of a trail; each is longer than the last, so the trail fades out away from the ball."""


def halo_shapes(model: BallModel, center: Point, picture_width: float) -> tuple[Shape, ...]:
    """Return a halo on the floor around a ball too small to find in the picture.

    Args:
        model: the ball.
        center: position of the ball, metres.
        picture_width: width of the part of the world that the picture shows, metres.

    Returns:
        One circle, or nothing where the ball is large enough.
    """
    radius = HALO * picture_width
    if radius < MIN_HALO * model.radius:
        return ()
    return (Circle(center, radius, palette.HALO, blur=0.3 * radius),)


def shadow_shapes(model: BallModel, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """Return the shadow on the floor, and for a ball in flight a line up to the ball.

    Args:
        model: the ball.
        center: position of the ball, metres.
        height: height of the ball's lowest point above the floor, metres.

    Returns:
        The shadow, and the line if `height` is not 0.
    """
    x, y = center
    offset, growth = SHADOW_OFFSET * height, _growth(height)
    on_floor = (x + offset, y - offset)
    blur = (0.3 + SHADOW_BLUR * height) * model.radius
    shadow = Circle(on_floor, 1.15 * growth * model.radius, palette.SHADOW, blur=blur)
    if not height:
        return (shadow,)
    stem = Line(on_floor, center, STEM * model.radius, palette.fade(palette.SHADOW, 0.6))
    return (shadow, stem)


def ball_shapes(model: BallModel, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """Return the ball and a highlight: true to scale on the floor, larger in flight.

    Args:
        model: the ball.
        center: position of the ball, metres.
        height: height of the ball's lowest point above the floor, metres.

    Returns:
        Two circles, the ball first.
    """
    radius = model.radius * _growth(height)
    x, y = center
    return (
        Circle(center, radius, palette.ORANGE),
        Circle((x - 0.3 * radius, y + 0.35 * radius), 0.3 * radius, palette.HIGHLIGHT),
    )


def _growth(height: float) -> float:
    """Factor on the drawn radius of a ball at this height."""
    return min(1.0 + GROWTH * height, MAX_GROWTH)


def trail_shapes(model: BallModel, center: Point, velocity: Point) -> tuple[Shape, ...]:
    """Return the motion trail of a fast ball: wedges that taper off behind the ball.

    Args:
        model: the ball.
        center: position of the ball, metres.
        velocity: velocity of the ball, m/s.

    Returns:
        `TRAIL_LAYERS` wedges, or nothing below `TRAIL_SPEED`.
    """
    speed = math.hypot(*velocity)
    if speed < TRAIL_SPEED:
        return ()
    radius = model.radius
    length = min(TRAIL_TIME * speed, TRAIL_LENGTH * radius)
    pose = Pose(center, velocity[0] / speed, velocity[1] / speed)
    return tuple(
        Polygon(
            pose.to_world(((0.0, radius), (-length * layer / TRAIL_LAYERS, 0.0), (0.0, -radius))),
            palette.TRAIL,
        )
        for layer in range(1, TRAIL_LAYERS + 1)
    )

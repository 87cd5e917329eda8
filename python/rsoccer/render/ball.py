"""The ball as seen from above, on the floor or in flight, and where it came from."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.shapes import Circle, Line, Point, Polygon, Pose, Shape

if TYPE_CHECKING:
    from rsoccer._core import BallModel

SHADOW_DRIFT = 0.4
"""How far a shadow moves right and down, by the height of the ball; the light is on the left."""
SHADOW_SPREAD = 1.0
"""How much softer a shadow is, in radii of the ball, for each metre of height."""
STEM = 0.4
"""Width of the line between a ball in flight and its shadow, in radii of the ball."""
NEARNESS = 1.3
"""How much larger a ball looks for each metre that it comes nearer to who looks down."""
LARGEST = 2.5
"""Most that a high ball grows."""
HALO = 0.0065
"""Radius of the glow around the ball by the width of the picture: seen at a glance, but no more."""
LOST = 1.5
"""Radii of the ball that the glow must exceed for the ball to need one."""
TRAIL_SPEED = 0.3
"""Metres per second above which the ball leaves a trail."""
TRAIL_TIME = 0.12
"""Seconds of motion that a trail shows."""
TRAIL_LENGTH = 20.0
"""Longest trail, in radii of the ball: a shot must not draw a line over the whole field."""
TRAIL_LAYERS = 5
"""Wedges of a trail; each is longer than the last, so they fade out away from the ball."""


def draw_halo(model: BallModel, center: Point, sight: float) -> tuple[Shape, ...]:
    """A glow on the floor around a ball that would be lost in a picture `sight` metres wide."""
    radius = HALO * sight
    if radius < LOST * model.radius:
        return ()
    return (Circle(center, radius, palette.HALO, blur=0.3 * radius),)


def draw_shadow(model: BallModel, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """The shadow on the floor, and how high above it the ball is."""
    x, y = center
    drift, growth = SHADOW_DRIFT * height, _growth(height)
    below = (x + drift, y - drift)
    blur = (0.3 + SHADOW_SPREAD * height) * model.radius
    shadow = Circle(below, 1.15 * growth * model.radius, palette.SHADOW, blur=blur)
    if not height:
        return (shadow,)
    stem = Line(below, center, STEM * model.radius, palette.fade(palette.SHADOW, 0.6))
    return (shadow, stem)


def draw_ball(model: BallModel, center: Point, height: float = 0.0) -> tuple[Shape, ...]:
    """The ball and a highlight; of true size on the floor, and larger as it rises."""
    radius = model.radius * _growth(height)
    x, y = center
    return (
        Circle(center, radius, palette.ORANGE),
        Circle((x - 0.3 * radius, y + 0.35 * radius), 0.3 * radius, palette.SHINE),
    )


def _growth(height: float) -> float:
    """How much larger a ball looks at that height."""
    return min(1.0 + NEARNESS * height, LARGEST)


def draw_trail(model: BallModel, center: Point, velocity: Point) -> tuple[Shape, ...]:
    """Where a fast ball came from: wedges that taper off behind it."""
    speed = math.hypot(*velocity)
    if speed < TRAIL_SPEED:
        return ()
    radius = model.radius
    length = min(TRAIL_TIME * speed, TRAIL_LENGTH * radius)
    pose = Pose(center, velocity[0] / speed, velocity[1] / speed)
    return tuple(
        Polygon(
            pose.place(((0.0, radius), (-length * layer / TRAIL_LAYERS, 0.0), (0.0, -radius))),
            palette.TRAIL,
        )
        for layer in range(1, TRAIL_LAYERS + 1)
    )

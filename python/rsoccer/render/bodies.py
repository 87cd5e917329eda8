"""The ball and the robots as seen from above: what moves in a picture."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from rsoccer.render import palette
from rsoccer.render.shapes import (
    Circle,
    Color,
    Point,
    Polygon,
    Pose,
    Shape,
    Text,
    rounded_rectangle,
)

if TYPE_CHECKING:
    from rsoccer._core import BallModel, RobotModel

SHADOW_BLUR = 0.12
"""Softness of a shadow, by the size of the body."""
TRAIL_SPEED = 0.3
"""Metres per second above which the ball leaves a trail."""
TRAIL_TIME = 0.12
"""Seconds of motion that a trail shows."""
TRAIL_LENGTH = 12.0
"""Longest trail, in radii of the ball: a shot must not draw a line over the whole field."""
TRAIL_LAYERS = 5
"""Wedges of a trail; each is longer than the last, so they fade out away from the ball."""


def draw_robot(model: RobotModel, pose: Pose, color: Color, number: int) -> tuple[Shape, ...]:
    """A square robot: chassis, wheels, cover in its team's colour, arrow ahead, upright number."""
    size = model.size
    outlines = _outlines(size, model.wheel_radius)
    ink = palette.INK if _is_light(color) else palette.WHITE
    (behind,) = pose.place(((-0.08 * size, 0.0),))
    return (
        Polygon(pose.place(outlines.chassis), palette.SHADOW, blur=SHADOW_BLUR * size),
        Polygon(pose.place(outlines.chassis), palette.mix(color, palette.INK, 0.5)),
        *(Polygon(pose.place(wheel), palette.TYRE) for wheel in outlines.wheels),
        Polygon(pose.place(outlines.cover), color),
        Polygon(pose.place(outlines.front), ink),
        Text(behind, 0.38 * size, str(number), ink),
    )


class Outlines(NamedTuple):
    """The parts of a robot in its own frame, x forwards, metres."""

    chassis: tuple[Point, ...]
    cover: tuple[Point, ...]
    front: tuple[Point, ...]
    wheels: tuple[tuple[Point, ...], ...]


@lru_cache(maxsize=8)
def _outlines(size: float, wheel_radius: float) -> Outlines:
    """The parts of a square robot, in proportion to its side."""
    half = size / 2
    chassis = rounded_rectangle(-half, -half, half, half, 0.17 * size)
    cover = rounded_rectangle(-0.44 * size, -0.35 * size, 0.44 * size, 0.35 * size, 0.12 * size)
    front = ((0.42 * size, 0.0), (0.25 * size, 0.24 * size), (0.25 * size, -0.24 * size))
    wheels = tuple(
        rounded_rectangle(-wheel_radius, inner, wheel_radius, inner + 0.1 * size, 0.03 * size)
        for inner in (-0.47 * size, 0.37 * size)
    )
    return Outlines(chassis, cover, front, wheels)


def draw_ball(model: BallModel, center: Point) -> tuple[Shape, ...]:
    """The ball, its shadow and a highlight."""
    radius = model.radius
    x, y = center
    return (
        Circle(center, 1.15 * radius, palette.SHADOW, blur=0.3 * radius),
        Circle(center, radius, palette.ORANGE),
        Circle((x - 0.3 * radius, y + 0.35 * radius), 0.3 * radius, palette.SHINE),
    )


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


def _is_light(color: Color) -> bool:
    """Whether dark ink reads better than white on the colour (relative luminance)."""
    red, green, blue = color[:3]
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 150

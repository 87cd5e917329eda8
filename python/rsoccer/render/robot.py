"""A robot as seen from above: whatever its model says that it is."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from rsoccer.render import palette
from rsoccer.render.shapes import (
    Color,
    Point,
    Polygon,
    Pose,
    Shape,
    Text,
    arc_points,
    rectangle,
    rounded_rectangle,
)

if TYPE_CHECKING:
    from rsoccer._core import RobotModel

SHADOW_BLUR = 0.12
"""Softness of a shadow, by the size of the body."""
GLOW = 0.09
"""How far the light of a mouth with the ball in it spreads, by the size of the body."""
SQUARE_SHADE, ROUND_SHADE = 0.5, 0.88
"""Darkness of a hull: a square one shows its team, a round one stands out from the carpet."""


class Outlines(NamedTuple):
    """The parts of a robot in its own frame, x forwards, metres; what it does not have is empty."""

    size: float  # from side to side
    shade: float  # darkness of the hull, 0 to 1
    hull: tuple[Point, ...]
    cover: tuple[Point, ...]
    wheels: tuple[tuple[Point, ...], ...]
    arrow: tuple[Point, ...]
    mouth: tuple[Point, ...]
    number_x: float
    number_height: float


def draw_robot(
    model: RobotModel, pose: Pose, color: Color, number: int, *, lit: bool = False
) -> tuple[Shape, ...]:
    """Hull, wheels, cover in its team's colour, front, upright number; `lit`: it has the ball."""
    parts = robot_outlines(model)
    ink = palette.INK if _is_light(color) else palette.WHITE
    hull = pose.place(parts.hull)
    (middle,) = pose.place(((parts.number_x, 0.0),))
    return (
        Polygon(hull, palette.SHADOW, blur=SHADOW_BLUR * parts.size),
        Polygon(hull, palette.mix(color, palette.INK, parts.shade)),
        *(Polygon(pose.place(wheel), palette.TYRE) for wheel in parts.wheels),
        Polygon(pose.place(parts.cover), color),
        *((Polygon(pose.place(parts.arrow), ink),) if parts.arrow else ()),
        *(_draw_mouth(parts, pose, lit) if parts.mouth else ()),
        Text(middle, parts.number_height, str(number), ink, 0.6 * parts.size),
    )


def _draw_mouth(parts: Outlines, pose: Pose, lit: bool) -> tuple[Shape, ...]:
    """The dribbler's bar, alight while the ball cuts the beam before it."""
    bar = pose.place(parts.mouth)
    if not lit:
        return (Polygon(bar, palette.BAR),)
    return (Polygon(bar, palette.LIT, blur=GLOW * parts.size), Polygon(bar, palette.LIT))


def robot_outlines(model: RobotModel) -> Outlines:
    """The parts of a robot, in proportion to its body."""
    mouth = model.mouth_width if model.has_mouth else 0.0
    side: float | None = getattr(model, "side", None)
    if side is None:
        return _round(model.radius, model.front, mouth)
    return _square(side, model.wheel_radius if model.drive == "differential" else 0.0, mouth)


@lru_cache(maxsize=16)
def _square(size: float, wheel_radius: float, mouth: float) -> Outlines:
    """A square robot; two wheels beside its cover, if they have a radius."""
    half = size / 2
    wheels = tuple(
        rounded_rectangle(-wheel_radius, inner, wheel_radius, inner + 0.1 * size, 0.03 * size)
        for inner in (-0.47 * size, 0.37 * size)
    )
    return Outlines(
        size,
        SQUARE_SHADE,
        hull=rounded_rectangle(-half, -half, half, half, 0.17 * size),
        cover=rounded_rectangle(-0.44 * size, -0.35 * size, 0.44 * size, 0.35 * size, 0.12 * size),
        wheels=wheels if wheel_radius else (),
        arrow=((0.42 * size, 0.0), (0.25 * size, 0.24 * size), (0.25 * size, -0.24 * size)),
        mouth=_bar(half, half, mouth, 0.06 * size),
        number_x=-0.08 * size,
        number_height=0.38 * size,
    )


@lru_cache(maxsize=16)
def _round(radius: float, front: float, mouth: float) -> Outlines:
    """A disc with a flat front; its wheels are under it.

    With a mouth the cover ends before it, much as the pattern plates of the league do.
    """
    bar = _bar(front, math.sqrt(radius**2 - front**2), mouth, 0.17 * radius)
    tip = 0.94 * front
    return Outlines(
        2 * radius,
        ROUND_SHADE,
        hull=_cut_disc(radius, front),
        cover=_cut_disc(0.88 * radius, front - (0.3 if bar else 0.06) * radius),
        wheels=(),
        arrow=() if bar else ((tip, 0.0), (0.55 * tip, 0.4 * tip), (0.55 * tip, -0.4 * tip)),
        mouth=bar,
        number_x=-0.14 * radius,
        number_height=(0.84 if bar else 0.7) * radius,
    )


def _cut_disc(radius: float, front: float) -> tuple[Point, ...]:
    """A disc cut off at `front`."""
    edge = math.acos(min(1.0, front / radius))
    return arc_points((0.0, 0.0), radius, edge, math.tau - edge)


def _bar(front: float, half_flat: float, width: float, depth: float) -> tuple[Point, ...]:
    """A bar of that width along a front, no wider than its flat part; empty without a width."""
    half = min(width / 2, half_flat)
    return rectangle(front - depth, -half, front, half) if half else ()


def _is_light(color: Color) -> bool:
    """Whether dark ink reads better than white on the colour (relative luminance)."""
    red, green, blue = color[:3]
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 150

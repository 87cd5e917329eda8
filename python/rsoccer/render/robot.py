"""A robot seen from above: outlines from its model, shapes from its pose and team."""

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
"""Softness of a shadow, as a fraction of the body's size."""
GLOW = 0.09
"""Blur of the light around a dribbler with the ball, as a fraction of the body's size."""
LABEL_GAP = 0.12
"""Distance between a robot and the label beside it, in sizes of the body."""
LABEL_PADDING = 0.45
"""Border of a label around its number, in heights of the number."""
DIGIT_WIDTH = 0.8
"""Width of a digit with its space, in heights of the number."""
SQUARE_SHADE, ROUND_SHADE = 0.5, 0.88
"""Darkness of a hull, 0 to 1: a square one shows its team, a round one contrasts with carpet."""


class Outlines(NamedTuple):
    """Outlines of a robot in its body frame, x forward, y left, meters; absent parts are empty.

    Attributes:
        size: width of the body, meters.
        shade: darkness of the hull, 0 to 1.
        hull: outline of the body.
        cover: outline of the plate in the team's color.
        wheels: outlines of the visible wheels.
        arrow: outline of the arrow that marks the front of a robot without a dribbler.
        big_arrow: outline of the arrow in the place of the number.
        dribbler: outline of the dribbler's bar.
        number_x: x of the center of the number, meters.
        number_height: height of the number, meters.
    """

    size: float
    shade: float
    hull: tuple[Point, ...]
    cover: tuple[Point, ...]
    wheels: tuple[tuple[Point, ...], ...]
    arrow: tuple[Point, ...]
    big_arrow: tuple[Point, ...]
    dribbler: tuple[Point, ...]
    number_x: float
    number_height: float


def robot_shapes(
    model: RobotModel,
    pose: Pose,
    color: Color,
    number: int,
    *,
    has_ball: bool = False,
    has_number: bool = True,
) -> tuple[Shape, ...]:
    """Return a robot: hull, wheels, cover in its team's color, front and upright number.

    Args:
        model: the robot.
        pose: position and heading.
        color: color of its team.
        number: number of the robot in its team.
        has_ball: the ball cuts the beam, which lights the dribbler.
        has_number: the number is on the robot; otherwise an arrow to the front is in its place.

    Returns:
        Shapes in the order of drawing, the lowest first.
    """
    outlines = robot_outlines(model)
    ink = palette.INK if _is_light(color) else palette.WHITE
    hull = pose.to_world(outlines.hull)
    (number_center,) = pose.to_world(((outlines.number_x, 0.0),))
    number_text = Text(number_center, outlines.number_height, str(number), ink, 0.6 * outlines.size)
    return (
        Polygon(hull, palette.SHADOW, blur=SHADOW_BLUR * outlines.size),
        Polygon(hull, palette.mix(color, palette.INK, outlines.shade)),
        *(Polygon(pose.to_world(wheel), palette.TIRE) for wheel in outlines.wheels),
        Polygon(pose.to_world(outlines.cover), color),
        *((Polygon(pose.to_world(outlines.arrow), ink),) if outlines.arrow else ()),
        *(_dribbler(outlines, pose, has_ball) if outlines.dribbler else ()),
        number_text if has_number else Polygon(pose.to_world(outlines.big_arrow), ink),
    )


def label_shapes(
    model: RobotModel, pose: Pose, color: Color, number: int, height: float
) -> tuple[Shape, ...]:
    """Return a label with the number of a robot, behind the robot: the ball is at its front.

    Args:
        model: the robot.
        pose: position and heading.
        color: color of its team.
        number: number of the robot in its team.
        height: height of the number, meters.

    Returns:
        A dark plate and the number.
    """
    text = str(number)
    padding = LABEL_PADDING * height
    half_width = DIGIT_WIDTH * height * len(text) / 2 + padding
    half_height = height / 2 + padding
    size = robot_outlines(model).size
    # The plate is upright, so its extent toward the robot depends on the direction.
    reach = abs(pose.cos) * half_width + abs(pose.sin) * half_height
    ((x, y),) = pose.to_world(((-(0.5 + LABEL_GAP) * size - reach, 0.0),))
    plate = rounded_rectangle(
        x - half_width, y - half_height, x + half_width, y + half_height, 0.7 * half_height
    )
    return (
        Polygon(plate, palette.LABEL),
        Text((x, y), height, text, palette.mix(color, palette.WHITE, 0.65)),
    )


def _dribbler(outlines: Outlines, pose: Pose, has_ball: bool) -> tuple[Shape, ...]:
    """The dribbler's bar, lit while the ball cuts the beam."""
    bar = pose.to_world(outlines.dribbler)
    if not has_ball:
        return (Polygon(bar, palette.DRIBBLER),)
    color = palette.DRIBBLER_LIT
    return (Polygon(bar, color, blur=GLOW * outlines.size), Polygon(bar, color))


def robot_outlines(model: RobotModel) -> Outlines:
    """Return the outlines of a robot, in proportion to its body.

    Args:
        model: the robot.

    Returns:
        Outlines of a square robot with its two wheels, or of a round one with a flat front.
    """
    mouth = model.mouth_width if model.has_mouth else 0.0
    side: float | None = getattr(model, "side_length", None)
    if side is None:
        return _round(model.radius, model.front_distance, mouth)
    return _square(side, model.wheel_radius if model.drive == "differential" else 0.0, mouth)


@lru_cache(maxsize=16)
def _square(size: float, wheel_radius: float, mouth: float) -> Outlines:
    """A square robot, with a wheel on each side of its cover if `wheel_radius` is not 0."""
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
        big_arrow=_chevron(0.12 * size, 0.21 * size),
        dribbler=_bar(half, half, mouth, 0.06 * size),
        number_x=-0.08 * size,
        number_height=0.42 * size,
    )


@lru_cache(maxsize=16)
def _round(radius: float, front: float, mouth: float) -> Outlines:
    """A disc with a flat front and hidden wheels.

    With a dribbler the cover ends before the dribbler, as the pattern plates of the league do.
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
        big_arrow=_chevron(0.42 * radius, 0.56 * radius),
        dribbler=bar,
        number_x=-0.14 * radius,
        number_height=(0.84 if bar else 0.7) * radius,
    )


def _cut_disc(radius: float, front: float) -> tuple[Point, ...]:
    """A disc cut off at x = `front`."""
    edge = math.acos(min(1.0, front / radius))
    return arc_points((0.0, 0.0), radius, edge, math.tau - edge)


def _chevron(tip: float, half_width: float) -> tuple[Point, ...]:
    """An arrowhead with a notch; its tip is at x = `tip`."""
    back = tip - 1.7 * half_width
    return ((tip, 0.0), (back, half_width), (back + 0.5 * half_width, 0.0), (back, -half_width))


def _bar(front: float, half_flat: float, width: float, depth: float) -> tuple[Point, ...]:
    """A bar along the front, no wider than its flat part; empty without a width."""
    half = min(width / 2, half_flat)
    return rectangle(front - depth, -half, front, half) if half else ()


def _is_light(color: Color) -> bool:
    """Whether the color needs dark text rather than white (relative luminance)."""
    red, green, blue = color[:3]
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 150

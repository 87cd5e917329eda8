"""Marks of a referee on the floor: areas, the place of the next kick, distances to keep."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from rsoccer.game import BLUE, NOBODY, YELLOW, Command
from rsoccer.render import palette
from rsoccer.render.referee_state import RefereeState, team_of
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import (
    Arc,
    Circle,
    Color,
    Line,
    Point,
    Polygon,
    Pose,
    Shape,
    arc_points,
)

if TYPE_CHECKING:
    from rsoccer._core import Field

AREA_TINT: Final = 0.13
"""Opacity of the color of its team on an area."""
POSITION_RADIUS: Final = 0.0105
"""Radius of the mark of the next kick, as a fraction of the picture's width."""
STROKE: Final = 0.0018
"""Width of strokes, in the same fraction."""
FILL: Final = 0.08
"""Opacity of the floor that robots keep off."""
EDGE: Final = 0.75
"""Opacity of its edge."""
MAY_TOUCH: Final = 0.22
"""Opacity of the disc under a robot that may touch the ball while others may not."""
MAY_TOUCH_RADIUS: Final = 0.78
"""Radius of that disc, and of the ring of a robot that may not, in sizes of the robot."""

_KICKS_WITH_DISTANCE: Final = (
    *(Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW),
    *(Command.DIRECT_FREE_BLUE, Command.DIRECT_FREE_YELLOW),
)
_PLACEMENTS: Final = (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW)

TEAM_COLORS: Final = {
    BLUE: palette.mix(palette.BLUE, palette.WHITE, 0.55),
    YELLOW: palette.YELLOW,
    NOBODY: palette.WHITE,
}
"""Colors of marks by team, which stand out on the floor."""


def area_outlines(field: Field) -> tuple[tuple[Point, ...], tuple[Point, ...]]:
    """Return the outlines of the areas of blue and of yellow.

    Args:
        field: the field.

    Returns:
        Points of each, m.
    """
    area = _area(field)
    return tuple((-x, y) for x, y in area), area


def area_shapes(field: Field) -> tuple[Shape, ...]:
    """Return the areas in the colors of the teams that defend them.

    Args:
        field: the field.

    Returns:
        A translucent surface for each area.
    """
    colors = (palette.BLUE, palette.YELLOW)
    return tuple(
        Polygon(outline, palette.fade(color, AREA_TINT))
        for outline, color in zip(area_outlines(field), colors, strict=True)
    )


def _area(field: Field) -> tuple[Point, ...]:
    """Outline of the area at +x, with the arc on its front."""
    back, y = field.half_length, field.goal_area_width / 2
    front = back - field.goal_area_depth
    half_chord, depth = field.area_arc_width / 2, field.area_arc_depth
    arc: tuple[Point, ...] = ()
    if half_chord * depth:
        radius = (half_chord**2 + depth**2) / (2 * depth)
        half_angle = math.atan2(half_chord, radius - depth)
        center = (front - depth + radius, 0.0)
        arc = arc_points(center, radius, math.pi - half_angle, math.pi + half_angle)
    return ((back, y), (front, y), *arc, (front, -y), (back, -y))


class FloorMarks(NamedTuple):
    """Marks around the ball, and of the next kick."""

    kept_off: str
    """Floor that opponents of the team keep off, or all robots: "disc" around the ball, "stadium"
    between the ball and its place, or "" for none."""
    team: int
    """Team for which they do: `BLUE`, `YELLOW` or `NOBODY`."""
    kick: int | None
    """Team that has the next kick; None if its place is not shown."""


def floor_marks(state: RefereeState) -> FloorMarks:
    """Return what the floor shows; nothing while the ball is in play.

    Args:
        state: state of the referee.
    """
    if state.in_play or state.is_over:
        return FloorMarks("", NOBODY, None)
    if state.command in (Command.HALT, Command.STOP):
        is_disc = state.command is Command.STOP and state.ball_distance > 0
        return FloorMarks("disc" if is_disc else "", NOBODY, team_of(state.next_command))
    # A command to start play does not say which kick is taken.
    kick = state.kick if state.command is Command.NORMAL_START else state.command
    team, kept_off = team_of(kick), ""
    if state.ball_distance > 0:
        is_disc = kick in _KICKS_WITH_DISTANCE
        kept_off = "stadium" if kick in _PLACEMENTS else "disc" if is_disc else ""
    return FloorMarks(kept_off, team, team)


def referee_shapes(field: Field, state: RefereeState, ball: Point) -> tuple[Shape, ...]:
    """Return the marks of the referee while play is stopped or a kick is due.

    Args:
        field: the field.
        state: state of the referee.
        ball: position of the ball, m.

    Returns:
        The floor that robots keep off, and the place of the next kick.
    """
    marks, place, radius = floor_marks(state), state.designated_position, state.ball_distance
    color = TEAM_COLORS[marks.team]
    shapes: tuple[Shape, ...] = ()
    if marks.kept_off == "stadium":
        shapes = _stadium(field, ball, place, radius, color)
    elif marks.kept_off == "disc":
        shapes = _disc(field, ball, radius, color)
    if marks.kick is None:
        return shapes
    return (*shapes, *_position(field, place, TEAM_COLORS[marks.kick]))


def _disc(field: Field, center: Point, radius: float, color: Color) -> tuple[Shape, ...]:
    """A translucent disc with an edge."""
    width = STROKE * scene_bounds(field).width
    return (
        Circle(center, radius, palette.fade(color, FILL)),
        Arc(center, radius, 0.0, math.tau, width, palette.fade(color, EDGE)),
    )


def _stadium(
    field: Field, ball: Point, place: Point, radius: float, color: Color
) -> tuple[Shape, ...]:
    """All points near the line from the ball to its place, and the line."""
    width = STROKE * scene_bounds(field).width
    angle = math.atan2(place[1] - ball[1], place[0] - ball[0])
    quarter, edge = math.pi / 2, palette.fade(color, EDGE)
    first, second = (angle + quarter, angle + 3 * quarter), (angle - quarter, angle + quarter)
    ends = ((ball, *first), (place, *second))
    outline = tuple(
        point for center, start, stop in ends for point in arc_points(center, radius, start, stop)
    )
    sides = tuple(
        Line(
            _at(ball, radius, angle + turn),
            _at(place, radius, angle + turn),
            width,
            edge,
        )
        for turn in (-quarter, quarter)
    )
    return (
        Polygon(outline, palette.fade(color, FILL)),
        *(Arc(center, radius, start, stop, width, edge) for center, start, stop in ends),
        *sides,
        Line(ball, place, width, palette.fade(color, 0.9)),
    )


def _at(center: Point, radius: float, angle: float) -> Point:
    """The point of a circle at an angle."""
    return center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)


def _position(field: Field, place: Point, color: Color) -> tuple[Shape, ...]:
    """A ring with four ticks."""
    picture_width = scene_bounds(field).width
    radius, width = POSITION_RADIUS * picture_width, STROKE * picture_width
    return (
        Arc(place, radius, 0.0, math.tau, width, color),
        *(
            Line(_at(place, radius, angle), _at(place, 1.6 * radius, angle), width, color)
            for angle in (0.0, math.pi / 2, math.pi, 3 * math.pi / 2)
        ),
    )


def may_touch_shapes(
    state: RefereeState, poses: Sequence[Pose | None], sizes: Sequence[float]
) -> tuple[Shape, ...]:
    """Return what shows who may touch the ball, where only some robots may.

    Args:
        state: state of the referee.
        poses: pose of each robot; None for an absent one.
        sizes: sizes of the robots, m.

    Returns:
        Before a kick, a light disc under each robot that may touch the ball. While the ball is in
        play, a ring around the robot that may not touch it again.
    """
    shapes: list[Shape] = []
    for pose, size, may_touch in zip(poses, sizes, state.may_touch, strict=True):
        radius = MAY_TOUCH_RADIUS * size
        if pose is None or may_touch == state.in_play:
            continue
        if may_touch:
            shapes.append(Circle(pose.center, radius, palette.fade(palette.WHITE, MAY_TOUCH)))
        else:
            shapes.append(Arc(pose.center, radius, 0.0, math.tau, 0.07 * size, palette.RED_CARD))
    return tuple(shapes)

"""Shapes over the picture for the person who plays: the driven robot, a status line and help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Arc, Point, Polygon, Shape, Text, rounded_rectangle

if TYPE_CHECKING:
    from rsoccer._core import Field, RobotModel

RING: Final = 0.72
"""Radius of the ring around the driven robot, in sizes of the robot."""
RING_WIDTH: Final = 0.0032
"""Width of that ring, as a fraction of the picture's width."""
TEXT: Final = 0.0125
"""Height of texts, as a fraction of the picture's width."""
LINE: Final = 2.1
"""Distance between lines of the help, in heights of the text."""
KEY_WIDTH: Final = 15.0
"""Width of the column of keys, in heights of the text."""
MEANING_WIDTH: Final = 26.0
"""Width of the column of meanings, in heights of the text."""

HelpLine = tuple[str, str]
"""Keys, and their meaning."""

_COMMON: Final[tuple[HelpLine, ...]] = (
    ("Tab, 0 to 9", "next robot, robot with that number"),
    ("P, N", "pause, one step while paused"),
    ("R", "new episode"),
    ("+, -", "faster, slower"),
    ("H, Esc", "help, leave"),
)
DIFFERENTIAL_HELP: Final[tuple[HelpLine, ...]] = (
    ("W S, Up Down", "forward, backward"),
    ("A D, Left Right", "turn left, turn right"),
    ("Shift", "slow"),
    *_COMMON,
)
"""Help for robots with a differential drive."""
OMNI_HELP: Final[tuple[HelpLine, ...]] = (
    ("W A S D, arrows", "move"),
    ("Q, E", "turn left, turn right"),
    ("Shift", "slow"),
    ("Space, C, X", "kick, pass, chip"),
    ("V", "dribbler on or off"),
    ("F", "move along the field or the robot"),
    *_COMMON,
)
"""Help for omnidirectional robots."""


def selection_shapes(field: Field, model: RobotModel, center: Point) -> tuple[Shape, ...]:
    """Return the ring around the driven robot.

    Args:
        field: the field.
        model: the robot.
        center: position of the robot, meters.

    Returns:
        One arc.
    """
    radius = RING * robot_outlines(model).size
    width = RING_WIDTH * scene_bounds(field).width
    return (Arc(center, radius, 0.0, math.tau, width, palette.SELECTED),)


def status_shapes(field: Field, left: Sequence[str], right: Sequence[str]) -> tuple[Shape, ...]:
    """Return texts on both sides of the score board.

    Args:
        field: the field.
        left: at most two lines on the left.
        right: at most two lines on the right.

    Returns:
        One text for each line.
    """
    bounds = scene_bounds(field)
    height = TEXT * bounds.width
    top = arena_bounds(field).top + 2.75 * height
    margin, width = 1.5 * height, 0.17 * bounds.width
    sides = ((left, bounds.left + margin, 0.0), (right, bounds.right - margin, 1.0))
    return tuple(
        Text((x, top - LINE * height * i), height, text, palette.MUTED, width, align)
        for texts, x, align in sides
        for i, text in enumerate(texts)
    )


def help_shapes(field: Field, lines: Sequence[HelpLine]) -> tuple[Shape, ...]:
    """Return a panel with the keys over the middle of the field.

    Args:
        field: the field.
        lines: keys and their meanings.

    Returns:
        Panel and texts.
    """
    height = TEXT * scene_bounds(field).width
    half_width = (KEY_WIDTH + MEANING_WIDTH) * height / 2
    half_height = (len(lines) + 1) * LINE * height / 2
    panel = rounded_rectangle(-half_width, -half_height, half_width, half_height, 1.2 * height)
    left = -half_width + 2.0 * height
    rows = [(half_height - (i + 1) * LINE * height, line) for i, line in enumerate(lines)]
    return (
        Polygon(panel, palette.CAPTION_BAND),
        *(Text((left, y), height, keys, palette.SELECTED, align=0.0) for y, (keys, _) in rows),
        *(
            Text((left + KEY_WIDTH * height, y), height, meaning, palette.WHITE, align=0.0)
            for y, (_, meaning) in rows
        ),
    )

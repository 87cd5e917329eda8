"""The board above the field: names of the sides, score and clock."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.shapes import Bounds, Point, Polygon, Shape, Text, arc_points, rounded_rectangle

if TYPE_CHECKING:
    from rsoccer._core import Field


@dataclass(frozen=True, slots=True)
class Board:
    """What a picture tells beside the field; each pair is blue's, then yellow's."""

    score: tuple[int, int] = (0, 0)  # goals
    clock: float = 0.0  # seconds of play
    names: tuple[str, str] = ("BLUE", "YELLOW")
    caption: str = ""  # large, over the field; none if empty


WIDTH = 0.6
"""Width of the board by the width of the picture."""
HEIGHT = 0.056
"""Height of the board by the width of the picture."""
SPACE = 0.014
"""Empty height above the board by the width of the picture."""
PLATE = 0.44
"""Half width of the dark plate in the middle, with score and clock, by half the board."""


def scene_bounds(field: Field) -> Bounds:
    """The arena with the board above it."""
    arena = arena_bounds(field)
    return Bounds(arena.left, arena.bottom, arena.right, arena.top + (HEIGHT + SPACE) * arena.width)


def draw_board(field: Field) -> tuple[Shape, ...]:
    """The empty board: a dark plate between the colours of the two sides."""
    at = _board(field)
    radius, edge = 0.22 * at.height, PLATE * at.right
    plate = rounded_rectangle(at.left, at.bottom, at.right, at.top, radius)
    yellow = _end_panel(edge, at.bottom, at.right, at.top, radius)
    blue = tuple((-x, y) for x, y in yellow)
    return (
        Polygon(plate, palette.BOARD),
        Polygon(blue, palette.BLUE),
        Polygon(yellow, palette.YELLOW),
    )


def draw_score(field: Field, board: Board) -> tuple[Shape, ...]:
    """What is written on the board: blue on the left, yellow on the right, the clock between."""
    at = _board(field)
    y, height, half = (at.top + at.bottom) / 2, at.height, at.right
    name_x, name_width = (1 + PLATE) / 2 * half, 0.86 * (1 - PLATE) * half
    goals_x, goals_width = 0.7 * PLATE * half, 0.45 * PLATE * half
    blue, yellow = (name.upper() for name in board.names)
    clock = clock_text(board.clock)
    return (
        Text((-name_x, y), 0.34 * height, blue, palette.WHITE, name_width),
        Text((-goals_x, y), 0.52 * height, str(board.score[0]), palette.WHITE, goals_width),
        Text((0.0, y), 0.34 * height, clock, palette.MUTED, 0.6 * PLATE * half),
        Text((goals_x, y), 0.52 * height, str(board.score[1]), palette.WHITE, goals_width),
        Text((name_x, y), 0.34 * height, yellow, palette.INK, name_width),
    )


def draw_caption(field: Field, caption: str) -> tuple[Shape, ...]:
    """A word across the middle of the field, on a dark band that lets the play through."""
    if not caption:
        return ()
    half_length, half_height = 0.45 * field.half_length, 0.11 * field.half_width
    plate = rounded_rectangle(
        -half_length, -half_height, half_length, half_height, 0.3 * half_height
    )
    text = Text((0.0, 0.0), 0.9 * half_height, caption.upper(), palette.WHITE, 1.8 * half_length)
    return (Polygon(plate, palette.VEIL), text)


def clock_text(clock: float) -> str:
    """Minutes and whole seconds of play, such as 1:05."""
    # A sum of float time steps falls a hair short of the second it stands for.
    minutes, seconds = divmod(int(clock + 1e-6), 60)
    return f"{minutes}:{seconds:02d}"


def _end_panel(
    left: float, bottom: float, right: float, top: float, radius: float
) -> tuple[Point, ...]:
    """A rectangle whose two corners on the right are round."""
    quarter = math.pi / 2
    lower, upper = (right - radius, bottom + radius), (right - radius, top - radius)
    return (
        (left, top),
        (left, bottom),
        *arc_points(lower, radius, -quarter, 0.0),
        *arc_points(upper, radius, 0.0, quarter),
    )


def _board(field: Field) -> Bounds:
    """Where the board is: centred above the arena."""
    arena = arena_bounds(field)
    half = WIDTH * arena.width / 2
    return Bounds(-half, arena.top, half, arena.top + HEIGHT * arena.width)

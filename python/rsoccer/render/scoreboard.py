"""The score board above the field: names of the teams, score and clock."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.shapes import Bounds, Point, Polygon, Shape, Text, arc_points, rounded_rectangle
from rsoccer.render.words import NOTHING, Words

if TYPE_CHECKING:
    from rsoccer._core import Field
    from rsoccer.render.referee_state import RefereeState


@dataclass(frozen=True, slots=True)
class Board:
    """Texts of a picture; pairs are blue's, then yellow's.

    Attributes:
        score: goals.
        clock: seconds of play.
        names: names of the teams.
        caption: large text over the field; none if empty.
        referee: state of the referee, which has score and clock of its own; None without one.
        announcement: what has just happened; shown with a referee.
    """

    score: tuple[int, int] = (0, 0)
    clock: float = 0.0
    names: tuple[str, str] = ("BLUE", "YELLOW")
    caption: str = ""
    referee: RefereeState | None = None
    announcement: Words = NOTHING


GOAL_PAUSE = 0.8
"""Seconds of still picture at a goal or the end of a match."""
WIDTH = 0.6
"""Width of the board, as a fraction of the picture's width."""
HEIGHT = 0.056
"""Height of the board, as a fraction of the picture's width."""
SPACE = 0.014
"""Empty height above the board and under the ticker, as a fraction of the picture's width."""
TICKER_HEIGHT = 0.04
"""Height of the ticker under the arena, as a fraction of the picture's width."""
PLATE = 0.44
"""Half width of the dark plate in the middle, with score and clock, as a fraction of half the
board's width."""


def scene_bounds(field: Field, *, ticker: bool = False) -> Bounds:
    """Return the bounds of a picture: the arena with the board above it.

    Args:
        field: the field.
        ticker: whether there is a ticker under the arena, as in matches with a referee.

    Returns:
        The rectangle, meters.
    """
    arena = arena_bounds(field)
    bottom = arena.bottom - (TICKER_HEIGHT + SPACE) * arena.width * ticker
    return Bounds(arena.left, bottom, arena.right, arena.top + (HEIGHT + SPACE) * arena.width)


def board_shapes(field: Field) -> tuple[Shape, ...]:
    """Return the empty board: a dark plate between the colors of the teams.

    Args:
        field: the field.

    Returns:
        The plate and its two colored ends.
    """
    bounds = board_bounds(field)
    radius, edge = 0.22 * bounds.height, PLATE * bounds.right
    plate = rounded_rectangle(bounds.left, bounds.bottom, bounds.right, bounds.top, radius)
    yellow = _end_panel(edge, bounds.bottom, bounds.right, bounds.top, radius)
    blue = tuple((-x, y) for x, y in yellow)
    return (
        Polygon(plate, palette.BOARD),
        Polygon(blue, palette.BLUE),
        Polygon(yellow, palette.YELLOW),
    )


def score_shapes(field: Field, board: Board) -> tuple[Shape, ...]:
    """Return the texts on the board: blue on the left, yellow on the right, the clock between.

    Args:
        field: the field.
        board: the texts.

    Returns:
        Names, goals and clock.
    """
    bounds = board_bounds(field)
    y, height, half = (bounds.top + bounds.bottom) / 2, bounds.height, bounds.right
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


def caption_shapes(field: Field, caption: str) -> tuple[Shape, ...]:
    """Return a word across the middle of the field, on a dark translucent band.

    Args:
        field: the field.
        caption: the word.

    Returns:
        Band and text; nothing for an empty caption.
    """
    if not caption:
        return ()
    half_length, half_height = 0.45 * field.half_length, 0.11 * field.half_width
    plate = rounded_rectangle(
        -half_length, -half_height, half_length, half_height, 0.3 * half_height
    )
    text = Text((0.0, 0.0), 0.9 * half_height, caption.upper(), palette.WHITE, 1.8 * half_length)
    return (Polygon(plate, palette.CAPTION_BAND), text)


def caption_of(referee: RefereeState | None, *, scored: bool) -> str:
    """Return the caption of a step, which a film shows for a moment.

    Args:
        referee: state of the referee, if there is one.
        scored: whether there was a goal.

    Returns:
        The caption; empty for none.
    """
    if scored:
        return "goal"
    return "full time" if referee is not None and referee.is_over else ""


def clock_text(clock: float) -> str:
    """Return a time of play as minutes and whole seconds.

    Args:
        clock: seconds of play.

    Returns:
        Text such as "1:05".
    """
    # A sum of time steps in floating point falls slightly short of a whole second.
    minutes, seconds = divmod(int(clock + 1e-6), 60)
    return f"{minutes}:{seconds:02d}"


def _end_panel(
    left: float, bottom: float, right: float, top: float, radius: float
) -> tuple[Point, ...]:
    """A rectangle with round corners on the right."""
    quarter = math.pi / 2
    lower, upper = (right - radius, bottom + radius), (right - radius, top - radius)
    return (
        (left, top),
        (left, bottom),
        *arc_points(lower, radius, -quarter, 0.0),
        *arc_points(upper, radius, 0.0, quarter),
    )


def board_bounds(field: Field) -> Bounds:
    """Return the bounds of the board: centered above the arena.

    Args:
        field: the field.
    """
    arena = arena_bounds(field)
    half = WIDTH * arena.width / 2
    return Bounds(-half, arena.top, half, arena.top + HEIGHT * arena.width)

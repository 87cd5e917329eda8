"""The ticker under the field of a match with a referee: the command, and what has just happened."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from rsoccer.game import BLUE, YELLOW
from rsoccer.render import palette
from rsoccer.render.pitch import arena_bounds
from rsoccer.render.scoreboard import TICKER_HEIGHT
from rsoccer.render.shapes import Color, Polygon, Shape, Text, rectangle, rounded_rectangle

if TYPE_CHECKING:
    from rsoccer._core import Field
    from rsoccer.render.words import Words

WIDTH: Final = 0.38
"""Width of a plate, as a fraction of the picture's width."""
GAP: Final = 0.012
"""Width between the plates, in the same fraction."""

TEAM_COLORS: Final[dict[int, Color]] = {BLUE: palette.BLUE, YELLOW: palette.YELLOW}
"""Colors of the teams; what is about no team is `palette.MUTED`."""


def ticker_shapes(field: Field, command: Words, announcement: Words) -> tuple[Shape, ...]:
    """Return both plates: the command on the left, the announcement on the right.

    Args:
        field: the field.
        command: command of the referee in words.
        announcement: what has just happened, in words.

    Returns:
        A plate for each that has a text, with a bar in the color of the team.
    """
    arena = arena_bounds(field)
    width, gap = WIDTH * arena.width, GAP * arena.width
    return (
        *_plate(field, -gap / 2 - width, command),
        *_plate(field, gap / 2, announcement),
    )


def _plate(field: Field, left: float, words: Words) -> tuple[Shape, ...]:
    """A dark plate with a bar and a text."""
    if not words.text:
        return ()
    arena = arena_bounds(field)
    height, right = TICKER_HEIGHT * arena.width, left + WIDTH * arena.width
    top = arena.bottom
    bottom, bar = top - height, 0.2 * height
    text_left = left + bar + 0.45 * height
    return (
        Polygon(rounded_rectangle(left, bottom, right, top, 0.16 * height), palette.BOARD),
        Polygon(
            rectangle(left, bottom, left + bar, top), TEAM_COLORS.get(words.team, palette.MUTED)
        ),
        Text(
            (text_left, (top + bottom) / 2),
            0.36 * height,
            words.text,
            palette.WHITE,
            right - text_left - 0.35 * height,
            align=0.0,
        ),
    )

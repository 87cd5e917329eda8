"""The score board of a match with a referee: half and clock, cards, robots on the field."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from rsoccer.game import BLUE, YELLOW
from rsoccer.render import palette
from rsoccer.render.scoreboard import PLATE, board_bounds, clock_text
from rsoccer.render.shapes import (
    Bounds,
    Circle,
    Color,
    Polygon,
    Shape,
    Text,
    rectangle,
    rounded_rectangle,
)
from rsoccer.render.words import has_clock, stage_text

if TYPE_CHECKING:
    from rsoccer._core import Field
    from rsoccer.render.referee_state import RefereeState
    from rsoccer.render.scoreboard import Board

PIP: Final = 0.085
"""Radius of the mark of a robot, in heights of the board."""
PIP_DISTANCE: Final = 0.235
"""Distance between the marks of two robots, in heights of the board."""
PIPS_WIDTH: Final = 1.9
"""Largest width of all marks of a team, in heights of the board."""
CARD_WIDTH, CARD_HEIGHT = 0.24, 0.31
"""Size of a card, in heights of the board."""
CARD_DISTANCE: Final = 0.36
"""Distance between two cards, in heights of the board."""
CARD_GAP: Final = 0.08
"""Width between robots and cards, in heights of the board."""
ROW: Final = 0.27
"""Height of the middle of the lower row, in heights of the board."""

_INKS: Final[tuple[Color, Color]] = (palette.WHITE, palette.INK)


def match_board_shapes(
    field: Field, board: Board, state: RefereeState, present: Sequence[Sequence[bool]]
) -> tuple[Shape, ...]:
    """Return the texts and marks on the board.

    Args:
        field: the field.
        board: names of the teams.
        state: state of the referee.
        present: for each robot of blue and of yellow, whether it is on the field.

    Returns:
        Part of the match, clock, goals; for each team its name, robots and cards.
    """
    bounds = board_bounds(field)
    return (
        *_middle(bounds, state),
        *_team(bounds, BLUE, board.names[BLUE], state, present[BLUE]),
        *_team(bounds, YELLOW, board.names[YELLOW], state, present[YELLOW]),
    )


def _middle(bounds: Bounds, state: RefereeState) -> tuple[Shape, ...]:
    """Goals of both teams, and part of the match and clock between them."""
    height, half = bounds.height, bounds.right
    y, x, width = (bounds.top + bounds.bottom) / 2, 0.76 * PLATE * half, 0.4 * PLATE * half
    between = 1.0 * PLATE * half
    stage = stage_text(state).upper()
    texts = [
        Text((-x, y), 0.52 * height, str(state.score[BLUE]), palette.WHITE, width),
        Text((x, y), 0.52 * height, str(state.score[YELLOW]), palette.WHITE, width),
    ]
    if has_clock(state):
        # The last second ends at 0:00.
        clock = clock_text(max(0, math.ceil(state.seconds_left - 1e-3)))
        lower, upper = bounds.bottom + 0.33 * height, bounds.bottom + 0.75 * height
        texts += [
            Text((0.0, upper), 0.19 * height, stage, palette.MUTED, between),
            Text((0.0, lower), 0.32 * height, clock, palette.WHITE, between),
        ]
    else:
        texts.append(Text((0.0, y), 0.25 * height, stage, palette.MUTED, between))
    return tuple(texts)


def _team(
    bounds: Bounds, team: int, name: str, state: RefereeState, present: Sequence[bool]
) -> tuple[Shape, ...]:
    """Name, robots and cards of a team, on its end of the board."""
    height, half = bounds.height, bounds.right
    middle = (1 + PLATE) / 2 * half
    ink, sign = _INKS[team], -1 if team == BLUE else 1
    name_width = 0.86 * (1 - PLATE) * half
    y = bounds.bottom + ROW * height
    cards = _cards(state, team)
    pips = min(PIP_DISTANCE, PIPS_WIDTH / max(len(present), 1)) * height
    card, gap = CARD_DISTANCE * height, bool(cards) * CARD_GAP * height
    pips_width, cards_width = len(present) * pips, len(cards) * card
    left = sign * middle - (pips_width + gap + cards_width) / 2
    # Cards are next to the plate in the middle of the board.
    pips_left, cards_left = left, left + pips_width + gap
    if team == YELLOW:
        pips_left, cards_left = left + cards_width + gap, left
    return (
        Text(
            (sign * middle, bounds.bottom + 0.7 * height),
            0.27 * height,
            name.upper(),
            ink,
            name_width,
        ),
        *(
            Circle(
                (pips_left + (i + 0.5) * pips, y),
                PIP * height,
                ink if is_present else palette.fade(ink, 0.3),
            )
            for i, is_present in enumerate(present)
        ),
        *(
            shape
            for i, (color, number_color, count) in enumerate(cards)
            for shape in _card(cards_left + (i + 0.5) * card, y, height, color, number_color, count)
        ),
    )


def _cards(state: RefereeState, team: int) -> list[tuple[Color, Color, int]]:
    """Color of the card, color of the number and number of cards, for each kind that was given."""
    yellow, red = state.yellow_cards[team], state.red_cards[team]
    kinds = (
        (palette.YELLOW_CARD, palette.INK, yellow),
        (palette.RED_CARD, palette.WHITE, red),
    )
    return [kind for kind in kinds if kind[2]]


def _card(
    x: float, y: float, height: float, color: Color, number_color: Color, count: int
) -> tuple[Shape, ...]:
    """A card with an edge, and the number of such cards on it."""
    half_width, half_height = CARD_WIDTH / 2 * height, CARD_HEIGHT / 2 * height
    edge = 0.03 * height
    outer = rounded_rectangle(
        x - half_width - edge,
        y - half_height - edge,
        x + half_width + edge,
        y + half_height + edge,
        2 * edge,
    )
    inner = rectangle(x - half_width, y - half_height, x + half_width, y + half_height)
    return (
        Polygon(outer, palette.INK),
        Polygon(inner, color),
        Text((x, y), 0.6 * CARD_HEIGHT * height, str(count), number_color, 0.8 * 2 * half_width),
    )

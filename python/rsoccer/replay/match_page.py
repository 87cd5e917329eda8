"""Further content of the page of a match with a referee: words, colors and marks by frame.

All words are made here, as for pictures; the page only chooses those of a frame.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final

from rsoccer._core import Field
from rsoccer.render.referee_floor import (
    AREA_TINT,
    EDGE,
    FILL,
    MAY_TOUCH,
    TEAM_COLORS,
    area_outlines,
    floor_marks,
)
from rsoccer.render.referee_state import RefereeState
from rsoccer.render.words import (
    FOULS,
    PROMINENT,
    Words,
    command_words,
    event_texts,
    has_clock,
    side_of,
    stage_text,
)
from rsoccer.replay.recorded import Recorded

DETAILS: Final = ("touch", "kick", "pass", "placement_succeeded", "end")
"""Kinds of events that the list shows on request only."""
FLOOR: Final[dict[str, Any]] = {
    "opacity": {"area": AREA_TINT, "fill": FILL, "edge": EDGE, "mayTouch": MAY_TOUCH},
    "markColors": {side_of(team): color[:3] for team, color in TEAM_COLORS.items()},
}
"""Looks of the referee's marks on the floor, as values for JSON."""


def match(replay: Recorded) -> dict[str, Any] | None:
    """Return the further content of the page; None without a referee.

    Lists by frame hold a frame and the values from there on.

    Args:
        replay: the replay.

    Returns:
        Values for JSON.
    """
    states = replay.referee_states
    if states is None:
        return None
    return {
        "commands": _changes(_words(command_words(state)) for state in states),
        "announcements": _changes(_words(words) for words in replay.announcements),
        "stages": _changes((stage_text(state), has_clock(state)) for state in states),
        "marks": _changes(map(_marks, states)),
        "texts": event_texts(replay.config.field),
        "fouls": FOULS,
        "prominent": PROMINENT,
        "details": DETAILS,
        "areas": areas(replay.config.field),
        **FLOOR,
    }


def areas(field: Field) -> list[list[float]]:
    """Return the outlines of the areas that the page tints, for JSON.

    Args:
        field: the field.

    Returns:
        For each area x and y of its points in turn, m.
    """
    outlines = area_outlines(field)
    return [[round(v, 4) for point in outline for v in point] for outline in outlines]


def _changes(values: Iterable[tuple[Any, ...]]) -> list[list[Any]]:
    """Frames at which values change, each with the values from there on."""
    changes: list[list[Any]] = []
    for frame, value in enumerate(values):
        if not changes or changes[-1][1:] != [*value]:
            changes.append([frame, *value])
    return changes


def _words(words: Words) -> tuple[str, str]:
    """A text and the team that it is about."""
    return words.text, side_of(words.team)


def _marks(state: RefereeState) -> tuple[str, str, str | None]:
    """Floor that robots keep off, team for which they do, team of the next kick."""
    marks = floor_marks(state)
    return marks.kept_off, side_of(marks.team), None if marks.kick is None else side_of(marks.kick)

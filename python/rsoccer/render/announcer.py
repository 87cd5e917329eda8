"""Announcements of events: what has just happened, for a moment, the most important first."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

from rsoccer import game
from rsoccer.game import NOBODY
from rsoccer.render.words import (
    NOTHING,
    PROMINENT,
    Words,
    announced,
    announcement,
    event_name,
    side_of,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rsoccer._core import Field
    from rsoccer.task import Task

SECONDS: Final = 2.5
"""Seconds for which an event is announced."""
Named = tuple[str, str, str]
"""Name, robot and detail of an event, as `announcement` takes them."""


class Announcer:
    """Announcements of a match, from its events in the order of time.

    A goal or a card stays for its whole time; other events give way to later ones. An earlier time
    begins anew.
    """

    def __init__(self, field: Field) -> None:
        """Prepare for a match that has not begun.

        Args:
            field: field of the match.
        """
        self._field = field
        self.clear()

    def clear(self) -> None:
        """Forget all events, as before the first step of an episode."""
        self._words = NOTHING
        self._clock = self._until = 0.0
        self._is_prominent = False

    def update(self, events: Iterable[Named], clock: float) -> Words:
        """Return the announcement after a step.

        Args:
            events: events of the step.
            clock: seconds of play.

        Returns:
            Words and the team that they are about; no text for none.
        """
        if not self._clock <= clock < self._until:
            self.clear()
        self._clock = clock
        for name, robot, detail in events:
            words = announcement(self._field, name, robot, detail)
            is_prominent = name in PROMINENT
            if words.text and (is_prominent or not self._is_prominent):
                self._words, self._is_prominent = words, is_prominent
                self._until = clock + SECONDS
        return self._words


def named_events(task: Task, events: Sequence[game.Event]) -> list[Named]:
    """Return the events of a step as an `Announcer` takes them.

    Args:
        task: the task that is played.
        events: events of the step, as `Events.of_world` returns them.
    """
    return [
        (
            event_name(event.kind),
            "" if event.robot == NOBODY else task.robots[event.robot],
            side_of(event.team),
        )
        for event in announced(events)
    ]

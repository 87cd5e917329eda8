"""Packets of the referee of a served match: those of the game controller or of VSSReferee."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

import numpy as np

from rsoccer._core import GAME_COLUMNS
from rsoccer.bridge.session import Datagram, Session
from rsoccer.game import Command, Stage
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import TEAM_NAMES
from rsoccer.protocols.referee_state import status_of_game

PERIOD: Final = 0.025
"""Simulated time between packets of the game controller, s; its own are sent at 39.5 Hz."""
VSS_PERIOD: Final = 0.5
"""Simulated time between packets of VSSReferee that repeat its command, s."""
_WATCHED: Final = np.array(
    [
        GAME_COLUMNS.index(name)
        for name in ("command", "stage", "next_command", "score_blue", "score_yellow", "in_play")
    ]
)
"""Columns whose change is reported at once."""
_IN_PLAY: Final = GAME_COLUMNS.index("in_play")
_STEPS: Final = GAME_COLUMNS.index("command_steps")


class Officials(ABC):
    """Packets of the referee of a match."""

    def __init__(self, session: Session) -> None:
        """Begin before the first packet.

        Args:
            session: the match.
        """
        self._session = session

    def datagrams(self) -> list[Datagram]:
        """Return what the referee tells after a tick; nothing without a referee of its own."""
        if self._session.arena.referee is None:
            return []
        return [Datagram("referee", data) for data in self.packets()]

    @abstractmethod
    def packets(self) -> list[bytes]:
        """Return the packets that are due after a tick: none or one."""


class GameController(Officials):
    """Packets of the SSL's game controller: on time, and at once when something happens."""

    def __init__(self, session: Session) -> None:
        """Begin before the first packet.

        Args:
            session: the match.
        """
        super().__init__(session)
        self._stamper, self._events = referee.Stamper(), referee.EventLog()
        self._next = 0.0
        self._last: list[float] | None = None
        self._steps = 0.0

    def packets(self) -> list[bytes]:
        """Return the packets that are due after a tick: none or one."""
        session, arena = self._session, self._session.arena
        play, seconds = arena.play, arena.seconds
        has_events = bool(play.events.count[0])
        row = play.game.referee[0]
        state, steps = row.take(_WATCHED).tolist(), float(row[_STEPS])
        # As after a robot that was too close to a kick, whose team gets its time once more.
        again, self._steps = steps < self._steps, steps
        if state == self._last and not again and not has_events and seconds < self._next:
            return []
        game, happened = play.game, play.events.of_world(0)
        command, wire_time = Command(int(state[0])), session.epoch + seconds
        in_play = bool(row[_IN_PLAY])
        reported = self._events.add(command, happened, wire_time, in_play=in_play)
        self._last, self._next = state, seconds + PERIOD - 1e-9
        status = status_of_game(
            session.layout, game, 0, arena.rule.rules, names=_names(session), events=reported
        )
        stamp = self._stamper.stamp(command, wire_time, again=again)
        try:
            packet = referee.to_packet(
                session.layout, status, stamp, source_identifier=session.identity
            )
        except MessageError:
            session.counts["referee: untold"] += 1
            return []
        return [packet.SerializeToString()]


class VssReferee(Officials):
    """Packets of VSSReferee: when the command changes, and repeated."""

    def __init__(self, session: Session) -> None:
        """Begin before the first packet.

        Args:
            session: the match.
        """
        super().__init__(session)
        self._next = 0.0
        self._last: tuple[int, int] | None = None

    def packets(self) -> list[bytes]:
        """Return the packets that are due after a tick: none or one."""
        session, arena = self._session, self._session.arena
        game, seconds = arena.play.game, arena.seconds
        state = int(game.command[0]), int(game.stage[0])
        if state == self._last and seconds < self._next:
            return []
        self._last, self._next = state, seconds + VSS_PERIOD - 1e-9
        x, y = game.designated_position[0].tolist()
        try:
            packet = vssref.to_command(
                session.layout,
                Command(state[0]),
                Stage(state[1]),
                timestamp=session.epoch + seconds,
                position=(x, y),
            )
        except MessageError:
            session.counts["referee: untold"] += 1
            return []
        return [packet.SerializeToString()]


def _names(session: Session) -> tuple[str, str]:
    """Names of the teams: those of their policies, or of their colors."""
    given = (session.settings.blue, session.settings.yellow)
    blue, yellow = (
        color.capitalize() if policy is None else policy
        for color, policy in zip(TEAM_NAMES, given, strict=True)
    )
    return blue, yellow

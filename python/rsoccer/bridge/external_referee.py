"""A match under a referee on the network: policies and pictures see what its packets tell."""

from __future__ import annotations

from rsoccer.arrays import Floats
from rsoccer.bridge.match_tasks import TICK
from rsoccer.bridge.session import Session
from rsoccer.protocols.limits import Limits, stopped
from rsoccer.protocols.reported_referee import ReportedReferee
from rsoccer.protocols.restraint import must_stand, restrained


class ExternalReferee:
    """Obeys packets of a game controller or of VSSReferee.

    The match is as it says: command, stage, score, cards, and who may touch the ball. Robots of
    policies do what it allows, whatever rules the policies know. Teams' software hears it by
    itself; robots of clients are not stopped here.
    """

    def __init__(self, session: Session) -> None:
        """Begin before the first packet.

        Args:
            session: the match.
        """
        self._session = session
        self._reported = ReportedReferee(session.arena.rule.rules)
        session.stand_ins.restrain = self._restrain

    @property
    def is_heard(self) -> bool:
        """True once a packet with a command has come."""
        return self._reported.state.command is not None

    def receive(self, data: bytes) -> None:
        """Take in a packet.

        Args:
            data: its bytes.

        Raises:
            ValueError: the bytes are no packet of the league's referee, a
                `rsoccer.protocols.errors.MessageError`.
        """
        session, reported = self._session, self._reported
        refused = reported.refused.total()
        reported.receive(session.layout, data)
        # Vision and commands keep the side of the start, and so do positions here.
        side = reported.blue_on_positive_half
        is_other = side is not None and side != session.layout.blue_on_positive_half
        session.counts["referee: blue on the other half"] += is_other
        session.counts["referee: parts refused"] += reported.refused.total() - refused
        self._write()

    def advance(self) -> None:
        """Take note of a tick: the time of the command, and whether the ball is in play now."""
        x, y = self._session.arena.frame.ball.position[0].tolist()
        self._reported.advance((x, y), TICK)
        self._write()

    def _restrain(self, commands: Floats) -> Floats:
        """Commands of policies that are allowed."""
        session, state = self._session, self._reported.state
        if state.command is None or must_stand(state, is_vsss=session.settings.league == "vsss"):
            return stopped(commands)
        if session.settings.league == "vsss":
            return commands
        arena = session.arena
        return restrained(arena.config, state, commands, arena.frame, Limits().stop_speed)

    def _write(self) -> None:
        arena = self._session.arena
        self._reported.write(arena.play.game, arena.config.n_blue)

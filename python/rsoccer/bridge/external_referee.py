"""A match under a referee on the network: policies and pictures see what its packets tell."""

from __future__ import annotations

from rsoccer._core import GAME_COLUMNS
from rsoccer.bridge.match_tasks import TICK
from rsoccer.bridge.session import Session
from rsoccer.game import NOBODY, Command, Game
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.ball_in_play import BallInPlay
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import referee_pb2, vssref_pb2


class ExternalReferee:
    """Obeys packets of a game controller or of VSSReferee.

    The match is as it says: command, stage, score, cards, and who may touch the ball. Teams'
    software hears it by itself; nobody's robots are stopped here.
    """

    def __init__(self, session: Session) -> None:
        """Begin before the first packet.

        Args:
            session: the match.
        """
        self._session = session
        self._state = BallInPlay(session.arena.rule.rules)

    def receive(self, data: bytes) -> None:
        """Take in a packet.

        Args:
            data: its bytes.

        Raises:
            ValueError: the bytes are no packet of the league's referee, a
                `rsoccer.protocols.errors.MessageError`.
        """
        session = self._session
        game = session.arena.play.game
        if session.settings.league == "vsss":
            reported = vssref.read_command(parse(vssref_pb2.Command, data))
            self._command(game, reported.command)
            if reported.stage is not None:
                _set(game, "stage", reported.stage)
            return
        message = parse(referee_pb2.Packet, data)
        if message.blue_team_on_positive_half != session.layout.blue_on_positive_half:
            # Vision and commands keep the side of the start, and so do positions here.
            known = message.HasField("blue_team_on_positive_half")
            session.counts["referee: blue on the other half"] += known
        message.ClearField("blue_team_on_positive_half")
        status, problems = referee.read_packet(session.layout, message)
        session.counts["referee: parts refused"] += len(problems)
        self._command(game, status.command)
        _set(game, "stage", status.stage)
        following = NOBODY if status.next_command is None else status.next_command
        _set(game, "next_command", following)
        for team in TEAMS:
            reported_team = status.teams[team]
            game.score[0, team] = reported_team.score
            _set(game, f"score_{TEAM_NAMES[team]}", reported_team.score)
            game.yellow_cards[0, team] = reported_team.yellow_cards
            game.red_cards[0, team] = reported_team.red_cards
        if status.seconds_left is not None:
            game.seconds_left[0] = status.seconds_left
        if status.designated_position is not None:
            game.designated_position[0] = status.designated_position

    def advance(self) -> None:
        """Take note of a tick: the time of the command, and whether the ball is in play now."""
        arena, state = self._session.arena, self._state
        state.steps += 1
        x, y = arena.frame.ball.position[0].tolist()
        state.judge((x, y), TICK)
        self._write(arena.play.game)

    def _command(self, game: Game, command: Command) -> None:
        self._state.give(command)
        self._write(game)

    def _write(self, game: Game) -> None:
        """Write the state into that of the match."""
        state = self._state
        if state.command is None:
            return
        _set(game, "command", state.command)
        _set(game, "command_steps", float(state.steps))
        _set(game, "in_play", float(state.in_play))
        if state.kick is not None:
            _set(game, "kick", state.kick)
        if state.kick_position is not None:
            game.kick_position[0] = state.kick_position
        for team in TEAMS:
            slots = self._session.layout.slots(team)
            game.may_touch[0, slots.start : slots.stop] = state.may_touch(team)


def _set(game: Game, name: str, value: float) -> None:
    game.referee[0, GAME_COLUMNS.index(name)] = value

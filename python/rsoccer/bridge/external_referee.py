"""A match under a referee on the network: policies and pictures see what its packets tell."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer._core import GAME_COLUMNS
from rsoccer.arrays import Mask
from rsoccer.bridge.session import Session
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, Game
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import referee_pb2, vssref_pb2

_RUNNING: Final = (Command.NORMAL_START, Command.FORCE_START)
_OF_TEAM: Final = {
    Command.PREPARE_KICKOFF_BLUE: BLUE,
    Command.PREPARE_PENALTY_BLUE: BLUE,
    Command.DIRECT_FREE_BLUE: BLUE,
    Command.BALL_PLACEMENT_BLUE: BLUE,
    Command.GOAL_KICK_BLUE: BLUE,
    Command.PREPARE_KICKOFF_YELLOW: YELLOW,
    Command.PREPARE_PENALTY_YELLOW: YELLOW,
    Command.DIRECT_FREE_YELLOW: YELLOW,
    Command.BALL_PLACEMENT_YELLOW: YELLOW,
    Command.GOAL_KICK_YELLOW: YELLOW,
}
_ALLOWS_TOUCH: Final = (
    *(Command.DIRECT_FREE_BLUE, Command.DIRECT_FREE_YELLOW),
    *(Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW),
)


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
            # Vision and commands keep the side that the server began with, and so do positions here.
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

    def _command(self, game: Game, command: Command) -> None:
        if int(game.command[0]) != command:
            _set(game, "command_steps", 0.0)
            team = _OF_TEAM.get(command, NOBODY)
            if team != NOBODY:
                _set(game, "kick", command)
        _set(game, "command", command)
        _set(game, "in_play", float(command in _RUNNING))
        game.may_touch[0] = self._may_touch(command)

    def _may_touch(self, command: Command) -> Mask:
        """Robots that may touch the ball."""
        config = self._session.arena.config
        allowed = np.zeros(config.n_robots, np.bool_)
        if command in _RUNNING:
            allowed[:] = True
        elif command in _ALLOWS_TOUCH:
            slots = self._session.layout.slots(_OF_TEAM[command])
            allowed[slots.start : slots.stop] = True
        return allowed


def _set(game: Game, name: str, value: float) -> None:
    game.referee[0, GAME_COLUMNS.index(name)] = value

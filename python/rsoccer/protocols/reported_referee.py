"""A match under a referee on the network: what its packets tell, and what follows from the ball."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Final

from rsoccer._core import GAME_COLUMNS
from rsoccer.game import BLUE, NOBODY, Command, Game, Stage
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.ball_in_play import BallInPlay
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS, WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.referee import RefereeStatus
from rsoccer.protocols.schemas import referee_pb2, vssref_pb2
from rsoccer.rules.referee_config import RefereeConfig

_EXCHANGED: Final = {
    command: Command[
        command.name.replace("BLUE", "X").replace("YELLOW", "BLUE").replace("X", "YELLOW")
    ]
    for command in Command
}
"""Commands with the colors exchanged."""


class ReportedReferee:
    """The state of a game controller or of VSSReferee.

    Attributes:
        state: command, kick and whether the ball is in play.
        stage: part of the match; None before it is known.
        status: the newest state of a game controller; None for VSSReferee and before its first.
        blue_on_positive_half: side of the robots that are blue on the wire; None if it is unknown.
        refused: parts of packets that are not honored.
    """

    def __init__(self, rules: RefereeConfig) -> None:
        """Begin before the first packet.

        Args:
            rules: rules of the match.
        """
        self.state = BallInPlay(rules)
        self.stage: Stage | None = None
        self.status: RefereeStatus | None = None
        self.blue_on_positive_half: bool | None = None
        self.refused: Counter[str] = Counter()
        self._counter: int | None = None
        self._is_vsss = rules.preset.startswith("vsss")

    def receive(self, layout: WireLayout, data: bytes) -> None:
        """Take in a packet.

        Args:
            layout: the match. Places are those of its side, whatever side a packet tells.
            data: the bytes.

        Raises:
            ValueError: no packet of the league's referee, a `MessageError`.
        """
        if self._is_vsss:
            reported = vssref.read_command(parse(vssref_pb2.Command, data))
            self.stage = reported.stage or self.stage
            self._give(layout, reported.command)
            return
        message = parse(referee_pb2.Packet, data)
        if message.HasField("blue_team_on_positive_half"):
            self.blue_on_positive_half = message.blue_team_on_positive_half
            message.ClearField("blue_team_on_positive_half")
        status, problems = referee.read_packet(layout, message)
        self.refused.update(str(problem.code) for problem in problems)
        if layout.colors_exchanged:
            following = status.next_command
            status = replace(
                status,
                teams=status.teams[::-1],
                next_command=None if following is None else _EXCHANGED[following],
            )
        self.status, self.stage = status, status.stage
        last, self._counter = self._counter, referee.read_stamp(message).command_counter
        self._give(layout, status.command, again=last is not None and last != self._counter)

    def _give(self, layout: WireLayout, command: Command, *, again: bool = False) -> None:
        exchanged = _EXCHANGED[command] if layout.colors_exchanged else command
        self.state.give(exchanged, again=again)

    def advance(self, ball: tuple[float, float], seconds: float) -> None:
        """Take note of a step: the time of the command, and whether the ball is in play now.

        Args:
            ball: place of the ball, x and y, m.
            seconds: duration of a step, s; the same in each call.
        """
        self.state.steps += 1
        self.state.judge(ball, seconds)

    def write(self, game: Game, n_blue: int) -> None:
        """Write what is known into the state of a match.

        Args:
            game: state of a match with a referee, of one world.
            n_blue: number of blue robots in a state row.
        """
        if self.stage is not None:
            _set(game, "stage", self.stage)
        if self.status is not None:
            _write_status(game, self.status)
        state = self.state
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
            slots = slice(n_blue) if team == BLUE else slice(n_blue, None)
            game.may_touch[0, slots] = state.may_touch(team)


def _write_status(game: Game, status: RefereeStatus) -> None:
    """Write the state of a game controller into that of a match."""
    following = NOBODY if status.next_command is None else status.next_command
    _set(game, "next_command", following)
    for team in TEAMS:
        reported = status.teams[team]
        game.score[0, team] = reported.score
        _set(game, f"score_{TEAM_NAMES[team]}", reported.score)
        game.yellow_cards[0, team] = reported.yellow_cards
        game.red_cards[0, team] = reported.red_cards
    if status.seconds_left is not None:
        game.seconds_left[0] = max(0.0, status.seconds_left)  # it is negative in overtime
    if status.designated_position is not None:
        game.designated_position[0] = status.designated_position


def _set(game: Game, name: str, value: float) -> None:
    game.referee[0, GAME_COLUMNS.index(name)] = value

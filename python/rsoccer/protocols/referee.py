"""Packets of the game controller: the state of the referee, and what a packet tells of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final, NamedTuple

from rsoccer import game
from rsoccer.game import BLUE, YELLOW, Command, Stage
from rsoccer.protocols.errors import Code, MessageError, Problem
from rsoccer.protocols.game_events import ReportedEvent, read_game_event, to_game_event
from rsoccer.protocols.layout import MICROSECONDS, MILLIMETERS, WireLayout
from rsoccer.protocols.schemas import referee_pb2

NAMES: Final = ("Blue", "Yellow")
"""Names of the teams where none are given."""
MAX_COUNT: Final = 9999
"""Greatest score and number of fouls and cards that is read: a row of a match counts exactly below
2^24, and no match has so many."""
RUNNING: Final = (Command.NORMAL_START, Command.FORCE_START)
"""Commands under which play goes on."""
_PLACEMENTS: Final = (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW)
_WIRE_COMMANDS: Final = frozenset(referee_pb2.Command.values())
_MAX_TIME: Final = 2**63 - 1
_MAX_KEPT: Final = 64
"""Greatest number of messages of teams that are kept."""
_READ_AS: Final[dict[int, Command]] = {
    referee_pb2.INDIRECT_FREE_YELLOW: Command.DIRECT_FREE_YELLOW,
    referee_pb2.INDIRECT_FREE_BLUE: Command.DIRECT_FREE_BLUE,
    referee_pb2.TIMEOUT_YELLOW: Command.HALT,
    referee_pb2.TIMEOUT_BLUE: Command.HALT,
    referee_pb2.GOAL_YELLOW: Command.STOP,
    referee_pb2.GOAL_BLUE: Command.STOP,
}
"""Commands that rSoccer does not have, and those that ask robots for the same."""


@dataclass(frozen=True)
class TeamStatus:
    """State of a team by the referee.

    Attributes:
        name: name of the team.
        score: goals that count.
        goalkeeper: uniform number of the goalkeeper.
        fouls: fouls that count for cards.
        yellow_cards: yellow cards of the match.
        yellow_card_seconds: playing time that each running yellow card has left, s.
        red_cards: red cards of the match.
        max_robots: robots that cards leave it; None if unknown.
        placement_failures: ball placements that failed; None if unknown.
        may_place: whether the team may still place the ball; None if unknown.
    """

    name: str = ""
    score: int = 0
    goalkeeper: int = 0
    fouls: int = 0
    yellow_cards: int = 0
    yellow_card_seconds: tuple[float, ...] = ()
    red_cards: int = 0
    max_robots: int | None = None
    placement_failures: int | None = None
    may_place: bool | None = None


@dataclass(frozen=True)
class RefereeStatus:
    """State of the referee, in SI units and the axes of the package.

    Attributes:
        command: command of the referee.
        stage: part of the match.
        teams: blue and yellow.
        next_command: command that follows; None if there is none.
        seconds_left: playing time that the stage has left, s, negative when it is over; None for a
            stage without a clock.
        action_seconds_left: time left for the kick or the ball placement, s; None for none.
        designated_position: place of the ball in a ball placement, m; None in other commands.
        events: events since play stopped.
    """

    command: Command
    stage: Stage
    teams: tuple[TeamStatus, TeamStatus] = (TeamStatus(NAMES[0]), TeamStatus(NAMES[1]))
    next_command: Command | None = None
    seconds_left: float | None = None
    action_seconds_left: float | None = None
    designated_position: tuple[float, float] | None = None
    events: tuple[ReportedEvent, ...] = ()


class Stamp(NamedTuple):
    """Times and number of a packet, for receivers that compare packets."""

    timestamp: float
    """Time of sending, Unix time, s."""
    command_counter: int
    """Number of commands so far, modulo 2**32."""
    command_timestamp: float
    """Time at which the command began, Unix time, s."""


class Stamper:
    """Counts commands, so that packets carry what the game controller's do."""

    def __init__(self, counter: int = 0) -> None:
        """Begin before the first command.

        Args:
            counter: number of commands before it.
        """
        self._counter = counter
        self._command: Command | None = None
        self._since = 0.0

    def stamp(self, command: Command, timestamp: float, *, again: bool = False) -> Stamp:
        """Return the stamp of a packet.

        Args:
            command: command of the referee.
            timestamp: time of sending, Unix time, s.
            again: whether the same command was given anew.
        """
        if command is not self._command or again:
            self._counter = (self._counter + 1) % 2**32
            self._command, self._since = command, timestamp
        return Stamp(timestamp, self._counter, self._since)


class EventLog:
    """Events since play stopped, as packets tell them."""

    def __init__(self) -> None:
        """Begin before the first event."""
        self._reported: list[ReportedEvent] = []
        self._count = 0

    def add(
        self,
        command: Command,
        events: Iterable[game.Event],
        seconds: float,
        *,
        in_play: bool,
    ) -> tuple[ReportedEvent, ...]:
        """Add the events of a step, and return all that a packet reports.

        Args:
            command: command of the referee after the step. While play goes on, a packet tells the
                events of its own step alone.
            events: events of the step.
            seconds: time of the step, Unix time, s.
            in_play: whether the ball is in play after the step: a free kick has no command with
                which play goes on.

        Returns:
            The events since play stopped, in the order in which they happened.
        """
        if command in RUNNING or in_play:
            self._reported.clear()
        for event in events:
            self._count += 1
            self._reported.append(ReportedEvent(event, f"rsoccer-{self._count}", seconds))
        return tuple(self._reported)


def to_packet(
    layout: WireLayout,
    status: RefereeStatus,
    stamp: Stamp,
    *,
    source_identifier: str = "rSoccer",
    match_type: int = referee_pb2.UNKNOWN_MATCH,
    status_message: str = "",
) -> referee_pb2.Packet:
    """Return the packet of a state.

    Args:
        layout: the match.
        status: the state.
        stamp: times and number of the command.
        source_identifier: identity of the running sender.
        match_type: kind of the match, a value of `referee_pb2.MatchType`.
        status_message: text for spectators.

    Returns:
        The packet. Events that the game controller does not have are left out.

    Raises:
        MessageError: a command that the game controller does not have, such as a goal kick.
    """
    message = referee_pb2.Packet(
        source_identifier=source_identifier,
        match_type=match_type,  # type: ignore[arg-type]
        packet_timestamp=_time(stamp.timestamp),
        stage=int(status.stage),  # type: ignore[arg-type]
        command=_wire_command(status.command),  # type: ignore[arg-type]
        command_counter=stamp.command_counter,
        command_timestamp=_time(stamp.command_timestamp),
        blue_team_on_positive_half=layout.blue_on_positive_half,
        blue=_team_info(status.teams[BLUE]),
        yellow=_team_info(status.teams[YELLOW]),
    )
    if status.next_command is not None:
        message.next_command = _wire_command(status.next_command)  # type: ignore[assignment]
    if status.seconds_left is not None:
        message.stage_time_left = round(status.seconds_left * MICROSECONDS)
    if status.action_seconds_left is not None:
        message.current_action_time_remaining = round(status.action_seconds_left * MICROSECONDS)
    if status.designated_position is not None and status.command in _PLACEMENTS:
        x, y = status.designated_position
        message.designated_position.x = MILLIMETERS * x * layout.sign
        message.designated_position.y = MILLIMETERS * y * layout.sign
    if status_message:
        message.status_message = status_message
    for reported in status.events:
        try:
            message.game_events.append(to_game_event(layout, reported))
        except MessageError:
            continue  # a pass is no event of the game controller
    return message


def _time(seconds: float) -> int:
    """Unix time in microseconds."""
    return min(max(0, round(seconds * MICROSECONDS)), _MAX_TIME)


def _wire_command(command: Command) -> int:
    if command not in _WIRE_COMMANDS:
        raise MessageError(
            Code.UNSUPPORTED_COMMAND, f"command: expected one of the SSL, got {command.name}"
        )
    return int(command)


@lru_cache(maxsize=_MAX_KEPT)  # a packet has a copy, and a team's state seldom changes
def _team_info(team: TeamStatus) -> referee_pb2.TeamInfo:
    message = referee_pb2.TeamInfo(
        name=team.name,
        score=team.score,
        goalkeeper=team.goalkeeper,
        foul_counter=team.fouls,
        yellow_cards=team.yellow_cards,
        yellow_card_times=sorted(_time(seconds) for seconds in team.yellow_card_seconds),
        red_cards=team.red_cards,
        timeouts=0,
        timeout_time=0,
        bot_substitution_intent=False,
        bot_substitution_allowed=False,
    )
    if team.max_robots is not None:
        message.max_allowed_bots = team.max_robots
    if team.placement_failures is not None:
        message.ball_placement_failures = max(0, team.placement_failures)
    if team.may_place is not None:
        message.can_place_ball = team.may_place
        message.ball_placement_failures_reached = not team.may_place
    return message


def read_packet(
    layout: WireLayout, message: referee_pb2.Packet
) -> tuple[RefereeStatus, list[Problem]]:
    """Return what a packet tells.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.

    Returns:
        The state, and what is left out or read as something else. Positions are turned by the side
        in the packet, if it has one, or else by that of the layout.
    """
    problems: list[Problem] = []
    if message.HasField("blue_team_on_positive_half"):
        layout = replace(layout, blue_on_positive_half=message.blue_team_on_positive_half)
    events = []
    for reported in message.game_events:
        try:
            events.append(read_game_event(layout, reported))
        except MessageError as error:
            problems.append(Problem(error.code, str(error)))
    position = None
    if message.HasField("designated_position"):
        x, y = message.designated_position.x, message.designated_position.y
        position = (x * layout.sign / MILLIMETERS, y * layout.sign / MILLIMETERS)
    left, action = message.stage_time_left, message.current_action_time_remaining
    timed = message.HasField("current_action_time_remaining")
    following = message.HasField("next_command")
    status = RefereeStatus(
        command=_command(message.command, problems),
        stage=Stage(message.stage),
        teams=(_team(message.blue, problems), _team(message.yellow, problems)),
        next_command=_command(message.next_command, problems) if following else None,
        seconds_left=left / MICROSECONDS if message.HasField("stage_time_left") else None,
        action_seconds_left=action / MICROSECONDS if timed else None,
        designated_position=position,
        events=tuple(events),
    )
    return status, problems


def read_stamp(message: referee_pb2.Packet) -> Stamp:
    """Return the times of a packet and the number of its command.

    Args:
        message: the packet, from `rsoccer.protocols.parsing.parse`.
    """
    return Stamp(
        message.packet_timestamp / MICROSECONDS,
        message.command_counter,
        message.command_timestamp / MICROSECONDS,
    )


def _command(code: int, problems: list[Problem]) -> Command:
    if code in _READ_AS:
        name = referee_pb2.Command.Name(code)
        text = f"command: expected one that rSoccer has, got {name}; read as {_READ_AS[code].name}"
        problems.append(Problem(Code.UNSUPPORTED_COMMAND, text))
        return _READ_AS[code]
    return Command(code)


def _count(name: str, value: int, problems: list[Problem]) -> int:
    """A number of a team, as far as a match has it."""
    if value <= MAX_COUNT:
        return value
    text = f"{name}: expected at most {MAX_COUNT}, got {value}; read as {MAX_COUNT}"
    problems.append(Problem(Code.OUT_OF_RANGE, text))
    return MAX_COUNT


def _team(message: referee_pb2.TeamInfo, problems: list[Problem]) -> TeamStatus:
    can = message.can_place_ball if message.HasField("can_place_ball") else None
    failed = message.HasField("ball_placement_failures")
    return TeamStatus(
        name=message.name,
        score=_count("score", message.score, problems),
        goalkeeper=message.goalkeeper,
        fouls=_count("foul_counter", message.foul_counter, problems),
        yellow_cards=_count("yellow_cards", message.yellow_cards, problems),
        yellow_card_seconds=tuple(time / MICROSECONDS for time in message.yellow_card_times),
        red_cards=_count("red_cards", message.red_cards, problems),
        max_robots=message.max_allowed_bots if message.HasField("max_allowed_bots") else None,
        placement_failures=message.ball_placement_failures if failed else None,
        may_place=can,
    )

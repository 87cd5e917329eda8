"""Packets of the game controller."""

from dataclasses import replace

import pytest

from rsoccer.game import BLUE, YELLOW, Command, Event, EventKind, Stage
from rsoccer.protocols import referee
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.game_events import ReportedEvent
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.referee import EventLog, RefereeStatus, Stamp, Stamper, TeamStatus
from rsoccer.protocols.schemas import referee_pb2
from tests.protocols.matches import SIDES, codes, layout

BLUE_TEAM = TeamStatus("Blau", 3, 5, 4, 2, (60.5, 90.0), 1, 4, 2, may_place=True)
YELLOW_TEAM = TeamStatus("Gelb", 1, 7, 0, 0, (), 0, 6, 5, may_place=False)
GOAL = ReportedEvent(Event(EventKind.GOAL, BLUE, 1, (4.5, 0.25)), "g1", 1.25)
STATUS = RefereeStatus(
    command=Command.BALL_PLACEMENT_YELLOW,
    stage=Stage.NORMAL_SECOND_HALF,
    teams=(BLUE_TEAM, YELLOW_TEAM),
    next_command=Command.DIRECT_FREE_YELLOW,
    seconds_left=-3.5,
    action_seconds_left=12.25,
    designated_position=(0.5, -1.5),
    events=(GOAL,),
)
STAMP = Stamp(1.7e9, 17, 1.7e9 - 3)
SSL_COMMANDS = [command for command in Command if command < 100]


@pytest.mark.parametrize("positive", SIDES)
def test_states_survive_the_wire(positive: bool) -> None:
    made = layout(positive=positive)
    packet = referee.to_packet(made, STATUS, STAMP, status_message="text", match_type=3)
    sent = parse(referee_pb2.Packet, packet.SerializeToString())
    status, problems = referee.read_packet(layout(), sent)  # the side is in the packet
    assert status == STATUS
    assert not problems
    assert referee.read_stamp(sent) == STAMP
    assert sent.blue_team_on_positive_half is positive
    assert sent.designated_position.x == (-500.0 if positive else 500.0)
    assert (sent.status_message, sent.match_type) == ("text", referee_pb2.FRIENDLY)
    assert list(sent.blue.yellow_card_times) == [60_500_000, 90_000_000]


def test_packets_share_no_message() -> None:
    first = referee.to_packet(layout(), STATUS, STAMP)
    first.blue.score, first.blue.name = 99, "another"
    second = referee.to_packet(layout(), STATUS, STAMP)
    assert (second.blue.score, second.blue.name) == (BLUE_TEAM.score, BLUE_TEAM.name)


@pytest.mark.parametrize("command", SSL_COMMANDS)
@pytest.mark.parametrize("stage", [Stage.NORMAL_FIRST_HALF_PRE, Stage.POST_GAME])
def test_all_commands_survive_the_wire(command: Command, stage: Stage) -> None:
    status = RefereeStatus(command, stage)
    sent = referee.to_packet(layout(), status, STAMP).SerializeToString()
    assert referee.read_packet(layout(), parse(referee_pb2.Packet, sent)) == (status, [])


@pytest.mark.parametrize("command", [command for command in Command if command >= 100])
def test_commands_of_vsss_are_refused(command: Command) -> None:
    with pytest.raises(MessageError, match=r"^command: expected one of the SSL") as error:
        referee.to_packet(layout(), RefereeStatus(command, Stage.NORMAL_FIRST_HALF), STAMP)
    assert error.value.code is Code.UNSUPPORTED_COMMAND


def test_designated_positions_are_reported_in_placements_alone() -> None:
    status = replace(STATUS, command=Command.STOP)
    assert not referee.to_packet(layout(), status, STAMP).HasField("designated_position")


@pytest.mark.parametrize(
    ("code", "command"),
    [
        (referee_pb2.TIMEOUT_BLUE, Command.HALT),
        (referee_pb2.INDIRECT_FREE_YELLOW, Command.DIRECT_FREE_YELLOW),
        (referee_pb2.GOAL_BLUE, Command.STOP),
    ],
)
def test_other_commands_are_read_as_the_nearest(code: int, command: Command) -> None:
    packet = referee.to_packet(layout(), STATUS, STAMP)
    packet.command = packet.next_command = code  # type: ignore[assignment]
    status, problems = referee.read_packet(layout(), packet)
    assert (status.command, status.next_command) == (command, command)
    assert codes(problems) == [Code.UNSUPPORTED_COMMAND] * 2


def test_events_that_cannot_be_read_are_listed() -> None:
    packet = referee.to_packet(layout(), STATUS, STAMP)
    packet.game_events.add().bot_substitution.by_team = referee_pb2.BLUE
    packet.game_events[0].goal.kicking_bot = 99
    status, problems = referee.read_packet(layout(), packet)
    assert codes(problems) == [Code.UNKNOWN_ROBOT, Code.UNSUPPORTED_EVENT]
    assert status.events == ()


def test_passes_are_not_reported() -> None:
    ball = ReportedEvent(Event(EventKind.PASS, BLUE, 1, (0.0, 0.0)), "p", 0.0)
    packet = referee.to_packet(layout(), replace(STATUS, events=(ball, GOAL)), STAMP)
    assert [event.id for event in packet.game_events] == ["g1"]


def test_sides_are_those_of_the_layout_without_a_side_in_the_packet() -> None:
    packet = referee.to_packet(layout(), STATUS, STAMP)
    packet.ClearField("blue_team_on_positive_half")
    status, _ = referee.read_packet(layout(positive=True), packet)
    assert status.designated_position == (-0.5, 1.5)


def test_stamps_count_commands() -> None:
    stamper = Stamper(2**32 - 2)
    assert stamper.stamp(Command.STOP, 1.0) == (1.0, 2**32 - 1, 1.0)
    assert stamper.stamp(Command.STOP, 2.0) == (2.0, 2**32 - 1, 1.0)
    assert stamper.stamp(Command.HALT, 3.0) == (3.0, 0, 3.0)
    assert stamper.stamp(Command.HALT, 4.0, again=True) == (4.0, 1, 4.0)


def test_events_are_reported_until_play_goes_on() -> None:
    log, event = EventLog(), Event(EventKind.GOAL, YELLOW, 3, (0.0, 0.0))

    def add(
        command: Command, events: list[Event], seconds: float, *, in_play: bool = False
    ) -> list[tuple[str, float]]:
        reported = log.add(command, events, seconds, in_play=in_play)
        return [(each.identity, each.seconds) for each in reported]

    assert add(Command.STOP, [event], 1.0) == [("rsoccer-1", 1.0)]
    assert add(Command.STOP, [event], 2.0) == [("rsoccer-1", 1.0), ("rsoccer-2", 2.0)]
    assert add(Command.FORCE_START, [event], 3.0) == [("rsoccer-3", 3.0)]
    assert add(Command.NORMAL_START, [], 4.0) == []
    # A free kick has no command with which play goes on.
    assert add(Command.STOP, [event], 5.0) == [("rsoccer-4", 5.0)]
    assert add(Command.DIRECT_FREE_BLUE, [], 6.0) == [("rsoccer-4", 5.0)]
    assert add(Command.DIRECT_FREE_BLUE, [], 7.0, in_play=True) == []
    assert add(Command.STOP, [event], 8.0) == [("rsoccer-5", 8.0)]

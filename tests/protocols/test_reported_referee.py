"""The state of a match by the packets of a referee."""

from __future__ import annotations

import pytest

from rsoccer import Matches
from rsoccer.game import Command, Game, Stage
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.referee import RefereeStatus, TeamStatus
from rsoccer.protocols.reported_referee import ReportedReferee
from rsoccer.protocols.schemas import referee_pb2
from rsoccer.rules.referee_config import RefereeConfig

STATUS = RefereeStatus(
    Command.BALL_PLACEMENT_YELLOW,
    Stage.NORMAL_SECOND_HALF,
    (TeamStatus("Blue", 2, yellow_cards=1), TeamStatus("Yellow", 5, red_cards=1)),
    next_command=Command.DIRECT_FREE_YELLOW,
    seconds_left=77.0,
    designated_position=(1.0, -0.5),
)


def new_game() -> tuple[Game, WireLayout]:
    matches = Matches("SSLMatch-v0", n_blue=2, n_yellow=2)
    matches.reset(seed=0)
    return matches.play.game, WireLayout(matches.task.config)


def packet(layout: WireLayout, status: RefereeStatus) -> bytes:
    made = referee.to_packet(layout, status, referee.Stamper().stamp(status.command, 1.0))
    data: bytes = made.SerializeToString()
    return data


@pytest.mark.parametrize("exchanged", [False, True])
def test_a_match_is_as_the_game_controller_tells(exchanged: bool) -> None:
    game, wire = new_game()
    layout = WireLayout(wire.config, colors_exchanged=exchanged)
    reported = ReportedReferee(RefereeConfig("ssl_2026_b"))
    reported.receive(layout, packet(wire, STATUS))
    reported.write(game, 2)
    placing = Command.BALL_PLACEMENT_BLUE if exchanged else Command.BALL_PLACEMENT_YELLOW
    free_kick = Command.DIRECT_FREE_BLUE if exchanged else Command.DIRECT_FREE_YELLOW
    assert game.command[0] == placing
    assert game.next_command[0] == free_kick
    assert game.stage[0] == Stage.NORMAL_SECOND_HALF
    assert game.score[0].tolist() == ([5, 2] if exchanged else [2, 5])
    assert game.yellow_cards[0].tolist() == ([0, 1] if exchanged else [1, 0])
    assert game.red_cards[0].tolist() == ([1, 0] if exchanged else [0, 1])
    assert game.may_touch[0].tolist() == [exchanged, exchanged, not exchanged, not exchanged]
    sign = -1.0 if exchanged else 1.0
    assert game.designated_position[0].tolist() == pytest.approx([sign, -0.5 * sign])
    assert game.seconds_left[0] == pytest.approx(77.0)


@pytest.mark.parametrize("again", [False, True])
def test_a_command_that_is_given_anew_begins_again(again: bool) -> None:
    _, layout = new_game()
    reported, stamper = ReportedReferee(RefereeConfig("ssl_2026_b")), referee.Stamper()
    status = RefereeStatus(Command.DIRECT_FREE_YELLOW, Stage.NORMAL_FIRST_HALF)
    for time, anew in ((1.0, False), (1.5, False), (9.0, again)):
        stamp = stamper.stamp(status.command, time, again=anew)
        reported.receive(layout, referee.to_packet(layout, status, stamp).SerializeToString())
        for _ in range(100):
            reported.advance((0.0, 0.0), 0.06)
    assert reported.state.steps == (100 if again else 300)
    assert reported.state.may_touch(0) != again, "10 s are over, or have begun anew"


@pytest.mark.parametrize("number", [10_000, 2**24 + 1, 2**32 - 1])
@pytest.mark.parametrize("name", ["score", "yellow_cards", "red_cards", "foul_counter"])
def test_numbers_that_no_match_has_are_read_as_the_greatest(name: str, number: int) -> None:
    game, layout = new_game()
    reported = ReportedReferee(RefereeConfig("ssl_2026_b"))
    message = referee_pb2.Packet.FromString(packet(layout, STATUS))
    setattr(message.blue, name, number)
    reported.receive(layout, message.SerializeToString())
    assert reported.refused == {"OUT_OF_RANGE": 1}
    reported.write(game, 2)
    greatest = {
        "score": game.score[0, 0],
        "yellow_cards": game.yellow_cards[0, 0],
        "red_cards": game.red_cards[0, 0],
        "foul_counter": reported.status.teams[0].fouls if reported.status else None,
    }
    assert greatest[name] == referee.MAX_COUNT


def test_the_side_is_reported_and_changes_no_place() -> None:
    _, layout = new_game()
    reported = ReportedReferee(RefereeConfig("ssl_2026_b"))
    assert reported.blue_on_positive_half is None
    other = WireLayout(layout.config, blue_on_positive_half=True)
    reported.receive(layout, packet(other, STATUS))
    assert reported.blue_on_positive_half
    assert reported.status is not None
    assert reported.status.designated_position == pytest.approx((-1.0, 0.5))


def test_a_kick_is_taken_when_the_ball_has_moved() -> None:
    game, layout = new_game()
    reported = ReportedReferee(RefereeConfig("ssl_2026_b"))
    reported.receive(
        layout, packet(layout, RefereeStatus(Command.DIRECT_FREE_BLUE, Stage.NORMAL_FIRST_HALF))
    )
    for x, in_play in ((0.0, False), (0.02, False), (0.2, True)):
        reported.advance((x, 0.0), 0.025)
        reported.write(game, 2)
        assert bool(game.in_play[0]) == in_play
        assert game.may_touch[0].tolist() == [True, True, in_play, in_play]


def test_vssreferee_tells_commands_and_halves() -> None:
    _, layout = new_game()
    reported = ReportedReferee(RefereeConfig("vsss_3v3"))
    for command in (Command.PREPARE_KICKOFF_YELLOW, Command.NORMAL_START):
        message = vssref.to_command(layout, command, Stage.NORMAL_FIRST_HALF, timestamp=1.0)
        reported.receive(layout, message.SerializeToString())
        assert reported.state.command is command
    assert reported.stage is Stage.NORMAL_FIRST_HALF
    assert reported.state.in_play
    with pytest.raises(MessageError):
        reported.receive(layout, b"\xff")

"""Robots under a referee."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.drive.officials import SILENCE, Officials
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.game import Command, Stage
from rsoccer.protocols import referee, vssref
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.referee import RefereeStatus
from rsoccer.protocols.restraint import KEEP_AWAY

SSL = SimConfig("ssl_b", 2, 2)
VSS = SimConfig("vss_3v3", 3, 3)


class Wall:
    now = 7.0

    def clock(self) -> float:
        return self.now


def under(
    command: Command, *others: Command, config: SimConfig = SSL, **settings: object
) -> tuple[Officials, WireLayout, Wall]:
    """A referee that has given commands, of which one is the last."""
    wall = Wall()
    made = Settings("ssl-simulation" if config is SSL else "firasim", **settings)  # type: ignore[arg-type]
    officials = Officials(made, None, wall.clock)
    layout = WireLayout(config, colors_exchanged=made.team == "yellow")
    for each in (*others, command):
        officials.receive(layout, packet(config, each))
    return officials, layout, wall


def packet(config: SimConfig, command: Command) -> bytes:
    layout = WireLayout(config)
    if config is VSS:
        message = vssref.to_command(layout, command, Stage.NORMAL_FIRST_HALF, timestamp=1.0)
    else:
        status = RefereeStatus(command, Stage.NORMAL_FIRST_HALF)
        message = referee.to_packet(layout, status, referee.Stamper().stamp(command, 1.0))  # type: ignore[assignment]
    data: bytes = message.SerializeToString()
    return data


def scene(distance: float) -> Frame:
    """Robots at a distance from the ball, at -x of it, that look at it."""
    frame = Frame.empty(1, 2, 2)
    frame.ball.position[0] = 1.0, 0.0
    for slot in range(4):
        angle = 0.3 * slot
        frame.robots.position[0, slot] = 1.0 - distance * np.cos(angle), distance * np.sin(angle)
        frame.robots.heading[0, slot] = np.cos(angle), -np.sin(angle)
    return frame


def full(speed: float = 2.0) -> np.ndarray:
    """Commands toward the ball, with kick and dribbler."""
    commands = np.zeros((4, len(SSL.command_columns)), np.float32)
    commands[:, 0] = speed
    commands[:, 3:] = 1.0
    return commands


@pytest.mark.parametrize(
    ("commands", "may_play"),
    [
        ((Command.FORCE_START,), [True, True]),
        ((Command.NORMAL_START,), [True, True]),
        ((Command.DIRECT_FREE_BLUE,), [True, False]),
        ((Command.DIRECT_FREE_YELLOW,), [False, True]),
        ((Command.NORMAL_START, Command.PREPARE_KICKOFF_YELLOW), [False, True]),
        ((Command.PREPARE_KICKOFF_BLUE,), [False, False]),
        ((Command.BALL_PLACEMENT_BLUE,), [True, False]),
        ((Command.STOP,), [False, False]),
    ],
)
def test_those_who_may_not_play_the_ball_keep_away_from_it(
    commands: tuple[Command, ...], may_play: list[bool]
) -> None:
    officials, layout, _ = under(*commands)
    asked = full()
    given = officials.restrain(layout, asked, scene(0.3))
    for team, may in enumerate(may_play):
        rows = given[2 * team : 2 * team + 2]
        if may:
            np.testing.assert_array_equal(rows, asked[2 * team : 2 * team + 2])
        else:
            # Under its own team's preparation a robot may wait near the ball.
            own = commands[0] is Command.PREPARE_KICKOFF_BLUE and team == 0
            assert (rows[:, 0] < 1.0).all() if own else (rows[:, 0] < 0.0).all()
            assert not rows[:, 3:].any()
    np.testing.assert_array_equal(asked, full())


def test_robots_far_from_the_ball_drive_on_until_they_are_near() -> None:
    officials, layout, _ = under(Command.DIRECT_FREE_YELLOW)
    far, near = (officials.restrain(layout, full(), scene(d))[0, 0] for d in (3.0, KEEP_AWAY))
    assert far == 2.0
    assert near == pytest.approx(0.0, abs=1e-5)


def test_a_stop_is_slow_everywhere() -> None:
    officials, layout, _ = under(Command.STOP)
    given = officials.restrain(layout, full(3.0), scene(3.0))
    assert given[:, 0].tolist() == pytest.approx([1.5] * 4)


def test_a_halt_stops_all() -> None:
    officials, layout, _ = under(Command.HALT)
    assert not officials.restrain(layout, full(), scene(3.0)).any()


def test_a_yellow_team_hears_the_commands_of_the_other_color() -> None:
    officials, layout, _ = under(Command.DIRECT_FREE_YELLOW, team="yellow")
    given = officials.restrain(layout, full(), scene(0.3))
    assert (given[:2, 0] == 2.0).all()
    assert (given[2:, 0] < 0.0).all()
    assert officials.reported.state.command is Command.DIRECT_FREE_BLUE


@pytest.mark.parametrize(
    ("command", "plays"),
    [
        (Command.NORMAL_START, True),
        (Command.STOP, False),
        (Command.HALT, False),
        (Command.PREPARE_KICKOFF_BLUE, False),
        (Command.FREE_BALL, False),
    ],
)
def test_robots_of_vsss_move_while_the_game_is_on(command: Command, plays: bool) -> None:
    officials, layout, _ = under(command, config=VSS)
    commands = np.ones((6, 2), np.float32)
    assert officials.restrain(layout, commands, Frame.empty(1, 3, 3)).any() == plays


def test_silence_is_a_halt_once_a_referee_was_heard() -> None:
    officials, _, wall = under(Command.FORCE_START)
    wall.now += SILENCE - 0.1
    assert not officials.is_halted
    wall.now += 0.2
    assert officials.is_halted
    nobody = Officials(Settings("grsim"), None, wall.clock)
    wall.now += 100.0
    assert not nobody.is_halted
    assert Officials(Settings("grsim", referee="require"), None, wall.clock).is_halted
    assert not Officials(Settings("grsim", referee="ignore"), None, wall.clock).is_halted


def test_bytes_of_somebody_else_are_refused() -> None:
    officials, layout, _ = under(Command.FORCE_START)
    with pytest.raises(MessageError):
        officials.receive(layout, b"\xff\xff\xff")
    assert officials.packets == 1

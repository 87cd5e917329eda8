"""Commands that a referee on the network allows."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.frame import Frame
from rsoccer.game import Command
from rsoccer.protocols.ball_in_play import BallInPlay
from rsoccer.protocols.restraint import KEEP_AWAY, must_stand, restrained
from rsoccer.rules.referee_config import RefereeConfig

SSL = SimConfig("ssl_b", 1, 1)
COMMANDS = np.full((2, len(SSL.command_columns)), 2.0, np.float32)


def under(*commands: Command) -> BallInPlay:
    state = BallInPlay(RefereeConfig("ssl_2026_b"))
    for command in commands:
        state.give(command)
    return state


def scene(distance: float) -> Frame:
    """Both robots at a distance from the ball, blue's at -x of it and yellow's at +x."""
    frame = Frame.empty(1, 1, 1)
    frame.robots.position[0, :, 0] = -distance, distance
    frame.robots.heading[0, :, 0] = 1.0
    return frame


def test_nothing_is_restrained_before_the_first_command() -> None:
    assert restrained(SSL, under(), COMMANDS, scene(0.2), 1.5) is COMMANDS


@pytest.mark.parametrize("command", Command)
def test_robots_stand_in_a_halt_and_in_vsss_while_no_game_is_on(command: Command) -> None:
    state = under(command)
    assert must_stand(state, is_vsss=False) == (command is Command.HALT)
    assert must_stand(state, is_vsss=True) == (
        command not in (Command.NORMAL_START, Command.FORCE_START)
    )


def test_robots_that_are_too_near_drive_away_whichever_way_they_look() -> None:
    given = restrained(SSL, under(Command.STOP), 0.0 * COMMANDS, scene(KEEP_AWAY - 0.2), 1.5)
    assert given[0, 0] < 0.0 < given[1, 0]
    assert not given[:, 1:].any()


@pytest.mark.parametrize("speed", [0.2, 1.5])
def test_a_stop_has_its_own_speed(speed: float) -> None:
    given = restrained(SSL, under(Command.STOP), COMMANDS, scene(3.0), speed)
    assert np.hypot(given[:, 0], given[:, 1]).tolist() == pytest.approx([speed] * 2)


def test_the_team_of_a_free_kick_plays() -> None:
    given = restrained(SSL, under(Command.DIRECT_FREE_YELLOW), COMMANDS, scene(0.2), 1.5)
    np.testing.assert_array_equal(given[1], COMMANDS[1])
    assert not given[0, 3:].any(), "neither kick nor dribbler"

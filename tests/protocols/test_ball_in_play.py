"""Kicks from the command of a referee until the ball is in play."""

from __future__ import annotations

import pytest

from rsoccer.game import BLUE, YELLOW, Command
from rsoccer.protocols.ball_in_play import BallInPlay
from rsoccer.rules.referee_config import RefereeConfig

STEP = 0.1
RULES = RefereeConfig("ssl_2026_b")
PLACE = (1.0, -2.0)


def touch(state: BallInPlay) -> tuple[bool, bool]:
    return state.may_touch(BLUE), state.may_touch(YELLOW)


def run(state: BallInPlay, steps: int, ball: tuple[float, float] = PLACE) -> None:
    for _ in range(steps):
        state.steps += 1
        state.judge(ball, STEP)


def after(*commands: Command, preset: str = "ssl_2026_b") -> BallInPlay:
    """The state after some commands of a second each, with a ball that rests."""
    state = BallInPlay(RefereeConfig(preset))
    for command in commands:
        state.give(command)
        run(state, 10)
    return state


@pytest.mark.parametrize(
    ("commands", "seconds"),
    [
        ((Command.STOP, Command.DIRECT_FREE_YELLOW), 10.0),
        ((Command.STOP, Command.PREPARE_KICKOFF_YELLOW, Command.NORMAL_START), 10.0),
        ((Command.STOP, Command.PREPARE_PENALTY_YELLOW, Command.NORMAL_START), None),
    ],
)
@pytest.mark.parametrize("way", [0.04, 0.06])
def test_a_kick_is_the_team_s_until_the_ball_has_moved_or_the_time_is_over(
    commands: tuple[Command, ...], seconds: float | None, way: float
) -> None:
    state = after(*commands)
    assert (touch(state), state.in_play, state.steps) == ((False, True), False, 10)
    assert state.kick is commands[1]
    state.give(commands[-1])
    assert state.steps == 10, "the command goes on"
    run(state, 1, (PLACE[0] + way, PLACE[1]))
    assert state.in_play == (way > 0.05)
    assert touch(state) == (way > 0.05, True)
    state = after(*commands)
    run(state, 89)
    assert (state.in_play, state.steps) == (False, 99)
    run(state, 1 if seconds else 1000)
    assert (state.in_play, touch(state)) == (seconds is not None, (seconds is not None, True))


def test_division_a_gives_a_free_kick_less_time() -> None:
    state = after(Command.STOP, Command.DIRECT_FREE_BLUE, preset="ssl_2026_a")
    run(state, 39)
    assert touch(state) == (True, False)
    run(state, 1)
    assert touch(state) == (True, True)


@pytest.mark.parametrize(
    ("command", "expected", "in_play"),
    [
        (Command.HALT, (False, False), False),
        (Command.STOP, (False, False), False),
        (Command.PREPARE_KICKOFF_BLUE, (False, False), False),
        (Command.BALL_PLACEMENT_BLUE, (True, False), False),
        (Command.FORCE_START, (True, True), True),
        (Command.NORMAL_START, (True, True), True),
    ],
)
def test_other_commands_alone_decide(
    command: Command, expected: tuple[bool, bool], in_play: bool
) -> None:
    state = after(command)
    run(state, 10, (0.0, 0.0))
    assert (touch(state), state.in_play) == (expected, in_play)


def test_a_stop_ends_play() -> None:
    state = after(Command.STOP, Command.DIRECT_FREE_BLUE)
    run(state, 1, (0.0, 0.0))
    assert state.in_play
    state.give(Command.STOP)
    assert (touch(state), state.in_play, state.steps) == ((False, False), False, 0)
    assert state.kick is None


def test_a_start_in_vsss_lets_all_play() -> None:
    state = after(Command.PREPARE_KICKOFF_BLUE, preset="vsss_3v3")
    assert touch(state) == (False, False)
    state.give(Command.NORMAL_START)
    assert (touch(state), state.in_play) == ((True, True), True)

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.game import Command, Stage
from rsoccer.policies.base import MatchState
from rsoccer.policies.vss.roles import ATTACKER, KEEPER, SUPPORT
from rsoccer.policies.vss.waiting import may_play, wait
from rsoccer.tasks import VssMatch
from tests.games import begin_play, set_game

TASK = VssMatch()
ROLES = np.array([[KEEPER, ATTACKER, SUPPORT, KEEPER, ATTACKER, SUPPORT]])


def playing(matches: Matches, robots: list[int]) -> list[bool]:
    """Mask of the robots that play."""
    play = matches.play
    match = MatchState(play.sensed.rows, play.game, np.array(robots), play.threads, TASK.config)
    return [bool(robot) for robot in may_play(match, ROLES[:, robots], TASK.n_blue)[0]]


def matches_in_play(**values: float) -> Matches:
    """A match with the ball in play."""
    matches = Matches(TASK, controllers={"all": "zero"})
    matches.reset()
    begin_play(matches)
    set_game(matches, **values)
    matches.step(np.zeros((1, 0, 2), np.float32))
    return matches


def test_all_wait_while_play_is_stopped_and_play_afterwards() -> None:
    everybody = list(range(6))
    assert playing(matches_in_play(), everybody) == [True] * 6
    for command in (Command.STOP, Command.FREE_BALL, Command.GOAL_KICK_BLUE):
        stopped = matches_in_play(command=command, wait_steps=100, in_play=False)
        assert playing(stopped, everybody) == [False] * 6, command


@pytest.mark.parametrize("robots", [[0, 1, 2, 3, 4, 5], [5, 1, 0], [3, 4]])
@pytest.mark.parametrize("blue_kicks", [True, False])
def test_in_the_shootout_only_kicker_and_keeper_play(blue_kicks: bool, robots: list[int]) -> None:
    kick = Command.PREPARE_PENALTY_BLUE if blue_kicks else Command.PREPARE_PENALTY_YELLOW
    command = Command.NORMAL_START
    matches = matches_in_play(stage=Stage.PENALTY_SHOOTOUT, kick=kick, command=command)
    takes_part = {1, 3} if blue_kicks else {0, 4}
    assert playing(matches, robots) == [robot in takes_part for robot in robots]


def test_a_robot_that_waits_stands_and_forgets() -> None:
    memory = {
        "roles": np.full((2, 2, 3), ATTACKER, np.int8),
        "delay": np.array([3, 3]),
        "slow_steps": np.full((2, 2), 9),
    }
    actions = np.ones((2, 2, 2), np.float32)
    wait(np.array([[True, True], [False, True]]), memory, actions)
    assert actions[:, :, 0].tolist() == [[0.0, 0.0], [1.0, 0.0]]
    assert memory["roles"][:, :, 0].tolist() == [[0, 0], [ATTACKER, 0]]
    assert memory["slow_steps"].tolist() == [[0, 0], [9, 0]]
    assert memory["delay"].tolist() == [0, 3]

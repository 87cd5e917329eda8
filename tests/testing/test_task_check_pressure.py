"""`check_task` also finds faults that need robots pressing on each other."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import BallColumns
from rsoccer.rules import BallOut, Crossings, Possession, Restart, Rule
from rsoccer.task import Play
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from rsoccer.testing import TaskError, check_task
from tests.helpers import Crowd


class RaisesUnderPressure(VssSelfPlay):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        if ((play.frame.robots.touched_ball > 0.0).sum(axis=1) > 2).any():
            raise IndexError("too many to count")
        return super().calculate_reward_and_done(play)


class RewardsNaNUnderPressure(VssSelfPlay):
    """The root is of a negative number where the ball is closer to a wall than a robot's corner."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        gap = 0.65 - 0.0215 - np.abs(play.frame.ball.position[:, 1])
        with np.errstate(invalid="ignore"):
            terms["gap"] = np.sqrt(gap)[:, None].astype(np.float32)
        return terms, done


class FaultyBallOut(BallOut):
    """The place of the ball depends on the number of worlds, or is the center of a robot."""

    def __init__(self, config: SimConfig, fault: str) -> None:
        super().__init__(config)
        self._fault = fault

    def judge(self, play: Play) -> Restart | None:
        restart = super().judge(play)
        if restart is not None and restart.balls is not None:
            ball = BallColumns(restart.balls)
            if self._fault == "batch":
                ball.velocity[:, 0] = 0.01 * len(play.frame)
            else:
                ball.position[:] = play.frame.robots.position[restart.worlds, 0]
        return restart


class RepositionDependsOnTheBatch(SslSelfPlay):
    @property
    def rules(self) -> Sequence[Rule]:
        return Crossings(), FaultyBallOut(self.config, "batch"), Possession(0.5)


class RepositionsIntoARobot(SslSelfPlay):
    @property
    def rules(self) -> Sequence[Rule]:
        return Crossings(), FaultyBallOut(self.config, "robot"), Possession(0.5)


class KeepsTheLastRows(Rule):
    """Play restarts with states that depend on those of earlier restarts."""

    last: ClassVar[list[Floats]] = []

    def judge(self, play: Play) -> Restart | None:
        stopped = np.flatnonzero(play.frame.ball.crossed > 0)
        if not len(stopped):
            return None
        self.last.append(play.frame.rows[stopped])
        return Restart(
            stopped, rows=VssSelfPlay().get_initial_positions_frame(play.rng).rows[stopped]
        )


class RestartsFromSelf(VssSelfPlay):
    @property
    def rules(self) -> Sequence[Rule]:
        return Crossings(), KeepsTheLastRows()


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (RaisesUnderPressure, "reward_and_done: IndexError: too many .*in step .* under pressure"),
        (RewardsNaNUnderPressure, "'gap' has NaN or infinite numbers .*in step .* pressure"),
        (RepositionDependsOnTheBatch, "rules: 'balls' of worlds .* differ from the same"),
        (RestartsFromSelf, r"rules keeps state on self, in KeepsTheLastRows\.last"),
        (RepositionsIntoARobot, "ValueError: .*ball and blue_0 overlap.*in step .* under pressure"),
    ],
)
def test_a_fault_that_shows_only_under_pressure_is_found(
    faulty: type[VssSelfPlay | SslSelfPlay], message: str
) -> None:
    with pytest.raises(TaskError, match=message):
        check_task(faulty())


def test_robots_press_even_if_the_meaning_of_actions_is_unknown() -> None:
    @dataclass(frozen=True)
    class Forward(Crowd):
        action_size = 1
        DISCRETE_ACTIONS = np.array([[1.0]], np.float32)

        def get_commands(self, play: Play, actions: Floats) -> Floats:
            return super().get_commands(play, np.repeat(actions, 2, axis=2))

        def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
            if (play.frame.robots.touched_opponent.sum(axis=1) > 3).any():
                raise IndexError("too many to count")
            return super().calculate_reward_and_done(play)

    with pytest.raises(TaskError, match="IndexError: too many"):
        check_task(Forward())

"""`check_task` also finds faults that need robots pressing on each other."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import BallColumns, Frame
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


class RepositionDependsOnTheBatch(SslSelfPlay):
    """The velocity of a repositioned ball depends on the number of worlds."""

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        result = super().reposition_ball(frame)
        if result is not None:
            BallColumns(result[1]).velocity[:, 0] = 0.01 * len(frame)
        return result


class RepositionsIntoARobot(SslSelfPlay):
    """The new position of the ball is the centre of a robot."""

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        result = super().reposition_ball(frame)
        if result is not None:
            result[1][:, :2] = frame.robots.position[result[0], 0]
        return result


class RestartsFromSelf(VssSelfPlay):
    """A free ball that is stuck is placed where the last one was."""

    last: ClassVar[list[Floats]] = []

    def restart_play(self, play: Play) -> tuple[NDArray[np.intp], Floats] | None:
        stopped = np.flatnonzero(play.frame.ball.crossed > 0)
        if not len(stopped):
            return None
        self.last.append(play.frame.rows[stopped])
        return stopped, self.get_initial_positions_frame(play.rng).rows[stopped]


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (RaisesUnderPressure, "reward_and_done: IndexError: too many .*in step .* under pressure"),
        (RewardsNaNUnderPressure, "'gap' has NaN or infinite numbers .*in step .* pressure"),
        (RepositionDependsOnTheBatch, "reposition_ball: 'balls' of worlds .* differ from the same"),
        (RestartsFromSelf, r"restart_play keeps state on self, in RestartsFromSelf\.last"),
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

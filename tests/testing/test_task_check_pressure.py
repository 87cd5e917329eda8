"""Faults that show only when robots press on each other must be found too."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer.frame import BallColumns, Floats, Frame, Mask
from rsoccer.task import Play
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from rsoccer.testing import TaskError, check_task
from tests.helpers import Crowd


class RaisesInACrowd(VssSelfPlay):
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        if ((play.frame.robots.touched_ball > 0.0).sum(axis=1) > 2).any():
            raise IndexError("too many to count")
        return super().calculate_reward_and_done(play)


class PaysNothingSensibleToACrowd(VssSelfPlay):
    """Per metre between the ball and the nearest wall that a robot's corner still fits behind."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        room = 0.65 - 0.0215 - np.abs(play.frame.ball.position[:, 1])
        with np.errstate(invalid="ignore"):
            terms["room"] = np.sqrt(room)[:, None].astype(np.float32)
        return terms, done


class BringsTheBallBackForAll(SslSelfPlay):
    """A ball that comes back is the faster, the more worlds there are."""

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        found = super().reposition_ball(frame)
        if found is not None:
            BallColumns(found[1]).velocity[:, 0] = 0.01 * len(frame)
        return found


class LosesTheBall(SslSelfPlay):
    """Puts a ball back in the middle of a robot."""

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        found = super().reposition_ball(frame)
        if found is not None:
            found[1][:, :2] = frame.robots.position[found[0], 0]
        return found


@pytest.mark.parametrize(
    ("faulty", "message"),
    [
        (RaisesInACrowd, "IndexError in step .* under pressure.*too many to count"),
        (PaysNothingSensibleToACrowd, "'room' has NaN or infinite numbers in step .* pressure"),
        (BringsTheBallBackForAll, "differ from the same worlds alone"),
        (LosesTheBall, "ValueError in step .* under pressure.*ball and blue_0 overlap"),
    ],
)
def test_a_fault_that_shows_only_under_pressure_is_found(
    faulty: type[VssSelfPlay | SslSelfPlay], message: str
) -> None:
    with pytest.raises(TaskError, match=message):
        check_task(faulty())


def test_what_is_driven_by_other_actions_is_pressed_by_pushes_that_last() -> None:
    """Where nothing is known of what actions do, robots still meet."""

    @dataclass(frozen=True)
    class Forward(Crowd):
        action_size = 1
        DISCRETE_ACTIONS = np.array([[1.0]], np.float32)

        def get_commands(self, play: Play, actions: Floats) -> Floats:
            return super().get_commands(play, np.repeat(actions, 2, axis=2))

        def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
            if (play.frame.robots.touched_foe.sum(axis=1) > 3).any():
                raise IndexError("too many to count")
            return super().calculate_reward_and_done(play)

    with pytest.raises(TaskError, match="IndexError in step"):
        check_task(Forward())

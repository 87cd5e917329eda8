"""Results of tasks that do not fit the matches."""

from dataclasses import dataclass

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Floats, Mask
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import zeros


@dataclass(frozen=True)
class Shaped(VssSelfPlay):
    """A task with a reward term of a given shape."""

    shape: tuple[int, ...] = ()

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms | {"own": np.ones(self.shape, np.float32)}, done


@pytest.mark.parametrize("shape", [(), (4,), (6,), (1, 6), (6, 4), (4, 5), (4, 6, 1)])
def test_a_reward_term_of_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    """Some of these shapes would broadcast to those of other robots or worlds."""
    matches = Matches(Shaped(shape=shape), 4)
    matches.reset()
    with pytest.raises(ValueError, match=r"expected \(4, 6\) or \(4, 1\) for 'own', got"):
        matches.step(zeros(matches))


@pytest.mark.parametrize("shape", [(4, 6), (4, 1)])
def test_a_reward_term_is_of_each_robot_or_of_all(shape: tuple[int, ...]) -> None:
    matches = Matches(Shaped(shape=shape), 4)
    matches.reset()
    assert matches.step(zeros(matches)).terms["own"].tolist() == np.ones((4, 6)).tolist()

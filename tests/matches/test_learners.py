"""The learners' part of arrays and reward terms, in arrays of their own."""

import numpy as np
import pytest

from rsoccer._core import Threads
from rsoccer.controllers import Controllers, assign
from rsoccer.matches.learners import Learners
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same

CONTROLLERS: dict[str, tuple[Controllers | None, list[int]]] = {
    "all": (None, [0, 1, 2, 3, 4, 5]),
    "yellow": ({"blue": "best"}, [3, 4, 5]),
    "none": ({"all": "best"}, []),
}


def learners(name: str) -> tuple[Learners, list[int]]:
    controllers, expected = CONTROLLERS[name]
    return Learners(VssSelfPlay(), assign(VssSelfPlay(), controllers, 2)), expected


@pytest.mark.parametrize("name", CONTROLLERS)
def test_the_learners_part_is_copied(name: str) -> None:
    part, places = learners(name)
    array = np.arange(2 * 6 * 3, dtype=np.float32).reshape(2, 6, 3)
    copied = part.copy(array, Threads())
    assert same(copied, array[:, places])
    copied += 1.0
    assert array[0, 0, 0] == 0.0


@pytest.mark.parametrize("name", CONTROLLERS)
def test_terms_of_all_observers_and_of_each_are_summed(name: str) -> None:
    part, places = learners(name)
    common = np.array([[1.0], [2.0]], np.float32)
    each = np.arange(12, dtype=np.float32).reshape(2, 6)
    terms, rewards = part.sum_terms({"common": common, "each": each}, 2)
    assert same(terms["common"], np.broadcast_to(common, (2, 6))[:, places])
    assert same(terms["each"], each[:, places])
    assert same(rewards, (common + each)[:, places])
    terms["each"] += 1.0
    assert each[0, 0] == 0.0


def test_a_term_of_another_shape_is_refused() -> None:
    part, _ = learners("all")
    with pytest.raises(ValueError, match=r"expected \(2, 6\) or \(2, 1\) for 'odd', got \(2, 5\)"):
        part.sum_terms({"odd": np.zeros((2, 5), np.float32)}, 2)

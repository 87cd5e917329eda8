"""The operations that stacked observations are made of."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import spaces
from rsoccer.history import ObservationStack
from tests.helpers import same
from tests.stacks import HandStack

STACK = ObservationStack(history=3, observation_size=2, action_size=1)


def rows(*numbers: float) -> np.ndarray:
    """Numbers of one robot in each world."""
    return np.array(numbers, np.float32)[:, None, None]


def test_a_stack_holds_the_newest_first_and_the_actions_last() -> None:
    memory = STACK.new_memory(1, 1)
    every, observation = slice(None), np.array([[[1.0, 10.0]]], np.float32)
    STACK.begin(memory, every, observation)
    assert STACK.stack(memory, every, observation).tolist() == [[[1, 10, 1, 10, 1, 10, 0, 0]]]
    STACK.push(memory, every, observation, rows(0.5))
    assert STACK.stack(memory, every, observation + 1).tolist() == [[[2, 11, 1, 10, 1, 10, 0.5, 0]]]
    STACK.push(memory, every, observation + 1, rows(0.25))
    expected = [[[3, 12, 2, 11, 1, 10, 0.25, 0.5]]]
    assert STACK.stack(memory, every, observation + 2).tolist() == expected
    STACK.push(memory, every, observation + 2, rows(-1.0))
    expected = [[[4, 13, 3, 12, 2, 11, -1.0, 0.25]]]
    assert STACK.stack(memory, every, observation + 3).tolist() == expected
    assert STACK.size == len(expected[0][0])


def test_other_worlds_stay_as_they_are() -> None:
    rng = np.random.default_rng(0)
    observations = rng.normal(size=(4, 3, 2)).astype(np.float32)
    actions = rng.normal(size=(4, 3, 1)).astype(np.float32)
    memory = STACK.new_memory(4, 3)
    STACK.begin(memory, slice(None), observations)
    STACK.push(memory, slice(None), observations + 1, actions)
    before = STACK.stack(memory, slice(None), observations)
    mask = np.array([True, False, False, True])
    STACK.push(memory, mask, observations[mask] + 2, actions[mask])
    STACK.begin(memory, np.array([2]), observations[[2]])
    after = STACK.stack(memory, slice(None), observations)
    assert same(after[1], before[1])
    assert all((after[world] != before[world]).any() for world in (0, 2, 3))
    assert same(STACK.stack(memory, mask, observations[mask]), after[mask])


def test_a_history_of_1_costs_nothing() -> None:
    plain = ObservationStack(1, 2, 1)
    observations = np.zeros((4, 3, 2), np.float32)
    memory = plain.new_memory(4, 3)
    plain.begin(memory, slice(None), observations)
    plain.push(memory, slice(None), observations, observations[..., :1])
    assert memory == {}
    assert plain.stack(memory, slice(None), observations) is observations
    assert plain.size == 2


def test_reflected_parts_are_the_reflected_stack() -> None:
    task = rsoccer.make_task("VSSMulti-v0")
    stack, rng = ObservationStack.of(task, 3), np.random.default_rng(1)
    here, there = (HandStack(3, task.action_size) for _ in range(2))
    symmetry, plain, reflection = task.symmetry, task.layout.reflection, stack.reflection(task)
    assert symmetry is not None and plain is not None and reflection is not None
    for step in range(4):
        observation = rng.normal(size=task.layout.size).astype(np.float32)
        action = rng.uniform(-1, 1, task.action_size).astype(np.float32)
        if step == 0:
            here.begin(observation)
            there.begin(plain.apply(observation))
        else:
            here.step(action, observation)
            there.step(symmetry.action.apply(action), plain.apply(observation))
    assert same(reflection.apply(here.value), there.value)
    assert (here.value != there.value).any()
    assert same(reflection.apply(there.value), here.value)


def test_an_asymmetric_task_has_no_reflection() -> None:
    task = rsoccer.make_task("SSLDribbling-v0")
    assert ObservationStack.of(task, 2).reflection(task) is None


def test_the_space_has_the_bounds_of_each_part() -> None:
    task = rsoccer.make_task("SSLGoToBall-v0")
    o, space = task.layout.size, spaces.observation_space(task, history=3)
    assert space.shape == (3 * o + 2 * task.action_size,)
    for first in range(0, 3 * o, o):
        assert same(space.high[first : first + o], task.layout.high)
        assert same(space.low[first : first + o], task.layout.low)
    assert (space.high[3 * o :] == 1.0).all() and (space.low[3 * o :] == -1.0).all()
    assert spaces.observation_space(task) == spaces.observation_space(task, 1)


BAD: list[tuple[Any, type[Exception], str]] = [
    (0, ValueError, "history: expected at least 1, got 0"),
    (-2, ValueError, "history: expected at least 1, got -2"),
    (1.5, TypeError, "history: expected a whole number, got 1.5"),
    (True, TypeError, "history: expected a whole number, got True"),
    ("3", TypeError, "history: expected a whole number, got '3'"),
    (None, TypeError, "history: expected a whole number, got None"),
]


@pytest.mark.parametrize(("history", "error", "message"), BAD)
def test_bad_histories_are_refused(history: Any, error: type[Exception], message: str) -> None:  # noqa: ANN401
    with pytest.raises(error, match=f"^{message}$"):
        rsoccer.Matches("VSS-v0", history=history)
    with pytest.raises(error, match=f"^{message}$"):
        spaces.observation_space(rsoccer.make_task("VSS-v0"), history)

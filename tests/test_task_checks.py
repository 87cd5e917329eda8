"""Validation of what the author of a task defines."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, task_checks
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.task import Play, Task
from rsoccer.tasks import VssSelfPlay
from rsoccer.testing import TaskError, check_task
from tests.helpers import zeros


def task_with(name: str, value: object) -> Task:
    """A task of the class Mine with another attribute."""
    made: Task = type("Mine", (VssSelfPlay,), {name: value})()
    return made


FRAME = r"expected a Frame of \d worlds with 3 blue and 3 yellow robots, got \d worlds with"
FAULTS: dict[str, list[tuple[Any, str]]] = {
    "get_initial_positions_frame": [
        (lambda self, rng: None, "expected a Frame, got NoneType"),
        (lambda self, rng: np.zeros((len(rng), 89)), "expected a Frame, got ndarray"),
        (lambda self, rng: Frame.empty(len(rng), 2, 2), f"{FRAME} 2 blue and 2 yellow"),
        (lambda self, rng: Frame.empty(len(rng) + 1, 3, 3), f"{FRAME} 3 blue and 3 yellow"),
    ],
    "frame_to_observations": [
        (lambda self, play: None, "expected blocks .* by name, got NoneType"),
        (lambda self, play: {}, r"expected at least one block, got \[\]"),
        (lambda self, play: {"a": 0.5}, "'a': expected an array .*, got float"),
        (lambda self, play: {"a": [0.5]}, "'a': expected an array .*, got list"),
        (lambda self, play: {"a": np.zeros(3)}, r"expected \(1, 1, ...\) for 'a', got \(3,\)"),
        (lambda self, play: observed(self, play) | {"a": 0.5}, "'a': expected an array .* float"),
        (lambda self, play: observed(self, play) | {"a": np.zeros(1)}, r"for 'a', got \(1,\)"),
    ],
    "new_memory": [(lambda self, n: None, "expected arrays by name, got None")],
    "default_controllers": [
        (lambda self: None, r"expected a controller for each of \['blue_0', .*, got NoneType"),
        (lambda self: {"blue_0": LEARN}, r"each of .*, got those of \['blue_0'\]"),
        (lambda self: dict.fromkeys([*VssSelfPlay().robots, "blue_9"], LEARN), "'blue_9'"),
        (lambda self: dict.fromkeys(VssSelfPlay().robots, 3), "'blue_0': expected .*, got 3"),
    ],
    "sides": [
        (("red",), r"expected teams of \('blue', 'yellow'\), got \('red',\)"),
        ("blue", "expected teams of .*, got 'blue'"),
        ((), r"expected teams of .*, got \(\)"),
        (None, "expected teams of .*, got None"),
    ],
    "rules": [
        (None, "expected a sequence of rules, got NoneType"),
        ((3,), r"expected a sequence of rules, got \(3,\)"),
    ],
    "action_size": [
        ("2", "expected a whole number, got '2'"),
        (0, "expected at least 1, got 0"),
    ],
    "optional_action_size": [(3, "expected at most 2, got 3")],
    "action_table": [
        ([[1.0, 0.0]], r"expected numbers \(choices, 2\) from -1 to 1, got \[\["),
        (np.array([[2.0, 0.0]]), "expected numbers .* from -1 to 1"),
        (np.array([[np.nan, 0.0]]), "expected numbers .* from -1 to 1"),
        (np.zeros((4, 3)), r"expected numbers \(choices, 2\)"),
        (np.zeros((0, 2)), r"expected numbers \(choices, 2\)"),
    ],
    "observation_limits": [
        (lambda self: None, "expected bounds by name, got NoneType"),
        (lambda self: {"bal": 3.0}, r"expected names of \['ball', .*, got \['bal'\]"),
        (lambda self: {"ball": 0.0}, "'ball': expected a positive number, got 0.0"),
        (lambda self: {"ball": None}, "'ball': expected a number, got None"),
    ],
}


def observed(task: Any, play: Play) -> Any:  # noqa: ANN401
    """Blocks of the parent, which have not been computed yet."""
    return VssSelfPlay.frame_to_observations(task, play)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [(name, value, message) for name, found in FAULTS.items() for value, message in found],
)
def test_what_a_task_defines_is_named_where_it_is_wrong(
    name: str, value: object, message: str
) -> None:
    """Most were once errors that named neither the task nor the method; some were not noticed."""
    with pytest.raises((TypeError, ValueError), match=message) as caught:
        Matches(task_with(name, value), 2)
    assert str(caught.value).startswith(f"Mine.{name}: ")


CHECKED = ("frame_to_observations", "rules", "sides", "observation_limits", "default_controllers")


@pytest.mark.parametrize("name", CHECKED)
def test_check_task_says_the_same(name: str) -> None:
    for value, message in FAULTS[name]:
        with pytest.raises(TaskError, match=message):
            check_task(task_with(name, value), worlds=2, steps=4)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("metrics", lambda self, play: None),
        ("metrics", lambda self, play: {"steps": np.zeros(len(play.frame), np.float32)}),
        ("calculate_reward_and_done", lambda self, play: None),
        ("calculate_reward_and_done", lambda self, play: (None, None)),
        ("calculate_reward_and_done", lambda self, play: ({}, False)),
        ("new_memory", lambda self, n: None),
    ],
)
def test_check_task_names_methods_that_return_other_types(name: str, value: object) -> None:
    with pytest.raises(TaskError, match=rf"{name}: (it|the end|expected)"):
        check_task(task_with(name, value), worlds=2, steps=4)


def test_initial_states_of_later_resets_are_checked_too(monkeypatch: pytest.MonkeyPatch) -> None:
    matches = Matches(task_with("text", ""), 2)
    monkeypatch.setattr(type(matches.task), "get_initial_positions_frame", lambda *_: None)
    with pytest.raises(TypeError, match=r"^Mine\.get_initial_positions_frame: expected a Frame"):
        matches.reset()


def test_blocks_of_later_steps_have_the_first_shapes() -> None:
    def growing(self: Any, play: Play) -> Any:  # noqa: ANN401
        size = 2 if play.steps.any() else 1
        block: Floats = np.zeros((len(play.frame), len(play.observers), size), np.float32)
        return observed(self, play) | {"a": block}

    matches = Matches(task_with("frame_to_observations", growing), 2)
    matches.reset()
    with pytest.raises(ValueError, match=r"^Mine.*expected \(2, 6, 1\) for 'a', got \(2, 6, 2\)"):
        matches.step(zeros(matches))


def test_bounds_of_blocks_that_a_class_of_the_package_lists_are_taken() -> None:
    """A task may have fewer blocks than its parent in the package."""

    def few(self: Any, play: Play) -> Any:  # noqa: ANN401
        return {"own": np.zeros((len(play.frame), len(play.observers), 1), np.float32)}

    def bounds(self: Any) -> dict[str, float]:  # noqa: ANN401
        return VssSelfPlay.observation_limits(self) | {"own": np.inf}

    attributes = {"frame_to_observations": few, "observation_limits": bounds}
    task: Task = type("Mine", (VssSelfPlay,), attributes)()
    assert task.layout.high.tolist() == [np.inf]


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_tasks_of_the_package_are_valid(name: str) -> None:
    task = rsoccer.make_task(name)
    task_checks.definition(task)
    assert task_checks.limits(task, task.layout.blocks) == task.observation_limits()
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 1))
    assert task_checks.initial_rows(task, frame, 1) is frame.rows

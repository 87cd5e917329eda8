from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rsoccer import LEARN, Matches
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.recording import film_match
from rsoccer.replay import record_replay
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import Crowd, begun, same, zeros


@pytest.mark.parametrize(
    ("actions", "error", "message"),
    [
        (np.zeros((5, 6), np.float32), ValueError, r"actions: expected shape \(5, 6, 2\), got"),
        (np.zeros((1, 6, 2), np.float32), ValueError, "actions: expected shape"),
        (
            np.zeros((5, 6, 2), np.int64),
            TypeError,
            "actions: expected a floating-point array, got int64",
        ),
        (np.full((5, 6, 2), np.nan, np.float32), ValueError, r"got nan at \(0, 0, 0\)"),
        (np.full((5, 6, 2), np.inf), ValueError, "actions: expected finite numbers, got inf"),
        ([["left"] * 2] * 6, TypeError, "actions: expected a floating-point array"),
        (None, TypeError, "actions: expected a floating-point array, got NoneType"),
        ([[[0.0], [0.0, 0.0]]], ValueError, "actions: .* got a list whose parts differ in length"),
    ],
    ids=["axes", "worlds", "int", "nan", "inf", "text", "none", "ragged"],
)
def test_wrong_actions_are_refused_without_a_change(
    actions: object, error: type[Exception], message: str
) -> None:
    matches = begun(VssSelfPlay(), controllers={"yellow_2": LEARN})
    before = matches.state_dict()
    with pytest.raises(error, match=message):
        matches.step(actions)  # type: ignore[arg-type]
    after = matches.state_dict()
    assert all(same(after[name], before[name]) for name in before)


@pytest.mark.parametrize(
    ("names", "error"),
    [
        (("one",), ValueError),
        (("a", "b", "c"), ValueError),
        ((), ValueError),
        ((1, 2), TypeError),
        (("A", None), TypeError),
        ("AB", TypeError),
        (None, TypeError),
    ],
)
@pytest.mark.parametrize("record", [record_replay, film_match])
def test_wrong_names_of_teams_are_refused_before_a_match_is_played(
    record: Callable[..., object], names: object, error: type[Exception]
) -> None:
    with pytest.raises(error, match="names: expected "):
        record(VssSelfPlay(), {"all": "zero"}, seconds=0.1, names=names)


def test_large_actions_are_clipped_and_float64_is_cast() -> None:
    double, single = begun(VssSelfPlay()), begun(VssSelfPlay())
    double.step(np.full((5, 6, 2), 1e300))
    single.step(np.ones((5, 6, 2), np.float32))
    assert same(double.frame.rows, single.frame.rows)
    assert (double.play.actions == 1.0).all()


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"worlds": 0}, ValueError, "worlds: expected at least 1, got 0"),
        ({"worlds": 2.0}, TypeError, "worlds: expected a whole number, got 2.0"),
        ({"worlds": True}, TypeError, "worlds: expected a whole number"),
        ({"threads": 0}, ValueError, "threads: expected at least 1"),
        ({"seed": -1}, ValueError, "seed: expected at least 0"),
        ({"max_steps": True}, TypeError, "max_steps: expected a whole number, got True"),
        ({"autoreset": "always"}, ValueError, "autoreset: expected one of.*same_step"),
        ({"controllers": {"green": "ou"}}, ValueError, r"unknown \['green'\].*'all', 'blue'"),
        ({"controllers": {"blue_3": "ou"}}, ValueError, "unknown"),
        ({"controllers": {"blue": "chess"}}, ValueError, "unknown policy 'chess'.*'ou'"),
        ({"controllers": {"blue": 7}}, TypeError, r"controllers\['blue'\]: expected"),
        ({"controllers": ["ou"]}, TypeError, r"controllers: expected a mapping.*, got \['ou'\]"),
        ({"controllers": []}, TypeError, r"controllers: expected a mapping.*, got \[\]"),
        ({"controllers": {7: "ou", "green": "ou"}}, ValueError, r"unknown \[7, 'green'\]"),
        ({"task": "Chess-v0"}, ValueError, "unknown task 'Chess-v0'"),
        ({"task": 3}, TypeError, "task: expected a task or its name, got 3"),
    ],
)
def test_wrong_options_are_refused(
    options: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        Matches(**({"task": "VSSSelfPlay-v0"} | options))


@pytest.mark.parametrize(
    ("reset", "error", "message"),
    [
        ({"seed": -1}, ValueError, "seed: expected at least 0"),
        ({"seed": "x"}, TypeError, "seed: expected a whole number"),
        ({"seed": np.array(1.5)}, TypeError, "seed: expected a whole number, got 1.5"),
        ({"mask": np.ones(4, np.bool_)}, ValueError, r"mask: expected bool \(5,\)"),
        ({"mask": np.ones(5)}, ValueError, "mask: expected bool"),
        ({"rows": np.zeros((5, 3), np.float32)}, ValueError, r"rows: expected shape \(5, 89\)"),
    ],
)
def test_wrong_resets_are_refused(
    reset: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        begun().reset(**reset)


def test_an_array_without_axes_is_the_number_in_it() -> None:
    assert same(begun().reset(seed=np.array(3)), begun().reset(seed=3))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ({"get_commands": np.zeros((5, 2))}, r"get_commands: expected shape \(5, 6, 2\)"),
        ({"reward": np.zeros(5)}, r"expected \(5, 6\) or \(5, 1\) for 'goal'"),
        ({"done": np.zeros((5, 6), np.bool_)}, r"expected bool \(5,\) for the end"),
        ({"done": np.zeros(5)}, r"expected bool \(5,\) for the end"),
    ],
)
def test_wrong_results_of_a_task_are_named(fault: dict[str, Array], message: str) -> None:
    class Faulty(VssSelfPlay):
        def get_commands(self, play: Play, actions: Floats) -> Floats:
            return fault.get("get_commands", actions)

        def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
            reward = fault.get("reward", np.zeros((5, 6), np.float32))
            return {"goal": reward}, fault.get("done", np.zeros(5, np.bool_))

    matches = begun(Faulty())
    with pytest.raises(ValueError, match=message):
        matches.step(zeros(matches))


@pytest.mark.parametrize("load", ["load_state_dict", "take_over"])
@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (lambda state: None, TypeError, "^state: expected arrays by name, got None"),
        (lambda state: [], TypeError, r"^state: expected arrays by name, got \[\]"),
        (
            lambda state: state | {"simulator": None},
            TypeError,
            "^state: expected an array for 'simulator', got None",
        ),
        (
            lambda state: state | {"simulator": np.zeros(3)},
            TypeError,
            r"^state: expected uint8 \(bytes,\) for 'simulator', got float64 \(3,\)",
        ),
        (
            lambda state: {name: array.tolist() for name, array in state.items()},
            TypeError,
            r"^state: expected an array for 'simulator', got \[",
        ),
        (lambda state: {}, ValueError, "^state: missing or unknown"),
        (
            lambda state: state | {"frame": np.full_like(state["frame"], np.nan)},
            ValueError,
            "^state: expected finite numbers for 'frame', got nan",
        ),
        (
            lambda state: state | {"commands": np.full_like(state["commands"], np.inf)},
            ValueError,
            "^state: expected finite numbers for 'commands', got inf",
        ),
        (
            lambda state: state | {"steps": state["steps"] - 99},
            ValueError,
            "^state: expected at least 0 for 'steps', got -99",
        ),
        (
            lambda state: state | {"starts": np.zeros((1, 3), np.float32)},
            ValueError,
            "^state: expected states of this task for 'starts'",
        ),
    ],
)
def test_a_damaged_state_is_refused_without_a_change(
    load: str, change: Callable[[dict[str, Any]], Any], error: type[Exception], message: str
) -> None:
    matches = begun(Crowd(), controllers={"yellow": "ou"})
    before = matches.state_dict()
    with pytest.raises(error, match=message):
        getattr(matches, load)(change(matches.state_dict()))
    after = matches.state_dict()
    assert all(same(after[name], before[name]) for name in before)


@pytest.mark.parametrize(
    ("argument", "settings"),
    [
        ("history", {"history": 2}),
        ("sensing", {"sensing": "vsss"}),
        ("randomization", {"randomization": {"robot.mass": (0.9, 1.1)}}),
    ],
)
def test_a_state_of_matches_with_another_argument_names_it(
    argument: str, settings: dict[str, Any]
) -> None:
    matches, other = (Matches("VSSSelfPlay-v0", 2, **each) for each in ({}, settings))
    state = other.state_dict()
    with pytest.raises(ValueError, match=f"same {argument}$"):
        matches.load_state_dict(state)
    with pytest.raises(ValueError, match=f"same {argument}$"):
        other.load_state_dict(matches.state_dict())


def test_numbers_of_authors_may_be_no_numbers() -> None:
    matches = Matches("SSLDribbling-v0", 2, controllers={"blue_0": "weave"})
    matches.reset()
    state = matches.state_dict()
    assert any(np.isnan(array).any() for array in state.values() if array.dtype.kind == "f")
    matches.load_state_dict(state)


def test_a_state_of_other_matches_is_refused_without_a_change() -> None:
    matches = begun(Crowd(), controllers={"yellow": "ou"})
    before = matches.state_dict()
    renamed = dict(before)
    renamed["rng.green_0"] = renamed.pop("rng.yellow_0")
    with pytest.raises(ValueError, match=r"state: missing or unknown \['rng.green_0'"):
        matches.load_state_dict(renamed)
    with pytest.raises(ValueError, match=r"state: expected float32 \(5, 89\) for 'frame'"):
        matches.load_state_dict(before | {"frame": before["frame"][:3]})
    with pytest.raises(ValueError, match="snapshot"):
        matches.load_state_dict(
            before | {"steps": before["steps"] + 1, "simulator": np.zeros(9, "u1")}
        )
    after = matches.state_dict()
    assert all(same(after[name], before[name]) for name in before)


def test_rows_refused_by_the_simulator_change_nothing() -> None:
    matches = begun(VssSelfPlay())
    before = matches.state_dict()
    rows = np.repeat(matches.frame.rows[:1], 5, axis=0)
    frame = Frame(rows, 3, 3)
    frame.robots.position[2, 1] = frame.robots.position[2, 4]
    with pytest.raises(ValueError, match="world 2"):
        matches.reset(seed=8, rows=rows)
    frame.robots.position[2, 1] = [3.0, 0.0]
    with pytest.raises(ValueError, match="outside"):
        matches.reset(rows=rows)
    after = matches.state_dict()
    assert all(same(after[name], before[name]) for name in before)

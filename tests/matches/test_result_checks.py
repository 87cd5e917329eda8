"""Results of tasks that do not fit the matches."""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Simulator
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same, zeros


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


@dataclass(frozen=True)
class Returning(VssSelfPlay):
    """A task that returns given ends, metrics or commands."""

    done: Any = None
    metric: Any = None
    commands: Any = None

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms, done if self.done is None else self.done

    def metrics(self, play: Play) -> dict[str, Floats]:
        return super().metrics(play) if self.metric is None else {"goal_score": self.metric}

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        usual = super().get_commands(play, actions)
        given: Floats = usual if self.commands is None else self.commands
        return given


@pytest.mark.parametrize("done", [np.zeros(4), np.zeros((4, 1), np.bool_), np.zeros(1, np.bool_)])
def test_ends_of_another_shape_or_type_are_refused(done: Array) -> None:
    matches = Matches(Returning(done=done), 4)
    matches.reset()
    with pytest.raises(ValueError, match=r"expected bool \(4,\) for the end of episodes, got"):
        matches.step(zeros(matches))


def test_commands_of_another_shape_are_refused() -> None:
    matches = Matches(Returning(commands=np.zeros((4, 6, 3), np.float32)), 4)
    matches.reset()
    with pytest.raises(
        ValueError, match=r"get_commands: expected shape \(4, 6, 2\), got \(4, 6, 3"
    ):
        matches.step(zeros(matches))


TERMS = np.zeros((4, 6), np.float32)
ENDS = np.zeros(4, np.bool_)
STEP_FAULTS: list[tuple[str, Any, str]] = [
    ("get_commands", None, r"get_commands: expected an array \(4, 6, 2\), got NoneType"),
    ("get_commands", [[0.0]], r"get_commands: expected an array \(4, 6, 2\), got list"),
    ("calculate_reward_and_done", None, r"ends of episodes\), got NoneType"),
    ("calculate_reward_and_done", (TERMS, ENDS), r"ends of episodes\), got \(ndarray, ndarray\)"),
    ("calculate_reward_and_done", ({}, ENDS, {}), r"got \(dict, ndarray, dict\)"),
    ("calculate_reward_and_done", ({"own": 0.5}, ENDS), r"'own': expected an array .* got float"),
    ("calculate_reward_and_done", ({"own": None}, ENDS), r"'own': expected an array .* got NoneTy"),
    ("calculate_reward_and_done", ({"own": TERMS}, False), r"bool \(4,\) for the end .*, got bool"),
    ("calculate_reward_and_done", ({"own": TERMS}, [False] * 4), r"for the end .*, got list"),
    ("metrics", None, r"metrics: expected arrays \(4,\) by name, got NoneType"),
    ("metrics", {"own": 1.0}, r"metrics: expected numbers \(4,\) for 'own', got float"),
    ("metrics", {"own": None}, r"metrics: expected numbers \(4,\) for 'own', got NoneType"),
    ("metrics", {"own": "text"}, r"metrics: expected numbers \(4,\) for 'own', got str"),
    ("metrics", {"own": TERMS}, r"metrics: expected numbers \(4,\) for 'own', got \(4, 6\)"),
    ("metrics", {"steps": ENDS}, "metrics: expected another name than 'steps'"),
    ("frame_to_observations", None, r"expected blocks .* by name, got NoneType"),
    ("frame_to_observations", {}, r"expected the blocks \['ball', .*, got \[\]"),
]


@pytest.mark.parametrize(("method", "value", "message"), STEP_FAULTS)
def test_results_of_other_types_are_named(
    method: str, value: object, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They were once errors of NumPy that named neither the task nor the method."""
    matches = Matches(Returning(), 4)
    matches.reset()
    monkeypatch.setattr(Returning, method, lambda *_: value, raising=False)
    with pytest.raises((TypeError, ValueError), match=message) as caught:
        matches.step(zeros(matches))
    assert str(caught.value).startswith(f"Returning.{method}: ")


@pytest.mark.parametrize("kind", [np.int64, np.bool_, np.float64])
def test_metrics_and_commands_of_any_type_become_float32(kind: type[np.generic]) -> None:
    task = Returning(metric=np.ones(4, kind), commands=np.ones((4, 6, 2), kind))
    matches = Matches(task, 4)
    matches.reset()
    metric = matches.step(zeros(matches)).metrics["goal_score"]
    assert same(metric, np.ones(4, np.float32))
    assert matches.play.commands.dtype == np.float32


class Spoiled:
    """The package's simulator, with one number of world 1 replaced after each step."""

    def __init__(self, column: int, value: float, *arguments: Any) -> None:  # noqa: ANN401
        self._own, self._column, self._value = Simulator(*arguments), column, value

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self._own, name)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._own.step(commands, out, active)
        out[1, self._column] = self._value


class Spoiling:
    """Perfect senses, with one number of world 1 replaced after each step."""

    def __init__(self, column: int, value: float) -> None:
        self._column, self._value = column, value

    def columns(self, n: int) -> dict[str, Array]:
        return {}

    def begin(self, frame: Frame, sensed: Frame, state: object, rng: object) -> None:
        pass

    def sense(self, frame: Frame, sensed: Frame, state: object, rng: object) -> None:
        sensed.rows[:] = frame.rows
        sensed.rows[1, self._column] = self._value


ABSENT = len(BALL_COLUMNS) + 2 * len(ROBOT_COLUMNS) + ROBOT_COLUMNS.index("absent")
PLACES = {name: BALL_COLUMNS.index(name) for name in ("x", "v_y", "last_touch", "crossed")}


@pytest.mark.parametrize(
    ("column", "value", "message"),
    [
        ("x", np.nan, r"expected finite numbers, got others in worlds \[1\]"),
        ("v_y", np.inf, r"expected finite numbers"),
        ("last_touch", 6.0, "from -1 to 5 for 'last_touch', got 6"),
        ("last_touch", -1.5, "for 'last_touch', got -1.5"),
        ("crossed", 7.0, "from 0 to 6 for 'crossed', got 7"),
        ("absent", 0.5, "from 0 to 1 for 'absent', got 0.5"),
    ],
)
@pytest.mark.parametrize("written", ["Spoiled.step", "Spoiling.sense"])
def test_rows_of_others_are_checked(column: str, value: float, message: str, written: str) -> None:
    place = {**PLACES, "absent": ABSENT}[column]
    given: dict[str, Any] = {"sensing": Spoiling(place, value)}
    if written == "Spoiled.step":
        given = {"simulator": partial(Spoiled, place, value)}
    matches = Matches("VSSSelfPlay-v0", 2, **given)
    matches.reset()
    with pytest.raises(ValueError, match=f"{written}: .*{message}"):
        matches.step(zeros(matches))


def test_a_sensor_models_columns_are_arrays_by_name() -> None:
    class Wrong:
        def columns(self, n: int) -> Any:  # noqa: ANN401
            return 3

        def begin(self, *given: object) -> None:
            pass

        sense = begin

    with pytest.raises(TypeError, match=r"Wrong\.columns: expected arrays by name, got 3"):
        Matches("VSSSelfPlay-v0", sensing=Wrong())

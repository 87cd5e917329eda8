"""`Task.restart_play`: invalid results, and worlds in any order."""

from dataclasses import dataclass, field

import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.play import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun, same, zeros

Result = tuple[Array, Floats]


@dataclass(frozen=True)
class Restarter(VssSelfPlay):
    """Restarts play by a list of results."""

    results: list[Result] = field(default_factory=list)

    def restart_play(self, play: Play) -> tuple[NDArray[np.intp], Floats] | None:
        return self.results.pop() if self.results else None


def line_ups(*shifts: float) -> Floats:
    """State rows (k, row) with all bodies in a line, shifted along y."""
    frame = Frame.empty(len(shifts), 3, 3)
    x = np.linspace(-0.5, 0.5, 7)
    y = np.array(shifts)[:, None]
    frame.ball.position[:] = np.concatenate([np.full_like(y, x[0]), y], axis=1)
    frame.robots.position[..., 0] = x[1:]
    frame.robots.position[..., 1] = y
    return frame.rows


def test_worlds_in_any_order_get_their_own_states() -> None:
    task = Restarter()
    matches, control = begun(task, 4), begun(Restarter(), 4)
    task.results.append((np.array([3, 0]), line_ups(0.3, -0.2)))
    outcome = matches.step(zeros(matches) + 0.5)
    control.step(zeros(control) + 0.5)
    expected = line_ups(-0.2, 0.3)
    assert same(matches.frame.rows[[0, 3]], expected)
    assert same(matches.frame.rows[1:3], control.frame.rows[1:3])
    assert same(matches.play.view.robots.data[0], matches.play.last_view.robots.data[0])
    assert matches.play.steps.tolist() == [1, 1, 1, 1]
    assert not outcome.terms["approach"][[0, 3]].any()


@pytest.mark.parametrize(
    ("result", "message"),
    [
        ((np.array([4]), line_ups(0.0)), r"restart_play: expected worlds 0 to 3, got \[4\]"),
        ((np.array([1, 1]), line_ups(0.0, 0.0)), r"restart_play: expected each world once"),
        ((np.array([0.0]), line_ups(0.0)), "restart_play: expected whole numbers"),
        ((np.array([0]), line_ups(0.0, 0.0)), r"restart_play: rows: expected shape \(1, "),
        ((np.array([0]), line_ups(np.nan)), "restart_play: rows: expected finite"),
        ((np.array([0]), line_ups(9.0)), "world 0: ball is outside the field"),
        (line_ups(0.0), "restart_play: expected worlds and rows, or None"),
    ],
)
def test_invalid_results_are_named(result: Result, message: str) -> None:
    task = Restarter()
    matches = begun(task, 4)
    task.results.append(result)
    with pytest.raises((TypeError, ValueError), match=message):
        matches.step(zeros(matches))

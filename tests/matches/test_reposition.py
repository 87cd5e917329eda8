"""`Task.reposition_ball`: valid and invalid results, and their effect on the matches."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Simulator
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.tasks import SslSelfPlay
from tests.helpers import begun, same, zeros

Result = tuple[Array, Floats] | None


def balls(*positions: tuple[float, float]) -> Floats:
    """Balls at rest (k, ball column) at given positions."""
    rows = np.zeros((len(positions), Frame.empty(1, 1, 1).ball.data.shape[1]), np.float32)
    rows[:, :2] = np.reshape(positions, (-1, 2))
    return rows


@dataclass(frozen=True)
class BallMover(SslSelfPlay):
    """Repositions balls by a list of results."""

    results: list[Result] = field(default_factory=list)

    def reposition_ball(self, frame: Frame) -> Result:
        return self.results.pop() if self.results else None


def ball_mover(worlds: int = 4, autoreset: str = "same_step") -> tuple[Matches, list[Result]]:
    task = BallMover()
    return begun(task, worlds, autoreset=autoreset), task.results


CORNERS = [(2.5, 1.5), (-2.5, 1.5), (2.5, -1.5), (-2.5, -1.5)]


def test_worlds_in_any_order_get_their_own_balls() -> None:
    """Formerly rows were used in the order of the result, but worlds in the order of a mask."""
    matches, results = ball_mover()
    corners = np.array(CORNERS)[:, None] + np.zeros((1, 6, 2))
    assert (np.abs(matches.frame.robots.position - corners).max(axis=-1) > 0.2).all(), (
        "all corners are free"
    )
    before = matches.frame.robots.position.copy()
    results.append((np.array([3, 0, 2]), balls(CORNERS[3], CORNERS[0], CORNERS[2])))
    matches.step(zeros(matches))
    for world in (0, 2, 3):
        assert matches.frame.ball.position[world] == pytest.approx(CORNERS[world])
    assert not same(matches.frame.ball.position[1], np.array(CORNERS[1], np.float32))
    assert matches.frame.robots.position == pytest.approx(before, abs=1e-3), "no robot moved"


def test_last_frame_and_views_equal_the_new_ones_only_in_these_worlds() -> None:
    matches, results = ball_mover()
    matches.step(zeros(matches) + 0.5)
    results.append((np.array([2, 0]), balls(CORNERS[2], CORNERS[0])))
    matches.step(zeros(matches) + 0.5)
    play, moved = matches.play, np.array([True, False, True, False])
    assert same(play.view.ball.data[moved], play.last_view.ball.data[moved])
    for now, last in (
        (play.frame.rows, play.last_frame.rows),
        (play.view.robots.data, play.last_view.robots.data),
    ):
        assert same(now[moved], last[moved])
        assert not any(same(now[world], last[world]) for world in np.flatnonzero(~moved))
    fresh = matches._viewpoint.new_view(4)
    matches._viewpoint.fill(play.frame, fresh)
    assert same(fresh.ball.data, play.view.ball.data)
    assert same(fresh.robots.data, play.view.robots.data)


def test_waiting_worlds_keep_their_balls() -> None:
    matches, results = ball_mover(autoreset="disabled")
    matches._done[1] = True
    before = matches.frame.rows.copy()
    results.append((np.array([1, 0]), balls(CORNERS[1], CORNERS[0])))
    matches.step(zeros(matches))
    assert same(matches.frame.rows[1], before[1])
    assert matches.frame.ball.position[0] == pytest.approx(CORNERS[0])
    rows = np.empty_like(before)
    simulator = matches._simulator
    assert isinstance(simulator, Simulator)
    simulator.read(rows)
    assert same(rows[1, :2], before[1, :2])


def test_drives_and_kickers_continue() -> None:
    """Formerly all bodies were placed again, so accelerating robots lost a step of their drives."""
    matches, results = ball_mover(2)
    control = begun(BallMover(), 2)
    for step in range(30):
        if step % 3 == 2:
            results.append((np.array([1]), balls(CORNERS[step % 4])))
        matches.step(zeros(matches) + 0.3)
        control.step(zeros(control) + 0.3)
    ours, theirs = matches.frame.robots, control.frame.robots
    assert same(ours.data, theirs.data), "no robot touched a ball, so nothing else may differ"
    assert np.abs(ours.velocity).max() > 0.3
    assert not same(matches.frame.ball.position[1], control.frame.ball.position[1])


@pytest.mark.parametrize(
    ("result", "message"),
    [
        ((np.array([0, 4]), balls((0, 0), (0, 0))), r"expected worlds 0 to 3, got \[0, 4\]"),
        ((np.array([-1]), balls((0, 0))), r"expected worlds 0 to 3, got \[-1\]"),
        ((np.array([1, 1]), balls((0, 0), (0, 0))), r"each world once, got \[1, 1\]"),
        ((np.array([True]), balls((0, 0))), "whole numbers"),
        ((np.array([0.0]), balls((0, 0))), "whole numbers"),
        ((np.array([0]), balls((0, 0), (0, 0))), r"balls: expected shape \(1, 14\), got \(2, 14\)"),
        (([], balls((0, 0))), r"balls: expected shape \(0, 14\), got \(1, 14\)"),
        ((np.array([0]), balls((np.nan, 0))), "balls: expected finite"),
        ((np.array([0]), balls((9, 9))), "world 0: ball is outside the field"),
        (np.array([0]), "expected worlds and balls, or None"),
    ],
)
def test_invalid_results_are_named(result: Result, message: str) -> None:
    matches, results = ball_mover()
    results.append(result)
    with pytest.raises((TypeError, ValueError), match=message):
        matches.step(zeros(matches))


NO_WORLDS: list[Any] = [(np.zeros(0, np.intp), balls()), ([], balls()), ([], []), ((), np.zeros(0))]


@pytest.mark.parametrize("empty", NO_WORLDS)
def test_a_result_may_be_empty(empty: Result) -> None:
    """Formerly an empty list was refused as an array of floats."""
    matches, results = ball_mover()
    control = begun(BallMover(), 4)
    results.append(empty)
    assert same(
        matches.step(zeros(matches)).observations, control.step(zeros(control)).observations
    )


def test_the_simulator_gets_worlds_and_balls_in_order() -> None:
    calls: list[tuple[list[bool], Floats]] = []

    class Recording:
        def __init__(self) -> None:
            self.own = Simulator(BallMover().config, 3)
            self.place, self.restart, self.step = self.own.place, self.own.restart, self.own.step

        def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
            calls.append((worlds.tolist(), balls.copy()))
            self.own.reposition_balls(worlds, balls, out)

    task = BallMover()
    matches = Matches(task, 3, simulator=Recording())
    matches.reset()
    task.results.append((np.array([2, 1]), balls(CORNERS[2], CORNERS[1])))
    matches.step(zeros(matches))
    [(mask, received)] = calls
    assert mask == [False, True, True]
    assert same(received, balls(CORNERS[1], CORNERS[2]))

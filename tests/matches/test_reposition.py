"""Balls that go on from elsewhere, and what a task may answer when it is asked."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Simulator
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.tasks import SslSelfPlay
from tests.helpers import begun, same, zeros

Answer = tuple[Array, Floats] | None


def balls(*places: tuple[float, float]) -> Floats:
    """Balls at rest (k, ball column) at these places."""
    found = np.zeros((len(places), Frame.empty(1, 1, 1).ball.data.shape[1]), np.float32)
    found[:, :2] = np.reshape(places, (-1, 2))
    return found


@dataclass(frozen=True)
class Told(SslSelfPlay):
    """Moves balls as it is told."""

    answers: list[Answer] = field(default_factory=list)

    def reposition_ball(self, frame: Frame) -> Answer:
        return self.answers.pop() if self.answers else None


def told(worlds: int = 4, autoreset: str = "same_step") -> tuple[Matches, list[Answer]]:
    task = Told()
    return begun(task, worlds, autoreset=autoreset), task.answers


CORNERS = [(2.5, 1.5), (-2.5, 1.5), (2.5, -1.5), (-2.5, -1.5)]


def test_worlds_in_any_order_get_their_own_balls() -> None:
    """Rows were handed on in the order given, but worlds in that of a mask."""
    matches, answers = told()
    where = np.array(CORNERS)[:, None] + np.zeros((1, 6, 2))
    assert (np.abs(matches.frame.robots.position - where).max(axis=-1) > 0.2).all(), "all free"
    before = matches.frame.robots.position.copy()
    answers.append((np.array([3, 0, 2]), balls(CORNERS[3], CORNERS[0], CORNERS[2])))
    matches.step(zeros(matches))
    for world in (0, 2, 3):
        assert matches.frame.ball.position[world] == pytest.approx(CORNERS[world])
    assert not same(matches.frame.ball.position[1], np.array(CORNERS[1], np.float32))
    assert matches.frame.robots.position == pytest.approx(before, abs=1e-3), "nobody else moved"


def test_last_frame_and_views_are_of_after_the_move_there_and_only_there() -> None:
    matches, answers = told()
    matches.step(zeros(matches) + 0.5)
    answers.append((np.array([2, 0]), balls(CORNERS[2], CORNERS[0])))
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


def test_worlds_that_wait_keep_their_balls() -> None:
    matches, answers = told(autoreset="disabled")
    matches._done[1] = True
    before = matches.frame.rows.copy()
    answers.append((np.array([1, 0]), balls(CORNERS[1], CORNERS[0])))
    matches.step(zeros(matches))
    assert same(matches.frame.rows[1], before[1])
    assert matches.frame.ball.position[0] == pytest.approx(CORNERS[0])
    rows = np.empty_like(before)
    simulator = matches._simulator
    assert isinstance(simulator, Simulator)
    simulator.read(rows)
    assert same(rows[1, :2], before[1, :2])


def test_drives_and_kickers_go_on() -> None:
    """Placing all anew began every robot's drive anew: robots that speed up lost a step of it."""
    matches, answers = told(2)
    control = begun(Told(), 2)
    for step in range(30):
        if step % 3 == 2:
            answers.append((np.array([1]), balls(CORNERS[step % 4])))
        matches.step(zeros(matches) + 0.3)
        control.step(zeros(control) + 0.3)
    ours, theirs = matches.frame.robots, control.frame.robots
    assert same(ours.data, theirs.data), "nobody met a ball, so nothing else may differ"
    assert np.abs(ours.velocity).max() > 0.3
    assert not same(matches.frame.ball.position[1], control.frame.ball.position[1])


@pytest.mark.parametrize(
    ("answer", "message"),
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
def test_answers_that_mean_nothing_are_named(answer: Answer, message: str) -> None:
    matches, answers = told()
    answers.append(answer)
    with pytest.raises((TypeError, ValueError), match=message):
        matches.step(zeros(matches))


NOBODY: list[Any] = [(np.zeros(0, np.intp), balls()), ([], balls()), ([], []), ((), np.zeros(0))]


@pytest.mark.parametrize("nobody", NOBODY)
def test_nobody_moved_is_an_answer(nobody: Answer) -> None:
    """An empty list was taken for numbers that are not whole."""
    matches, answers = told()
    control = begun(Told(), 4)
    answers.append(nobody)
    assert same(
        matches.step(zeros(matches)).observations, control.step(zeros(control)).observations
    )


def test_a_simulator_is_asked_for_the_ball_alone() -> None:
    calls: list[tuple[list[bool], Floats]] = []

    class Asked:
        def __init__(self) -> None:
            self.own = Simulator(Told().config, 3)
            self.place, self.step = self.own.place, self.own.step

        def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
            calls.append((worlds.tolist(), balls.copy()))
            self.own.reposition_balls(worlds, balls, out)

    task = Told()
    matches = Matches(task, 3, simulator=Asked())
    matches.reset()
    task.answers.append((np.array([2, 1]), balls(CORNERS[2], CORNERS[1])))
    matches.step(zeros(matches))
    [(mask, given)] = calls
    assert mask == [False, True, True]
    assert same(given, balls(CORNERS[1], CORNERS[2]))

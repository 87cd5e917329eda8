"""Crowds that drive at the ball for long, in every task: what learners do soon.

`make soak` plays a hundred times as long, by RSOCCER_SOAK_STEPS.
"""

import os

import numpy as np
import pytest
from numpy.typing import NDArray

import rsoccer
from rsoccer import Matches
from rsoccer.frame import Floats, Frame
from rsoccer.task import Task
from rsoccer.tasks import SslSelfPlay
from rsoccer.testing.pressure import Pressing
from tests.helpers import same, touches

STEPS = int(os.environ.get("RSOCCER_SOAK_STEPS", "10000"))  # of all worlds together, in each case
TASKS: dict[str, Task] = {name: rsoccer.make_task(name) for name in rsoccer.list_tasks()} | {
    "five a side": rsoccer.make_task("VSSSelfPlay-v0", n_blue=5, n_yellow=5),
    "eleven a side": rsoccer.make_task("SSLSelfPlay-v0", n_blue=11, n_yellow=11),
}
WORLDS = 32


@pytest.mark.parametrize("name", TASKS)
def test_a_crowd_at_the_ball_plays_on(name: str) -> None:
    task = TASKS[name]
    matches = Matches(task, WORLDS, seed=1)
    pressing, met = Pressing(task), 0
    matches.reset()
    for _ in range(STEPS // WORLDS):
        outcome = matches.step(pressing.actions(matches))
        assert np.isfinite(outcome.observations).all()
        assert np.isfinite(outcome.rewards).all()
        # A task that ends with the ball reached leaves no time to touch it.
        met += touches(matches.frame, task.config) + int(outcome.terminated.sum())
    assert met > WORLDS, "they never met"


@pytest.mark.parametrize(("robots", "seed"), [(3, 0), (3, 1), (11, 0)])
def test_robots_that_press_do_not_end_a_batch_when_a_ball_comes_back(
    robots: int, seed: int
) -> None:
    """Placing all of a world anew was refused where robots pressed on each other or on a wall."""
    moved: list[tuple[NDArray[np.intp], Floats]] = []

    class Watched(SslSelfPlay):
        def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
            found = super().reposition_ball(frame)
            moved.extend([found] if found else [])
            return found

    task = Watched(n_blue=robots, n_yellow=robots)
    matches = Matches(task, WORLDS, seed)
    pressing, met = Pressing(task, seed), 0
    matches.reset()
    for _ in range(STEPS // WORLDS):
        before, play = len(moved), matches.play
        matches.step(pressing.actions(matches))
        met += touches(matches.frame, task.config)
        for worlds, balls in moved[before:]:
            came = play.steps[worlds] > 0  # not where the clock ended it just then
            worlds, place = worlds[came], balls[came, :2]
            assert same(play.frame.ball.position[worlds], place)
            assert same(play.frame.rows[worlds], play.last_frame.rows[worlds])
            assert same(play.view.robots.data[worlds], play.last_view.robots.data[worlds])
            assert same(play.view.ego.position[worlds, 0], play.frame.blue.position[worlds, 0])
            assert same(play.view.ball.position[worlds, 0], place)
    assert len(moved) > 20, "hardly a ball came back"
    assert met > 1000, "nobody pressed"

"""Robots that press at the ball for long, in every task, as trained robots do.

`make soak` plays a hundred times as long, by RSOCCER_SOAK_STEPS.
"""

import os
from collections.abc import Sequence

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.play import Play
from rsoccer.rules import BallOut, Restart, Rule
from rsoccer.task import Task
from rsoccer.tasks import SslMatch, SslSelfPlay, VssMatch
from rsoccer.testing.pressure import Pressing
from tests.games import begin_play
from tests.helpers import same, touches

STEPS = int(os.environ.get("RSOCCER_SOAK_STEPS", "10000"))  # of all worlds together, in each test
TASKS: dict[str, Task] = {name: rsoccer.make_task(name) for name in rsoccer.list_tasks()} | {
    "five a side": rsoccer.make_task("VSSSelfPlay-v0", n_blue=5, n_yellow=5),
    "eleven a side": rsoccer.make_task("SSLSelfPlay-v0", n_blue=11, n_yellow=11),
}
MATCHES: dict[str, Task] = {
    "VSSS 1": VssMatch(n_blue=1, n_yellow=1),
    "VSSS 3": VssMatch(engine="rapier"),
    "VSSS 5": VssMatch(n_blue=5, n_yellow=5, field="vss_5v5"),
    "SSL 1": SslMatch(n_blue=1, n_yellow=1, placement="robots"),
    "SSL 6": SslMatch(placement="robots", engine="rapier"),
    "SSL 8": SslMatch(n_blue=8, n_yellow=4, knockout=True),
    "SSL 11": SslMatch(n_blue=11, n_yellow=11, division="A"),
}
"""Matches under a referee: team sizes, ways of placing the ball, and engines in turn."""
WORLDS = 32


@pytest.mark.parametrize("name", TASKS)
def test_pressing_robots_play_without_errors(name: str) -> None:
    task = TASKS[name]
    matches = Matches(task, WORLDS, seed=1)
    pressing, contacts = Pressing(task), 0
    matches.reset()
    for _ in range(STEPS // WORLDS):
        outcome = matches.step(pressing.actions(matches))
        assert np.isfinite(outcome.observations).all()
        assert np.isfinite(outcome.rewards).all()
        # Tasks that end when a robot reaches the ball end before a touch.
        contacts += touches(matches.frame, task.config) + int(outcome.terminated.sum())
    assert contacts > WORLDS, "too few contacts"


@pytest.mark.parametrize(("robots", "seed"), [(3, 0), (3, 1), (11, 0)])
def test_a_ball_can_be_repositioned_while_robots_press(robots: int, seed: int) -> None:
    """Formerly a whole world was placed again, which failed where robots pressed on each other."""
    moved: list[Restart] = []

    class WatchedBallOut(BallOut):
        def judge(self, play: Play) -> Restart | None:
            restart = super().judge(play)
            moved.extend([restart] if restart else [])
            return restart

    class Watched(SslSelfPlay):
        @property
        def rules(self) -> Sequence[Rule]:
            return tuple(
                WatchedBallOut(self.config) if isinstance(rule, BallOut) else rule
                for rule in super().rules
            )

    task = Watched(n_blue=robots, n_yellow=robots)
    matches = Matches(task, WORLDS, seed)
    pressing, contacts = Pressing(task, seed), 0
    matches.reset()
    for _ in range(STEPS // WORLDS):
        before, play = len(moved), matches.play
        matches.step(pressing.actions(matches))
        contacts += touches(matches.frame, task.config)
        for restart in moved[before:]:
            assert restart.balls is not None
            # Without worlds that the time limit ended in this step.
            kept = play.steps[restart.worlds] > 0
            worlds, position = restart.worlds[kept], restart.balls[kept, :2]
            assert same(play.frame.ball.position[worlds], position)
            assert same(play.frame.rows[worlds], play.last_frame.rows[worlds])
            assert same(play.view.robots.data[worlds], play.last_view.robots.data[worlds])
            assert same(play.view.ego.position[worlds, 0], play.frame.blue.position[worlds, 0])
            assert same(play.view.ball.position[worlds, 0], position)
    assert len(moved) > 20, "too few balls were repositioned"
    assert contacts > 1000, "too few contacts"


def corner(task: Task, robots: int, sign: float) -> Floats:
    """Actions (robots, action) by which SSL robots drive to a corner, and VSSS robots whirl."""
    actions = np.full((robots, task.action_size), sign, np.float32)
    if not task.config.robot.has_mouth:
        actions[::2, 0] *= -1.0
    return actions


@pytest.mark.parametrize("name", MATCHES)
def test_a_referee_restarts_play_in_crowds_without_errors(name: str) -> None:
    """Robots at the ball, robots at a corner, and robots that do all that they can."""
    task = MATCHES[name]
    matches, worlds = Matches(task, 12, seed=3), np.arange(12)
    pressing, restarts = Pressing(task), 0
    rng = np.random.default_rng(0)
    matches.reset()
    begin_play(matches)
    for step in range(STEPS // 8):
        actions = pressing.actions(matches)
        actions[worlds % 3 == 1] = corner(task, actions.shape[1], 1.0 if step % 300 < 150 else -1.0)
        saturated = worlds % 3 == 2
        actions[saturated] = rng.choice([-1.0, 1.0], actions[saturated].shape)
        before = matches.play.game.command.copy()
        outcome = matches.step(actions)
        restarts += int((matches.play.game.command != before).sum())
        assert np.isfinite(outcome.observations).all()
        assert np.isfinite(outcome.rewards).all()
        assert np.isfinite(matches.frame.rows).all()
    assert restarts > 12, "too few commands"

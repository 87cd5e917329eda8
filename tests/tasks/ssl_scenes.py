"""Scenes and episodes of scripted policies for tests of the SSL tasks."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import rsoccer
from rsoccer import LEARN, Matches, policies
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.matches import Outcome
from rsoccer.policies.base import PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task

STAND = (0.0, 0.0, 0.0, -1.0, -1.0)
DRIBBLE = (0.0, 0.0, 0.0, -1.0, 1.0)
KICK = (0.0, 0.0, 0.0, 1.0, -1.0)


def scene(task: Task, **poses: Any) -> Frame:  # noqa: ANN401  (numbers, nested)
    """Frame of one world: `ball` (x, y) or (x, y, v_x, v_y), robots (x, y) or (x, y, angle).

    Robots without a pose stand in a column near blue's goal line.
    """
    frame = Frame.empty(1, task.n_blue, task.n_yellow)
    for i, name in enumerate(task.robots):
        x, y, *angle = poses.pop(name, (-2.8, 1.8 - 0.3 * i))
        frame.robots.position[0, i] = x, y
        frame.robots.heading[0, i] = [np.cos(a := angle[0] if angle else 0.0), np.sin(a)]
    ball = poses.pop("ball")
    frame.ball.position[0] = ball[:2]
    frame.ball.velocity[0] = ball[2:] or (0.0, 0.0)
    assert not poses, f"no such robots: {list(poses)}"
    return frame


def run(
    task: Task, start: Frame, action: Sequence[float] = STAND, steps: int = 100
) -> tuple[Outcome, Matches]:
    """Play a scene with one action for all learners, until the episode ends or for `steps`."""
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=start.rows)
    actions = np.broadcast_to(np.array(action, np.float32), (1, len(matches.agents), 5)).copy()
    for _ in range(steps):
        outcome = matches.step(actions)
        if outcome.ended[0]:
            break
    return outcome, matches


@dataclass
class Episodes:
    """Results of episodes, one per world."""

    returns: Floats  # (n,) of agent 0
    metrics: dict[str, Floats]  # (n,) each, at the end
    term_totals: dict[str, float] = field(default_factory=dict)  # sum of magnitudes, by term

    def largest_term(self) -> str:
        """Reward term with the largest total."""
        return max(self.term_totals, key=lambda name: self.term_totals[name])


def play(task: Task, policy: str, worlds: int = 24, seed: int = 5) -> Episodes:
    """Episodes in which `policy` controls all learners."""
    matches = Matches(task, worlds, seed, 2, autoreset="disabled")
    matches.reset()
    controller, shape = policies.make_policy(policy, task), (worlds, len(matches.agents), 5)
    rng = WorldRng.seeded(1, worlds)
    memory = controller.new_memory(shape, rng)
    episodes = Episodes(np.zeros(worlds, np.float32), {})
    playing = np.ones(worlds, np.bool_)
    for _ in range(task.max_steps):
        view = matches.play.view.select(matches.assignment.learner_indices)
        outcome = matches.step(controller.act(PolicyInput(shape, view, None), rng, memory))
        episodes.returns += outcome.rewards[:, 0]
        for name, term in outcome.terms.items():
            episodes.term_totals[name] = episodes.term_totals.get(name, 0.0) + float(
                np.abs(term).sum()
            )
        for name, metric in outcome.metrics.items():
            episodes.metrics.setdefault(name, np.zeros(worlds, np.float32))[playing] = metric[
                playing
            ]
        playing &= ~outcome.ended
        if not playing.any():
            break
    return episodes


def expect_solved(task: Task, solver: str, metric: str, low: float, worlds: int = 24) -> Episodes:
    """Check that `solver` alone solves the task, and that effort hardly counts; its episodes."""
    solved, idle, uniform = (play(task, name, worlds) for name in (solver, "zero", "uniform"))
    assert solved.metrics[metric].mean() >= low
    for other in (idle, uniform):
        assert other.metrics[metric].mean() < 0.2 * low
        assert solved.returns.mean() > other.returns.mean() + 2.0
    assert solved.term_totals["energy"] < 0.02 * sum(solved.term_totals.values())
    return solved


def make(name: str, **options: Any) -> Task:  # noqa: ANN401
    """Create a registered task."""
    return rsoccer.make_task(name, **options)


__all__ = ["DRIBBLE", "KICK", "LEARN", "STAND", "Episodes", "expect_solved", "make", "play", "run"]

"""What tests of the SSL tasks share: scenes, and episodes of scripts."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import rsoccer
from rsoccer import LEARN, Matches, policies
from rsoccer.frame import Floats, Frame
from rsoccer.matches import Outcome
from rsoccer.policies.base import PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task

STAND = (0.0, 0.0, 0.0, -1.0, -1.0)
DRIBBLE = (0.0, 0.0, 0.0, -1.0, 1.0)
KICK = (0.0, 0.0, 0.0, 1.0, -1.0)


def scene(task: Task, **poses: Any) -> Frame:  # noqa: ANN401  (numbers, nested)
    """One world: `ball` (x, y) or (x, y, v_x, v_y), and robots (x, y) or (x, y, angle) by name.

    Robots that are not named stand far off in a row behind the own goal line of blue.
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
    """Play one scene, everyone who learns acting alike, until it ends or for `steps`."""
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
    """What a policy got in some episodes, one a world."""

    returns: Floats  # (n,) of the first agent
    metrics: dict[str, Floats]  # (n,) each, at the end
    paid: dict[str, float] = field(default_factory=dict)  # sum of magnitudes, by term

    def largest(self) -> str:
        """The term that paid most."""
        return max(self.paid, key=lambda name: self.paid[name])


def play(task: Task, policy: str, worlds: int = 24, seed: int = 5) -> Episodes:
    """Episodes in which `policy` drives all who would learn."""
    matches = Matches(task, worlds, seed, 2, autoreset="disabled")
    matches.reset()
    driver, shape = policies.make(policy, task), (worlds, len(matches.agents), 5)
    rng = WorldRng.seeded(1, worlds)
    memory = driver.new_memory(shape, rng)
    got = Episodes(np.zeros(worlds, np.float32), {})
    playing = np.ones(worlds, np.bool_)
    for _ in range(task.max_steps):
        view = matches.play.view.select(matches.assignment.learner_indices)
        outcome = matches.step(driver.act(PolicyInput(shape, view, None), rng, memory))
        got.returns += outcome.rewards[:, 0]
        for name, term in outcome.terms.items():
            got.paid[name] = got.paid.get(name, 0.0) + float(np.abs(term).sum())
        for name, fact in outcome.metrics.items():
            got.metrics.setdefault(name, np.zeros(worlds, np.float32))[playing] = fact[playing]
        playing &= ~outcome.ended
        if not playing.any():
            break
    return got


def expect_solved(task: Task, solver: str, metric: str, least: float, worlds: int = 24) -> Episodes:
    """The solver's episodes; it solves it, others do not and earn less, effort hardly counts."""
    solved, idle, wild = (play(task, name, worlds) for name in (solver, "zero", "uniform"))
    assert solved.metrics[metric].mean() >= least
    for other in (idle, wild):
        assert other.metrics[metric].mean() < 0.2 * least
        assert solved.returns.mean() > other.returns.mean() + 2.0
    assert solved.paid["energy"] < 0.02 * sum(solved.paid.values())
    return solved


def make(name: str, **options: Any) -> Task:  # noqa: ANN401
    """A registered task."""
    return rsoccer.make_task(name, **options)


__all__ = ["DRIBBLE", "KICK", "LEARN", "STAND", "Episodes", "expect_solved", "make", "play", "run"]

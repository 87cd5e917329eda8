"""What tests of scripts for SSL robots share."""

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, policies
from rsoccer.policies.base import PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from tests.helpers import same


def expect_rows_alone(name: str, task: Task, steps: int = 60) -> None:
    """Row i of a batch does what the same world does alone; the script keeps nothing itself."""
    worlds = 4
    every: dict[str, rsoccer.policies.Policy | str] = dict.fromkeys(
        task.agents, policies.make(name, task)
    )
    many = Matches(task, worlds, 3, controllers=every)
    ones = [Matches(task, 1, 3 + i, controllers=every) for i in range(worlds)]
    for each in (many, *ones):
        each.reset()
    nobody = np.zeros((worlds, 0, 5), np.float32)
    for _ in range(steps):
        many.step(nobody)
        for one in ones:
            one.step(nobody[:1])
        assert same(many.play.actions, np.concatenate([one.play.actions for one in ones]))
    assert np.abs(many.play.actions).max() > 0.0


def expect_view_needed(name: str, task: Task) -> None:
    """Blind it says what it misses."""
    policy, rng = policies.make(name, task), WorldRng.seeded(0, 1)
    shape = (1, 1, 5)
    with pytest.raises(ValueError, match=f"{name} needs a view"):
        policy.act(PolicyInput(shape, None, None), rng, policy.new_memory(shape, rng))


def score(task: Task, metric: str, **controllers: str) -> float:
    """Mean of a metric at the end of 30 episodes."""
    worlds = 30
    matches = Matches(task, worlds, 9, 2, controllers=controllers, autoreset="disabled")
    matches.reset()
    assert not matches.agents, "all are driven"
    found, playing = np.zeros(worlds, np.float32), np.ones(worlds, np.bool_)
    for _ in range(task.max_steps):
        outcome = matches.step(np.zeros((worlds, 0, 5), np.float32))
        found[playing] = outcome.metrics[metric][playing]
        playing &= ~outcome.ended
        if not playing.any():
            break
    return float(found.mean())


__all__ = ["LEARN", "expect_rows_alone", "expect_view_needed", "score"]

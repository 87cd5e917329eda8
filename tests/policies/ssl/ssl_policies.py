"""Checks shared by the tests of scripts for SSL robots."""

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, policies
from rsoccer.policies.base import PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from tests.helpers import same


def expect_independent_worlds(name: str, task: Task, steps: int = 60) -> None:
    """Row i of a batch acts like the same world alone; the policy object keeps no state."""
    worlds = 4
    controllers: dict[str, rsoccer.policies.Policy | str] = dict.fromkeys(
        task.agents, policies.make_policy(name, task)
    )
    batch = Matches(task, worlds, 3, controllers=controllers)
    singles = [Matches(task, 1, 3 + i, controllers=controllers) for i in range(worlds)]
    for each in (batch, *singles):
        each.reset()
    no_actions = np.zeros((worlds, 0, 5), np.float32)
    for _ in range(steps):
        batch.step(no_actions)
        for single in singles:
            single.step(no_actions[:1])
        expected = np.concatenate([single.play.actions for single in singles])
        assert same(batch.play.actions, expected)
    assert np.abs(batch.play.actions).max() > 0.0


def expect_view_needed(name: str, task: Task) -> None:
    """Without a view the policy raises an error."""
    policy, rng = policies.make_policy(name, task), WorldRng.seeded(0, 1)
    shape = (1, 1, 5)
    with pytest.raises(ValueError, match=f"{name} needs a view"):
        policy.act(PolicyInput(shape, None, None), rng, policy.new_memory(shape, rng))


def mean_metric(task: Task, metric: str, sensing: str | None = None, **controllers: str) -> float:
    """Mean of a metric at the end of 30 episodes."""
    worlds = 30
    matches = Matches(
        task, worlds, 9, 2, controllers=controllers, sensing=sensing, autoreset="disabled"
    )
    matches.reset()
    assert not matches.agents, "every robot has a policy"
    values, playing = np.zeros(worlds, np.float32), np.ones(worlds, np.bool_)
    for _ in range(task.max_steps):
        outcome = matches.step(np.zeros((worlds, 0, 5), np.float32))
        values[playing] = outcome.metrics[metric][playing]
        playing &= ~outcome.ended
        if not playing.any():
            break
    return float(values.mean())

"""Matches played to their end, each once, and what came of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer.controllers import Controller
from rsoccer.frame import Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Task

Doubles = NDArray[np.float64]

RETURN = "return"
"""What stands for a metric where a task names no success."""


@dataclass(frozen=True)
class Terms:
    """Who plays, and how."""

    task: Task
    controllers: Mapping[str, Controller]
    policy: Policy  # drives those that learn
    worlds: int  # matches at once
    threads: int


@dataclass(frozen=True)
class Episodes:
    """What each match came to, (n,) each."""

    metric: str  # what the score is
    score: Doubles  # the task's success, as the task counts it
    returns: Doubles  # mean over the policy's robots of all that they were paid
    seconds: Doubles
    decided: NDArray[np.bool_]  # by a goal of either side, or by full success


def play(terms: Terms, count: int, base: int) -> Episodes:
    """Play `count` matches, the i-th of them with seed `base + i`, as many at once as may be."""
    parts = [
        _play(terms, min(terms.worlds, count - first), base + first)
        for first in range(0, count, terms.worlds)
    ]
    score, returns, steps = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    task, metric = terms.task, terms.task.success
    full = task.full_success
    decided = score != 0.0 if task.two_sided else score >= (np.inf if full is None else full)
    if metric is None:
        score, decided = returns, np.zeros(count, np.bool_)
    return Episodes(metric or RETURN, score, returns, steps * task.config.time_step, decided)


def _play(terms: Terms, n: int, seed: int) -> tuple[Doubles, Doubles, Doubles]:
    """Success, return and steps of n matches, (n,) each."""
    # Ended worlds wait, so long matches count as often as short ones.
    matches = Matches(
        terms.task,
        n,
        seed,
        terms.threads,
        controllers=terms.controllers,
        autoreset="disabled",
    )
    observations = matches.reset()
    driver = _Driver(terms.policy, matches, seed)
    score, returns, steps = np.zeros(n), np.zeros(n), np.zeros(n)
    playing = ~matches.done
    while playing.any():
        outcome = matches.step(driver.act(observations))
        observations = outcome.observations
        steps += playing
        returns += outcome.rewards.mean(axis=1)  # nothing where a match waits
        ending = playing & outcome.ended
        score[ending] = _success(terms.task, outcome)[ending]
        playing &= ~ending
    return score, returns, steps


def _success(task: Task, outcome: Outcome) -> Floats:
    """The task's metric (n,), or zeros where it names none."""
    if task.success is None:
        return np.zeros(len(outcome.terminated), np.float32)
    if task.success not in outcome.metrics:
        raise ValueError(f"task {task.name!r} has no metric {task.success!r} to evaluate by")
    return outcome.metrics[task.success]


class _Driver:
    """A policy in the place of those that learn: they are paid, which others are not."""

    def __init__(self, policy: Policy, matches: Matches, seed: int) -> None:
        """Take the learners of matches that have just begun; world i draws by `seed + i`."""
        self._policy, self._matches = policy, matches
        self._shape = (matches.worlds, len(matches.agents), matches.action_size)
        self._rng = WorldRng.seeded(seed, matches.worlds).split(matches.agents[0])
        self._memory = policy.new_memory(self._shape, self._rng)

    def act(self, observations: Floats) -> Floats:
        """What the learners do, (n, agents, action), by what they see (n, agents, o)."""
        view, seen = None, None
        if self._policy.observes != "nothing":
            view = self._matches.play.view.select(self._matches.assignment.learner_indices)
        if self._policy.observes == "observation":
            seen = observations
        return self._policy.act(PolicyInput(self._shape, view, seen), self._rng, self._memory)

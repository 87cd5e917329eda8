"""Numbers of matches and seeds of evaluations."""

from __future__ import annotations

import os

import numpy as np

from rsoccer import checks
from rsoccer.task import Task


def first_seed(seed: int, side: int) -> int:
    """Return the seed of the first match that an evaluation plays from a side.

    Args:
        seed: seed of the evaluation.
        side: index of the side: 0 for blue or the only one, 1 for yellow.
    """
    words = np.random.SeedSequence((seed, side)).generate_state(1, np.uint64)
    return int(words[0]) >> 1


def matches_per_side(task: Task, matches: int) -> int:
    """Return the number of matches for each side, so that their sum is `matches`.

    Args:
        task: the task that is played.
        matches: number of matches of the evaluation.

    Raises:
        ValueError: too few matches, an odd number in a two-sided task, or such a task without a
            success metric.
        TypeError: a number of another type.
    """
    if task.two_sided and task.success is None:
        raise ValueError(f"task: {task.name} has two sides and must name its success, got None")
    if not task.two_sided:
        return checks.integer("matches", matches, 1)
    matches = checks.integer("matches", matches, 2)
    if matches % 2:
        raise ValueError(
            f"matches: expected an even number, as {task.name} is played from both sides, "
            f"got {matches}"
        )
    return matches // 2


def processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1

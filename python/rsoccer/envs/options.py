"""Arguments that the environments of all libraries take: task, learner, reset options, actions."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium.spaces import Space

from rsoccer import checks
from rsoccer.controllers import Controllers, given_by_name, resolve
from rsoccer.envs import spaces
from rsoccer.frame import Array, Floats, Mask
from rsoccer.registry import as_task, make_task
from rsoccer.task import LEARN, Task


def chosen_task(task: Task | str, max_steps: int | None, options: Mapping[str, Any]) -> Task:
    """A task from its name and options, or itself; with a clock of its own if asked for."""
    if isinstance(task, str):
        clock = {} if max_steps is None else {"max_steps": max_steps}
        return make_task(task, **options, **clock)
    if options:
        raise TypeError(f"options: a task that is made has its own, got {sorted(options)} besides")
    task = as_task(task)
    return task if max_steps is None else timed(task, "max_steps", max_steps)


def timed(task: Task, name: str, limit: int) -> Task:
    """A copy with another clock: the caller's own task keeps its own."""
    task = copy.copy(task)
    object.__setattr__(task, "max_steps", checks.integer(name, limit, 1))
    return task


def one_learner(task: Task, learner: str | None, controllers: Controllers | None) -> Controllers:
    """A driver for each robot, one of them the learner; or an error that says how to get there."""
    given = given_by_name(controllers)
    if learner is not None:
        if learner not in task.robots:
            raise ValueError(f"learner: expected one of {list(task.robots)}, got {learner!r}")
        given[learner] = LEARN
    chosen = resolve(task, given)
    learners = [robot for robot, controller in chosen.items() if controller is LEARN]
    if len(learners) != 1:
        raise ValueError(
            f"{task.name}: expected one robot that learns, got {learners or 'none'}: name it and "
            f"who drives the others, as in learner={task.robots[0]!r}, controllers={{'all': 'ou'}}"
        )
    return chosen


def reset_options(options: object) -> Mapping[str, Any]:
    """What was given to `reset` as options; keys that nobody here knows are for others."""
    if not isinstance(options, Mapping | None):
        raise TypeError(f"options: expected a dictionary, got {type(options).__name__}")
    return options or {}


def starts(options: Mapping[str, Any], task: Task, mask: Mask) -> Floats | None:
    """Rows (k, row) to start the k worlds of the mask from, if `options["frame"]` gives any.

    It is one row (row,) for all, or a row for each of all worlds (n, row).
    """
    given, size = options.get("frame"), task.config.row_size
    if given is None:
        return None
    if np.ndim(given) == 2:
        return checks.floats("options['frame']", given, (len(mask), size))[mask]
    return np.tile(checks.floats("options['frame']", given, (size,)), (int(mask.sum()), 1))


def actions_of(task: Task, given: object, space: Space[Any]) -> Array:
    """What was chosen in `space` as numbers (..., action); `Matches` checks their values."""
    chosen = np.asarray(given)
    if chosen.shape != space.shape:
        raise ValueError(f"actions: expected shape {space.shape}, got {chosen.shape}")
    return spaces.numbers(task, chosen)

"""Arguments that the environments of all libraries take: learner, reset options, actions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Space

from rsoccer import checks, spaces
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.controllers import Controller, Controllers, given_by_name, resolve
from rsoccer.frame import team_of
from rsoccer.lineup import DEFAULT_OPPONENT
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES


def learner_controllers(
    task: Task, learner: str | None, controllers: Controllers | None
) -> dict[str, Controller]:
    """Return a controller for each robot.

    Args:
        task: the task that is played.
        learner: the only robot that learns; None for all robots that the task and the controllers
            let learn.
        controllers: controllers of the other robots, by robot, team or "all". `DEFAULT_OPPONENT`
            replaces the task's other learners where a learner and no controller is given.

    Raises:
        TypeError: something that is not a controller.
        ValueError: an unknown robot, or no robot that learns.
    """
    given = given_by_name(controllers)
    if learner is not None:
        if learner not in task.robots:
            raise ValueError(f"learner: expected one of {list(task.robots)}, got {learner!r}")
        named = {"all", *SIDES, *task.robots}.intersection(given)
        others = [name for name in task.agents if not {"all", team_of(name), name} & named]
        given = {**given, **dict.fromkeys(others, DEFAULT_OPPONENT), learner: LEARN}
    resolved = resolve(task, given)
    require_learners([robot for robot, controller in resolved.items() if controller is LEARN])
    return resolved


def require_learners(learners: Sequence[str]) -> None:
    """Refuse an environment without learners.

    Args:
        learners: names of the robots that learn.

    Raises:
        ValueError: there are none.
    """
    if not learners:
        raise ValueError(
            "controllers: expected at least one learner, got none; rsoccer.Matches runs "
            "without learners"
        )


def single_learner_controllers(
    task: Task, learner: str | None, controllers: Controllers | None
) -> dict[str, Controller]:
    """Return a controller for each robot, exactly one of them `LEARN`.

    Args:
        task: the task that is played.
        learner: the robot that learns; None if the task and the controllers leave one only.
        controllers: controllers of the other robots, as for `learner_controllers`.

    Raises:
        TypeError: something that is not a controller.
        ValueError: an unknown robot, or none or several robots that learn.
    """
    resolved = learner_controllers(task, learner, controllers)
    learners = [robot for robot, controller in resolved.items() if controller is LEARN]
    if len(learners) != 1:
        raise ValueError(
            f"{task.name}: expected exactly one learner, got {learners}: name the learner and the "
            f"other robots' controllers, as in learner={task.robots[0]!r}, "
            "controllers={'all': 'ou'}"
        )
    return resolved


def reset_options(options: object, *keys: str, ignored: Sequence[str] = ()) -> Mapping[str, Any]:
    """Return the options of a `reset` as a dictionary; an empty one for None.

    Args:
        options: argument of `reset`.
        *keys: the keys that it may have.
        ignored: further keys that it may have, without a meaning.

    Raises:
        TypeError: not a dictionary.
        ValueError: an unknown key.
    """
    if options is None:
        return {}
    if not isinstance(options, Mapping):
        raise TypeError(f"options: expected a dictionary, got {type(options).__name__}")
    if unknown := [key for key in options if key not in (*keys, *ignored)]:
        raise ValueError(f"options: unknown {unknown}; valid are {list(keys)}")
    return options


def initial_rows(options: Mapping[str, Any], task: Task, mask: Mask) -> Floats | None:
    """Return the initial state rows that `options["frame"]` sets, if any.

    Args:
        options: options of a `reset`. "frame" is one row (row,) for all matches, or a row for
            each of all matches (n, row).
        task: the task that is played.
        mask: (n,) matches to reset, k of them.

    Returns:
        (k, row) float32, or None without the option.

    Raises:
        TypeError: not an array of floats.
        ValueError: a wrong shape, or numbers that are not finite.
    """
    given, size = options.get("frame"), task.config.row_size
    if given is None:
        return None
    if np.ndim(given) == 2:
        return checks.floats("options['frame']", given, (len(mask), size))[mask]
    return np.tile(checks.floats("options['frame']", given, (size,)), (int(mask.sum()), 1))


def action_array(task: Task, actions: object, space: Space[Any]) -> Array:
    """Return an element of an action space as action vectors.

    Args:
        task: the task that is played.
        actions: argument of `step`: vectors or, for a task with an `action_table`, indices.
        space: the space that the actions are from.

    Returns:
        (..., action) numbers from -1 to 1.

    Raises:
        TypeError: indices that are not integers, or vectors that are not floats.
        ValueError: a wrong shape, numbers that are not finite, or an index out of range.
    """
    shape = space.shape or ()
    if task.action_table is None:
        return checks.actions(actions, shape)
    indices = checks.as_array("actions", actions)
    if indices.shape != shape:
        raise ValueError(f"actions: expected shape {shape}, got {indices.shape}")
    return spaces.action_vectors(task, indices)

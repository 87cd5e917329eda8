"""Changes of matches that run, for curricula: options of the task, policies, starts of episodes."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import Simulator, Threads
from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Assignment, Controllers, PolicyGroup, given_by_name
from rsoccer.frame import team_of
from rsoccer.game import new_game
from rsoccer.policies import Policy, PolicyLike, make_policy
from rsoccer.registry import make_task, options_of, with_max_steps
from rsoccer.rules.base import columns
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES

FIXED: Final = ("config", "sides", "robots", "agents", "action_size", "optional_action_size")
"""Attributes of a task that stay as they are while matches run."""


def changed_task(task: Task, options: Mapping[str, Any]) -> Task:
    """Return a task with other options, which matches of the task can go on with.

    Args:
        task: the task that is played.
        options: options by name.

    Raises:
        TypeError: an unknown option, one of the wrong type, or a task whose class is no dataclass.
        ValueError: a value out of range, or an option on which sizes, robots, physics or
            controllers depend.
    """
    names = option_names(task)
    if unknown := sorted(set(options) - set(names)):
        raise TypeError(f"options: unknown {unknown}; valid are {names}")
    known = options_of(task)
    if known is None:
        replaced: Any = task
        unchanged: Task = dataclasses.replace(replaced)
        changed: Task = dataclasses.replace(replaced, **options)
    else:
        unchanged = make_task(task.name, **known)
        changed = make_task(task.name, **{**known, **options})
    if "max_steps" not in names and unchanged.max_steps != task.max_steps:  # an argument of matches
        changed = with_max_steps(changed, task.max_steps, "max_steps")
    for name, what in _differences(task, changed).items():
        raise ValueError(
            f"options: expected ones that leave {what} of the task as they are, got "
            f"{dict(options)}, which change its {name}; make new matches for them"
        )
    return changed


def option_names(task: Task) -> list[str]:
    """Return the names of the options of a task.

    Args:
        task: the task.

    Raises:
        TypeError: a task whose class is no dataclass.
    """
    if not dataclasses.is_dataclass(task):
        raise TypeError(
            f"options: expected a task whose class is a dataclass, got {type(task).__name__}"
        )
    return [field.name for field in dataclasses.fields(task) if field.init]


def _differences(task: Task, changed: Task) -> dict[str, str]:
    """Parts that must stay and differ, in words by name."""
    different = {
        name: "sizes, robots and physics"
        for name in FIXED
        if getattr(task, name) != getattr(changed, name)
    }
    if task.layout.text != changed.layout.text:
        different["observations"] = "observations"
    if not _equal(task.action_table, changed.action_table):
        different["action_table"] = "actions"
    if dict(task.default_controllers()) != dict(changed.default_controllers()):
        different["default controllers"] = "controllers (see `change_controllers`)"
    if _state(task) != _state(changed):
        different["state"] = "arrays of state"
    return different


def _state(task: Task) -> dict[str, tuple[Any, ...]]:
    """Shape and type of each array of a world's state, by name."""
    arrays = {**task.new_memory(1), **vars(new_game(1, columns(task.rules, 1)))}
    found = {}
    for name, array in arrays.items():
        parts = array if isinstance(array, Mapping) else {"": array}
        for part, value in parts.items():
            if isinstance(value, np.ndarray):
                found[f"{name}.{part}"] = (value.shape, value.dtype.str)
    return found


def _equal(first: Array | None, second: Array | None) -> bool:
    if first is None or second is None:
        return first is second
    return np.array_equal(first, second)


def change_controllers(
    task: Task,
    assignment: Assignment,
    controllers: Controllers,
    forecasting: tuple[str, ...] | None = None,
) -> None:
    """Replace policies of robots that do not learn; their memory begins anew.

    Args:
        task: the task that is played.
        assignment: controllers of the matches, which change.
        controllers: policies by robot, team or "all"; others stay.
        forecasting: teams that forecast; None where robots know the true state or have senses of
            another kind.

    Raises:
        TypeError: something that is not a policy.
        ValueError: an unknown robot, one that learns, different policies for robots that share one,
            a policy that does not fit the task, one that observes where the one before did not, or
            one that needs a forecast in a team without it. Nothing has changed.
    """
    given = given_by_name(controllers)
    valid = ["all", *SIDES, *task.robots]
    if unknown := sorted(set(given) - set(valid), key=str):
        raise ValueError(f"controllers: unknown {unknown}; valid are {valid}")
    learners = {task.robots[robot] for robot in assignment.learners}
    for name, controller in given.items():
        if controller is LEARN or name in learners:
            raise ValueError(
                f"controllers[{name!r}]: expected a policy for robots that do not learn, as "
                f"learners stay, got {controller!r}"
            )
    made: dict[int | str, Any] = {}
    changes = [
        (group, _policy(task, group, new, made, group.robots[0] in assignment.observers))
        for group in assignment.groups
        if (new := _controller_of(task, group, given)) is not None
    ]
    if not changes:
        raise ValueError(f"controllers: expected robots with policies, got {sorted(given)}")
    for group, policy in changes:
        _check_forecast(task, group, policy, forecasting)
    for group, policy in changes:
        shape = (len(group.rng), len(group.robots), task.action_size)
        group.policy = policy
        group.memory = checks.memory(
            type(policy).__name__, policy.new_memory(shape, group.rng), shape[0]
        )


def _controller_of(task: Task, group: PolicyGroup, given: Mapping[str, Any]) -> PolicyLike | None:
    """The new controller of a group's robots; None if it stays."""
    found = []
    for robot in (task.robots[index] for index in group.robots):
        key = next((key for key in (robot, team_of(robot), "all") if key in given), None)
        found.append(None if key is None else given[key])
    if any(each != found[0] for each in found):
        robots = [task.robots[index] for index in group.robots]
        raise ValueError(
            f"controllers: expected one policy for {robots}, which share one, got {found}; begin "
            "with policies that differ, such as 'scripted:0' for those that change"
        )
    first: PolicyLike | None = found[0]
    return first


def _policy(
    task: Task,
    group: PolicyGroup,
    controller: PolicyLike,
    made: dict[int | str, Any],
    observes: bool,
) -> Any:  # noqa: ANN401
    """A new policy for a group, whose robots observe or not; one object for equal controllers."""
    key = controller if isinstance(controller, str) else id(controller)
    if key not in made:
        made[key] = make_policy(controller, task)
    policy = made[key]
    if policy.observes != "nothing" and not observes:
        raise ValueError(
            f"controllers: expected a policy that observes nothing, as "
            f"{type(group.policy).__name__} before it, got {type(policy).__name__}; begin with one "
            "that observes, such as 'scripted:0'"
        )
    return policy


def _check_forecast(
    task: Task, group: PolicyGroup, policy: Policy, forecasting: tuple[str, ...] | None
) -> None:
    """Check that the team of a new policy forecasts if the policy needs it."""
    teams = {team_of(task.robots[robot]) for robot in group.robots}
    if policy.needs_forecast and forecasting is not None:
        without = sorted(teams - set(forecasting))
        if without:
            raise ValueError(
                f"controllers: expected a policy without forecasts for {', '.join(without)}, "
                f"got {type(policy).__name__}; begin with one that needs them, or with "
                "sensing that has forecast=1"
            )


def start_rows(task: Task, rows: object) -> Floats:
    """Return checked initial states of episodes.

    Args:
        task: the task that is played.
        rows: (row,) or (m, row) states, m at least 1, in the layout of `Frame.rows`.

    Returns:
        (m, row) float32, a copy.

    Raises:
        TypeError: not an array of floats.
        ValueError: a wrong shape, numbers that are not finite, or bodies that overlap or are
            outside.
    """
    size = task.config.row_size
    array = np.atleast_2d(checks.as_array("rows", rows))
    if not len(array):
        raise ValueError("rows: expected at least one state, got none")
    states = checks.floats("rows", array, (len(array), size)).copy()
    placed = np.empty_like(states)
    scratch = Simulator(task.config, len(states), Threads(1))
    scratch.place(np.ones(len(states), np.bool_), states, placed)
    return states


def saved_starts(task: Task, rows: object) -> Floats:
    """Return checked initial states of episodes of a saved state of matches.

    Args:
        task: the task that is played.
        rows: what has been saved.

    Returns:
        (m, row) float32, a copy.

    Raises:
        ValueError: not what `start_rows` has returned.
    """
    try:
        return start_rows(task, rows)
    except (TypeError, ValueError) as error:
        raise ValueError(f"state: expected states of this task for 'starts': {error}") from error

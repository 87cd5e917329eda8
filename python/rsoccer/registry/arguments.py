"""Tasks as functions take them: by name, with options, or as objects."""

import copy
import inspect
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from rsoccer import checks, option_values
from rsoccer.registry.names import list_options, list_tasks, make_named, make_task, task_class
from rsoccer.registry.overrides import check_overrides
from rsoccer.task import Task


def options_of(task: Task) -> dict[str, Any] | None:
    """Return the options of a task that differ from its defaults, as JSON values for `make_task`.

    Args:
        task: the task.

    Returns:
        Options by name; None if the task is not registered or an option is another object.
    """
    if not is_registered(task):
        return None
    try:
        default = make_task(task.name)
        names = list_options(type(task))
        values = {name: (getattr(task, name), getattr(default, name)) for name in names}
        return {
            name: option_values.encoded(name, value)
            for name, (value, usual) in values.items()
            if value != usual
        }
    except (AttributeError, OSError, TypeError, ValueError):
        return None


def is_registered(task: Task) -> bool:
    """Return whether the class of a task is registered under the name that the task has.

    Args:
        task: the task.
    """
    return task.name in list_tasks() and task_class(task.name) is type(task)


def task_with_options(name: str, options: Mapping[str, Any]) -> Task:
    """Create a task by name, with options that a user gave as one mapping `task_options`.

    Args:
        name: a registered name or an alias.
        options: options of the task, by name.

    Returns:
        The task.

    Raises:
        ValueError: an unknown name, or options that the task refuses.
    """
    try:
        return make_task(name, **options)
    except TypeError as error:
        notes = getattr(error, "__notes__", ())  # of the core, which name the argument
        raise ValueError(f"task_options: {' '.join([str(error), *notes])}") from error


def as_task(task: object) -> Task:
    """Return a task given as an instance or by name.

    Args:
        task: a task, a registered name or an alias.

    Raises:
        TypeError: anything else, or a task whose options keep the defaults of its parent, see
            `rsoccer.registry.overrides`.
        ValueError: an unknown name.
    """
    if isinstance(task, str):
        return make_task(task)
    if not isinstance(task, Task):
        raise TypeError(f"task: expected a task or its name, got {task!r}")
    check_overrides(type(task))
    return task


def resolve_task(
    task: Task | str,
    max_steps: int | None,
    options: Mapping[str, Any],
    caller: Callable[..., object],
    limit_name: str = "max_steps",
) -> Task:
    """Return the task that matches or an environment play.

    Args:
        task: a task, or the name of a registered one.
        max_steps: time limit of an episode in control steps; None for the task's own.
        options: options of a registered task, by name.
        caller: function or class that got the options beside its own arguments, which errors list;
            the constructor of a class whose metaclass hides its arguments.
        limit_name: name of the caller's argument `max_steps`, for errors.

    Raises:
        TypeError: not a task, a task that `as_task` refuses, an unknown option, or options for a
            Task object.
        ValueError: an unknown task, or a value out of range.
    """
    if max_steps is not None:
        max_steps = checks.integer(limit_name, max_steps, 1)
    if isinstance(task, str):
        time_limit = {} if max_steps is None else {"max_steps": max_steps}
        return make_named(task, {**options, **time_limit}, _arguments(caller))
    if options:
        raise TypeError(
            f"options: a Task object has its own options, got {sorted(options)} in addition; "
            f"valid are the arguments {_arguments(caller)}"
        )
    task = as_task(task)
    return task if max_steps is None else with_max_steps(task, max_steps, limit_name)


def _arguments(caller: Callable[..., object]) -> list[str]:
    """Names of the arguments of a function or class beside the task and its options."""
    parameters = inspect.signature(caller).parameters.values()
    names = [each.name for each in parameters if each.kind is not each.VAR_KEYWORD]
    return [name for name in names if name not in ("self", "task")]


def with_max_steps(task: Task, max_steps: int, name: str) -> Task:
    """Return a copy of a task with another time limit; the caller's task does not change.

    Args:
        task: the task.
        max_steps: time limit of an episode in control steps, at least 1.
        name: name of the caller's argument, for the error message.

    Raises:
        TypeError: not an integer.
        ValueError: less than 1.
    """
    task = copied(task)
    object.__setattr__(task, "max_steps", checks.integer(name, max_steps, 1))
    return task


def copied(task: Task) -> Task:
    """Return a copy of a task whose cached properties are computed anew, from what changes in it.

    Args:
        task: the task.
    """
    parts = (part for each in type(task).__mro__ for part in vars(each).items())
    cached = {name for name, value in parts if isinstance(value, cached_property)}
    task = copy.copy(task)
    for name in vars(task).keys() & cached:
        del vars(task)[name]
    return task

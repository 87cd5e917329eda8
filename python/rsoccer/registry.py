"""Tasks by name."""

import inspect
import re
from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from rsoccer.envs import ids
from rsoccer.task import Task


class Alias(NamedTuple):
    """Another name's meaning: a registered task, with options."""

    task: str
    options: Mapping[str, Any]


_TASKS: Final[dict[str, type[Task]]] = {}
_ALIASES: Final[dict[str, Alias]] = {}
_GONE: Final[dict[str, str]] = {}
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]*-v[0-9]+")


def register(name: str, task_class: type[Task]) -> None:
    """Make a task known by `name`, such as "MyTask-v0", which its tasks then carry.

    Gymnasium and PettingZoo know it as "rsoccer/MyTask-v0", the former where one robot learns;
    neither does where an option has no default. `alias` gives a task a second name.

    Raises:
        TypeError: what is no subclass of `Task`.
        ValueError: a name without a version, or one that is taken, or a task that has a name.
        Exception: whatever making the task raises, if all its options have defaults.
    """
    _check_name(name)
    if not (isinstance(task_class, type) and issubclass(task_class, Task)):
        raise TypeError(f"task_class: expected a subclass of Task, got {task_class!r}")
    if _TASKS.get(name, task_class) is not task_class:
        raise ValueError(f"name: {name!r} is already taken by {_TASKS[name].__qualname__}")
    if name in _ALIASES:
        raise ValueError(f"name: {name!r} is already taken, for {_ALIASES[name].task}")
    known = next((other for other, its in _TASKS.items() if its is task_class), name)
    if known != name:
        raise ValueError(
            f"task_class: {task_class.__qualname__} is known as {known!r} already; "
            f"registry.alias({name!r}, {known!r}) gives it another name"
        )
    learners = None if _needs_options(task_class) else len(task_class().agents)
    task_class.name = name
    _TASKS[name] = task_class
    ids.register_ids(name, learners)


def alias(name: str, task: str, **options: Any) -> None:  # noqa: ANN401  (the task's own)
    """Make a registered task with these options known by another name as well.

    It has ids too, and takes the task's options; what it makes carries the task's own name.
    """
    _check_name(name)
    if name in _TASKS or _ALIASES.get(name, (task, options)) != (task, options):
        raise ValueError(f"name: {name!r} is already taken")
    learners = len(make_task(task, **options).agents)  # refuses what cannot be made
    _ALIASES[name] = Alias(task, options)
    ids.register_ids(name, learners)


def retire(name: str, hint: str) -> None:
    """Tell those who ask for `name`, which no task has any more, what to do instead."""
    _check_name(name)
    if name in _TASKS or name in _ALIASES:
        raise ValueError(f"name: {name!r} is still in use")
    _GONE[name] = hint


def list_tasks() -> list[str]:
    """Names of all tasks, each once: without aliases."""
    return sorted(_TASKS)


def list_aliases() -> dict[str, Alias]:
    """Other names, and the tasks and options that they stand for."""
    return dict(sorted(_ALIASES.items()))


def make_task(name: str, **options: Any) -> Task:  # noqa: ANN401  (each task has its own options)
    """A task by its name; options are the fields of its class, or what it is made with."""
    if name in _ALIASES:
        meant, preset = _ALIASES[name]
        return make_task(meant, **{**preset, **options})
    if name not in _TASKS:
        hint = _GONE.get(name, f"expected one of {list_tasks()}")
        raise ValueError(f"unknown task {name!r}: {hint}")
    task_class = _TASKS[name]
    valid = list_options(task_class)
    unknown = sorted(set(options) - set(valid))
    if unknown:
        raise ValueError(f"{name}: unknown option {', '.join(unknown)}; valid are {valid}")
    return task_class(**options)


def as_task(task: object) -> Task:
    """A task by its name, or itself; a TypeError for anything else."""
    if isinstance(task, str):
        return make_task(task)
    if not isinstance(task, Task):
        raise TypeError(f"task: expected a task or its name, got {task!r}")
    return task


def list_options(task_class: type[Task]) -> list[str]:
    """Names of the options that a task's class takes."""
    return list(inspect.signature(task_class).parameters)


def _needs_options(task_class: type[Task]) -> bool:
    """Whether it cannot be made without saying something."""
    variadic = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    parameters = inspect.signature(task_class).parameters.values()
    return any(p.default is p.empty and p.kind not in variadic for p in parameters)


def _check_name(name: str) -> None:
    if not _NAME.fullmatch(name):
        raise ValueError(f"name: expected letters and a version, like 'MyTask-v0', got {name!r}")

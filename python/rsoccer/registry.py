"""Tasks by name."""

import inspect
import re
from typing import Any, Final

from rsoccer import ids
from rsoccer.task import Task

_TASKS: Final[dict[str, type[Task]]] = {}
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]*-v[0-9]+")


def register(name: str, task_class: type[Task]) -> None:
    """Make a task known by `name`, such as "MyTask-v0", which its tasks then carry.

    Gymnasium and PettingZoo know it as "rsoccer/MyTask-v0", the former where one robot learns.
    """
    if not _NAME.fullmatch(name):
        raise ValueError(f"name: expected letters and a version, like 'MyTask-v0', got {name!r}")
    if not (isinstance(task_class, type) and issubclass(task_class, Task)):
        raise TypeError(f"task_class: expected a subclass of Task, got {task_class!r}")
    if _TASKS.get(name, task_class) is not task_class:
        raise ValueError(f"name: {name!r} is already taken by {_TASKS[name].__qualname__}")
    task_class.name = name
    _TASKS[name] = task_class
    ids.announce(name, task_class)


def list_tasks() -> list[str]:
    """Names of all tasks."""
    return sorted(_TASKS)


def make_task(name: str, **options: Any) -> Task:  # noqa: ANN401  (each task has its own options)
    """A task by its name; options are the fields of its class, or what it is made with."""
    if name not in _TASKS:
        raise ValueError(f"unknown task {name!r}: expected one of {list_tasks()}")
    task_class = _TASKS[name]
    valid = list_options(task_class)
    unknown = sorted(set(options) - set(valid))
    if unknown:
        raise ValueError(f"{name}: unknown option {', '.join(unknown)}; valid are {valid}")
    return task_class(**options)


def list_options(task_class: type[Task]) -> list[str]:
    """Names of the options that a task's class takes."""
    return list(inspect.signature(task_class).parameters)

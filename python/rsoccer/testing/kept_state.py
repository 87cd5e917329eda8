"""State that a task must not keep: attributes that change, and global random numbers."""

from __future__ import annotations

import pickle
import random
import sys
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from rsoccer.rules import Rule
from rsoccer.task import Task
from rsoccer.testing.errors import expect


class KeptState:
    """State outside of matches at one time, to find out later what has changed it."""

    def __init__(self, task: Task) -> None:
        """Note the attributes of a task, its rules and their classes, and the global random state.

        Args:
            task: the task.
        """
        self._task = task
        self._before = _attributes(task)
        self._generators = _generators()

    def expect_unchanged(self, culprit: str) -> None:
        """Raise unless all is as before. Properties may have been cached in the meantime.

        Args:
            culprit: what was called in the meantime, for the error.

        Raises:
            TaskError: an attribute or the global random state has changed.
        """
        now = _attributes(self._task)
        names = [name for name in now | self._before if self._changed(name, now)]
        fault = f"keeps state on self, in {', '.join(names)}; state of an episode belongs in"
        expect(not names, f"{culprit} {fault} play.memory")
        now_at = _generators()
        drawn = [name for name, state in self._generators.items() if state != now_at[name]]
        fault = f"draws global random numbers of {', '.join(drawn)} instead of numbers from its rng"
        expect(not drawn, f"{culprit} {fault}")

    def _changed(self, name: str, now: Mapping[str, bytes]) -> bool:
        """Whether an attribute differs; one that was cached for the first time does not."""
        if name not in self._before:
            return not _is_cached(self._task, name)
        return now.get(name) != self._before[name]


def _attributes(task: Task) -> dict[str, bytes]:
    """Content of all attributes of a task, and of those of its classes that hold data."""
    rules = {
        f"{type(rule).__name__}.{name}": value
        for rule in task.rules
        for name, value in vars(rule).items()
    }
    # `rules` are looked into, and the package computes the properties of `Task` itself.
    ignored = {"rules", *vars(Task)}
    own = {name: value for name, value in vars(task).items() if name not in ignored}
    of_classes = {
        f"{owner.__name__}.{name}": value
        for each in (task, *task.rules)
        for owner in type(each).__mro__
        if issubclass(owner, Task | Rule) and owner not in (Task, Rule)
        for name, value in vars(owner).items()
        if _is_data(name, value)
    }
    return {name: _content(value) for name, value in {**own, **rules, **of_classes}.items()}


def _is_data(name: str, value: object) -> bool:
    """Whether an attribute of a class is neither Python's own nor a method or property."""
    return not (name.startswith(("__", "_abc_")) or callable(value) or hasattr(value, "__get__"))


def _content(value: Any) -> bytes:  # noqa: ANN401  (any attribute)
    """Bytes that change with a value; its identity where it cannot be pickled."""
    try:
        return pickle.dumps(value)
    except Exception:
        return str(id(value)).encode()


def _is_cached(task: Task, name: str) -> bool:
    """Whether a name of `_attributes` is a cached property of the task or of one of its rules."""
    attribute = name.rpartition(".")[2]
    classes = [owner for each in (task, *task.rules) for owner in type(each).__mro__]
    return any(isinstance(vars(c).get(attribute), cached_property) for c in classes)


def _generators() -> dict[str, bytes]:
    """States of the global random generators; of torch's if something has imported it."""
    states: dict[str, object] = {
        "random": random.getstate(),
        "numpy.random": np.random.get_state(),  # noqa: NPY002
    }
    if (torch := sys.modules.get("torch")) is not None:
        states["torch"] = torch.random.get_rng_state().numpy()
    return {name: pickle.dumps(state) for name, state in states.items()}

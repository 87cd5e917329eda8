"""State that a task must not keep: attributes that change, and global random numbers."""

from __future__ import annotations

import pickle
import random
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any, Final

import numpy as np

from rsoccer.task import Task
from rsoccer.testing.errors import expect

_GENERATORS: Final = ("random", "numpy.random")


class KeptState:
    """State outside of matches at one time, to find out later what has changed it."""

    def __init__(self, task: Task) -> None:
        """Note the attributes of a task and of its classes, and the global random state.

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
        drawn = [name for name, state in _generators().items() if state != self._generators[name]]
        fault = f"draws global random numbers of {', '.join(drawn)} instead of numbers from its rng"
        expect(not drawn, f"{culprit} {fault}")

    def _changed(self, name: str, now: Mapping[str, bytes]) -> bool:
        """Whether an attribute differs; one that was cached for the first time does not."""
        if name not in self._before:
            return not isinstance(_class_attribute(self._task, name), cached_property)
        return now.get(name) != self._before[name]


def _attributes(task: Task) -> dict[str, bytes]:
    """Content of all attributes of a task, and of those of its classes that hold data."""
    of_classes = (
        (f"{owner.__name__}.{name}", value)
        for owner in type(task).__mro__
        if issubclass(owner, Task) and owner is not Task
        for name, value in vars(owner).items()
        if _is_data(name, value)
    )
    return {name: _content(value) for name, value in (*vars(task).items(), *of_classes)}


def _is_data(name: str, value: object) -> bool:
    """Whether an attribute of a class is neither Python's own nor a method or property."""
    return not (name.startswith(("__", "_abc_")) or callable(value) or hasattr(value, "__get__"))


def _content(value: Any) -> bytes:  # noqa: ANN401  (any attribute)
    """Bytes that change with a value; its identity where it cannot be pickled."""
    try:
        return pickle.dumps(value)
    except Exception:
        return str(id(value)).encode()


def _class_attribute(task: Task, name: str) -> object:
    return next((vars(c)[name] for c in type(task).__mro__ if name in vars(c)), None)


def _generators() -> dict[str, bytes]:
    """States of the global random generators."""
    states: Iterator[object] = iter((random.getstate(), np.random.get_state()))  # noqa: NPY002
    return {name: pickle.dumps(next(states)) for name in _GENERATORS}

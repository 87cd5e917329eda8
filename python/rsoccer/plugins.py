"""Tasks and policies of others: modules that a user names, and entry points of installed packages.

A module registers what it holds when it is imported, with `rsoccer.register` and
`rsoccer.register_policy`. A package names a task or a policy in its metadata instead, in
`pyproject.toml`:

    [project.entry-points."rsoccer.tasks"]
    "Reach-v0" = "my_package:Reach"

    [project.entry-points."rsoccer.policies"]
    spin = "my_package:Spin"

Entry points are loaded when their name is asked for, and is not registered yet.
"""

from __future__ import annotations

import importlib
import operator
import os
import sys
import warnings
from collections.abc import Iterable
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Final

TASKS: Final = "rsoccer.tasks"
"""Group of entry points that name a class of tasks."""
POLICIES: Final = "rsoccer.policies"
"""Group of entry points that name a class of policies, or a function that makes one."""
VARIABLE: Final = "RSOCCER_IMPORT"
"""Environment variable with modules to import, separated by commas, before a name is unknown.

Processes that are started from one that imported modules find them there.
"""


def import_modules(names: Iterable[str]) -> None:
    """Import modules that register tasks and policies; those of the current folder come first.

    Args:
        names: names of modules, such as "my_tasks" or "my_package.tasks".

    Raises:
        ImportError: a module does not exist or raises an error.
        ValueError: a file or another text in the place of a module's name.
    """
    for name in names:
        _import("import", name)
        os.environ[VARIABLE] = ",".join(dict.fromkeys([*_inherited(), name]))


def import_inherited() -> None:
    """Import the modules that a parent process has imported.

    Raises:
        ImportError: a module does not exist or raises an error.
    """
    import_modules(name for name in _inherited() if name not in sys.modules)


def load(group: str, name: str) -> Any | None:  # noqa: ANN401  (whatever a package offers)
    """Return what an entry point names; None if there is none of the name.

    Args:
        group: `TASKS` or `POLICIES`.
        name: name of the task or the policy.

    Raises:
        ImportError: the entry point cannot be loaded.
    """
    point = _points(group).get(name)
    if point is None:
        return None
    try:
        return point.load()
    except Exception as error:
        raise ImportError(
            f"{_described(point)} cannot be loaded: {type(error).__name__}: {error}"
        ) from error


def find(argument: str, text: str) -> Any:  # noqa: ANN401  (whatever the module holds)
    """Return what a text names in a module; modules of the current folder come first.

    Args:
        argument: name of the argument that has the text, for errors.
        text: module and name, such as "my_package.robots:connect".

    Raises:
        ImportError: the module does not exist or raises an error, or has no such name.
        ValueError: a text of another form.
    """
    module, separator, name = text.partition(":")
    if not (separator and module and all(part.isidentifier() for part in name.split("."))):
        raise ValueError(f"{argument}: expected a text 'module:name', got {text!r}")
    _import(argument, module)
    try:
        return operator.attrgetter(name)(sys.modules[module])
    except AttributeError:
        raise ImportError(f"{argument}: the module {module!r} has no {name!r}") from None


def list_names(group: str) -> list[str]:
    """Return the names of the entry points of a group in alphabetical order, without loading them.

    Args:
        group: `TASKS` or `POLICIES`.
    """
    return sorted(_points(group))


def warn_of_taken_names(group: str, taken: Iterable[str]) -> None:
    """Warn of entry points that are never loaded, because their names stand for something else.

    Args:
        group: `TASKS` or `POLICIES`.
        taken: names that stand for tasks or policies of other origin.
    """
    for name in sorted(_points(group).keys() & set(taken)):
        point = _points(group)[name]
        warnings.warn(f"{_described(point)} is ignored: the name is taken", stacklevel=3)


def _described(point: EntryPoint) -> str:
    """Words that name an entry point and its package."""
    package = "" if point.dist is None else f" of {point.dist.name} {point.dist.version}"
    return f"{point.name!r}: the entry point {point.value!r}{package} in {point.group!r}"


@cache
def _points(group: str) -> dict[str, EntryPoint]:
    """Entry points by name."""
    return {point.name: point for point in entry_points(group=group)}


def _import(argument: str, name: str) -> None:
    """Import a module; errors name the argument."""
    if not all(part.isidentifier() for part in name.split(".")) or name.endswith(".py"):
        stem = os.path.basename(name).removesuffix(".py")
        hint = f", such as {stem}" if stem.isidentifier() else ""
        raise ValueError(f"{argument}: expected the name of a module{hint}, got {name!r}")
    folder = os.getcwd()
    if folder not in sys.path:
        sys.path.insert(0, folder)  # as `python -m` does
    try:
        importlib.import_module(name)
    except Exception as error:
        if isinstance(error, ModuleNotFoundError) and error.name == name.partition(".")[0]:
            raise ImportError(
                f"{argument}: expected a module of {folder} or an installed one, got {name!r}"
            ) from error
        raise ImportError(f"{argument}: {name!r} raises {type(error).__name__}: {error}") from error


def _inherited() -> list[str]:
    return [name for name in os.environ.get(VARIABLE, "").split(",") if name]

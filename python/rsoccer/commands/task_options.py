"""`--task-options`: the options of the task that a command plays."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

from tyro.constructors import PrimitiveConstructorSpec

from rsoccer.commands.entries import check_entries
from rsoccer.registry import task_with_options
from rsoccer.task import Task


def _parse_options(words: list[str]) -> dict[str, Any]:
    """Options given as NAME=VALUE; values as `rsoccer list` prints them, or text without quotes."""
    options: dict[str, Any] = {}
    names = []
    for word in words:
        name, separator, value = word.partition("=")
        if not name or not separator:
            raise ValueError(f"task_options: expected NAME=VALUE, got {word!r}")
        names.append(name)
        try:
            options[name] = ast.literal_eval(value)
        except (SyntaxError, ValueError):
            options[name] = value
    check_entries("task_options", names)
    return options


TASK_OPTIONS = PrimitiveConstructorSpec[Mapping[str, Any]](
    nargs="*",
    metavar="[NAME=VALUE [NAME=VALUE ...]]",
    instance_from_str=_parse_options,
    is_instance=lambda value: isinstance(value, Mapping),
    str_from_instance=lambda options: [f"{name}={value!r}" for name, value in options.items()],
)
"""Type of the option for tyro."""


def named_task(name: str | None, options: Mapping[str, Any]) -> Task | None:
    """Return the task that a command names, with its options; None if it names none.

    Args:
        name: a registered name or an alias, or None.
        options: options of the task, by name.

    Raises:
        ValueError: options without a task, an unknown task, or options that it refuses.
    """
    if name is None:
        if options:
            raise ValueError(f"task_options: expected --task with them, got {dict(options)} alone")
        return None
    return task_with_options(name, options)

"""`--task-options` and `--randomization`: values by name for what a command plays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from tyro.constructors import PrimitiveConstructorSpec

from rsoccer.option_words import parse_options
from rsoccer.registry import task_with_options
from rsoccer.task import Task


def _values_by_name(
    parse: Callable[[Sequence[str]], dict[str, Any]],
) -> PrimitiveConstructorSpec[Mapping[str, Any]]:
    """Type of an option with values by name, for tyro."""
    return PrimitiveConstructorSpec[Mapping[str, Any]](
        nargs="*",
        metavar="[NAME=VALUE [NAME=VALUE ...]]",
        instance_from_str=parse,
        is_instance=lambda value: isinstance(value, Mapping),
        str_from_instance=lambda options: [f"{name}={value!r}" for name, value in options.items()],
    )


def _parse_ranges(words: Sequence[str]) -> dict[str, Any]:
    """Distributions by name; one of a kind is that and its numbers, as in `normal,1.0,0.1`."""
    ranges = parse_options("randomization", words)
    return {
        name: _distribution(value) if isinstance(value, str) else value
        for name, value in ranges.items()
    }


def _distribution(text: str) -> Any:  # noqa: ANN401  (a distribution, or what is none)
    """A distribution from text that is no value of Python: with a kind, or with nan or inf."""
    parts = text.split(",")
    numbers = [_number(part) for part in parts]
    if None not in numbers:
        return tuple(numbers) if len(numbers) > 1 else numbers[0]
    if len(parts) > 1 and None not in numbers[1:]:
        return (parts[0], *numbers[1:])
    return text


def _number(word: str) -> float | None:
    """The number of a word; None if it is none."""
    try:
        return float(word)
    except ValueError:
        return None


TASK_OPTIONS = _values_by_name(partial(parse_options, "task_options"))
"""Type of the option for tyro."""
RANDOMIZATION = _values_by_name(_parse_ranges)
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

"""Options of tasks as words of a command line, for programs without the parser of the commands."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any


def check_entries(option: str, names: Iterable[str]) -> None:
    """Refuse a name that is given more than once.

    Args:
        option: name of the option.
        names: names of its entries.

    Raises:
        ValueError: a name is repeated.
    """
    for name, uses in Counter(names).items():
        if uses > 1:
            raise ValueError(f"{option}: expected each name once, got {name!r} {uses} times")


def parse_options(argument: str, words: Sequence[str]) -> dict[str, Any]:
    """Return values given as NAME=VALUE, as `rsoccer list` prints them, or text without quotes.

    Args:
        argument: name of the argument, for the error.
        words: the words, such as `half_seconds=30` and `division=A`.

    Raises:
        ValueError: a word of another form, or a name that is given twice.
    """
    options: dict[str, Any] = {}
    names = []
    for word in words:
        name, separator, value = word.partition("=")
        if not name or not separator:
            raise ValueError(f"{argument}: expected NAME=VALUE, got {word!r}")
        names.append(name)
        try:
            options[name] = ast.literal_eval(value)
        except (SyntaxError, ValueError):
            options[name] = value
    check_entries(argument, names)
    return options

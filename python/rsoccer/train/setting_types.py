"""Types of settings: the range beside the type of a field, conversion, and errors that name it."""

from __future__ import annotations

import dataclasses
import math
import numbers
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Final, Literal, get_args, get_origin, get_type_hints

import numpy as np


@dataclass(frozen=True)
class Range:
    """Range of a number; NaN and infinity are outside of it."""

    words: str
    """Description for errors."""
    low: float = field(repr=False)  # the words are enough in signatures of the reference
    """Least number."""
    high: float = field(default=math.inf, repr=False)
    """Greatest number."""
    without_low: bool = field(default=False, repr=False)
    """`low` itself is outside."""

    def holds(self, value: float) -> bool:
        """Return whether a number is inside.

        Args:
            value: the number.
        """
        inside = self.low < value if self.without_low else self.low <= value
        return inside and value <= self.high and math.isfinite(value)


Count = Annotated[int, Range("at least 1", 1)]
"""An integer of at least 1."""
Natural = Annotated[int, Range("at least 0", 0)]
"""An integer of at least 0."""
Fraction = Annotated[float, Range("between 0 and 1", 0.0, 1.0)]
"""A number from 0 to 1."""
Positive = Annotated[float, Range("finite and above 0", 0.0, without_low=True)]
"""A finite number above 0."""
Signed = Annotated[float, Range("between -1 and 1", -1.0, 1.0)]
"""A number from -1 to 1."""
Shares = dict[str, Annotated[float, Range("finite and at least 0", 0.0)]]
"""Shares by name, which need not sum to 1."""


def convert_fields(settings: Any, prefix: str = "") -> None:  # noqa: ANN401  (any frozen dataclass)
    """Convert every field of frozen settings to its type, and check its range.

    Numbers of NumPy become Python's, sequences tuples, and mappings dictionaries.

    Args:
        settings: instance of a dataclass whose fields are bool, int, float, str, Path, a Literal of
            texts, another dataclass, such a type or None, a tuple of numbers or texts, or a
            mapping from texts; numbers may have a `Range`.
        prefix: put before the name of a field in errors.

    Raises:
        ValueError: a value of another type or outside its range.
    """
    kinds = get_type_hints(type(settings), include_extras=True)
    for name in (each.name for each in dataclasses.fields(settings)):
        value = converted(f"{prefix}{name}", getattr(settings, name), kinds[name])
        object.__setattr__(settings, name, value)


def converted(name: str, value: Any, kind: Any) -> Any:  # noqa: ANN401  (any field, any type)
    """Return a value in the type of its field.

    Args:
        name: name of the field.
        value: its value.
        kind: type of the field, see `convert_fields`.

    Raises:
        ValueError: a value of another type or outside its range.
    """
    found = _convert(value, kind)
    if found is _WRONG:
        raise ValueError(f"{name} must be {_words(kind)}, got {value!r}")
    return found


def expect(name: str, valid: bool, expected: str, value: Any) -> None:  # noqa: ANN401
    """Raise ValueError, which names the field, unless its value is valid.

    Args:
        name: name of the field.
        valid: whether its value is.
        expected: description of valid values.
        value: the value.

    Raises:
        ValueError: the value is not valid.
    """
    if not valid:
        raise ValueError(f"{name} must be {expected}, got {value!r}")


_WRONG: Final = object()
"""Result for a value of another type."""
_TYPE_WORDS: Final[Mapping[Any, str]] = {
    bool: "True or False",
    int: "an integer",
    float: "a number",
    str: "text",
    Path: "a path",
}


def _convert(value: Any, kind: Any) -> Any:  # noqa: ANN401
    arguments = get_args(kind)
    origin = get_origin(kind)
    if origin is Annotated:
        return _convert_in_range(value, arguments)
    if origin is Literal:
        return value if isinstance(value, str) and value in arguments else _WRONG
    if origin is tuple:
        return _convert_sequence(value, arguments[0])
    if origin in (dict, Mapping):
        return _convert_mapping(value, arguments[1])
    if arguments:  # a type or None
        return None if value is None else _convert(value, arguments[0])
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        return value if isinstance(value, kind) else _WRONG
    return _convert_one(value, kind)


def _convert_in_range(value: Any, arguments: tuple[Any, ...]) -> Any:  # noqa: ANN401
    """Convert to a type that may have a range beside it."""
    kind, *extras = arguments
    found = _convert(value, kind)
    ranges = [extra for extra in extras if isinstance(extra, Range)]
    valid = found is not _WRONG and all(each.holds(found) for each in ranges)
    return found if valid else _WRONG


def _convert_one(value: Any, kind: Any) -> Any:  # noqa: ANN401
    is_bool = isinstance(value, bool | np.bool_)
    if kind is Any:
        return value
    if kind is bool:
        return bool(value) if is_bool else _WRONG
    if kind is int and not is_bool:
        return _as_integer(value)
    if kind is float and isinstance(value, numbers.Real) and not is_bool:
        return _as_number(value)
    if kind is str and isinstance(value, str):
        return str(value)
    if kind is Path and isinstance(value, str | os.PathLike):
        return Path(value)
    return _WRONG


def _as_integer(value: Any) -> Any:  # noqa: ANN401
    if isinstance(value, numbers.Integral):
        return int(value)
    is_whole = isinstance(value, float | np.floating) and float(value).is_integer()  # 1e6
    return int(value) if is_whole else _WRONG


def _as_number(value: numbers.Real) -> Any:  # noqa: ANN401
    try:
        number = float(value)
    except OverflowError:
        return _WRONG
    return value if isinstance(value, int) else number  # 1 stays 1 in files


def _convert_sequence(value: Any, kind: Any) -> Any:  # noqa: ANN401
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, Sequence) or isinstance(value, str | bytes):
        return _WRONG
    items = tuple(_convert(item, kind) for item in value)
    return _WRONG if any(item is _WRONG for item in items) else items


def _convert_mapping(value: Any, kind: Any) -> Any:  # noqa: ANN401
    if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
        return _WRONG
    items = {name: _convert(item, kind) for name, item in value.items()}
    return _WRONG if any(item is _WRONG for item in items.values()) else items


def _words(kind: Any) -> str:  # noqa: ANN401
    """Description of the values of a type."""
    arguments, origin = get_args(kind), get_origin(kind)
    if origin is Annotated:
        ranges = [extra.words for extra in arguments[1:] if isinstance(extra, Range)]
        return " ".join([_words(arguments[0]), *ranges])
    if origin is Literal:
        return f"one of {', '.join(arguments)}"
    if origin is tuple:
        return f"a sequence, each {_words(arguments[0])}"
    if origin in (dict, Mapping):
        item = "" if arguments[1] is Any else f", each {_words(arguments[1])}"
        return f"a mapping from names{item}"
    if arguments:
        return f"{_words(arguments[0])} or None"
    return _TYPE_WORDS.get(kind) or f"an instance of {kind.__name__}"

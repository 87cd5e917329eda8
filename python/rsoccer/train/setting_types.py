"""Types of settings: conversion of a value to the type of its field, or an error that names it."""

from __future__ import annotations

import numbers
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, Literal, get_args, get_origin

import numpy as np

_WORDS: Final[Mapping[Any, str]] = {
    bool: "True or False",
    int: "an integer",
    float: "a number",
    str: "text",
    Path: "a path",
}


def converted(name: str, value: Any, kind: Any) -> Any:  # noqa: ANN401  (any field, any type)
    """Return a value in the type of its field.

    Numbers of NumPy become Python's, sequences tuples, and mappings dictionaries.

    Args:
        name: name of the field.
        value: its value.
        kind: type of the field: bool, int, float, str, Path, a Literal of texts, such a type or
            None, a tuple of numbers or texts, or a mapping from texts.

    Raises:
        ValueError: a value of another type.
    """
    found = _convert(value, kind)
    if found is _WRONG:
        raise ValueError(f"{name} must be {_words(kind)}, got {value!r}")
    return found


_WRONG: Final = object()
"""Result for a value of another type."""


def _convert(value: Any, kind: Any) -> Any:  # noqa: ANN401
    arguments = get_args(kind)
    origin = get_origin(kind)
    if origin is Literal:
        return value if isinstance(value, str) else _WRONG  # the settings check the choice
    if origin is tuple:
        return _convert_sequence(value, arguments[0])
    if origin in (dict, Mapping):
        return _convert_mapping(value, arguments[1])
    if arguments:  # a type or None
        return None if value is None else _convert(value, arguments[0])
    return _convert_one(value, kind)


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
    arguments, origin = get_args(kind), get_origin(kind)
    if origin is Literal:
        return f"one of {', '.join(arguments)}"
    if origin is tuple:
        return f"a sequence, each {_words(arguments[0])}"
    if origin in (dict, Mapping):
        item = "" if arguments[1] is Any else f", each {_words(arguments[1])}"
        return f"a mapping from names{item}"
    if arguments:
        return f"{_words(arguments[0])} or None"
    return _WORDS[kind]

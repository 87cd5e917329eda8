"""Names of arrays with a prefix, so that several parts can share one file or memory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]
"""Arrays by name."""


def add_prefix(prefix: str, arrays: Mapping[str, NDArray[Any]]) -> Arrays:
    """Return arrays under the names `prefix.name`.

    Args:
        prefix: name of the part.
        arrays: arrays of the part by name.
    """
    return {f"{prefix}.{name}": array for name, array in arrays.items()}


def select_prefix(prefix: str, arrays: Mapping[str, NDArray[Any]]) -> Arrays:
    """Return the arrays that `add_prefix` named with a prefix, by their names without it.

    Args:
        prefix: name of the part.
        arrays: arrays of all parts by `prefix.name`; other prefixes are skipped.
    """
    start = f"{prefix}."
    return {name[len(start) :]: array for name, array in arrays.items() if name.startswith(start)}

"""Options that take several entries, each under a name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable


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

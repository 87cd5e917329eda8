"""Options that take several entries, each under a name."""

from __future__ import annotations

from collections.abc import Iterable

from rsoccer.option_words import check_entries


def named_entries(option: str, given: Iterable[str]) -> list[tuple[str, str]]:
    """Return names and values of NAME=VALUE.

    Args:
        option: name of the option.
        given: its entries.

    Raises:
        ValueError: a name is repeated, or an entry has no value.
    """
    entries = [entry.partition("=") for entry in given]
    check_entries(option, (name for name, _, _ in entries))
    for name, equals, value in entries:
        if not (name and equals and value):
            raise ValueError(f"{option}: expected NAME=VALUE, got {name + equals + value!r}")
    return [(name, value) for name, _, value in entries]

"""Markdown tables, and pages with generated parts between hand-written prose.

A generated part stands between `<!-- begin:NAME -->` and `<!-- end:NAME -->`.
"""

import re
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Final

FENCE: Final = re.compile(r"^```python *(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
"""A block of Python: its kind, such as `needs_ray` (often none), and its code."""

_MARKUP: Final = frozenset("&<>|`[]*\\{}")
"""Letters that Markdown, HTML or tables take as their own."""
_IN_CODE: Final = str.maketrans("`|", "'/")


def filled(page: str, parts: Mapping[str, Callable[[], str]], name: str) -> str:
    """Return a page with every generated part renewed.

    A part that begins in a list item, or is indented, is written with that indentation.

    Args:
        page: The text of the page.
        parts: The function that writes each part, by name.
        name: Name of the page, for the error.

    Returns:
        The new text.

    Raises:
        ValueError: The page has an unknown part.
    """
    found = re.findall(r"<!-- begin:(\w+) -->", page)
    if unknown := sorted(set(found) - set(parts)):
        raise ValueError(f"{name}: expected parts from {sorted(parts)}, got the unknown {unknown}")
    for part in found:
        begin, end = f"<!-- begin:{part} -->", f"<!-- end:{part} -->"
        first, rest = page.split(begin, 1)
        before = first.rpartition("\n")[2]
        indentation = "" if before.strip("- ") else " " * len(before)
        text = textwrap.indent(parts[part]().strip("\n") + "\n", indentation).lstrip("\n")
        page = f"{first}{begin}\n{text}{indentation}{end}{rest.split(end, 1)[1]}"
    return page


def escaped(text: str) -> str:
    """Return a text of others as prose in one cell: no markup, no tags, no further cells.

    Args:
        text: Any text.
    """
    return "".join(
        f"&#{ord(letter)};" if letter in _MARKUP else letter for letter in " ".join(text.split())
    )


def code(text: str) -> str:
    """Return a text of others as code in one cell, where no letter can be escaped.

    Args:
        text: Any text; `'` stands for a backtick in it and `/` for a bar.
    """
    return f"`{' '.join(text.split()).translate(_IN_CODE)}`"


def table(header: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return cells as a Markdown table.

    Args:
        header: Titles of the columns.
        rows: Cells of each row.
    """
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)

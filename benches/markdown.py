"""Markdown tables, and pages with generated parts between hand-written prose.

A generated part stands between `<!-- begin:NAME -->` and `<!-- end:NAME -->`.
"""

import re
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Final

FENCE: Final = re.compile(r"^```python *(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
"""A block of Python: its kind, such as `needs_ray` (often none), and its code."""


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


def table(header: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return cells as a Markdown table.

    Args:
        header: Titles of the columns.
        rows: Cells of each row.
    """
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)

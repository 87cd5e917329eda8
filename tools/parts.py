"""Pages whose prose is written by hand and whose tables are written by code.

Each part of code stands between `<!-- begin:NAME -->` and `<!-- end:NAME -->`.
"""

import re
from collections.abc import Callable, Iterable, Mapping


def filled(page: str, parts: Mapping[str, Callable[[], str]], name: str) -> str:
    """The page with every part as it should be now; ValueError for a part nobody writes."""
    found = re.findall(r"<!-- begin:(\w+) -->", page)
    if unknown := sorted(set(found) - set(parts)):
        raise ValueError(f"{name}: no one writes the parts {unknown}; known: {sorted(parts)}")
    for part in found:
        begin, end = f"<!-- begin:{part} -->", f"<!-- end:{part} -->"
        text = parts[part]().strip("\n")
        pattern = re.escape(begin) + ".*?" + re.escape(end)
        new = f"{begin}\n{text}\n{end}" if text else f"{begin}\n{end}"
        page = re.sub(pattern, lambda _, new=new: new, page, count=1, flags=re.DOTALL)  # type: ignore[misc]
    return page


def table(header: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Cells as a Markdown table."""
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)

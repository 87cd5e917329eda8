"""Tables for notebooks."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from rsoccer.evaluate.tables import Cells

_CELL = "padding:2px 10px;border:none"
_POSITIVE, _NEGATIVE = "47,109,179", "200,60,50"


def html_table(
    rows: Sequence[Cells], names: int, shades: Sequence[Sequence[float | None]] | None = None
) -> str:
    """Return rows as an HTML table.

    Args:
        rows: cells of text, those of a header first.
        names: number of first columns that are aligned to the left; numbers are to the right.
        shades: numbers from -1 to 1 by which the cells below the header are colored, None for no
            color; by default no cell is.
    """
    header = "".join(_cell("th", text, index < names, None) for index, text in enumerate(rows[0]))
    body = []
    for number, row in enumerate(rows[1:]):
        of_row = [None] * len(row) if shades is None else shades[number]
        cells = zip(row, of_row, strict=True)
        body.append(
            "".join(_cell("td", text, i < names, shade) for i, (text, shade) in enumerate(cells))
        )
    lines = "".join(f"<tr>{line}</tr>" for line in body)
    return f"<table><thead><tr>{header}</tr></thead><tbody>{lines}</tbody></table>"


def _cell(kind: str, text: str, is_name: bool, shade: float | None) -> str:
    """A cell; texts of others, such as names of files, are escaped."""
    style = f"{_CELL};text-align:{'left' if is_name else 'right'}"
    if shade is not None:
        color = _POSITIVE if shade >= 0.0 else _NEGATIVE
        style += f";background:rgba({color},{min(1.0, abs(shade)) * 0.6:.2f})"
    return f'<{kind} style="{style}">{escape(text)}</{kind}>'


def paragraph(text: str) -> str:
    """Return a text as a paragraph.

    Args:
        text: plain text.
    """
    return f"<p>{escape(text)}</p>"

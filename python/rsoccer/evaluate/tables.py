"""Text tables with aligned columns."""

from __future__ import annotations

from collections.abc import Sequence

Cells = tuple[str, ...]
"""Cells of a row."""


def align(rows: Sequence[Cells], names: int) -> str:
    """Return rows with the same number of cells as lines with aligned columns.

    Args:
        rows: the rows; those of a table begin with its header.
        names: number of first columns that are aligned to the left; numbers are to the right.
    """
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(_aligned(row, widths, names) for row in rows)


def _aligned(row: Cells, widths: Sequence[int], names: int) -> str:
    """A line with names aligned to the left and numbers to the right."""
    cells = (
        cell.ljust(width) if column < names else cell.rjust(width)
        for column, (cell, width) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join(cells).rstrip()

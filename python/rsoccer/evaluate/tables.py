"""Evaluations as text tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

from rsoccer.evaluate.results import Evaluation, Interval, Results

Cells = tuple[str, ...]

_INTERVAL = "95% interval"


def table(evaluations: Iterable[Evaluation]) -> str:
    """Return evaluations as lines of text: a header, one line each, aligned columns.

    Intervals of fewer than 10 matches a side are left out.

    Args:
        evaluations: the rows, in order. Consecutive ones of the same metrics share a table.

    Returns:
        The tables, separated by an empty line.
    """
    groups = groupby(evaluations, _header)
    return "\n\n".join(align([header, *map(_row, group)], 2) for header, group in groups)


def align(rows: Sequence[Cells], names: int) -> str:
    """Return rows with the same number of cells as lines with aligned columns.

    Args:
        rows: the rows; those of a table begin with its header.
        names: number of first columns that are aligned to the left; numbers are to the right.
    """
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(_aligned(row, widths, names) for row in rows)


def _header(evaluation: Evaluation) -> Cells:
    """Column titles: of a two-sided task if the evaluation has sides."""
    metric = evaluation.metric.replace("_", " ")
    first = ("policy", "opponent", "matches")
    others = [name.replace("_", " ") for name in evaluation.metrics]
    if evaluation.sides:
        counts = ("won", "drawn", "lost")
        named = (metric, _INTERVAL, "as blue", "as yellow", "goal after")
        return (*first, *counts, *named, *others)
    means = (title for name in (metric, "return", "seconds") for title in (name, _INTERVAL))
    return (*first, *means, "done after", *others)


def _row(evaluation: Evaluation) -> Cells:
    """Cells of an evaluation below its header."""
    after = evaluation.seconds_to_decision
    last = "-" if after is None else f"{after:.1f} s"
    first = (evaluation.policy, evaluation.opponent, str(evaluation.matches))
    others = [f"{value:.2f}" for value in evaluation.metrics.values()]
    score = Interval(evaluation.score, evaluation.low, evaluation.high)
    if not evaluation.sides:
        means = (score, evaluation.returns, evaluation.seconds)
        signs = ("", "+", "")
        cells = (_mean(mean, sign) for mean, sign in zip(means, signs, strict=True))
        return (*first, *(cell for pair in cells for cell in pair), last, *others)
    counts = (evaluation.wins, evaluation.draws, evaluation.losses)
    sides = (_score(evaluation.sides[side]) for side in ("blue", "yellow"))
    return (*first, *map(str, counts), *_mean(score, "+"), *sides, last, *others)


def _mean(interval: Interval, sign: str) -> Cells:
    """Cells of a mean and its interval, "-" without one: three decimals below 10, else two."""
    style = f"{sign}.{3 if abs(interval.mean) < 10.0 else 2}f"
    mean = f"{interval.mean:{style}}"
    if interval.low is None or interval.high is None:
        return mean, "-"
    return mean, f"[{interval.low:{style}}, {interval.high:{style}}]"


def _score(results: Results) -> str:
    """Cell of the mean score of one side."""
    return f"{results.score:+.3f}"


def _aligned(row: Cells, widths: Sequence[int], names: int) -> str:
    """A line with names aligned to the left and numbers to the right."""
    cells = (
        cell.ljust(width) if column < names else cell.rjust(width)
        for column, (cell, width) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join(cells).rstrip()

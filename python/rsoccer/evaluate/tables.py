"""Evaluations as lines of text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

from rsoccer.evaluate.results import Evaluation, Interval, Results

Cells = tuple[str, ...]

INTERVAL = "95% interval"
BOTH_SIDES: Cells = (
    *("policy", "opponent", "matches", "won", "drawn", "lost"),
    *("goal score", INTERVAL, "as blue", "as yellow", "goal after"),
)


def table(evaluations: Iterable[Evaluation]) -> str:
    """Evaluations, one a line under a header, columns aligned.

    Where headers differ, as those of tasks with different successes do, there are several tables.
    """
    groups = groupby(evaluations, _header)
    return "\n\n".join(_table([header, *map(_row, group)]) for header, group in groups)


def _table(rows: Sequence[Cells]) -> str:
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(_aligned(row, widths) for row in rows)


def _header(evaluation: Evaluation) -> Cells:
    metric = evaluation.metric.replace("_", " ")
    if evaluation.sides:
        return (*BOTH_SIDES[:6], metric, *BOTH_SIDES[7:])
    means = (title for name in (metric, "return", "seconds") for title in (name, INTERVAL))
    return ("policy", "opponent", "matches", *means, "done after")


def _row(evaluation: Evaluation) -> Cells:
    after = evaluation.decided_after
    last = "-" if after is None else f"{after:.1f} s"
    first = (evaluation.policy, evaluation.opponent, str(evaluation.matches))
    score = Interval(evaluation.score, evaluation.low, evaluation.high)
    if not evaluation.sides:
        means = (score, evaluation.returns, evaluation.seconds)
        signs = ("", "+", "")
        cells = (_mean(mean, sign) for mean, sign in zip(means, signs, strict=True))
        return (*first, *(cell for pair in cells for cell in pair), last)
    counts = (evaluation.wins, evaluation.draws, evaluation.losses)
    sides = (_side(evaluation.sides[side]) for side in ("blue", "yellow"))
    return (*first, *map(str, counts), *_mean(score, "+"), *sides, last)


def _mean(interval: Interval, sign: str) -> Cells:
    """A mean and its interval, to three digits after the point, or two where numbers are large."""
    places = 3 if abs(interval.mean) < 10.0 else 2
    mean, low, high = (
        f"{value:{sign}.{places}f}" for value in (interval.mean, interval.low, interval.high)
    )
    return mean, f"[{low}, {high}]"


def _side(results: Results) -> str:
    return f"{results.score:+.3f}"


def _aligned(row: Cells, widths: Sequence[int]) -> str:
    """Names to the left, numbers to the right."""
    cells = (
        cell.ljust(width) if column < 2 else cell.rjust(width)
        for column, (cell, width) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join(cells).rstrip()

"""Results of a tournament as text and as a picture."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.evaluate.cycles import in_words
from rsoccer.evaluate.html import html_table, paragraph
from rsoccer.evaluate.ratings import ANCHOR_RATING
from rsoccer.evaluate.results import MIN_PER_SIDE
from rsoccer.evaluate.standings import Standings
from rsoccer.evaluate.tables import align
from rsoccer.files import write_atomically

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BAR_COLOR = "#2f6db3"
MATRIX = "goal score of the row against the column"


def report(result: Standings) -> str:
    """Return the ratings, the goal scores of each pair and the cycles as lines of text.

    Args:
        result: the tournament.
    """
    return "\n\n".join(
        (
            _title(result),
            align(_ratings(result), 1),
            f"{MATRIX}\n{align(_matrix(result), 1)}",
            _cycles(result),
        )
    )


def report_html(result: Standings) -> str:
    """Return the same as HTML, with goal scores in color.

    Args:
        result: the tournament.
    """
    shades = [
        (None, *(None if i == j else score for j, score in enumerate(scores)))
        for i, scores in enumerate(result.scores)
    ]
    parts = (
        paragraph(_title(result)),
        html_table(_ratings(result), 1),
        paragraph(MATRIX),
        html_table(_matrix(result), 1, shades),
        paragraph(_cycles(result)),
    )
    return "".join(parts)


def _title(result: Standings) -> str:
    return f"{result.task}, {result.matches} matches a pair, half from each side"


def _cycles(result: Standings) -> str:
    """Line with the cycles, if the matches suffice for intervals."""
    if result.low is None:
        return f"intervals and cycles of wins need {2 * MIN_PER_SIDE} matches a pair or more"
    return f"cycles of wins (95% intervals above 0): {in_words(result.cycles)}"


def _ratings(result: Standings) -> list[tuple[str, ...]]:
    """Cells of the table of ratings."""
    header = ("policy", "rating", "95% interval", "won", "drawn", "lost", "goal score")
    rows = [
        (
            standing.label,
            f"{standing.rating:.0f}",
            "-" if standing.low is None else f"[{standing.low:.0f}, {standing.high:.0f}]",
            *(str(count) for count in (standing.wins, standing.draws, standing.losses)),
            f"{standing.score:+.3f}",
        )
        for standing in result.standings
    ]
    return [header, *rows]


def _matrix(result: Standings) -> list[tuple[str, ...]]:
    """Cells of the table of goal scores."""
    labels = [standing.label for standing in result.standings]
    rows = [
        (label, *("-" if i == j else f"{score:+.2f}" for j, score in enumerate(scores)))
        for i, (label, scores) in enumerate(zip(labels, result.scores, strict=True))
    ]
    return [("", *labels), *rows]


def draw(result: Standings, path: Path) -> Path:
    """Draw the goal scores as a heat map and the ratings as bars, as a PNG file.

    Args:
        result: the tournament.
        path: the file to write.

    Returns:
        `path`.
    """
    from matplotlib.figure import Figure

    n = len(result.standings)
    figure = Figure(figsize=(6.0 + 1.1 * n, 2.2 + 0.55 * n), dpi=130, layout="constrained")
    matrix, bars = figure.subplots(1, 2, width_ratios=(1.0, 0.8))
    _draw_matrix(matrix, result)
    _draw_ratings(bars, result)
    figure.suptitle(f"{result.task}: {result.matches} matches a pair, half from each side")
    content = BytesIO()
    figure.savefig(content, format="png")
    write_atomically(path, content.getvalue())
    return path


def _draw_matrix(axes: Axes, result: Standings) -> None:
    """Heat map of the goal scores, with numbers."""
    labels = [standing.label for standing in result.standings]
    scores = np.array(result.scores)
    np.fill_diagonal(scores, np.nan)
    axes.imshow(scores, cmap="RdBu", vmin=-1.0, vmax=1.0, aspect="auto")
    for (row, column), score in np.ndenumerate(scores):
        if row != column:
            color = "white" if abs(score) > 0.6 else "black"
            text = f"{score:+.2f}"
            axes.text(column, row, text, ha="center", va="center", color=color, fontsize=9)
    axes.set_xticks(range(len(labels)), labels, rotation=30, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(labels)), labels)
    axes.set_title(MATRIX, fontsize=10)


def _draw_ratings(axes: Axes, result: Standings) -> None:
    """Bars of the ratings with their intervals, beside the rows of the heat map."""
    ratings = np.array([standing.rating for standing in result.standings])
    low, high = (
        np.array([getattr(standing, name) for standing in result.standings], np.float64)
        for name in ("low", "high")
    )  # NaN without intervals, and the bars then have no caps
    # A percentile interval may leave out the rating of an unbeaten policy.
    errors = np.maximum([ratings - low, high - ratings], 0.0)
    rows = range(len(ratings))
    axes.barh(rows, ratings - ANCHOR_RATING, left=ANCHOR_RATING, color=BAR_COLOR, height=0.6)
    axes.axvline(ANCHOR_RATING, color="black", linewidth=0.8)
    axes.errorbar(ratings, rows, xerr=errors, fmt="none", ecolor="black", capsize=3, linewidth=1.2)
    end = np.fmax(high, ratings)
    for row, (x, rating) in enumerate(zip(end, ratings, strict=True)):
        axes.annotate(
            f"{rating:.0f}", (x, row), (5, 0), textcoords="offset points", va="center", fontsize=9
        )
    axes.margins(x=0.12)
    axes.set_ylim(len(ratings) - 0.5, -0.5)
    axes.set_yticks(rows, [standing.label for standing in result.standings])
    anchor = "mean" if result.anchor is None else result.anchor
    interval = "" if result.low is None else " with 95% interval"
    title = f"rating{interval} ({anchor} = {ANCHOR_RATING:.0f})"
    axes.set_title(title, fontsize=10)
    axes.grid(axis="x", alpha=0.25)
    axes.set_axisbelow(True)

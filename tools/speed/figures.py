"""Selection and format of the measured figures that the tables of speed share."""

from collections.abc import Sequence

from benches.result_files import Figure, format_number, format_ratio
from benches.scenarios import DEFAULT_ENGINE, ENGINES

SPEED = "speed"
OTHER_ENGINE = ENGINES[1]
BY_ENGINE = "compact / rapier"
"""Engine of a ratio of both."""


def of_default(figures: Sequence[Figure], group: str) -> list[Figure]:
    """Return the figures of a group without those of the engine that is not the default."""
    return [f for f in figures if f.group == group and f.engine in ("", DEFAULT_ENGINE)]


def ratio(figure: Figure) -> str:
    """Format a ratio with minimum and maximum."""
    minimum, maximum = format_ratio(figure.minimum), format_ratio(figure.maximum)
    return f"{format_ratio(figure.median)} ({minimum} to {maximum})"


def cell(figures: Sequence[Figure], variant: str | None, worlds: int) -> str:
    """Return a speed or ratio for a table cell; empty if not measured."""
    for figure in figures:
        if (figure.variant, figure.worlds) != (variant, worlds):
            continue
        if figure.quantity in (SPEED, "ratio"):
            return ratio(figure) if figure.quantity == "ratio" else format_number(figure.median)
    return ""

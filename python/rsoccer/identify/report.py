"""Identified numbers as a table for people."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rsoccer.evaluate.tables import align
from rsoccer.identify.identification import Identified
from rsoccer.identify.results import Estimate

_GOOD = 1.5  # scatter by noise up to which the model explains poses


def report(identified: Identified) -> str:
    """Return the identified numbers, and what is missing for the others, as text.

    Args:
        identified: the numbers.
    """
    rows = [("number", "value", "95% interval", "unit")]
    rows += [_row(each) for each in identified.estimates if each.is_identified]
    parts = [align(rows, names=1)]
    missing = [each for each in identified.estimates if not each.is_identified]
    if missing:
        parts.append("not identified:\n" + align([_missing(each) for each in missing], names=2))
    parts.append(_explained(identified.misfit, identified.seconds))
    return "\n\n".join(part for part in parts if part)


def _row(each: Estimate) -> tuple[str, str, str, str]:
    digits = _digits((each.low, each.high))
    numbers = [f"{number:.{digits}f}" for number in (each.value, each.low, each.high)]
    unit = "" if each.unit == "1" else each.unit
    return each.name, numbers[0], f"{numbers[1]} to {numbers[2]}", unit


def _missing(each: Estimate) -> tuple[str, str]:
    return f"  {each.name}", each.hint


def _digits(ends: Sequence[float]) -> int:
    """Decimals that show the width of an interval in two digits, of a number in six at most."""
    most = 5 - math.floor(math.log10(max(map(abs, ends)) or 1.0))
    width = ends[1] - ends[0]
    shown = 1 - math.floor(math.log10(width)) if width > 0.0 else 3
    return max(min(shown, most, 6), 0)


def _explained(misfit: float, seconds: float) -> str:
    """A sentence on the fit."""
    if math.isnan(misfit):
        return ""
    verdict = "the model explains the poses" if misfit < _GOOD else "the model misses some motion"
    return f"{seconds:.0f} s of driving; poses scatter by {misfit:.2f} of their noise: {verdict}"

"""Learning curves that results store: values between points, mean over seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from rsoccer.arrays import Doubles

Curve = Mapping[str, Any]
GRID: Final = 60
RESAMPLES: Final = 2_000


def value_at(curve: Curve, samples: float) -> float | None:
    """Return the value of a curve after some samples; None before its first point.

    After the last point it is that of the last.
    """
    if not curve["samples"] or samples < curve["samples"][0]:
        return None
    return float(np.interp(samples, curve["samples"], curve["values"]))


def mean_between(curve: Curve, start: float, end: float) -> float:
    """Return the mean of a curve between two numbers of samples.

    Args:
        curve: Curve with at least one point, which goes on horizontally beyond its ends.
        start: First samples.
        end: Last samples; where they are fewer, the value at the start is returned.
    """
    grid = np.linspace(start, max(start, end), GRID)
    return float(np.interp(grid, curve["samples"], curve["values"]).mean())


def seconds_to(curves: Sequence[Curve], value: float) -> float | None:
    """Return the median time at which the mean of several seeds' curves first reaches a value.

    Args:
        curves: Curve of each seed.
        value: The value.

    Returns:
        Seconds of learning; None if the mean stays below the value.
    """
    known = [curve for curve in curves if curve["samples"]]
    if not known:
        return None
    first = max(curve["samples"][0] for curve in known)
    for samples in (n for n in known[0]["samples"] if n >= first):
        values, seconds = (
            [np.interp(samples, curve["samples"], curve[name]) for curve in known]
            for name in ("values", "seconds")
        )
        if np.mean(values) >= value:
            return float(np.median(seconds))
    return None


def band(curves: Sequence[Curve]) -> tuple[Doubles, Doubles, Doubles, Doubles] | None:
    """Return the mean of several seeds' curves with its 95% bootstrap interval.

    Args:
        curves: Curve of each seed.

    Returns:
        Samples, means, and lower and upper bounds, (points,) each, where all curves have values;
        None without such samples.
    """
    known = [curve for curve in curves if len(curve["samples"]) > 1]
    if not known:
        return None
    first = max(curve["samples"][0] for curve in known)
    last = min(curve["samples"][-1] for curve in known)
    if first >= last:
        return None
    samples = np.geomspace(first, last, GRID)
    values = np.stack([np.interp(samples, curve["samples"], curve["values"]) for curve in known])
    rng = np.random.default_rng(0)
    drawn = values[rng.integers(len(values), size=(RESAMPLES, len(values)))].mean(axis=1)
    low, high = np.quantile(drawn, (0.025, 0.975), axis=0)
    return samples, values.mean(axis=0), low, high

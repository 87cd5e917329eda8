"""Learning curves that results store."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from rsoccer.arrays import Array

POINTS: Final = 50
"""Most points of a stored curve."""


def thinned(metric: str, samples: Array, seconds: Array, values: Array, weights: Array) -> Any:  # noqa: ANN401
    """Return the curve that a result stores: at most `POINTS` means over equal ranges of samples.

    Args:
        metric: Name of the metric.
        samples: (updates,) samples at the end of each update, rising.
        seconds: (updates,) seconds of training at the end of each update.
        values: (updates,) mean of the metric over the episodes of an update; NaN without episodes.
        weights: (updates,) number of these episodes.

    Returns:
        Values ready for JSON; points without episodes are left out.
    """
    points: list[tuple[int, float, float]] = []
    if len(samples):
        edges = np.linspace(0.0, samples[-1], POINTS + 1)[1:]
        bins = np.searchsorted(edges, samples - 1e-6)
        weights = np.where(np.isfinite(values), weights, 0.0)
        for index in range(POINTS):
            chosen = np.flatnonzero(bins == index)
            if total := weights[chosen].sum():
                mean = np.nansum(values[chosen] * weights[chosen]) / total
                last = chosen[-1]
                points.append((int(samples[last]), float(seconds[last]), float(mean)))
    columns: list[list[Any]] = [list(column) for column in zip(*points, strict=True)]
    columns = columns or [[], [], []]
    return {
        "metric": metric,
        "samples": columns[0],
        "seconds": [round(second, 1) for second in columns[1]],
        "values": [round(value, 4) for value in columns[2]],
    }

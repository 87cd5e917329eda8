"""Statistics over seeds, by the definitions of rliable (Agarwal et al., arXiv 2108.13264).

SciPy computes them: rliable itself would bring ten more packages.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import stats

from rsoccer.arrays import Doubles

RESAMPLES: Final = 20_000
SEED: Final = 0
LEVEL: Final = 0.95
QUARTER: Final = 0.25


@dataclass(frozen=True)
class Estimate:
    """A statistic with its interval."""

    value: float
    low: float
    """Lower bound of the 95% interval."""
    high: float
    runs: int
    """Number of scores."""


def iqm(scores: Sequence[float]) -> Estimate:
    """Return the interquartile mean of the scores of the seeds: the mean of their middle half.

    A quarter of the scores, rounded down, is left out at each end. The interval is that of a
    percentile bootstrap which draws seeds with replacement.
    """
    return _bootstrap([scores], lambda x, axis: stats.trim_mean(x, QUARTER, axis=axis))


def probability_of_improvement(x: Sequence[float], y: Sequence[float]) -> Estimate | None:
    """Return the probability that a run of x scores higher than a run of y; a tie counts half.

    The bootstrap draws the runs of each side on their own, as strata. None where one side has a
    single run.
    """
    return _bootstrap([x, y], _improvement) if min(len(x), len(y)) > 1 else None


def _improvement(x: Doubles, y: Doubles, axis: int) -> Doubles:
    """Share of the pairs of runs that x wins; the runs are on the last axis."""
    assert axis == -1
    difference = x[..., :, None] - y[..., None, :]
    share: Doubles = ((difference > 0) + 0.5 * (difference == 0)).mean(axis=(-1, -2))
    return share


def _bootstrap(samples: Sequence[Sequence[float]], statistic: Callable[..., Doubles]) -> Estimate:
    """A statistic with the interval of a stratified percentile bootstrap."""
    arrays = [np.array(scores, float) for scores in samples]
    value = float(statistic(*arrays, axis=-1))
    runs = sum(map(len, arrays))
    if runs == 1:
        return Estimate(value, value, value, runs)
    low, high = stats.bootstrap(
        arrays,
        statistic,
        n_resamples=RESAMPLES,
        confidence_level=LEVEL,
        method="percentile",
        vectorized=True,
        rng=SEED,
    ).confidence_interval
    return Estimate(value, float(low), float(high), runs)

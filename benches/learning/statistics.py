"""Statistics over seeds, by the definitions of rliable (Agarwal et al., arXiv 2108.13264)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles

RESAMPLES: Final = 20_000
SEED: Final = 0
LEVEL: Final = 0.95

Statistic = Callable[[list[Doubles]], Doubles]
"""Statistic of scores by stratum, each (resamples, runs), for each resample."""


@dataclass(frozen=True)
class Estimate:
    """A statistic with its interval."""

    value: float
    low: float
    """Lower bound of the 95% interval."""
    high: float
    runs: int
    """Number of scores."""


def interquartile_mean(scores: Doubles) -> Doubles:
    """Return the mean of the middle half of the scores (..., runs), (...,).

    A quarter of the scores, rounded down, is left out at each end.
    """
    count = scores.shape[-1]
    cut = count // 4
    mean: Doubles = np.sort(scores, axis=-1)[..., cut : count - cut].mean(axis=-1)
    return mean


def iqm(strata: Sequence[Sequence[float]]) -> Estimate:
    """Return the interquartile mean over the scores of all strata.

    Args:
        strata: Scores of the seeds, one sequence per task.

    Returns:
        Estimate with the interval of a percentile bootstrap that draws seeds within each task.
    """
    return _bootstrap(strata, lambda parts: interquartile_mean(np.concatenate(parts, axis=-1)))


def probability_of_improvement(x: Sequence[float], y: Sequence[float]) -> Estimate:
    """Return the probability that a run of x scores higher than a run of y; a tie counts half."""
    return _bootstrap([x, y], _improvement)


def comparison(x: Sequence[float], y: Sequence[float]) -> Estimate | None:
    """Return `probability_of_improvement`; None where one side has a single run."""
    return probability_of_improvement(x, y) if min(len(x), len(y)) > 1 else None


def _improvement(parts: list[Doubles]) -> Doubles:
    x, y = (part[..., None, :] for part in parts)
    difference = x.swapaxes(-1, -2) - y
    share: Doubles = ((difference > 0) + 0.5 * (difference == 0)).mean(axis=(-1, -2))
    return share


def _bootstrap(strata: Sequence[Sequence[float]], statistic: Statistic) -> Estimate:
    """A statistic with the interval of a stratified percentile bootstrap."""
    rng = np.random.default_rng(SEED)
    arrays = [np.array(scores, float) for scores in strata]
    drawn = [a[rng.integers(len(a), size=(RESAMPLES, len(a)))] for a in arrays]
    tail = (1.0 - LEVEL) / 2.0
    low, high = np.quantile(statistic(drawn), (tail, 1.0 - tail)).tolist()
    value = float(statistic([array[None] for array in arrays])[0])
    return Estimate(value, low, high, sum(map(len, arrays)))

"""Results of an evaluation: means over matches with bootstrap confidence intervals.

A bootstrap over few matches gives intervals that are too narrow, and with one match a side they
have no width at all. The probability that the interval of the goal score between two equal policies
lies above 0 should be 2.5%. It is up to 33% with one match a side, 9% with two, 6% with three, 4%
with five and 3% with ten. (These are sums over all results, for the share of draws and the
advantage of a side that are worst.) Therefore means of fewer than `MIN_PER_SIDE` matches a side
have no interval.

The interval of equal values has no width for any number of matches, although the mean is not exact:
Wilson's interval for the share of such matches begins at n / (n + 1.96^2), which is 98.1% for 200.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rsoccer.arrays import Doubles

N_RESAMPLES = 10_000
"""Resamples of the bootstrap; the bounds of an interval then repeat to about 0.005."""
MIN_PER_SIDE = 10
"""Fewest matches that a policy plays from each side, or the only one, for an interval."""
_DRAWN_AT_ONCE = 2**20  # indices; bounds the memory for any number of matches


@dataclass(frozen=True)
class Interval:
    """A mean with its 95% bootstrap confidence interval."""

    mean: float
    """mean of the values"""
    low: float | None
    """lower bound; None if there are fewer than 10 matches a side, which is too few"""
    high: float | None
    """upper bound, or None; both bounds equal the mean if all values are equal, which says little
    about rare other values"""


@dataclass(frozen=True)
class Results:
    """Wins, draws, losses and mean score of some matches, by the task's success metric."""

    matches: int
    """number of matches"""
    wins: int
    """matches with a score above 0"""
    draws: int
    """matches with a score of 0"""
    losses: int
    """matches with a score below 0"""
    score: float
    """mean score; for goal scores the mean goal difference, which is (wins - losses) / matches
    where a match ends with its first goal"""
    low: float | None
    """lower bound of the score's 95% interval, as in `Interval`; None for too few matches"""
    high: float | None
    """upper bound of the score's 95% interval, or None"""


def count_results(strata: Sequence[Doubles], rng: np.random.Generator) -> Results:
    """Return wins, draws, losses and the mean score of matches.

    Args:
        strata: scores of the matches, one array (n,) per side that the policy played.
        rng: draws the resamples of the interval.
    """
    scores = np.concatenate(strata)
    counts = (int((np.sign(scores) == sign).sum()) for sign in (1, 0, -1))
    return Results(len(scores), *counts, *vars(bootstrap_interval(strata, rng)).values())


def bootstrap_interval(strata: Sequence[Doubles], rng: np.random.Generator) -> Interval:
    """Return the mean of all values with its 95% interval, by a stratified percentile bootstrap.

    Values are resampled with replacement within each stratum, so the sides keep their weights. With
    fewer than `MIN_PER_SIDE` values in a stratum there is no interval.

    Args:
        strata: values, one array (n,) per side that the policy played.
        rng: draws the resamples.
    """
    total = sum(map(len, strata))
    mean = float(np.concatenate(strata).sum()) / total
    if min(map(len, strata)) < MIN_PER_SIDE:
        return Interval(mean, None, None)
    return Interval(mean, *_quantiles(_resampled_sums(strata, rng) / total))


def bootstrap_rate(strata: Sequence[Doubles], rng: np.random.Generator) -> Interval:
    """Return a ratio of two sums over all matches with its 95% interval, by the same bootstrap.

    Args:
        strata: pairs (n, 2) of each match, one array per side that the policy played: what is
            counted, and the time above 0 in which it is.
        rng: draws the resamples.
    """
    counted, time = np.concatenate(strata).sum(axis=0).tolist()
    if min(map(len, strata)) < MIN_PER_SIDE:
        return Interval(counted / time, None, None)
    sums = _resampled_sums(strata, rng)
    return Interval(counted / time, *_quantiles(sums[:, 0] / sums[:, 1]))


def _resampled_sums(strata: Sequence[Doubles], rng: np.random.Generator) -> Doubles:
    """Sums (N_RESAMPLES, ...) of values (n, ...) drawn with replacement in each stratum."""
    sums = np.zeros((N_RESAMPLES, *strata[0].shape[1:]))
    for values in strata:
        rows = max(1, _DRAWN_AT_ONCE // len(values))
        for start in range(0, N_RESAMPLES, rows):
            size = (min(rows, N_RESAMPLES - start), len(values))
            indices = rng.integers(len(values), size=size)
            sums[start : start + rows] += values[indices].sum(axis=1)
    return sums


def _quantiles(values: Doubles) -> tuple[float, float]:
    """Bounds of a 95% interval."""
    low, high = np.quantile(values, (0.025, 0.975)).tolist()
    return low, high

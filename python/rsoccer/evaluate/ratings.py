"""Ratings of policies from matches between them: the Bradley-Terry model on the Elo scale.

Policy i wins a match against policy j with probability 1 / (1 + exp(s_j - s_i)), where s are the
strengths (Bradley and Terry, 1952). A draw counts as half a win for each. On the Elo scale a
difference of 400 stands for odds of 10 to 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Doubles

ELO_SCALE: Final = 400.0 / math.log(10.0)
"""Points on the Elo scale of a difference of 1 in strength."""
ANCHOR_RATING: Final = 1000.0
"""Rating of the policy that fixes the scale, or the mean of all ratings."""
PRIOR_DRAWS: Final = 1.0
"""Draws that each policy has played, beforehand, against one of strength 0. They keep the ratings
of unbeaten policies finite, and matter little beside real matches."""
N_RESAMPLES: Final = 1000
"""Resamples of the bootstrap."""
_STEPS: Final = 200
_LARGEST_STEP: Final = 2.0
_TOLERANCE: Final = 1e-9


@dataclass(frozen=True)
class Ratings:
    """Ratings of k policies and the scores between them, with 95% bootstrap intervals."""

    ratings: Doubles
    """(k,) ratings on the Elo scale"""
    low: Doubles
    """(k,) lower bounds of the ratings"""
    high: Doubles
    """(k,) upper bounds of the ratings"""
    scores: Doubles
    """(k, k) (wins - losses) / matches of the row against the column; 0 on the diagonal"""
    scores_low: Doubles
    """(k, k) lower bounds of the scores"""
    scores_high: Doubles
    """(k, k) upper bounds of the scores"""


def rate(counts: NDArray[np.int64], anchor: int | None, rng: np.random.Generator) -> Ratings:
    """Return the ratings of policies, with intervals from a bootstrap over matches.

    Matches are resampled with replacement among those of the same two policies on the same sides.

    Args:
        counts: (k, k, 3) wins, draws and losses of the row as blue against the column as yellow,
            equally many matches for all pairs; zeros on the diagonal.
        anchor: index of the policy whose rating is `ANCHOR_RATING`, in each resample too; None for
            the mean of all.
        rng: draws the resamples.
    """
    matches = counts.sum(axis=2)
    shares = counts / np.maximum(matches, 1)[..., None]
    np.einsum("iij->ij", shares)[:] = (0.0, 1.0, 0.0)  # unused: there are no such matches
    resampled = rng.multinomial(matches, shares, size=(N_RESAMPLES, *matches.shape))
    points, drawn = _points(counts), _points(resampled)
    ratings, bootstrap = (_anchored(strengths(part), anchor) for part in (points, drawn))
    low, high = np.quantile(bootstrap, (0.025, 0.975), axis=0)
    scores_low, scores_high = np.quantile(_scores(drawn), (0.025, 0.975), axis=0)
    return Ratings(ratings, low, high, _scores(points), scores_low, scores_high)


def strengths(points: Array) -> Doubles:
    """Return the strengths that make results most likely, by Newton's method, (..., k).

    Args:
        points: (..., k, k) points of the row against the column: 1 for a win, 0.5 for a draw.
    """
    k = points.shape[-1]
    played = points + np.swapaxes(points, -1, -2)
    strength = np.zeros(points.shape[:-1])
    diagonal = np.arange(k)
    for _ in range(_STEPS):
        expected = _logistic(strength[..., :, None] - strength[..., None, :])
        prior = _logistic(strength)
        gradient = (points - played * expected).sum(-1) + PRIOR_DRAWS * (0.5 - prior)
        slope = played * expected * (1.0 - expected)
        curvature = -slope
        curvature[..., diagonal, diagonal] += slope.sum(-1) + PRIOR_DRAWS * prior * (1.0 - prior)
        step = np.linalg.solve(curvature, gradient[..., None])[..., 0]
        # Far from the maximum a full step could overshoot.
        largest = np.abs(step).max(axis=-1, keepdims=True)
        strength += step * np.minimum(1.0, _LARGEST_STEP / np.maximum(largest, _TOLERANCE))
        if largest.max() < _TOLERANCE:
            break
    return strength


def _logistic(x: Doubles) -> Doubles:
    """Logistic function, without overflow."""
    result: Doubles = 0.5 * (1.0 + np.tanh(0.5 * x))
    return result


def _points(counts: Array) -> Doubles:
    """Points (..., k, k) of the row against the column on both sides, from counts as blue."""
    as_blue = counts[..., 0] + 0.5 * counts[..., 1]
    as_yellow = counts[..., 2] + 0.5 * counts[..., 1]
    points: Doubles = as_blue + np.swapaxes(as_yellow, -1, -2)
    return points


def _scores(points: Doubles) -> Doubles:
    """Scores (..., k, k) of the row against the column."""
    other = np.swapaxes(points, -1, -2)
    scores: Doubles = (points - other) / np.maximum(points + other, 1.0)
    return scores


def _anchored(strength: Doubles, anchor: int | None) -> Doubles:
    """Ratings (..., k) of strengths (..., k)."""
    zero = strength.mean(-1) if anchor is None else strength[..., anchor]
    ratings: Doubles = ANCHOR_RATING + ELO_SCALE * (strength - zero[..., None])
    return ratings

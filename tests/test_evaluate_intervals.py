import sys

import numpy as np
import pytest

from rsoccer.evaluate import Results

module = sys.modules["rsoccer.evaluate"]


def results(*strata: tuple[int, int, int], seed: int = 0) -> Results:
    scores = [np.repeat([1, 0, -1], counts) for counts in strata]
    found: Results = module.__dict__["_results"](scores, np.random.default_rng(seed))
    return found


def test_intervals_are_those_of_the_normal_approximation() -> None:
    found = results((60, 20, 20), (50, 30, 20))
    variances = [(0.6 + 0.2 - 0.4**2) * 100, (0.5 + 0.2 - 0.3**2) * 100]
    half = 1.96 * np.sqrt(sum(variances)) / 200
    assert found.goal_score == pytest.approx(0.35)
    assert found.low == pytest.approx(0.35 - half, abs=0.012)
    assert found.high == pytest.approx(0.35 + half, abs=0.012)
    assert half > 0.1


def test_intervals_hold_the_truth_19_times_in_20() -> None:
    rng = np.random.default_rng(0)
    draws = rng.multinomial(100, (0.5, 0.2, 0.3), size=200).tolist()
    held = [found.low <= 0.2 <= found.high for found in (results(tuple(draw)) for draw in draws)]
    assert 0.91 < np.mean(held) < 0.99


def test_sides_are_resampled_apart() -> None:
    """A policy that always wins as blue and always loses as yellow leaves nothing to chance."""
    found = results((50, 0, 0), (0, 0, 50))
    assert (found.goal_score, found.low, found.high) == (0.0, 0.0, 0.0)
    mixed = results((50, 0, 50))
    assert mixed.high - mixed.low > 0.3

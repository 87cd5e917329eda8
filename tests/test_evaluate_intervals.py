"""Bootstrap intervals against the normal approximation."""

import numpy as np
import pytest

from rsoccer.evaluate.results import Results, bootstrap_interval, count_results


def results_of(*strata: tuple[int, int, int], seed: int = 0) -> Results:
    scores = [np.repeat([1.0, 0.0, -1.0], counts) for counts in strata]
    return count_results(scores, np.random.default_rng(seed))


def test_intervals_are_those_of_the_normal_approximation() -> None:
    found = results_of((60, 20, 20), (50, 30, 20))
    variances = [(0.6 + 0.2 - 0.4**2) * 100, (0.5 + 0.2 - 0.3**2) * 100]
    half = 1.96 * np.sqrt(sum(variances)) / 200
    assert found.score == pytest.approx(0.35)
    assert found.low == pytest.approx(0.35 - half, abs=0.012)
    assert found.high == pytest.approx(0.35 + half, abs=0.012)
    assert half > 0.1


def test_intervals_contain_the_true_mean_19_times_in_20() -> None:
    rng = np.random.default_rng(0)
    draws = rng.multinomial(100, (0.5, 0.2, 0.3), size=200).tolist()
    contained = [
        found.low <= 0.2 <= found.high for found in (results_of(tuple(draw)) for draw in draws)
    ]
    assert 0.91 < np.mean(contained) < 0.99


def test_sides_are_resampled_separately() -> None:
    """A policy that always wins as blue and always loses as yellow has an interval of width 0."""
    found = results_of((50, 0, 0), (0, 0, 50))
    assert (found.score, found.low, found.high) == (0.0, 0.0, 0.0)
    mixed = results_of((50, 0, 50))
    assert mixed.high - mixed.low > 0.3


def test_intervals_of_times_are_those_of_the_normal_approximation() -> None:
    rng = np.random.default_rng(0)
    strata = [rng.gamma(2.0, 3.0, 400), rng.gamma(2.0, 5.0, 400)]
    found = bootstrap_interval(strata, rng)
    half = 1.96 * np.sqrt(sum(part.var() * 400 for part in strata)) / 800
    assert found.mean == pytest.approx(np.concatenate(strata).mean())
    assert found.low == pytest.approx(found.mean - half, abs=0.1 * half)
    assert found.high == pytest.approx(found.mean + half, abs=0.1 * half)


def test_the_interval_of_equal_values_has_width_0() -> None:
    found = bootstrap_interval([np.full(7, 0.1)], np.random.default_rng(0))
    assert found.low == found.mean == found.high

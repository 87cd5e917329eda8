"""Bootstrap intervals against the normal approximation."""

import numpy as np
import pytest

from rsoccer.evaluate.results import (
    MIN_PER_SIDE,
    Interval,
    Results,
    bootstrap_interval,
    count_results,
)
from tests.helpers import bounds


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
        low <= 0.2 <= high for low, high in (bounds(results_of(tuple(draw))) for draw in draws)
    ]
    assert 0.91 < np.mean(contained) < 0.99


def test_sides_are_resampled_separately() -> None:
    """A policy that always wins as blue and always loses as yellow has an interval of width 0."""
    found = results_of((50, 0, 0), (0, 0, 50))
    assert (found.score, found.low, found.high) == (0.0, 0.0, 0.0)
    low, high = bounds(results_of((50, 0, 50)))
    assert high - low > 0.3


def test_intervals_of_times_are_those_of_the_normal_approximation() -> None:
    rng = np.random.default_rng(0)
    strata = [rng.gamma(2.0, 3.0, 400), rng.gamma(2.0, 5.0, 400)]
    found = bootstrap_interval(strata, rng)
    half = 1.96 * np.sqrt(sum(part.var() * 400 for part in strata)) / 800
    assert found.mean == pytest.approx(np.concatenate(strata).mean())
    assert found.low == pytest.approx(found.mean - half, abs=0.1 * half)
    assert found.high == pytest.approx(found.mean + half, abs=0.1 * half)


def test_the_interval_of_equal_values_has_width_0() -> None:
    found = bootstrap_interval([np.full(11, 0.1)], np.random.default_rng(0))
    assert found.low == found.mean == found.high


def test_too_few_matches_have_no_interval() -> None:
    """Formerly one match a side had an interval of width 0."""
    enough, few = (MIN_PER_SIDE, 0, 0), (MIN_PER_SIDE - 1, 0, 0)
    assert bounds(results_of(enough, enough)) == (1.0, 1.0)
    for strata in ((few, enough), (enough, few), (few,), ((1, 0, 0), (1, 0, 0))):
        found = results_of(*strata)
        assert (found.score, found.low, found.high) == (1.0, None, None)
    rng = np.random.default_rng(0)
    assert bootstrap_interval([np.array([2.0, 4.0])], rng) == Interval(3.0, None, None)


def test_intervals_of_the_fewest_matches_seldom_find_a_difference_where_there_is_none() -> None:
    rng = np.random.default_rng(0)
    draws = rng.multinomial(MIN_PER_SIDE, (0.4, 0.2, 0.4), size=(600, 2)).tolist()
    found = [bounds(results_of(tuple(blue), tuple(yellow))) for blue, yellow in draws]
    assert 0.0 < np.mean([low > 0.0 for low, _ in found]) < 0.045
    assert 0.0 < np.mean([high < 0.0 for _, high in found]) < 0.045

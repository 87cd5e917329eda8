import numpy as np
import pytest

from benches.learning.reporting.statistics import iqm, probability_of_improvement


def test_the_interquartile_mean_leaves_out_a_quarter_at_each_end() -> None:
    assert iqm([9.0, 1.0, 2.0, -50.0]).value == 1.5
    assert iqm([1.0, 2.0, 3.0]).value == 2.0  # nothing of three
    assert iqm([0.0, 1.0, 2.0, 3.0, 100.0]).value == 2.0


def test_a_single_run_has_no_interval() -> None:
    estimate = iqm([0.7])
    assert (estimate.value, estimate.low, estimate.high, estimate.runs) == (0.7, 0.7, 0.7, 1)
    assert probability_of_improvement([0.0, 2.0], [1.0]) is None
    assert probability_of_improvement([1.0], [1.0, 2.0]) is None


def test_the_interval_covers_the_true_mean_about_as_often_as_promised() -> None:
    rng = np.random.default_rng(0)
    covered = [(e := iqm(rng.normal(size=20).tolist())).low < 0.0 < e.high for _ in range(60)]
    assert 0.85 < np.mean(covered) <= 1.0


def test_equal_scores_have_an_interval_without_width() -> None:
    estimate = iqm([0.5] * 5)
    assert (estimate.value, estimate.low, estimate.high, estimate.runs) == (0.5, 0.5, 0.5, 5)


def test_the_probability_of_improvement_counts_pairs() -> None:
    better = probability_of_improvement([1.0, 2.0], [0.0, 0.5])
    assert better is not None
    assert (better.value, better.low, better.high, better.runs) == (1.0, 1.0, 1.0, 4)
    equal = probability_of_improvement([1.0, 1.0], [1.0, 1.0])
    assert equal is not None
    assert equal.value == 0.5
    estimate = probability_of_improvement([0.0, 1.0, 2.0], [0.5, 1.0])
    assert estimate is not None
    assert estimate.value == pytest.approx((0 + 0 + 1 + 0.5 + 1 + 1) / 6)
    assert estimate.low < estimate.value < estimate.high

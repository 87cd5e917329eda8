import numpy as np
import pytest

from benches.learning.statistics import (
    interquartile_mean,
    iqm,
    probability_of_improvement,
)


def test_the_interquartile_mean_leaves_out_a_quarter_at_each_end() -> None:
    assert interquartile_mean(np.array([9.0, 1.0, 2.0, -50.0])) == 1.5
    assert interquartile_mean(np.array([1.0, 2.0, 3.0])) == 2.0  # nothing of three
    assert interquartile_mean(np.array([0.0, 1.0, 2.0, 3.0, 100.0])) == 2.0


def test_interquartile_mean_agrees_with_scipy() -> None:
    stats = pytest.importorskip("scipy.stats")
    for count in (3, 4, 5, 10, 31):
        scores = np.random.default_rng(count).normal(size=count)
        assert interquartile_mean(scores) == pytest.approx(stats.trim_mean(scores, 0.25))


def test_the_interval_covers_the_true_mean_about_as_often_as_promised() -> None:
    rng = np.random.default_rng(0)
    covered = [(e := iqm([rng.normal(size=20).tolist()])).low < 0.0 < e.high for _ in range(60)]
    assert 0.85 < np.mean(covered) <= 1.0


def test_equal_scores_have_an_interval_without_width() -> None:
    estimate = iqm([[0.5, 0.5, 0.5], [0.5, 0.5]])
    assert (estimate.value, estimate.low, estimate.high, estimate.runs) == (0.5, 0.5, 0.5, 5)


def test_strata_keep_their_share() -> None:
    # Each resample holds five runs of each task, so its middle half holds both tasks.
    estimate = iqm([[0.0] * 5, [1.0] * 5])
    assert (estimate.low, estimate.high) == (0.5, 0.5)


def test_the_probability_of_improvement_counts_pairs() -> None:
    assert probability_of_improvement([1.0, 2.0], [0.0, 0.5]).value == 1.0
    assert probability_of_improvement([0.0, 2.0], [1.0]).value == 0.5
    assert probability_of_improvement([1.0], [1.0]).value == 0.5
    estimate = probability_of_improvement([0.0, 1.0, 2.0], [0.5, 1.0])
    assert estimate.value == pytest.approx((0 + 0 + 1 + 0.5 + 1 + 1) / 6)
    assert estimate.low < estimate.value < estimate.high

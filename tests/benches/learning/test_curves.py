import numpy as np

from benches.learning.curves import POINTS, seconds_to, thinned


def test_a_curve_keeps_the_mean_of_all_episodes() -> None:
    rng = np.random.default_rng(0)
    samples, values = np.arange(1, 1001) * 100, rng.normal(size=1000)
    values[::3] = np.nan
    weights = rng.integers(1, 9, 1000).astype(float)
    kept = thinned("goal_score", samples, samples / 7.0, values, weights)
    assert len(kept["samples"]) == POINTS
    assert kept["samples"][-1] == 100_000
    known = np.isfinite(values)
    parts = (np.arange(1000) // 20)[known]
    sums = np.bincount(parts, (values * weights)[known]) / np.bincount(parts, weights[known])
    np.testing.assert_allclose(kept["values"], sums, atol=1e-4)


def test_a_curve_without_episodes_is_empty() -> None:
    nothing = thinned("passes", np.ones(3), np.ones(3), np.full(3, np.nan), np.zeros(3))
    assert nothing == {"metric": "passes", "samples": [], "seconds": [], "values": []}


def test_the_time_to_a_value_is_that_of_the_mean_curve() -> None:
    curves = [
        {"samples": [10, 20, 30], "seconds": [1.0, 2.0, 3.0], "values": [0.9, 0.4, 0.6]},
        {"samples": [20, 30, 40], "seconds": [4.0, 6.0, 9.0], "values": [0.5, 0.7, 0.9]},
        {"samples": [20, 30, 40], "seconds": [4.0, 7.0, 9.0], "values": [0.5, 0.5, 0.6]},
    ]
    assert seconds_to(curves, 0.45) == 4.0
    assert seconds_to(curves, 0.6) == 6.0
    assert seconds_to(curves, 0.8) is None
    assert seconds_to([], 0.0) is None

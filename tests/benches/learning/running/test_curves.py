import numpy as np

from benches.learning.running.curves import POINTS, thinned


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

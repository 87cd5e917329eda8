"""The evolution strategy finds better numbers."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer.policies.tactics import Tactic
from rsoccer.train.evolution.strategy import Strategy, standardized

KNOWN = [Tactic("speed", 2.0, 0.5, 4.0), Tactic("gain", 10.0, 1.0, 30.0), Tactic("vain", 1, 0.1, 9)]


def begun(first: np.ndarray | None = None) -> Strategy:
    return Strategy.begin(KNOWN, 0.2, 2.0, 0.5, first)


def test_it_climbs_to_the_best_numbers_through_noise() -> None:
    strategy, rng = begun(), np.random.default_rng(0)
    for _ in range(40):
        draws = strategy.draw(50, rng)
        tactics = strategy.tactics(draws)
        errors = np.log(tactics[:, :2] / np.array([3.0, 5.0]))
        scores = -np.square(errors).sum(axis=1) + rng.normal(0.0, 0.2, len(draws))
        strategy.learn(draws, standardized(scores))
    np.testing.assert_allclose(strategy.tactics()[:2], [3.0, 5.0], rtol=0.2)


def test_draws_are_mirrored_and_within_the_ranges() -> None:
    strategy = begun()
    draws = strategy.draw(500, np.random.default_rng(0)) * 10
    np.testing.assert_array_equal(draws[:500], -draws[500:])
    tactics = strategy.tactics(draws)
    assert tactics.shape == (1000, 3)
    for number, tactic in zip(tactics.T, KNOWN, strict=True):
        assert (number.min(), number.max()) == pytest.approx((tactic.least, tactic.most))


def test_it_begins_with_given_numbers_and_stays_in_the_ranges() -> None:
    np.testing.assert_allclose(begun().tactics(), [2.0, 10.0, 1.0])
    strategy = begun(np.array([4.0, 1.0, 2.0]))
    np.testing.assert_allclose(strategy.tactics(), [4.0, 1.0, 2.0])
    draws = strategy.draw(50, np.random.default_rng(0))
    strategy.learn(draws, standardized(draws[:, 0]))
    assert strategy.tactics()[0] == pytest.approx(4.0)
    strategy.step[:] = 0.0
    strategy.learn(draws, standardized(-draws[:, 0]))
    assert strategy.tactics()[0] < 3.9, "a number at the end of its range comes back at once"


def test_scores_are_compared_within_their_kind() -> None:
    scores = np.array([1.0, 2.0, 3.0, 90.0] + [2.0] * 96)
    found = standardized(scores)
    assert found.max() == 3.0, "one match does not decide"
    np.testing.assert_array_equal(standardized(np.full(5, 7.0)), np.zeros(5))

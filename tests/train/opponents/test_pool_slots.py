"""Slots of past policies: prioritized draws, and draws from shares."""

import numpy as np
import pytest

from rsoccer.train.opponents.pool_slots import EVEN_SHARE, PoolSlots, draw


def slots_with(win_rates: list[float]) -> PoolSlots:
    return PoolSlots(8, list(range(len(win_rates))), win_rates)


def test_the_shares_follow_the_weights_and_a_floor() -> None:
    rates = np.array([0.0, 0.5, 0.9, 1.0])
    shares = slots_with(rates.tolist()).shares()
    weights = 1 - rates
    np.testing.assert_allclose(shares, EVEN_SHARE / 4 + (1 - EVEN_SHARE) * weights / weights.sum())
    assert shares.sum() == pytest.approx(1.0)
    assert shares.min() >= EVEN_SHARE / 4 - 1e-12, "a past policy is forgotten"
    assert (np.diff(shares) <= 1e-12).all(), "a harder opponent is drawn less often"


def test_the_shares_are_even_where_every_past_policy_is_always_beaten() -> None:
    assert slots_with([1.0, 1.0]).shares().tolist() == [0.5, 0.5]


def test_win_rates_follow_the_results() -> None:
    slots = slots_with([0.5, 0.5, 0.5])
    slots.record([0, 1, 0], [1.0, 0.0, -1.0])
    assert slots.win_rates == pytest.approx([0.525 * 0.95, 0.5, 0.5])
    slots.record(np.zeros(200, int), np.ones(200))
    assert slots.win_rates[0] > 0.99


def test_matches_without_an_order_weigh_as_much_as_one_after_the_other() -> None:
    one_by_one, together = slots_with([0.5, 0.3]), slots_with([0.5, 0.3])
    one_by_one.record([0, 0, 0, 1], [1.0, 1.0, 1.0, 0.0])
    together.record_mean(0, 1.0, 3)
    together.record_mean(1, 0.5, 1)
    assert together.win_rates == pytest.approx(one_by_one.win_rates)


def test_a_new_past_policy_starts_as_an_equal() -> None:
    slots = PoolSlots(2, [10, 20], [0.9, 0.1])
    replaced = slots.take(30)
    assert slots.win_rates[replaced] == 0.5 and slots.win_rates[1 - replaced] != 0.5


def test_draws_have_the_probabilities_of_the_shares() -> None:
    uniform = np.linspace(0.0, 1.0, 1001)  # with both ends
    counts = np.bincount(draw(uniform, [0.0, 0.25, 0.0, 0.75, 0.0]), minlength=5)
    assert counts[[0, 2, 4]].tolist() == [0, 0, 0]
    assert counts[[1, 3]] / 1001 == pytest.approx([0.25, 0.75], abs=0.002)

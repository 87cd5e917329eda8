"""Bradley-Terry ratings: known cases, symmetry, unbeaten policies, intervals; cycles."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rsoccer.evaluate.cycles import cycles, in_words
from rsoccer.evaluate.ratings import ANCHOR_RATING, ELO_SCALE, PRIOR_DRAWS, rate, strengths
from rsoccer.evaluate.results import MIN_PER_SIDE


def generator() -> np.random.Generator:
    return np.random.default_rng(1)


def counts_of(results: dict[tuple[int, int], tuple[int, int, int]], k: int) -> NDArray[np.int64]:
    """Return counts with these wins, draws and losses for both sides of each pair."""
    counts = np.zeros((k, k, 3), np.int64)
    for (a, b), (wins, draws, losses) in results.items():
        counts[a, b], counts[b, a] = (wins, draws, losses), (losses, draws, wins)
    return counts


def test_two_policies_have_the_odds_of_their_points() -> None:
    """The likelihood of 900 points to 100 is largest at odds of 9 to 1."""
    difference = np.diff(strengths(np.array([[0.0, 100.0], [900.0, 0.0]])))[0]
    assert difference == pytest.approx(math.log(9.0), rel=0.01)
    rated = rate(counts_of({(0, 1): (50_000, 0, 5_000)}, 2), None, generator())
    assert np.diff(rated.ratings)[0] == pytest.approx(-400.0, abs=0.5), "400 points are 10 to 1"
    assert rated.ratings.mean() == pytest.approx(ANCHOR_RATING)


def test_the_strengths_of_a_known_case() -> None:
    """Points that are exactly those expected give back the strengths, whatever the prior."""
    true = np.array([-1.0, 0.0, 0.2, 0.8])
    expected = 1.0 / (1.0 + np.exp(true[None, :] - true[:, None]))
    points = 1e6 * expected * (1 - np.eye(4))
    found = strengths(points)
    np.testing.assert_allclose(found - found.mean(), true - true.mean(), atol=1e-4)


def test_the_gradient_vanishes_at_the_strengths() -> None:
    points = generator().integers(0, 30, (5, 5)).astype(float)
    np.fill_diagonal(points, 0.0)
    s = strengths(points)
    expected = 1.0 / (1.0 + np.exp(s[None, :] - s[:, None]))
    gradient = (points - (points + points.T) * expected).sum(1)
    gradient += PRIOR_DRAWS * (0.5 - 1.0 / (1.0 + np.exp(-s)))
    np.testing.assert_allclose(gradient, 0.0, atol=1e-7)


def test_ratings_do_not_depend_on_the_order_or_the_sides() -> None:
    rng = generator()
    counts = rng.multinomial(20, (0.5, 0.2, 0.3), size=(6, 6))
    counts[np.arange(6), np.arange(6)] = 0
    ratings = rate(counts, None, rng).ratings
    order = rng.permutation(6)
    np.testing.assert_allclose(
        rate(counts[np.ix_(order, order)], None, rng).ratings, ratings[order], atol=1e-6
    )
    other_side = counts.transpose(1, 0, 2)[..., ::-1]
    np.testing.assert_allclose(rate(other_side, None, rng).ratings, ratings, atol=1e-6)
    reversed_results = counts[..., ::-1]  # all wins become losses
    np.testing.assert_allclose(
        rate(reversed_results, None, rng).ratings, 2 * ANCHOR_RATING - ratings, atol=1e-6
    )


def test_a_draw_is_half_a_win() -> None:
    drawn = rate(counts_of({(0, 1): (10, 20, 10)}, 2), None, generator()).ratings
    decided = rate(counts_of({(0, 1): (20, 0, 20)}, 2), None, generator()).ratings
    np.testing.assert_allclose(drawn, ANCHOR_RATING)
    np.testing.assert_allclose(decided, ANCHOR_RATING)


def test_an_unbeaten_policy_has_a_finite_rating_above_all_others() -> None:
    results = {(0, 1): (100, 0, 0), (0, 2): (100, 0, 0), (1, 2): (100, 0, 0)}
    rated = rate(counts_of(results, 3), None, generator())
    assert np.isfinite(rated.ratings).all() and rated.ratings.max() < ANCHOR_RATING + 3000
    assert (np.diff(rated.ratings) < -400).all()
    more = {pair: (10_000, 0, 0) for pair in results}
    assert np.ptp(rate(counts_of(more, 3), None, generator()).ratings) > np.ptp(rated.ratings)


def test_the_anchor_has_its_rating_in_all_resamples() -> None:
    counts = counts_of({(0, 1): (10, 5, 5), (0, 2): (12, 3, 5), (1, 2): (9, 2, 9)}, 3)
    rated = rate(counts, 1, generator())
    assert rated.ratings[1] == rated.low[1] == rated.high[1] == ANCHOR_RATING
    assert (rated.low[[0, 2]] < rated.ratings[[0, 2]]).all()
    assert (rated.ratings[[0, 2]] < rated.high[[0, 2]]).all()
    free = rate(counts, None, generator()).ratings
    np.testing.assert_allclose(rated.ratings - rated.ratings[0], free - free[0], atol=1e-6)


def test_intervals_cover_the_true_ratings() -> None:
    rng = generator()
    true = np.array([0.0, 0.5, 1.0])
    win = 1.0 / (1.0 + np.exp(true[None, :] - true[:, None]))
    shares = np.stack([win, np.zeros_like(win), 1.0 - win], axis=-1)
    covered = 0
    for _ in range(40):
        counts = rng.multinomial(40, shares)
        counts[np.arange(3), np.arange(3)] = 0
        rated = rate(counts, 0, rng)
        expected = ANCHOR_RATING + ELO_SCALE * true[2]
        covered += bool(rated.low[2] <= expected <= rated.high[2])
    assert 33 <= covered <= 40


def test_equal_policies_seldom_beat_each_other_in_the_fewest_matches_with_intervals() -> None:
    k, rng = 30, generator()
    for per_side, lowest, highest in ((MIN_PER_SIDE, 0.01, 0.045), (1, 0.25, 0.4)):
        counts = rng.multinomial(per_side, (0.35, 0.3, 0.35), size=(k, k))
        counts[np.arange(k), np.arange(k)] = 0
        beats = rate(counts, None, rng).scores_low > 0.0
        assert lowest < beats.sum() / (k * (k - 1)) < highest, per_side


def test_scores_are_of_the_row_against_the_column() -> None:
    counts = counts_of({(0, 1): (30, 10, 10)}, 2)
    counts[1, 0] = (0, 0, 50)  # policy 0 won all matches as yellow
    rated = rate(counts, None, generator())
    assert rated.scores.tolist() == [[0.0, 0.7], [-0.7, 0.0]]
    assert rated.scores_low[0, 1] < 0.7 < rated.scores_high[0, 1]
    np.testing.assert_allclose(rated.scores_low, -rated.scores_high.T)


def beats(*pairs: tuple[int, int], k: int) -> NDArray[np.bool_]:
    matrix = np.zeros((k, k), np.bool_)
    matrix[tuple(np.array(pairs).T)] = True
    return matrix


def test_cycles_are_found_once() -> None:
    assert cycles(beats((0, 1), (0, 2), (1, 2), k=3)) == []
    assert cycles(beats((0, 1), (1, 2), (2, 0), k=3)) == [(0, 1, 2)]
    assert cycles(beats((1, 0), (2, 1), (0, 2), (0, 3), k=4)) == [(0, 2, 1)]
    longer = ((3, 1), (1, 4), (4, 0), (0, 3))
    assert cycles(beats(*longer, k=5)) == [(0, 3, 1, 4)]
    both = beats((0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2), k=5)
    assert cycles(both) == [(0, 1, 2), (2, 3, 4)]


def test_cycles_in_words() -> None:
    assert in_words([]) == "none"
    assert in_words([("a", "b", "c"), ("c", "d", "e")]) == (
        "a beats b beats c beats a; c beats d beats e beats c"
    )

"""Tactics as arrays."""

import numpy as np
import pytest

from rsoccer.policies.tactics import Tactic, checked, rows_of

KNOWN = [Tactic("speed", 1.0, 0.1, 2.0), Tactic("gain", 10.0, 1.0, 30.0)]


def test_numbers_out_of_their_ranges_are_named() -> None:
    assert checked([0.1, 30.0], KNOWN).dtype == np.float32
    assert checked([[1.0, 2.0]] * 3, KNOWN).shape == (3, 2)
    for wrong, message in (
        ([1.0], r"expected 2 numbers, got shape \(1,\)"),
        ([1.0, 31.0], "expected gain from 1 to 30, got 31"),
        ([[1.0, 2.0], [np.nan, 2.0]], "expected speed from 0.1 to 2, got nan"),
        (np.ones((1, 1, 2)), "expected 2 numbers"),
    ):
        with pytest.raises(ValueError, match=f"tactics: {message}"):
            checked(wrong, KNOWN)


def test_matches_have_a_row_each() -> None:
    one, two = np.ones(2, np.float32), np.array([[1, 2], [3, 4]], np.float32)
    assert rows_of(one, 3).shape == (3, 2)
    np.testing.assert_array_equal(rows_of(two, 2), two)
    np.testing.assert_array_equal(rows_of(two, 1), two[:1])
    with pytest.raises(ValueError, match="tactics: expected a row for each of 3 matches, got 2"):
        rows_of(two, 3)

"""Settings of the opponents."""

from __future__ import annotations

from dataclasses import dataclass, field

from rsoccer.train.setting_types import Fraction, Shares, convert_fields, expect


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class OpponentSettings:
    """Opponents of the learners, by share of the matches.

    Where both teams learn, matches are shared by the current policy, past ones, and the fixed
    policies. Where one team learns the fixed policies, if there are any, play all matches in place
    of the task's own opponents.

    Raises:
        ValueError: a value of another type or outside its range, or shares whose sum is above 1.
    """

    solo_fraction: Fraction = 0.4
    """first part of the samples, with one learner per match"""
    latest_fraction: Fraction = 0.5
    """share of matches against the current policy"""
    past_fraction: Fraction = 0.35
    """share of matches against frozen past policies"""
    fixed: Shares = field(default_factory=dict)
    """policies with their shares in all other matches, else ou or the task's own"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self, "opponents.")
        # Sorted, so that equal mixes give equal runs.
        object.__setattr__(self, "fixed", dict(sorted(self.fixed.items())))
        shares = self.fixed.values()
        expect("opponents.fixed", not shares or sum(shares) > 0, "shares above 0", self.fixed)
        total = self.latest_fraction + self.past_fraction
        words = "at most 1 together with opponents.past_fraction"
        expect("opponents.latest_fraction", total <= 1.0 + 1e-6, words, self.latest_fraction)

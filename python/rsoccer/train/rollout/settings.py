"""Settings of the rollouts."""

from __future__ import annotations

from dataclasses import dataclass

from rsoccer.train.setting_types import Count, Fraction, convert_fields


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class RolloutSettings:
    """Matches from which an update learns.

    Raises:
        ValueError: a value of another type or outside its range.
    """

    worlds: Count = 256
    """matches at once; more give steadier gradients"""
    horizon: Count = 16
    """decisions per match between two updates"""
    action_repeat: Count = 3
    """control steps (25 ms) for which a decision holds"""
    random_truncation: Fraction = 0.002
    """probability that a match is cut off after a decision"""
    normalize_observations: bool = True
    """scale by running mean and deviation; off in ablations"""
    normalize_rewards: bool = True
    """divide by the deviation of returns; off in ablations"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self, "rollout.")

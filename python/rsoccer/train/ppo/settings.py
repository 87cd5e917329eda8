"""Settings of PPO."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rsoccer.train.setting_types import Count, Fraction, Natural, Positive, convert_fields, expect

Schedule = Literal["linear", "adaptive"]
"""Names of schedules of the learning rate."""


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class PpoSettings:
    """Advantages and updates of PPO.

    Raises:
        ValueError: a value of another type or outside its range, or an adaptive learning rate with
            one epoch.
    """

    gamma: Fraction = 0.985
    """discount factor per control step"""
    final_gamma: Fraction | None = None
    """discount factor at the end of the run; None is gamma"""
    gae_lambda: Fraction = 0.9
    """1 trusts rewards alone, 0 the value network"""
    learning_rate: Positive = 2e-3
    """step size of Adam at the start"""
    learning_rate_schedule: Schedule = "linear"
    """falls to a tenth, or follows the KL divergence"""
    n_epochs: Count = 6
    """passes over a batch, at most"""
    n_minibatches: Count = 8
    """minibatches in a pass"""
    mirror_augmentation: bool = False
    """learn from samples with left and right swapped, too"""
    bootstrap_time_limits: bool = True
    """count the value after time limits; off in ablations"""
    critic_warmup: Natural = 0
    """first updates, in which the value network alone learns"""
    overlap: bool = False
    """play the next rollout while a thread learns from the last one; for a GPU"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self, "ppo.")
        if self.final_gamma is not None:  # the horizon 1 / (1 - discount) has to be finite
            for name in ("gamma", "final_gamma"):
                value = getattr(self, name)
                expect(f"ppo.{name}", value < 1.0, "below 1 where ppo.final_gamma is set", value)
        if self.learning_rate_schedule == "adaptive":
            # An only pass is never cut short, so the rate would never fall.
            words = "at least 2 if ppo.learning_rate_schedule is adaptive"
            expect("ppo.n_epochs", self.n_epochs >= 2, words, self.n_epochs)

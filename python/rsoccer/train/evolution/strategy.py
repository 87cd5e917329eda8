"""The evolution strategy: draws around the present tactics, and steps to where more is scored."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Floats
from rsoccer.policies.tactics import Tactic

GREATEST_SCORE: Final = 3.0
"""Standard deviations beyond which a score counts no more: single matches are luck."""


@dataclass
class Strategy:
    """Present tactics, and the step that led to them."""

    known: Sequence[Tactic]
    """numbers of the script"""
    mean: Doubles
    """(tactics,) natural logarithm of the tactics, relative to those that were set by hand"""
    step: Doubles
    """(tactics,) mean gradient so far, in standard deviations of the score for one of the draws"""
    spread: float
    """standard deviation of the draws"""
    step_size: float
    """step along the gradient, in units of the spread"""
    momentum: float
    """share of the last gradients"""

    @classmethod
    def begin(
        cls,
        known: Sequence[Tactic],
        spread: float,
        step_size: float,
        momentum: float,
        first: Floats | None = None,
    ) -> Strategy:
        """Return the strategy before the first generation.

        Args:
            known: numbers of the script.
            spread: standard deviation of the draws.
            step_size: step along the gradient, in units of the spread.
            momentum: share of the last gradients.
            first: (tactics,) tactics to begin with; None for those that were set by hand.
        """
        defaults = _column(known, "default")
        mean = np.zeros(len(known)) if first is None else np.log(first / defaults)
        return cls(known, mean, np.zeros(len(known)), spread, step_size, momentum)

    def draw(self, pairs: int, rng: np.random.Generator) -> Doubles:
        """Return draws and their mirror images, (2 * pairs, tactics), in units of the spread.

        Args:
            pairs: number of draws.
            rng: random stream.
        """
        draws = rng.standard_normal((pairs, len(self.known)))
        return np.concatenate([draws, -draws])

    def tactics(self, draws: Doubles | None = None) -> Doubles:
        """Return tactics, each number in its range.

        Args:
            draws: (n, tactics) draws; None for the present tactics.

        Returns:
            (n, tactics), or (tactics,) without draws.
        """
        logarithms = self.mean if draws is None else self.mean + self.spread * draws
        tactics = _column(self.known, "default") * np.exp(logarithms)
        least, most = (_column(self.known, name) for name in ("least", "most"))
        found: Doubles = np.clip(tactics, least, most)
        return found

    def learn(self, draws: Doubles, scores: Doubles) -> None:
        """Step to where more is scored.

        Args:
            draws: (n, tactics) draws.
            scores: (n,) what they scored, `standardized`.
        """
        gradient = (draws * scores[:, None]).mean(axis=0)
        self.step = self.momentum * self.step + (1.0 - self.momentum) * gradient
        mean = self.mean + self.spread * self.step_size * self.step
        # A number at the end of its range stays there, so that it can come back at once.
        low, high = (
            np.log(_column(self.known, name) / _column(self.known, "default"))
            for name in ("least", "most")
        )
        self.mean = np.clip(mean, low, high)


def _column(known: Sequence[Tactic], name: str) -> Doubles:
    """Default, least or greatest values, (tactics,)."""
    return np.array([getattr(tactic, name) for tactic in known])


def standardized(scores: Doubles) -> Doubles:
    """Return scores with mean 0 and standard deviation 1; zeros if all are equal.

    Args:
        scores: (n,) scores of matches of one kind.
    """
    deviation = float(scores.std())
    if deviation == 0.0:
        return np.zeros_like(scores)
    found: Doubles = np.clip((scores - scores.mean()) / deviation, -GREATEST_SCORE, GREATEST_SCORE)
    return found

"""Slots of frozen past policies: the choice of opponents, and of the slot that is replaced.

The trainer's pool and RLlib's league both use it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from rsoccer.arrays import Array, Doubles

EVEN_SHARE = 0.2
"""Share of the matches against past policies in which all of them are equally likely."""
RATE = 0.05
"""Weight of one match in a win rate, an exponential mean: that of the last 20 matches or so."""
EQUAL = 0.5
"""Win rate against a policy that was just frozen: it is the one that learns."""


@dataclass
class PoolSlots:
    """Ages of the past policies in a pool of limited size, and the win rates against them.

    Past policies are drawn by prioritized fictitious self-play (PFSP, Vinyals et al. 2019): those
    that the learner beats seldom are drawn often.

    Example:
        >>> slots = PoolSlots(size=3)
        >>> [slots.take(update) for update in (10, 20, 30, 40, 50)]
        [0, 1, 2, 1, 2]
        >>> slots.frozen_at
        [10, 40, 50]
        >>> slots.record([0] * 40, [1.0] * 40)
        >>> slots.shares().round(2).tolist()
        [0.11, 0.44, 0.44]
    """

    size: int
    """Largest number of past policies."""
    frozen_at: list[int] = field(default_factory=list)
    """Number of updates after which each past policy was frozen."""
    win_rates: list[float] = field(default_factory=list)
    """Exponential mean of the learner's results against each past policy: 1 for a win, 0.5 for a
    draw, 0 for a loss."""

    def take(self, update: int) -> int:
        """Return the slot of a new past policy, and record its age.

        A full pool evicts the one closest in age to its neighbors. The ages in the pool thus stay
        spread over the whole run.

        Args:
            update: number of updates that the policy was trained for.
        """
        if len(self.frozen_at) < self.size:
            self.frozen_at.append(update)
            self.win_rates.append(EQUAL)
            return len(self.frozen_at) - 1
        slot = self._most_crowded()
        self.frozen_at[slot] = update
        self.win_rates[slot] = EQUAL
        return slot

    def record(self, slots: ArrayLike, scores: ArrayLike) -> None:
        """Update the win rates with the results of matches against past policies, in order.

        Args:
            slots: (k,) slots of the opponents.
            scores: (k,) scores of the learner: positive for a win, 0 for a draw.
        """
        results = (np.sign(scores) + 1.0) / 2.0
        for slot, result in zip(np.asarray(slots).tolist(), results.tolist(), strict=True):
            self.win_rates[slot] += RATE * (result - self.win_rates[slot])

    def record_mean(self, slot: int, result: float, matches: float) -> None:
        """Update a win rate with several matches whose order is unknown.

        The matches together weigh as much as one after the other.

        Args:
            slot: slot of the opponent.
            result: mean result of the learner: 1 for a win, 0.5 for a draw, 0 for a loss.
            matches: number of matches.
        """
        weight = 1.0 - (1.0 - RATE) ** matches
        self.win_rates[slot] += weight * (result - self.win_rates[slot])

    def shares(self) -> Doubles:
        """Return the probability of each past policy in the next draw, (slots,), with sum 1.

        The probability is proportional to 1 - win rate. In a share of `EVEN_SHARE` of the draws all
        past policies are equally likely, so that none is forgotten.
        """
        weights = 1.0 - np.clip(self.win_rates, 0.0, 1.0)
        even = np.full(len(weights), 1.0 / len(weights))
        total = weights.sum()
        hard = weights / total if total > 0.0 else even
        shares: Doubles = EVEN_SHARE * even + (1.0 - EVEN_SHARE) * hard
        return shares

    def _most_crowded(self) -> int:
        """Slot whose removal leaves the smallest gap between the ages of its neighbors."""
        order = np.argsort(self.frozen_at)
        if len(order) < 3:
            return int(order[0])
        updates = np.array(self.frozen_at)[order]
        return int(order[1 + np.argmin(updates[2:] - updates[:-2])])


def draw(uniform: Array, shares: Sequence[float] | Doubles) -> Array:
    """Return the indices of n draws from a discrete distribution, (n,).

    Args:
        uniform: (n,) random numbers from 0 to 1.
        shares: (k,) probabilities with sum 1; an index with probability 0 is never drawn.
    """
    bounds = np.cumsum(shares)
    last = np.flatnonzero(np.asarray(shares) > 0.0)[-1]  # a uniform number may round to 1
    indices: Array = np.minimum(np.searchsorted(bounds, uniform, side="right"), last)
    return indices

"""Slots of frozen past policies: the choice of opponents, and of the slot that is replaced.

The trainer's pool and RLlib's league both use it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rsoccer.arrays import Array

OU, LATEST, PAST = 0, 1, 2
"""Codes of opponents; the past policy in slot `k` has code `PAST + k`."""


@dataclass
class PoolSlots:
    """Ages of the past policies in a pool of limited size.

    Example:
        >>> slots = PoolSlots(size=3)
        >>> [slots.take(update) for update in (10, 20, 30, 40, 50)]
        [0, 1, 2, 1, 2]
        >>> slots.frozen_at
        [10, 40, 50]
    """

    size: int
    """Largest number of past policies."""
    frozen_at: list[int] = field(default_factory=list)
    """Number of updates after which each past policy was frozen."""

    def take(self, update: int) -> int:
        """Return the slot of a new past policy, and record its age.

        A full pool evicts the one closest in age to its neighbours. The ages in the pool thus stay
        spread over the whole run.

        Args:
            update: number of updates that the policy was trained for.
        """
        if len(self.frozen_at) < self.size:
            self.frozen_at.append(update)
            return len(self.frozen_at) - 1
        slot = self._most_crowded()
        self.frozen_at[slot] = update
        return slot

    def _most_crowded(self) -> int:
        """Slot whose removal leaves the smallest gap between the ages of its neighbours."""
        order = np.argsort(self.frozen_at)
        if len(order) < 3:
            return int(order[0])
        updates = np.array(self.frozen_at)[order]
        return int(order[1 + np.argmin(updates[2:] - updates[:-2])])


def choose_opponents(uniform: Array, slot: Array, fractions: Mapping[str, float]) -> Array:
    """Return the codes of opponents for n episodes, (n,).

    Args:
        uniform: (n,) random numbers from 0 to 1, which select the kind.
        slot: (n,) slots of past policies.
        fractions: shares of the episodes, 0 to 1: "ou" for the `ou` policy, "latest" for the
            current policy; the others have a past one.
    """
    is_ou = uniform < fractions["ou"]
    is_ou_or_latest = uniform < fractions["ou"] + fractions["latest"]
    return np.where(is_ou, OU, np.where(is_ou_or_latest, LATEST, PAST + slot))

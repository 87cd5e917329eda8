"""Numbers that a log identifies, with intervals, as a table and as JSON."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Estimate:
    """A number with its interval of 95%."""

    name: str
    """Name, such as "latency"."""
    unit: str
    """Unit, such as "s"."""
    low: float
    """Lower end of the interval."""
    value: float
    """Estimated number."""
    high: float
    """Upper end of the interval."""
    hint: str = ""
    """Reason why it is not identified; the numbers are NaN then."""

    @classmethod
    def missing(cls, name: str, unit: str, excited_by: str) -> Estimate:
        """Return a number that a log does not identify.

        Args:
            name: its name.
            unit: its unit.
            excited_by: what would show it.
        """
        return cls(name, unit, math.nan, math.nan, math.nan, f"needs {excited_by}")

    @property
    def is_identified(self) -> bool:
        """True if the log identifies it."""
        return not self.hint

"""Checks: a measured number, its expected value and a tolerance."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isnan
from typing import SupportsFloat

CLOSED_FORM = "closed form"


@dataclass(frozen=True)
class Tolerance:
    """Allowed deviation: a share of the expected value if `relative`, else in the value's unit."""

    value: float
    relative: bool = False

    def __str__(self) -> str:
        if self.value == 0.0:
            return "exact"
        return f"{100 * self.value:g}%" if self.relative else f"{self.value:g}"


def percent(value: float) -> Tolerance:
    """Return a tolerance of `value` percent of the expected value."""
    return Tolerance(value / 100, relative=True)


def absolute(value: float) -> Tolerance:
    """Return a tolerance of `value` in the unit of the measurement."""
    return Tolerance(value)


EXACT = Tolerance(0.0)


@dataclass(frozen=True)
class Check:
    """One measured number with its expected value, tolerance and source."""

    topic: str
    quantity: str
    case: str
    expected: float
    measured: float
    unit: str
    tolerance: Tolerance
    source: str

    @property
    def error(self) -> float:
        """Deviation: a share of the expected value if the tolerance is relative, else in `unit`."""
        error = abs(self.measured - self.expected)
        if not self.tolerance.relative or error == 0.0:
            return error
        return error / abs(self.expected) if self.expected else float("inf")

    @property
    def tolerance_used(self) -> float:
        """Deviation as a share of the tolerance; above 1 the check fails."""
        if isnan(self.error):
            return float("inf")
        if self.tolerance.value == 0.0:
            return 0.0 if self.error == 0.0 else float("inf")
        return self.error / self.tolerance.value

    @property
    def passed(self) -> bool:
        """True if the deviation is within the tolerance."""
        return self.tolerance_used <= 1.0

    def __str__(self) -> str:
        return (
            f"{self.topic}, {self.quantity}, {self.case}: {self.measured:.6g} {self.unit}, "
            f"expected {self.expected:.6g} ± {self.tolerance} ({self.source})"
        )


@dataclass(frozen=True)
class Criterion:
    """Acceptance criterion: the quantity compared, its unit, tolerance and source of expectation.

    Calling it with a case, the expected and the measured value returns a `Check`.
    """

    topic: str
    quantity: str
    unit: str
    tolerance: Tolerance
    source: str = CLOSED_FORM

    def __call__(self, case: str, expected: SupportsFloat, measured: SupportsFloat) -> Check:
        """Return the check of one case."""
        return Check(
            self.topic,
            self.quantity,
            case,
            float(expected),
            float(measured),
            self.unit,
            self.tolerance,
            self.source,
        )


Checks = Iterator[Check]

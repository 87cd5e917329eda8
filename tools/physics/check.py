"""A measurement beside what it should be."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isnan
from typing import SupportsFloat

CLOSED_FORM = "closed form"


@dataclass(frozen=True)
class Tolerance:
    """How far a measurement may be off: by a share of what is expected, or by so much."""

    value: float
    relative: bool = False

    def __str__(self) -> str:
        if self.value == 0.0:
            return "exact"
        return f"{100 * self.value:g}%" if self.relative else f"{self.value:g}"


def percent(value: float) -> Tolerance:
    """Off by at most so many hundredths of what is expected."""
    return Tolerance(value / 100, relative=True)


def within(value: float) -> Tolerance:
    """Off by at most so much, in the unit of the measurement."""
    return Tolerance(value)


EXACT = Tolerance(0.0)


@dataclass(frozen=True)
class Check:
    """One number: what it should be, who says so, and what the simulator does."""

    topic: str
    what: str
    case: str
    reference: float
    measured: float
    unit: str
    tolerance: Tolerance
    source: str

    @property
    def error(self) -> float:
        """How far off it is: a share of the reference, or in its unit."""
        error = abs(self.measured - self.reference)
        if not self.tolerance.relative or error == 0.0:
            return error
        return error / abs(self.reference) if self.reference else float("inf")

    @property
    def used(self) -> float:
        """Share of the tolerance that the error takes up; above 1 it does not hold."""
        if isnan(self.error):
            return float("inf")
        if self.tolerance.value == 0.0:
            return 0.0 if self.error == 0.0 else float("inf")
        return self.error / self.tolerance.value

    @property
    def holds(self) -> bool:
        """Whether the simulator does what it should."""
        return self.used <= 1.0

    def __str__(self) -> str:
        return (
            f"{self.topic}, {self.what}, {self.case}: {self.measured:.6g} {self.unit}, "
            f"expected {self.reference:.6g} ± {self.tolerance} ({self.source})"
        )


@dataclass(frozen=True)
class Line:
    """A line of the acceptance: what is compared, in what unit, how closely, with whose number."""

    topic: str
    what: str
    unit: str
    tolerance: Tolerance
    source: str = CLOSED_FORM

    def __call__(self, case: str, reference: SupportsFloat, measured: SupportsFloat) -> Check:
        """The check of one case."""
        return Check(
            self.topic,
            self.what,
            case,
            float(reference),
            float(measured),
            self.unit,
            self.tolerance,
            self.source,
        )


Checks = Iterator[Check]

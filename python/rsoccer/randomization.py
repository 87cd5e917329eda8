"""Variation of numbers between worlds: each episode draws its own, and keeps them to its end.

| name | meaning of the values |
| --- | --- |
| `ball.` and a name of `BALL_PARAMETERS` | the number itself, in the units of `BallModel` |
| `robot.` and a name of `ROBOT_PARAMETERS` | a factor on each robot's own number |
| `sensing.` and a number of `Sensing` | the number itself |

A match has one ball, but robots of several models; so numbers of the ball are values, and those of
robots are factors.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import Any, Final, TypeAlias

import numpy as np

from rsoccer._core import (
    BALL_PARAMETERS,
    ROBOT_PARAMETERS,
    SENSING_NUMBERS,
    Sensing,
    SimConfig,
)
from rsoccer.arrays import Floats
from rsoccer.rng import WorldRng

Range: TypeAlias = float | Sequence[float | str]
"""A distribution: `(low, high)` or `("uniform", low, high)`, `("log_uniform", low, high)`,
`("normal", mean, deviation)` within three deviations, or one number for a fixed value."""
Ranges: TypeAlias = Mapping[str, Range]
"""Distributions by name."""

_KINDS: Final = ("uniform", "log_uniform", "normal")
_BALL_NUMBERS: Final = {"hop": "vertical_restitution"}
"""Number of the ball's model that a parameter scales, where its name differs."""
_WHOLE: Final = ("cameras_along", "cameras_across")
"""Numbers of `Sensing` that are whole."""
_OF_BOTH: Final = {
    "position_noise": ("ball_position_noise", "robot_position_noise"),
    "missing": ("missing_balls", "missing_robots"),
}
_NUMBERS: Final = {
    "ball": BALL_PARAMETERS,
    "robot": ROBOT_PARAMETERS,
    "sensing": (*SENSING_NUMBERS, *_OF_BOTH),
}
"""Names by the part before the point."""


@dataclass(frozen=True)
class Distribution:
    """A distribution of one number."""

    kind: str
    """"uniform", "log_uniform" or "normal"."""
    first: float
    """Lower bound, or mean."""
    second: float
    """Upper bound, or standard deviation."""
    is_whole: bool = False
    """True for whole numbers alone: the nearest ones; all from the lower to the upper bound are
    equally likely if the kind is uniform."""

    @classmethod
    def of(cls, name: str, value: Range) -> Distribution:
        """Return the distribution that a value of `randomization` describes.

        Args:
            name: name of the number, for errors.
            value: the description.

        Raises:
            TypeError: another type.
            ValueError: an unknown kind, bounds in the wrong order, or numbers that are not finite.
        """
        parts: list[Any] = [value, value] if isinstance(value, Real) else _listed(name, value)
        kind = parts.pop(0) if parts and isinstance(parts[0], str) else "uniform"
        if kind not in _KINDS:
            raise ValueError(f"randomization[{name!r}]: expected one of {_KINDS}, got {kind!r}")
        if len(parts) != 2 or not all(_is_number(part) for part in parts):
            raise ValueError(f"randomization[{name!r}]: expected two finite numbers, got {value!r}")
        first, second = map(float, parts)
        ordered = second >= 0.0 if kind == "normal" else second >= first
        if not ordered or (kind == "log_uniform" and first <= 0.0):
            bounds = "a deviation of at least 0" if kind == "normal" else "low <= high"
            above = ", above 0" if kind == "log_uniform" else ""
            raise ValueError(f"randomization[{name!r}]: expected {bounds}{above}, got {value!r}")
        return cls(kind, first, second)

    @property
    def bounds(self) -> tuple[float, float]:
        """The lowest and the highest value."""
        if self.kind == "normal":
            return self.first - 3.0 * self.second, self.first + 3.0 * self.second
        return self.first, self.second

    def scaled(self, factor: float) -> Distribution:
        """Return the distribution of the number times a factor.

        Args:
            factor: the factor, above 0.
        """
        return Distribution(self.kind, self.first * factor, self.second * factor)

    def draw(self, rng: WorldRng, count: int) -> Floats:
        """Draw numbers.

        Args:
            rng: (k,) random streams.
            count: how many a world.

        Returns:
            (k, count) float32, within the bounds: a sum of floats may be a rounding beyond them,
            where the simulator would refuse the number in some episode.
        """
        low, high = map(np.float32, self.bounds)
        return np.clip(self._drawn(rng, count), low, high)

    def _drawn(self, rng: WorldRng, count: int) -> Floats:
        """Draw numbers, which may be a rounding beyond the bounds."""
        if self.is_whole:
            reach = 0.5 if self.kind == "uniform" else 0.0
            around = Distribution(self.kind, self.first - reach, self.second + reach)
            return np.rint(around._drawn(rng, count))
        if self.kind == "normal":
            deviation = np.clip(rng.normal((count,)), -3.0, 3.0)
            return np.float32(self.first) + np.float32(self.second) * deviation
        if self.kind == "log_uniform":
            drawn = rng.uniform(math.log(self.first), math.log(self.second), (count,))
            return np.exp(drawn, dtype=np.float32)
        return rng.uniform(self.first, self.second, (count,))


@dataclass(frozen=True)
class NumberRanges:
    """Distributions of some numbers of a row; the others are fixed."""

    base: Floats
    """(size,) the row without variation."""
    drawn: tuple[tuple[tuple[int, ...], Distribution], ...]
    """Columns, and the distribution from which each of them draws a number."""

    def draw(self, rng: WorldRng) -> Floats:
        """Draw rows.

        Args:
            rng: (k,) random streams.

        Returns:
            (k, size) float32.
        """
        rows = np.repeat(self.base[None], len(rng), axis=0)
        for columns, distribution in self.drawn:
            rows[:, columns] = distribution.draw(rng, len(columns))
        return rows


@dataclass(frozen=True)
class Randomization:
    """Variation of the numbers of some matches."""

    parameters: NumberRanges | None
    """Factors on the models' numbers, as `Simulator.place` takes them."""
    sensing: NumberRanges | None
    """Numbers of senses, as `Simulator.begin_senses` takes them."""

    @classmethod
    def of(cls, ranges: Ranges | None, config: SimConfig, sensing: Sensing | None) -> Randomization:
        """Return the variation that distributions by name describe.

        Args:
            ranges: distributions by name; None for no variation.
            config: the models.
            sensing: the senses; None if robots know the true state.

        Raises:
            TypeError: no mapping, or a distribution of another type.
            ValueError: an unknown name, a distribution that is none, or values out of range.
        """
        if ranges is None:
            return cls(None, None)
        check(ranges)
        parameters: list[tuple[tuple[int, ...], Distribution]] = []
        numbers: list[tuple[tuple[int, ...], Distribution]] = []
        # By name, so that equal mappings draw equally; one noise of both bodies before that of one.
        for name in sorted(ranges, key=lambda name: (name.partition(".")[2] not in _OF_BOTH, name)):
            distribution = Distribution.of(name, ranges[name])
            owner, _, number = name.partition(".")
            if owner == "ball":
                parameters.append(_of_ball(name, number, distribution, config))
            elif owner == "robot":
                parameters.append(_of_robots(name, number, distribution, config))
            else:
                both = _OF_BOTH.get(number, (number,))
                numbers += [_of_senses(each, distribution, sensing or Sensing()) for each in both]
        ones = np.ones(config.parameters_size, np.float32)
        values = json.loads((sensing or Sensing()).to_json())
        base = np.array([values[name] for name in SENSING_NUMBERS], np.float32)
        return cls(
            NumberRanges(ones, tuple(parameters)) if parameters else None,
            NumberRanges(base, tuple(numbers)) if numbers else None,
        )


def check(ranges: Ranges) -> None:
    """Check names and distributions, as far as they depend on no models.

    Args:
        ranges: distributions by name.

    Raises:
        TypeError: no mapping, or a distribution of another type.
        ValueError: an unknown name, or a distribution that is none.
    """
    _check_names(ranges)
    for name, value in ranges.items():
        owner, _, number = name.partition(".")
        if number not in _NUMBERS.get(owner, ()):
            raise ValueError(f"randomization: expected {_known()}, got {name!r}")
        Distribution.of(name, value)


def written(ranges: Ranges) -> dict[str, Any]:
    """Return distributions as JSON values by name, which `Randomization.of` reads again.

    Args:
        ranges: distributions by name.
    """
    return {
        name: (
            [part if isinstance(part, str) else float(part) for part in value]
            if isinstance(value, Sequence)
            else float(value)
        )
        for name, value in ranges.items()
    }


def describe(ranges: Ranges) -> str:
    """Return distributions in a line, such as "robot.mass 0.9 to 1.1".

    Args:
        ranges: distributions by name.
    """
    return ", ".join(f"{name} {_words(Distribution.of(name, v))}" for name, v in ranges.items())


def _words(distribution: Distribution) -> str:
    """A distribution in a few words."""
    first, second = f"{distribution.first:g}", f"{distribution.second:g}"
    if distribution.kind == "normal":
        return f"{first} with deviation {second}"
    if first == second:
        return first
    return f"{first} to {second}" + (" (log)" if distribution.kind == "log_uniform" else "")


def _check_names(ranges: object) -> None:
    """Refuse what has no distributions by name."""
    if not isinstance(ranges, Mapping):
        raise TypeError(f"randomization: expected distributions by name, got {ranges!r}")
    for name in ranges:
        if not isinstance(name, str):
            raise TypeError(f"randomization: expected names of numbers, got {name!r}")


def _listed(name: str, value: object) -> list[Any]:
    """The parts of a description."""
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise TypeError(
            f"randomization[{name!r}]: expected (low, high), (kind, number, number) or a number, "
            f"got {value!r}"
        )
    return list(value)


def _is_number(value: object) -> bool:
    """Whether a value is a number that floats can have, neither infinite nor NaN."""
    try:
        return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:
        return False


def _known() -> str:
    """All names, for errors."""
    return "one of " + ", ".join(
        f"{owner}.{number}" for owner, numbers in _NUMBERS.items() for number in numbers
    )


def _of_ball(
    name: str, number: str, distribution: Distribution, config: SimConfig
) -> tuple[tuple[int, ...], Distribution]:
    """Column and factors of a number of the ball."""
    attribute = _BALL_NUMBERS.get(number, number)
    value = getattr(config.ball, attribute)
    if value == 0.0:
        raise ValueError(f"randomization: {name} is 0 for the ball {config.ball.name!r}")
    high = distribution.bounds[1]
    if attribute.endswith("restitution") and high > 1.0:
        raise ValueError(f"randomization[{name!r}]: expected values of at most 1, got {high:.3g}")
    factors = distribution.scaled(1.0 / value)
    _check_factors(name, factors, value)
    return (BALL_PARAMETERS.index(number),), factors


def _of_robots(
    name: str, number: str, distribution: Distribution, config: SimConfig
) -> tuple[tuple[int, ...], Distribution]:
    """Columns and factors of a number of all robots."""
    _check_factors(name, distribution, 1.0)
    size, first = len(ROBOT_PARAMETERS), len(BALL_PARAMETERS) + ROBOT_PARAMETERS.index(number)
    return tuple(first + size * robot for robot in range(config.n_robots)), distribution


def _of_senses(
    number: str, distribution: Distribution, sensing: Sensing
) -> tuple[tuple[int, ...], Distribution]:
    """Column and values of a number of senses."""
    distribution = replace(distribution, is_whole=number in _WHOLE)
    for bound in distribution.bounds:
        Sensing.from_json(json.dumps({**json.loads(sensing.to_json()), number: bound}))
    return (SENSING_NUMBERS.index(number),), distribution


def _check_factors(name: str, factors: Distribution, unit: float) -> None:
    """Refuse factors that the simulator would refuse in some episode."""
    low, high = factors.bounds
    if low < 1e-3 or high > 1e3:
        expected = f"values from {1e-3 * unit:.3g} to {1e3 * unit:.3g}"
        raise ValueError(
            f"randomization[{name!r}]: expected {expected}, got {low * unit:.3g} to "
            f"{high * unit:.3g}"
        )

"""Numbers and switches of the rules of a whole match."""

import json
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import referee_preset, referee_rules, referee_values

PRESETS: Final = ("ssl_2026_a", "ssl_2026_b", "vsss_3v3", "vsss_5v5")
"""Names of the presets."""
CHOICES: Final = {
    "clock": ("stopped", "running"),
    "placement": ("teleport", "robots"),
    "half_end": ("at_once", "next_stop"),
}
"""Values of the choices by name."""
LEAGUES: Final = ("ssl", "vsss")
"""Names of the leagues."""
RULES: Final = {league: tuple(name for name, *_ in referee_rules(league)) for league in LEAGUES}
"""Names of each league's rules."""
_COUNTS: Final = frozenset(name for name, unit, _ in referee_values() if unit == "1")
_LARGEST: Final = float(np.finfo(np.float32).max)
_EITHER: Final = frozenset({"early_end_goals", "early_end_lead"})
"""Numbers that matches of both leagues can have, though one league has none."""
_OTHERS: Final = {"ssl": {"placement_error"}, "vsss": {"placement"}}
"""Values that only the other league has, though presets do not show it."""


def _foreign_names() -> dict[str, frozenset[str]]:
    """Names of the values that only the other league has: the presets of the league have none."""
    used: dict[str, set[str]] = {league: set() for league in LEAGUES}
    for preset in PRESETS:
        values = json.loads(referee_preset(preset))
        used[values["league"]] |= {name for name, value in values.items() if value}
    ssl, vsss = (used[league] for league in LEAGUES)
    only = {"ssl": vsss - ssl, "vsss": ssl - vsss}
    return {league: frozenset(only[league] - _EITHER | _OTHERS[league]) for league in LEAGUES}


_FOREIGN: Final = _foreign_names()


class RefereeConfig(Mapping[str, Any]):
    """Numbers and switches of the rules of a whole match, from a preset and replaced values.

    The rules of the leagues are the presets "ssl_2026_a" and "ssl_2026_b" (divisions A and B of
    the Small Size League) and "vsss_3v3" and "vsss_5v5". The page of the referee's rules lists all
    names with units and sources. Names are attributes too. `off` names rules that are not judged,
    such as "BOT_PUSHED_BOT".

    Example:
        >>> from rsoccer.referee import RefereeConfig
        >>> rules = RefereeConfig("ssl_2026_b", half_seconds=60, off=["BOT_PUSHED_BOT"])
        >>> rules.dribble_distance
        1.0
    """

    def __init__(self, preset: str, /, **values: Any) -> None:  # noqa: ANN401  (checked here)
        """Take a preset, and replace some of its values.

        Args:
            preset: name of a preset.
            **values: values that replace those of the preset: numbers, names of choices, or for
                `off` a list of names of rules.

        Raises:
            TypeError: a value of another type.
            ValueError: an unknown preset, name or choice; the other league, or a value or rule that
                only it has; a number that is not finite or below 0, or a count that is not whole.
        """
        if preset not in PRESETS:
            raise ValueError(f"preset: expected one of {PRESETS}, got {preset!r}")
        self.preset = preset
        self._values: dict[str, Any] = json.loads(referee_preset(preset))
        for name, value in values.items():
            self._replace(name, value)

    def _replace(self, name: str, value: object) -> None:
        """Replace a value by one that the league's rules can have."""
        league = self._values["league"]
        foreign = _FOREIGN[league]
        if name in self._values:
            value = _like(name, value, self._values[name], league)
            if name not in foreign or value == self._values[name]:
                self._values[name] = value
                return
        known = ", ".join(each for each in self._values if each not in foreign)
        raise ValueError(f"referee: expected one of {known}, got {name!r}")

    def replaced(self, **values: Any) -> "RefereeConfig":  # noqa: ANN401  (checked here)
        """Return a configuration with some values replaced.

        Args:
            **values: as for a new one.
        """
        return RefereeConfig(self.preset, **{**self._values, **values})

    def to_json(self) -> str:
        """Return all values as JSON."""
        return json.dumps(self._values)

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401  (a value)
        if not name.startswith("_") and name in self._values:
            return self._values[name]
        raise AttributeError(f"RefereeConfig has no {name!r}")

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401  (a value)
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        values = json.loads(referee_preset(self.preset))
        changed = [f"{k}={v!r}" for k, v in self._values.items() if v != values[k]]
        return f"RefereeConfig({', '.join([repr(self.preset), *changed])})"

    def __hash__(self) -> int:
        return hash(self.to_json())


def _like(name: str, value: object, old: object, league: str) -> object:
    """A value of the kind of the one that it replaces."""
    if isinstance(old, bool):
        return checks.boolean(name, value)
    if isinstance(old, float):
        return _number(name, value)
    if isinstance(old, list):
        return _rules(name, value, RULES[league])
    choices = CHOICES.get(name, (old,))
    if value not in choices:
        raise ValueError(f"{name}: expected one of {choices}, got {value!r}")
    return value


def _rules(name: str, value: object, known: tuple[str, ...]) -> list[str]:
    """A list of names of a league's rules."""
    if not isinstance(value, list | tuple):
        raise TypeError(f"{name}: expected a list of names of rules, got {value!r}")
    for part in value:
        if part not in known:
            raise ValueError(f"{name}: expected names of {', '.join(known)}, got {part!r}")
    return list(value)


def _number(name: str, value: object) -> float:
    """A number as the rules have them: finite, at least 0, of counts a whole one."""
    number = checks.number(name, value)
    if not 0.0 <= number <= _LARGEST:
        raise ValueError(f"{name}: expected a finite number, at least 0, got {value}")
    if name in _COUNTS and not number.is_integer():
        raise ValueError(f"{name}: expected a whole number, got {value}")
    if name == "halves" and number not in (1.0, 2.0):
        raise ValueError(f"{name}: expected 1 or 2, got {value}")
    return number

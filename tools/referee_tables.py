"""Tables of docs/referee.md: the rules of both leagues, and the values of their presets."""

from typing import Final

from benches.markdown import table
from rsoccer._core import referee_rules, referee_values
from rsoccer.rules.referee_config import CHOICES, PRESETS, RefereeConfig

SOURCES: Final = {
    "ssl": "https://github.com/RoboCup-SSL/ssl-rules",
    "vsss": "https://github.com/VSSSLeague/VSSReferee",
}
"""Repositories of the rules by league."""


def ssl_rules() -> str:
    """Return the table of the rules of SSL, in the order in which they are judged."""
    return _rules("ssl")


def vsss_rules() -> str:
    """Return the table of the rules of VSSS, in the order in which they are judged."""
    return _rules("vsss")


def _rules(league: str) -> str:
    """The table of the rules of a league."""
    rows = [
        (f"`{name}`", summary, source, f"`{function.replace(' ', '')}`")
        for name, source, summary, function in referee_rules(league)
    ]
    return table(
        ("rule", "meaning", f"paragraph of the [source]({SOURCES[league]})", "function"), rows
    )


def choices() -> str:
    """Return the table of the choices: names, meanings, and the value in each preset."""
    rows = [
        (f"`{name}`", meaning, _options(name), *_cells(name))
        for name, unit, meaning in referee_values()
        if not unit
    ]
    return table(("choice", "meaning", "values", *_titles()), rows)


def numbers() -> str:
    """Return the table of the numbers: names, meanings, units, and the value in each preset."""
    rows = [
        (f"`{name}`", meaning, unit, *_cells(name))
        for name, unit, meaning in referee_values()
        if unit
    ]
    return table(("number", "meaning", "unit", *_titles()), rows)


def _titles() -> tuple[str, ...]:
    """Names of the presets as titles of columns."""
    return tuple(f"`{preset}`" for preset in PRESETS)


def _options(name: str) -> str:
    """Values of a choice; those of switches and lists follow from their meanings."""
    return ", ".join(f'`"{value}"`' for value in CHOICES.get(name, ()))


def _cells(name: str) -> tuple[str, ...]:
    """The value in each preset."""
    return tuple(_text(RefereeConfig(preset)[name]) for preset in PRESETS)


def _text(value: object) -> str:
    """A value as text: "-" for an empty list."""
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, float):
        return f"{value:g}"
    return f"`{value}`" if value else "-"

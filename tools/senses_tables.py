"""Tables of docs/senses.md: the numbers of senses and their presets, and names of randomization."""

import json
from typing import Final

from benches import forecast
from benches.markdown import table
from rsoccer import BALL_PARAMETERS, ROBOT_PARAMETERS, Sensing

PRESETS: Final = tuple(name for name in Sensing.PRESETS if name != "none")
"""Presets with an effect."""


def numbers() -> str:
    """Return the table of all numbers: names, meanings, and the value in each preset."""
    presets = [json.loads(Sensing(name).to_json()) for name in PRESETS]
    names = [name for name in presets[0] if name != "name"]
    rows = [
        (f"`{name}`", _meaning(name), *(f"{preset[name]:.4g}" for preset in presets))
        for name in names
    ]
    return table(("number", "meaning", *(f"`{name}`" for name in PRESETS)), rows)


def _meaning(name: str) -> str:
    """Meaning, unit and range of a number, without the period."""
    meaning: str = getattr(Sensing, name).__doc__
    return meaning.removesuffix(".")


def forecasts() -> str:
    """Return the table of the scores with delays, without and with forecasts."""
    return forecast.report(json.loads(forecast.STORED.read_text()))


def randomization() -> str:
    """Return the table of the names that randomization takes."""
    rows = [
        ("value", ", ".join(f"`ball.{name}`" for name in BALL_PARAMETERS)),
        ("factor on each robot's own", ", ".join(f"`robot.{name}`" for name in ROBOT_PARAMETERS)),
        ("value", "`sensing.` and each number of the table above"),
    ]
    return table(("range of a", "names"), rows)

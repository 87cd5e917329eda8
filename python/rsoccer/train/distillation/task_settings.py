"""Recommended settings of a distillation by task: those of the policies `best:robust`.

Senses are those of a tournament, and numbers of robots and ball vary, by about what teams measure
of their own. In the VSSS league commands take up to 112.5 ms, which the policy does not know: a
history of 5 has the actions of the last two decisions of 75 ms, which are still on their way at the
longest delay. In the SSL the policy learns behind a forecast that knows the delay of its matches to
half a control step, and reads the newest observation alone. Without a forecast a ball at the
dribbler is lost, and with a history policies score no more (docs/robustness.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from rsoccer.registry import list_aliases

_ROBOTS: Final = {
    "robot.mass": [0.85, 1.15],
    "robot.acceleration": [0.85, 1.15],
    "robot.speed": [0.9, 1.1],
    "robot.traction": [0.85, 1.15],
}
_ROLLING: Final = {"SSL": [0.15, 0.35], "VSS": [0.1, 0.2]}
"""Rolling deceleration of the ball by league, m/s^2; the models have .26 and .14."""

_FORECAST: Final = {
    "sensing": "rc2021, forecast=1",
    "command_delays": [0.0, 0.025, 0.05],
    "history": 1,
}
"""Settings behind a forecast. With that of the frames the longest delay is 107.5 ms."""

DISTILL_SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {
    "VSS-v0": {"samples": 350_000},
    "VSSSelfPlay-v0": {"samples": 400_000},
    "SSLGoToBall-v0": {"samples": 300_000, **_FORECAST},
    "SSLContestedPossession-v0": {"samples": 1_200_000, **_FORECAST},
    "SSLStaticDefenders-v0": {"samples": 600_000, **_FORECAST},
    # Three times as many samples make it worse: 4.7 gates with the senses instead of 5.3.
    "SSLDribbling-v0": {"samples": 300_000, **_FORECAST},
    "SSLPassEnduranceMulti-v1": {"samples": 1_200_000, **_FORECAST},
}
"""Values of settings by name, by the name of the task."""


def recommended_settings(task: str) -> dict[str, Any]:
    """Return the recommended settings for a task.

    Args:
        task: a registered name or an alias, which has the settings of its task.
    """
    alias = list_aliases().get(task)
    if task not in DISTILL_SETTINGS and alias is not None:
        return recommended_settings(alias.task)
    rolling = {"ball.rolling_deceleration": _ROLLING[task[:3]]} if task[:3] in _ROLLING else {}
    return {"randomization": {**_ROBOTS, **rolling}, **DISTILL_SETTINGS.get(task, {})}

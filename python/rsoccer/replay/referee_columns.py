"""State of the referee in a replay file: steps of its columns, and checks of what is read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer.game import NOBODY, Command, Stage
from rsoccer.render.referee_state import COLUMNS
from rsoccer.replay.container import ReplayError

if TYPE_CHECKING:
    from rsoccer._core import SimConfig
    from rsoccer.arrays import Doubles

STEPS: Final = {
    "designated_position_x": 1e-3,
    "designated_position_y": 1e-3,
    "ball_distance": 1e-3,
}
"""Steps of columns, m; those of times are control steps, those of other numbers 1."""

_CODES: Final = {
    "command": set(Command),
    "next_command": {NOBODY, *Command},
    "kick": {NOBODY, *Command},
    "stage": set(Stage),
}


def names(config: SimConfig) -> tuple[str, ...]:
    """Return the names of all columns.

    Args:
        config: the configuration.
    """
    return (*COLUMNS, *(f"may_touch_{robot}" for robot in range(config.n_robots)))


def steps(config: SimConfig) -> list[float]:
    """Return the steps of all columns.

    Args:
        config: the configuration.
    """
    known = {**STEPS, "seconds_left": config.time_step}
    return [known.get(name, 1.0) for name in names(config)]


def check(values: Doubles) -> None:
    """Check the codes of commands and of parts of a match.

    Args:
        values: (f, column) values of all columns.

    Raises:
        ReplayError: a code that does not exist.
    """
    for name, codes in _CODES.items():
        found = set(np.rint(values[:, COLUMNS.index(name)]).tolist())
        if not found <= codes:
            raise ReplayError(f"referee: expected codes of {name}, got {min(found - codes):g}")

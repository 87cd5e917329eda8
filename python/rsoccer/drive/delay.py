"""The delay of the whole loop: from a command until vision shows what it does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, Forecaster, Sensing, SimConfig
from rsoccer.arrays import Doubles, Floats

CANDIDATES: Final = tuple(0.005 * step for step in range(61))
"""Delays that are tried, s: up to 0.3."""


class Recording(NamedTuple):
    """A movement of a robot from rest to rest."""

    times: Doubles
    """(k,) times of the frames, s."""
    rows: Floats
    """(k, row) what was seen."""
    sent: tuple[tuple[float, Floats], ...]
    """Times and commands (robots, command) that were sent, in order."""


def fitted_delay(
    config: SimConfig, recordings: Sequence[Recording], slot: int
) -> tuple[float, float]:
    """Return the delay with which the model of a robot moves as it was seen, and the gain.

    For each delay the physics run from the first row through the commands; the gain is the factor
    on the way that fits best.

    Args:
        config: field, ball and robots.
        recordings: movements, each shorter than 2 s.
        slot: index of the robot in a state row.

    Returns:
        Delay in s, one of `CANDIDATES`, and driven by commanded way.

    Raises:
        ValueError: no recording.
    """
    if not recordings:
        raise ValueError("recordings: expected some, got none")
    fits = [_fit(config, recordings, slot, delay) for delay in CANDIDATES]
    best = min(range(len(fits)), key=lambda index: fits[index][0])
    return CANDIDATES[best], fits[best][1]


def _fit(
    config: SimConfig, recordings: Sequence[Recording], slot: int, delay: float
) -> tuple[float, float]:
    """Squared error of a delay, and the gain."""
    seen, expected = [], []
    begin = len(BALL_COLUMNS) + slot * len(ROBOT_COLUMNS)
    place = slice(begin, begin + 2)
    model = config.with_sensing(Sensing(command_delay=delay))
    for times, rows, sent in recordings:
        forecaster = Forecaster(model)
        for time, commands in sent:
            forecaster.send(commands[None], np.array([time]))
        first, out = rows[:1], np.empty_like(rows[:1])
        for time, row in zip(times[1:], rows[1:], strict=True):
            forecaster.forecast(first, times[:1], np.array([time - delay]), out)
            seen.append(row[place] - first[0, place])
            expected.append(out[0, place] - first[0, place])
    ways, model_ways = np.array(seen, np.float64), np.array(expected, np.float64)
    power = float((model_ways**2).sum())
    gain = float((ways * model_ways).sum()) / power if power else 0.0
    return float(((ways - gain * model_ways) ** 2).sum()), gain

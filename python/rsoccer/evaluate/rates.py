"""Goals by the time in which the ball is in play, for tasks that stop play."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer.evaluate.episodes import Episodes
from rsoccer.evaluate.results import Interval, bootstrap_rate
from rsoccer.view import SIDES

MINUTES: Final = 10
"""Playing time that the goals are counted for."""
GOALS: Final = tuple(f"{side}_goals" for side in SIDES)
"""Metrics with the goals of each team."""
PLAYING_TIME: Final = "in_play"
"""Metric with the time in which the ball is in play, s."""


def goal_rates(episodes: Sequence[Episodes], rng: np.random.Generator) -> dict[str, Interval]:
    """Return the goals of the policy's team and of the other one in 10 minutes of playing time.

    Args:
        episodes: episodes of each side that the policy played, blue first.
        rng: draws the resamples of the intervals.

    Returns:
        Rates by "own" and "opponent"; empty for tasks without these metrics, and where the ball was
        out of play in a whole match.
    """
    if not {*GOALS, PLAYING_TIME} <= episodes[0].metrics.keys():
        return {}
    times = [part.metrics[PLAYING_TIME] / (60.0 * MINUTES) for part in episodes]
    if not all((time > 0.0).all() for time in times):
        return {}
    rates = {}
    for team, names in (("own", GOALS), ("opponent", GOALS[::-1])):
        goals = [part.metrics[name] for part, name in zip(episodes, names, strict=True)]
        pairs = [np.stack(pair, axis=1) for pair in zip(goals, times, strict=True)]
        rates[team] = bootstrap_rate(pairs, rng)
    return rates

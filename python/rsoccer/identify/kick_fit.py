"""Speeds and latencies of kicks: commanded ones, and the runs of the ball that they began."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer.identify.ball_fit import BallFit
from rsoccer.identify.least_squares import student
from rsoccer.identify.log import Log
from rsoccer.identify.results import Estimate

_SOON: Final = 1.0  # s after a command in which its kick happens: kickers charge
_LIMITED: Final = 0.92  # of the gain of slow kicks, below which fast ones are limited


def kick_estimates(log: Log, ball: BallFit) -> list[Estimate]:
    """Return gain, greatest speed and latency of kicks, identified or not.

    Args:
        log: the log.
        ball: the fitted ball.
    """
    kicks = _matched(log, ball)
    commanded = np.array([kick[0] for kick in kicks])
    speeds = np.array([kick[1] for kick in kicks])
    gains = speeds / commanded
    slow = gains[commanded <= np.median(commanded)] if len(gains) else gains
    limited = gains < _LIMITED * float(np.median(slow)) if len(gains) else np.zeros(0, np.bool_)
    return [
        _mean("kick_gain", "1", gains[~limited], "kicks from rest at several commanded speeds"),
        _mean("max_kick_speed", "m/s", speeds[limited], "kicks beyond the greatest speed"),
        _mean("kick_latency", "s", [kick[2] for kick in kicks], "kicks from rest"),
    ]


def _matched(log: Log, ball: BallFit) -> list[tuple[float, float, float]]:
    """Commanded and driven speeds (m/s) and latencies (s) of kicks that a run shows."""
    kicks = [ball.kick(index) for index in range(len(ball.runs))]
    seen = [kick for kick in kicks if kick is not None]
    found = []
    for commands in log.commands.values():
        on = commands.kicks > 0.0
        begins = np.flatnonzero(on & ~np.concatenate([[False], on[:-1]]))
        for begin in begins.tolist():
            sent = float(commands.times[begin])
            after = [kick for kick in seen if 0.0 <= kick[1] - sent <= _SOON]
            if after:
                speed, time = min(after, key=lambda kick: kick[1])
                found.append((float(commands.kicks[begin]), speed, time - sent))
    return found


def _mean(name: str, unit: str, numbers: Sequence[float], excited_by: str) -> Estimate:
    """A mean with its interval by Student's t; two numbers or more."""
    count = len(numbers)
    if count < 2:
        return Estimate.missing(name, unit, f"two {excited_by}, or more")
    mean, deviation = float(np.mean(numbers)), float(np.std(numbers, ddof=1))
    half = float(student(count - 1)) * deviation / math.sqrt(count)
    return Estimate(name, unit, mean - half, mean, mean + half)

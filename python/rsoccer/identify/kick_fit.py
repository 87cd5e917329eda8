"""Speeds and latencies of kicks: commanded ones, and the runs of the ball that they began."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer.identify.ball_fit import BallFit
from rsoccer.identify.least_squares import student
from rsoccer.identify.log import Commands, Log
from rsoccer.identify.results import Estimate

_SOON: Final = 1.0  # s after a command in which its kick happens: kickers charge
_EARLY: Final = 0.03  # s by which a kick seems to come before its command, from rough speeds
_REACH: Final = 0.15  # m between the center of a robot and the ball that it kicks
_UNSEEN: Final = 0.25  # s without poses, after which nobody knows where a robot is
_CLOSE: Final = 0.02  # s: half an interval of a latency that may hold 0
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
    """Commanded and driven speeds (m/s) and latencies (s) of kicks that a run shows.

    A run is one kick, of the last command of the robot that was next to the ball.
    """
    kicks = [(ball.kick(index), run.place) for index, run in enumerate(ball.runs)]
    sent = {robot: _begins(commands) for robot, commands in log.commands.items()}
    found = []
    for kick, place in kicks:
        if kick is None:
            continue
        speed, time = kick
        begins = sent.get(_kicker(log, place, time), [])
        before = [begin for begin in begins if -_EARLY <= time - begin[0] <= _SOON]
        if before:
            begin = max(before)
            begins.remove(begin)
            found.append((begin[1], speed, time - begin[0]))
    return found


def _begins(commands: Commands) -> list[tuple[float, float]]:
    """Times (s) and speeds (m/s) with which kicks begin to be commanded."""
    on = commands.kicks > 0.0
    first = on & ~np.concatenate([[False], on[:-1]])
    return list(zip(commands.times[first].tolist(), commands.kicks[first].tolist(), strict=True))


def _kicker(log: Log, place: tuple[float, float], time: float) -> str:
    """Name of the robot that was next to a place at a time; empty if none could kick there."""
    near = {"": _REACH}
    for robot, track in log.poses.items():
        if not len(track) or np.abs(track.times - time).min() > _UNSEEN:
            continue
        x, y = (float(np.interp(time, track.times, axis)) for axis in track.positions.T)
        near[robot] = math.hypot(x - place[0], y - place[1])
    return min(near, key=lambda robot: near[robot])


def _mean(name: str, unit: str, numbers: Sequence[float], excited_by: str) -> Estimate:
    """A mean with its interval by Student's t; two numbers or more that agree."""
    count = len(numbers)
    if count < 2:
        return Estimate.missing(name, unit, f"two {excited_by}, or more")
    mean, deviation = float(np.mean(numbers)), float(np.std(numbers, ddof=1))
    half = float(student(count - 1)) * deviation / math.sqrt(count)
    low = mean - half
    if unit == "s" and half <= _CLOSE:
        # Without any latency, noise may leave it a little below 0.
        return Estimate(name, unit, max(low, 0.0), max(mean, 0.0), max(mean + half, 0.0))
    if low <= 0.0:
        return Estimate.missing(name, unit, f"more {excited_by}: {count} differ too much")
    return Estimate(name, unit, low, mean, mean + half)

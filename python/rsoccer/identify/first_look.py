"""Checks before a fit: clocks of commands and poses, and units and signs of commands."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles
from rsoccer.identify.log import Commands, Log, Track
from rsoccer.identify.windows import MAX_LATENCY

_GRID: Final = 0.01  # s
_HALF: Final = 3  # poses to each side of one whose velocity is measured
_LATE: Final = 0.3  # s left between two clocks, as accelerations add up to this to their lag
_EARLY: Final = 0.05  # s by which poses seem earlier than commands, from rough velocities
_STEADY: Final = 0.15  # s that a command has held before a robot drives as it says
_CARRIED: Final = 0.98  # share of the time that robots drive
_GAINS: Final = (0.12, 5.0)  # beyond them units are mixed up
_CLEAR: Final = 0.5  # correlation of commanded and seen speeds that is more than chance
_HINTS: Final = {
    np.pi / 180.0: "it looks like degrees per second",
    180.0 / np.pi: "headings look like degrees",
    1e-3: "it looks like millimeters per second",
    1e3: "positions look like millimeters",
    np.pi / 30.0: "it looks like revolutions per minute",
    1.0 / (2.0 * np.pi): "it looks like radians where turns are meant",
    2.0 * np.pi: "it looks like revolutions per second",
}


def lag(log: Log, model: RobotModel) -> float:
    """Return the time from commanded to seen speeds that makes them most alike, s.

    It is rough, to a few hundredths of a second: it contains half the time of accelerations.

    Args:
        log: the log.
        model: the robots, for commands of wheel speeds.

    Raises:
        ValueError: no robot has both commands and poses, or they have nothing in common.
    """
    robot = _longest(log)
    commands, track = log.commands[robot], log.poses[robot]
    sent_times = np.arange(commands.times[0], commands.times[-1] + 1.0, _GRID)
    sent = _speeds(_commanded(_held(commands, sent_times), model))
    middles, velocities = _driven(track)
    seen_times = np.arange(middles[0], middles[-1], _GRID)
    seen = np.column_stack([np.interp(seen_times, middles, x) for x in _speeds(velocities).T])
    size = 1 << int(np.ceil(np.log2(len(sent) + len(seen))))
    # Driving and turning count by themselves: one of them may be in another unit.
    likeness = _correlation(_scaled(sent), _scaled(seen), size)
    best = int(likeness.argmax())
    if likeness[best] < _CLEAR:
        raise ValueError(
            f"log: {robot} does not move as its commands say at any latency: expected velocities "
            "in the robot's own frame, or the speeds of its wheels, of the robot with that name"
        )
    steps = best if best < size // 2 else best - size
    return float(seen_times[0] - sent_times[0]) + steps * _GRID


def _scaled(speeds: Doubles) -> Doubles:
    """Speeds around their means, with a norm of 1; those that never change as 0."""
    centered = speeds - speeds.mean(axis=0)
    norms = np.linalg.norm(centered, axis=0)
    scaled: Doubles = centered / np.where(norms > 1e-9, norms, np.inf)
    return scaled


def _correlation(sent: Doubles, seen: Doubles, size: int) -> Doubles:
    """Mean correlation of the columns that change in both, by the lag of the second."""
    both = sent.any(axis=0) & seen.any(axis=0)
    first, second = (np.fft.rfft(each[:, both], size, axis=0) for each in (sent, seen))
    product = np.fft.irfft(second * np.conj(first), size, axis=0)
    mean: Doubles = product.sum(axis=1) / max(int(sent.any(axis=0).sum()), 1)
    return mean


def with_one_clock(log: Log, model: RobotModel, clocks: int) -> Log:
    """Return a log whose commands and poses are less than the greatest latency apart.

    Args:
        log: the log.
        model: the robots.
        clocks: 1 if commands and poses have the same clock, 2 if each has its own.

    Raises:
        ValueError: one clock by which poses come long before or after their commands.
    """
    late = lag(log, model)
    if clocks == 1:
        if not -_EARLY <= late <= MAX_LATENCY + 0.2:
            raise ValueError(
                f"time: poses follow commands after {late:.2f} s, expected 0 to {MAX_LATENCY:g} s; "
                "if each has a clock of its own, say so by clocks=2: the latency then stays unknown"
            )
        return log
    return shifted(log, late - _LATE)


def shifted(log: Log, shift: float) -> Log:
    """Return a log whose commands were sent later.

    Args:
        log: the log.
        shift: time by which they were, s.
    """
    moved = {
        robot: replace(commands, times=commands.times + shift)
        for robot, commands in log.commands.items()
    }
    return replace(log, commands=moved)


def check_gains(log: Log, model: RobotModel) -> None:
    """Refuse commands that robots obey to a small part, many times over, or backward.

    Args:
        log: the log, with one clock.
        model: the robots.

    Raises:
        ValueError: such commands; the message names the unit or sign that would explain it.
    """
    late = max(lag(log, model), 0.0)
    robot = _longest(log)
    commands, track = log.commands[robot], log.poses[robot]
    middles, velocities = _driven(track)
    sent = _commanded(_held(commands, middles - late), model)
    before = _commanded(_held(commands, middles - late - _STEADY), model)
    steady = np.abs(sent - before).max(axis=1) < 1e-6
    for column, what in ((0, "velocity forward"), (1, "velocity to the left"), (2, "turning")):
        chosen = steady & (np.abs(sent[:, column]) > 0.2 * np.abs(sent[:, column]).max() + 1e-3)
        if chosen.sum() < 2 * _HALF:
            continue
        x, y = sent[chosen, column], velocities[chosen, column]
        gain = _typical(y / x)
        if _GAINS[0] <= gain <= _GAINS[1]:
            continue
        close = min(_HINTS, key=lambda ratio: abs(np.log(ratio / max(abs(gain), 1e-9))))
        hint = _HINTS[close]
        if abs(np.log(close / max(abs(gain), 1e-9))) > 0.4:
            hint = "expected velocities in the robot's own frame, and SI units"
        if gain < -_GAINS[0]:
            hint = "its sign is wrong: x points forward, y to the left, turning is counterclockwise"
        raise ValueError(f"{what} of {robot}: it is {gain:.3g} of what is commanded; {hint}")


def _typical(gains: Doubles) -> float:
    """The gain of robots that have reached their speed, the faster half."""
    middle = float(np.median(gains))
    return float(np.quantile(gains, 0.75 if middle > 0.0 else 0.25))


def _longest(log: Log) -> str:
    """Robot with both commands and most poses."""
    both = [robot for robot in log.commands if len(log.poses.get(robot, ())) > 2 * _HALF + 1]
    still = sorted(robot for robot in log.commands if len(log.poses.get(robot, ())) == 1)
    if not both and still:
        raise ValueError(
            f"log: the poses of {still} never change, though they are commanded: expected robots "
            "that are on, and poses of these columns and robots"
        )
    if not both:
        raise ValueError(
            "log: expected commands and poses of the same robot; commands of "
            f"{sorted(log.commands)}, poses of {sorted(log.poses)}"
        )
    return max(both, key=lambda robot: len(log.poses[robot]))


def _held(commands: Commands, times: Doubles) -> Doubles:
    """Commands that hold at some times."""
    index = np.searchsorted(commands.times, times, side="right") - 1
    held: Doubles = commands.wheels[np.maximum(index, 0)] * (index >= 0)[:, None]
    return held


def _commanded(wheels: Doubles, model: RobotModel) -> Doubles:
    """Velocities forward and to the left, and angular velocities, that are commanded."""
    if model.drive == "omni":
        return wheels
    left, right = (model.wheel_radius * wheels).T
    turn = (right - left) / model.track_width
    return np.column_stack([(left + right) / 2.0, np.zeros(len(left)), turn])


def _speeds(velocities: Doubles) -> Doubles:
    """Speeds of driving (m/s) and turning (rad/s)."""
    driving: Doubles = np.hypot(velocities[:, 0], velocities[:, 1])
    return np.column_stack([driving, np.abs(velocities[:, 2])])


def _driven(track: Track) -> tuple[Doubles, Doubles]:
    """Times of poses, and velocities in the robot's frame there."""
    times, headings = track.times, np.unwrap(track.headings)
    first, last, middle = slice(None, -2 * _HALF), slice(2 * _HALF, None), slice(_HALF, -_HALF)
    seconds = np.maximum(times[last] - times[first], 1e-6)
    moved = (track.positions[last] - track.positions[first]) / seconds[:, None]
    cos, sin = np.cos(headings[middle]), np.sin(headings[middle])
    forward = cos * moved[:, 0] + sin * moved[:, 1]
    left = cos * moved[:, 1] - sin * moved[:, 0]
    turn = (headings[last] - headings[first]) / seconds
    velocities = np.column_stack([forward, left, turn])
    speeds = _speeds(velocities)
    # A robot that is carried seems fast for as long as it is compared with where it was.
    whole = (speeds <= 1.5 * np.quantile(speeds, _CARRIED, axis=0) + 1e-6).all(axis=1)
    whole &= seconds < 1.0
    return times[middle][whole], velocities[whole]

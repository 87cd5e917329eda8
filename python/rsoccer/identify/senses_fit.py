"""Frame rate, noise and delays of a log, as numbers of `rsoccer.Sensing`."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles
from rsoccer.identify.alignment import heading_noise, track_noise
from rsoccer.identify.least_squares import student
from rsoccer.identify.log import Log, Track
from rsoccer.identify.results import Estimate

_PARTS: Final = 12  # parts of a track whose numbers differ by chance
_SLACK: Final = 0.005  # s by which stamps and latency may contradict each other
_LOST: Final = 1.5  # of the median time between frames, beyond which one is missing
_LEAST: Final = 40  # poses of a track that is cut into parts


def camera_estimates(log: Log) -> list[Estimate]:
    """Return frame rate and noise of cameras.

    Args:
        log: the log; detections, and not estimates of a tracker, whose noise is smoothed.
    """
    robot = max(log.poses.values(), key=len, default=_part(log.ball, 0, 0))
    longest = max(robot, log.ball, key=len)
    return [
        _of_parts("frame_rate", "Hz", longest, _frame_rate),
        _of_parts("ball_position_noise", "m", log.ball, track_noise),
        _of_parts("robot_position_noise", "m", robot, track_noise),
        _of_parts("heading_noise", "rad", robot, heading_noise),
    ]


def delay_estimates(log: Log, latency: Estimate) -> list[Estimate]:
    """Return the delays on both ways, of which a log without stamps of cameras tells the sum.

    Args:
        log: the log.
        latency: time from commands to the poses that show them.

    Returns:
        `delay` and `command_delay` as in `Sensing`.

    Raises:
        ValueError: poses that were captured after they arrived, or so long before that the latency
            has no room for it.
    """
    parts = [track.times - track.captured for track in log.poses.values()]
    late = np.concatenate(parts) if parts else np.zeros(0)
    late = late[np.isfinite(late)]
    missing = Estimate.missing("command_delay", "s", "the column captured, to tell it from delay")
    if not latency.is_identified:
        return [Estimate.missing("delay", "s", latency.hint.removeprefix("needs ")), missing]
    if not len(late):
        # Without any latency, noise may leave it a little below 0.
        low, value, high = (max(x, 0.0) for x in (latency.low, latency.value, latency.high))
        return [Estimate("delay", "s", low, value, high), missing]
    medians = [float(np.median(part)) for part in np.array_split(late, _PARTS) if len(part)]
    _check_captured(late, latency)
    vision = _with_half("delay", "s", max(float(np.median(late)), 0.0), medians)
    rest = latency.value - vision.value
    below = math.hypot(latency.value - latency.low, vision.high - vision.value)
    above = math.hypot(latency.high - latency.value, vision.high - vision.value)
    low, value, high = (max(x, 0.0) for x in (rest - below, rest, rest + above))
    return [vision, Estimate("command_delay", "s", low, value, high)]


def _check_captured(late: Doubles, latency: Estimate) -> None:
    """Refuse stamps of cameras that the latency contradicts."""
    median, least, most = float(np.median(late)), float(late.min()), latency.high
    if least < -_SLACK:
        raise ValueError(
            f"captured: expected times up to `time` of the row, got one {-least:.4g} s after it; "
            "both columns need one clock"
        )
    if median > most + _SLACK:
        raise ValueError(
            f"captured: expected times at most the latency of {most:.4g} s before `time` of the "
            f"row, got {median:.4g} s as their median; both columns need one clock"
        )


def _frame_rate(track: Track) -> float:
    """Frames a second of a camera, by its own stamps if the log has them: arrivals vary."""
    stamped = bool(np.isfinite(track.captured).all())
    gaps = np.diff(np.sort(track.captured) if stamped else track.times)
    gaps = gaps[gaps > 0.0]
    # Longer ones are of frames that did not arrive.
    return 1.0 / float(gaps[gaps < _LOST * np.median(gaps)].mean())


def _of_parts(name: str, unit: str, track: Track, number: Callable[[Track], float]) -> Estimate:
    """A number with the interval that its scatter over parts of a track gives."""
    if len(track) < _LEAST:
        return Estimate.missing(name, unit, f"{_LEAST} poses or more")
    ends = np.linspace(0, len(track), _PARTS + 1).astype(np.intp).tolist()
    found = [number(_part(track, *pair)) for pair in pairwise(ends)]
    return _with_half(name, unit, number(track), found)


def _with_half(name: str, unit: str, value: float, parts: list[float]) -> Estimate:
    """A number with an interval by the scatter of those of parts."""
    deviation = float(np.std(parts, ddof=1)) if len(parts) > 1 else 0.0
    half = float(student(len(parts) - 1)) * deviation / len(parts) ** 0.5 if deviation else 0.0
    return Estimate(name, unit, max(value - half, 0.0), value, value + half)


def _part(track: Track, first: int, last: int) -> Track:
    part = slice(first, last)
    return Track(
        track.times[part], track.positions[part], track.headings[part], track.captured[part]
    )

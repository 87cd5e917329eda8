"""Misfits of simulated paths and seen poses, and the noise that they are measured by."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles
from rsoccer.identify.log import Log, Track
from rsoccer.identify.simulation import Paths
from rsoccer.identify.windows import Windows

_LEAST: Final = (0.0002, 0.001)  # m, rad: noise that residuals count with at least
_THIRD: Final = 20.0  # variance of third differences of white noise of variance 1


@dataclass(frozen=True)
class Noise:
    """Standard deviations of seen poses."""

    position: float
    """m, in each direction."""
    heading: float
    """rad."""


def noise_of(log: Log) -> Noise:
    """Return the noise of the robots' poses in a log.

    Args:
        log: the log.
    """
    tracks = [track for track in log.poses.values() if len(track) > 3]
    positions = [track_noise(track) for track in tracks]
    headings = [heading_noise(track) for track in tracks]
    return Noise(
        max(_LEAST[0], min(positions, default=0.0)), max(_LEAST[1], min(headings, default=0.0))
    )


def track_noise(track: Track) -> float:
    """Return the noise of the positions of a body, m in each direction.

    Args:
        track: its poses; 0 for fewer than four.
    """
    return _deviation(np.diff(track.positions, n=3, axis=0)) if len(track) > 3 else 0.0


def heading_noise(track: Track) -> float:
    """Return the noise of the headings of a robot, rad.

    Args:
        track: its poses; 0 for fewer than four.
    """
    turns = _wrapped(np.diff(track.headings))
    return _deviation(np.diff(turns, n=2)) if len(track) > 3 else 0.0


def _deviation(third: Doubles) -> float:
    """Noise by third differences, which smooth motion leaves small."""
    return 1.4826 * float(np.median(np.abs(third))) / math.sqrt(_THIRD)


def misfits(paths: Paths, windows: Windows, latency: float, noise: Noise) -> Doubles:
    """Return what remains between simulated paths and seen poses, in standard deviations.

    Each path is moved and turned to fit its window best: only the motion within it counts.

    Args:
        paths: simulated paths of the windows.
        windows: the windows.
        latency: time from a motion to the pose that shows it, ticks.
        noise: standard deviations of poses.

    Returns:
        (w, 3 n) misfits of x, y and heading; 0 where there is no pose.
    """
    seen = windows.seen.astype(np.float64)
    count = seen.sum(axis=0)
    positions, headings = paths.at(windows.times - latency)
    turned = np.where(windows.seen, windows.headings - headings, 0.0)
    mean = np.arctan2((np.sin(turned) * seen).sum(axis=0), (np.cos(turned) * seen).sum(axis=0))
    here = _centered(windows.positions, seen, count)
    there = _centered(_rotated(positions, mean), seen, count)
    # A small further turn weighs positions against headings, whose mean misfit is 0 already.
    cross = (there[..., 0] * here[..., 1] - there[..., 1] * here[..., 0]).sum(axis=0)
    length = (there**2).sum(axis=(0, 2))
    ratio = (noise.position / noise.heading) ** 2
    further = cross / (length + ratio * count)
    there = _rotated(there, further)
    left = _wrapped(turned - mean - further) * seen / noise.heading
    parts = [*np.moveaxis((here - there) / noise.position, 2, 0), left]
    return np.concatenate(parts, axis=0).T


def _centered(points: Doubles, seen: Doubles, count: Doubles) -> Doubles:
    """Points of windows around their means; 0 where there is none."""
    means = (points * seen[..., None]).sum(axis=0) / count[:, None]
    centered: Doubles = (points - means) * seen[..., None]
    return centered


def _rotated(points: Doubles, angles: Doubles) -> Doubles:
    cos, sin = np.cos(angles), np.sin(angles)
    x, y = points[..., 0], points[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def _wrapped(angles: Doubles) -> Doubles:
    wrapped: Doubles = (angles + np.pi) % (2.0 * np.pi) - np.pi
    return wrapped

"""Runs of the ball: straight stretches of its track between two contacts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Mask
from rsoccer.identify.log import Log, Track

SLOWEST: Final = 0.12  # m/s: below it dimples of the carpet decide
_HALF: Final = 4  # poses to each side of one, whose line gives the velocity there
_FEW: Final = 20  # least number of poses of a run
_SHORT: Final = 0.3  # m: least length of a run
_GAP: Final = 0.3  # s without poses
_CHANGE: Final = 0.35  # m/s, of the velocity within some poses by a contact
_SHARE: Final = 0.12  # of the speed, added to it
_REACH: Final = 0.13  # m between a robot's center and a ball that it may touch
_ASIDE: Final = 8.0  # standard deviations of noise that a straight run may leave its line


@dataclass(frozen=True)
class Run:
    """A ball between two contacts."""

    times: Doubles
    """(n,) s, since the first pose."""
    distances: Doubles
    """(n,) m along the line, from the first pose."""
    began: float
    """Time of the first pose, s."""
    rest: float
    """Distance of the place where the ball lay before it was kicked, m; NaN if it did not lie."""
    place: tuple[float, float]
    """That place, m; NaN if it did not lie."""


def runs(log: Log, noise: float) -> list[Run]:
    """Return all runs of the ball that are long enough to tell something.

    Args:
        log: the log.
        noise: standard deviation of the ball's positions in each direction, m.
    """
    ball = log.ball
    if len(ball) < _FEW:
        return []
    pieces = np.flatnonzero(np.diff(ball.times) > _GAP) + 1
    ends = [0, *pieces.tolist(), len(ball)]
    found = [
        run
        for first, last in pairwise(ends)
        if last - first >= _FEW
        for run in _of_piece(log, ball, slice(first, last), noise)
    ]
    return found


def _of_piece(log: Log, ball: Track, piece: slice, noise: float) -> Iterator[Run]:
    """Runs in a piece without gaps."""
    times, positions = ball.times[piece], ball.positions[piece]
    velocities = _velocities(times, positions)
    speeds = np.linalg.norm(velocities, axis=1)
    free = (speeds > SLOWEST) & ~_near_robots(log, times, positions)
    # Lines to both sides of a pose differ by more than floor friction can change.
    before, after = velocities[: -2 * _HALF], velocities[2 * _HALF :]
    jump = np.linalg.norm(after - before, axis=1)
    contact = jump > _CHANGE + _SHARE * np.maximum(speeds[: -2 * _HALF], speeds[2 * _HALF :])
    broken = np.zeros(len(times), np.bool_)
    broken[_HALF:-_HALF] = contact
    whole = free & ~_widened(broken)
    for first, last in _stretches(whole):
        run = _run(times, positions, slice(first, last), noise)
        if run is not None:
            yield run


def _velocities(times: Doubles, positions: Doubles) -> Doubles:
    """Velocities by lines through some poses around each one."""
    count = 2 * _HALF + 1
    found = np.zeros_like(positions)
    windows = np.lib.stride_tricks.sliding_window_view
    t = windows(times, count)
    p = windows(positions, count, axis=0)
    t = t - t.mean(axis=1, keepdims=True)
    slopes = np.einsum("nk,nck->nc", t, p) / np.maximum((t**2).sum(axis=1), 1e-12)[:, None]
    found[_HALF:-_HALF] = slopes
    found[:_HALF], found[-_HALF:] = slopes[0], slopes[-1]
    return found


def _widened(mask: Mask) -> Mask:
    """A mask with some neighbors of each pose, whose lines a contact bends."""
    wide = mask.copy()
    for step in range(1, _HALF // 2 + 1):
        wide[step:] |= mask[:-step]
        wide[:-step] |= mask[step:]
    return wide


def _near_robots(log: Log, times: Doubles, positions: Doubles) -> Mask:
    """Whether a robot may touch the ball."""
    near = np.zeros(len(times), np.bool_)
    for track in log.poses.values():
        x, y = (np.interp(times, track.times, axis) for axis in track.positions.T)
        near |= np.hypot(positions[:, 0] - x, positions[:, 1] - y) < _REACH
    return near


def _stretches(mask: Mask) -> Iterator[tuple[int, int]]:
    """First and end of each stretch of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(np.int8), [0]])))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def _run(times: Doubles, positions: Doubles, part: slice, noise: float) -> Run | None:
    """A stretch as a run; None if it is short or not straight."""
    points = positions[part]
    if len(points) < _FEW:
        return None
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=False)
    direction = axes[0] * np.sign((points[-1] - points[0]) @ axes[0])
    aside = (points - middle) @ np.array([-direction[1], direction[0]])
    distances = (points - points[0]) @ direction
    if distances[-1] < _SHORT or np.sqrt((aside**2).mean()) > _ASIDE * max(noise, 0.0005):
        return None
    moment = times[part]
    rest = _resting_place(times, positions, part.start)
    x, y = (np.nan, np.nan) if rest is None else rest.tolist()
    along = float((np.array([x, y]) - points[0]) @ direction)
    return Run(moment - moment[0], distances, float(moment[0]), along, (x, y))


def _resting_place(times: Doubles, positions: Doubles, first: int) -> Doubles | None:
    """Place where the ball lay shortly before a pose; None if it moved."""
    end = int(np.searchsorted(times, times[first] - 0.12))
    begin = int(np.searchsorted(times, times[first] - 0.35))
    before = positions[begin:end]
    if len(before) < 4 or np.ptp(before, axis=0).max() > 0.02:
        return None
    place: Doubles = before.mean(axis=0)
    return place

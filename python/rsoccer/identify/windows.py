"""Windows of a log: a second of a robot's poses each, with the commands before them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Mask
from rsoccer.identify.log import Commands, Log, Track
from rsoccer.identify.simulation import TICK

LENGTH: Final = 1.0
"""Length of a window, s."""
MAX_LATENCY: Final = 0.4
"""Greatest latency that can be identified, s."""
_WARM_UP: Final = 0.6  # s before a window, in which an error of the first velocity fades
_NEAR: Final = 0.06  # s around a time whose poses give the velocity
_FEW: Final = 10  # least number of poses in a window
_GAP: Final = 0.25  # s without poses
_JUMP: Final = 10.0  # m/s: a robot that was carried
_REACH: Final = 0.25  # m between centers of robots that may push each other
_BALL_REACH: Final = 0.12  # m between a light robot's center and a ball that it may push


@dataclass(frozen=True)
class Windows:
    """Poses of w windows, padded to the longest, and commands from before their begin."""

    commands: Doubles
    """(ticks, w, columns) commands of the wheels that hold in each tick, if nothing is late."""
    velocities: Doubles
    """(w, 3) velocity forward and to the left (m/s) and angular velocity (rad/s) at the start."""
    times: Doubles
    """(n, w) when poses arrived, in ticks since the start."""
    positions: Doubles
    """(n, w, 2) m."""
    headings: Doubles
    """(n, w) rad."""
    seen: Mask
    """(n, w) whether there is such a pose."""

    def __len__(self) -> int:
        """Return the number of windows."""
        return int(self.times.shape[1])

    def take(self, chosen: Mask) -> Windows:
        """Return some of the windows.

        Args:
            chosen: (w,) bool.
        """
        return Windows(
            self.commands[:, chosen],
            self.velocities[chosen],
            self.times[:, chosen],
            self.positions[:, chosen],
            self.headings[:, chosen],
            self.seen[:, chosen],
        )


@dataclass(frozen=True)
class _Window:
    commands: Doubles
    velocity: Doubles
    times: Doubles
    positions: Doubles
    headings: Doubles


def cut(log: Log, latency: float, heavy: bool, reach: float = MAX_LATENCY) -> Windows:
    """Cut the poses of all robots that have commands into windows.

    Windows in which a robot had no command, was carried, unseen, or so near another that they may
    push each other, are left out.

    Args:
        log: the log.
        latency: a guess of the time from commands to poses, s, for the velocities at the start.
        heavy: whether robots are too heavy for the ball to push them.
        reach: greatest latency that the windows' commands begin early enough for, s.

    Returns:
        The windows.

    Raises:
        ValueError: no such windows.
    """
    found = [
        window
        for robot, commands in log.commands.items()
        if robot in log.poses
        for window in _windows(log, robot, commands, (latency, reach), heavy)
    ]
    if not found:
        raise ValueError(
            f"log: no window of {LENGTH:g} s in which a robot with commands is seen {_FEW} times "
            f"or more; robots with commands: {sorted(log.commands)}, seen: {sorted(log.poses)}"
        )
    most = max(len(window.times) for window in found)
    seen = np.array([np.arange(most) < len(window.times) for window in found]).T

    def padded(parts: list[Doubles]) -> Doubles:
        full = np.zeros((most, len(parts), *parts[0].shape[1:]))
        for number, part in enumerate(parts):
            full[: len(part), number] = part
        return full

    return Windows(
        np.stack([window.commands for window in found], axis=1),
        np.stack([window.velocity for window in found]),
        padded([window.times for window in found]),
        padded([window.positions for window in found]),
        padded([window.headings for window in found]),
        seen,
    )


def _windows(
    log: Log, robot: str, commands: Commands, latencies: tuple[float, float], heavy: bool
) -> Iterator[_Window]:
    """Windows of one robot; latencies are a guess, and the greatest."""
    latency, reach = latencies
    track = log.poses[robot]
    others = [pose for name, pose in log.poses.items() if name != robot]
    light = [] if heavy else [log.ball]
    if len(track) < _FEW:
        return
    for begin in np.arange(track.times[0], track.times[-1] - 0.5 * LENGTH, LENGTH):
        part = slice(*np.searchsorted(track.times, [begin, begin + LENGTH]))
        times, positions = track.times[part], track.positions[part]
        start = begin - reach - _WARM_UP
        whole = slice(*np.searchsorted(track.times, [start, begin + LENGTH]))
        if len(times) < _FEW or _is_broken(track.times[whole], track.positions[whole]):
            continue
        if _is_near(track, whole, others, _REACH) or _is_near(track, whole, light, _BALL_REACH):
            continue
        start = _anchored(commands, start, begin + LENGTH)
        velocity = _velocity(track, start + latency)
        held = _held(commands, start, reach)
        if velocity is not None and held.any():  # a robot at rest shows nothing
            ticks = (times - start) / TICK
            yield _Window(held, velocity, ticks, positions, track.headings[part])


def _is_broken(times: Doubles, positions: Doubles) -> bool:
    """Whether a robot was unseen or carried."""
    steps = np.diff(times)
    moved = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    return bool((steps > _GAP).any() or (moved > 0.05 + _JUMP * steps).any())


def _is_near(track: Track, part: slice, others: list[Track], reach: float) -> bool:
    """Whether a robot comes near another body."""
    times, positions = track.times[part], track.positions[part]
    for other in others:
        if len(other) < 2 or other.times[-1] < times[0] or other.times[0] > times[-1]:
            continue
        x, y = (np.interp(times, other.times, axis) for axis in other.positions.T)
        if (np.hypot(positions[:, 0] - x, positions[:, 1] - y) < reach).any():
            return True
    return False


def _anchored(commands: Commands, start: float, end: float) -> float:
    """A start up to a tick earlier, so that the greatest change of a command begins a tick."""
    changes = np.zeros(len(commands.times))
    scale = np.abs(commands.wheels).max(axis=0) + 1e-9
    changes[1:] = np.abs(np.diff(commands.wheels, axis=0) / scale).sum(axis=1)
    changes[(commands.times < start) | (commands.times > end)] = -1.0
    greatest = int(changes.argmax())
    if changes[greatest] <= 0.0:
        return start
    return start - (start - float(commands.times[greatest])) % TICK


def _held(commands: Commands, start: float, reach: float) -> Doubles:
    """Commands that hold in the ticks from a start; none before the first."""
    ticks = round((_WARM_UP + reach + LENGTH) / TICK) + 2
    middles = start + (np.arange(ticks) + 0.5) * TICK
    index = np.searchsorted(commands.times, middles, side="right") - 1
    held: Doubles = commands.wheels[np.maximum(index, 0)] * (index >= 0)[:, None]
    return held


def _velocity(track: Track, time: float) -> Doubles | None:
    """Velocity in the robot's frame around a time; None if it was unseen then."""
    if time < track.times[0] - _NEAR:
        return np.zeros(3)  # a log begins at rest
    near = slice(*np.searchsorted(track.times, [time - _NEAR, time + _NEAR]))
    times = track.times[near] - time
    if len(times) < 3:
        return None
    headings = np.unwrap(track.headings[near])
    values = np.column_stack([track.positions[near], headings])
    (x, y, turn), (_, _, heading) = np.polyfit(times, values, 1)
    cos, sin = np.cos(heading), np.sin(heading)
    return np.array([cos * x + sin * y, cos * y - sin * x, turn])

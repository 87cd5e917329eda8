"""Mixed-up units of a log: each is refused with a hint at the unit that it looks like."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer.arrays import Doubles
from rsoccer.identify.log import BALL, DRIVES, Log, Track

_POSITION: Final = 30.0  # m from the center: no field is half as large
_HEADING: Final = 2.0 * np.pi + 0.01  # rad
_SPEED: Final = 15.0  # m/s: no robot drives half as fast
_KICK: Final = 20.0  # m/s: no kick is half as fast
_ANGULAR_VELOCITY: Final = 100.0  # rad/s: no robot turns half as fast
_WHEEL_SPEED: Final = 400.0  # rad/s
_FRAME_TIME: Final = 0.5  # s between two frames


def check_units(log: Log) -> None:
    """Refuse a log whose numbers are too large for SI units.

    Args:
        log: the log.

    Raises:
        ValueError: a column that looks like millimeters, degrees, milliseconds or revolutions; the
            message names it and the unit that it looks like.
    """
    for name, track in {**log.poses, BALL: log.ball}.items():
        _check_track(name, track)
    for robot, commands in log.commands.items():
        for column, numbers in zip(DRIVES[str(log.drive)], commands.wheels.T, strict=True):
            limit, unit, hint = {
                "v_theta": (_ANGULAR_VELOCITY, "rad/s", "degrees per second"),
                "left": (_WHEEL_SPEED, "rad/s", "revolutions per minute"),
                "right": (_WHEEL_SPEED, "rad/s", "revolutions per minute"),
            }.get(column, (_SPEED, "m/s", "millimeters per second"))
            _check(f"{column} of {robot}", numbers, limit, unit, hint)
        _check(f"kick_v_x of {robot}", commands.kicks, _KICK, "m/s", "millimeters per second")


def _check_track(name: str, track: Track) -> None:
    """Refuse poses in other units."""
    if not len(track):
        return
    _check(f"x and y of {name}", track.positions, _POSITION, "m", "millimeters")
    _check(f"theta of {name}", track.headings, _HEADING, "rad", "degrees")
    if len(track) > 2 and (frame := float(np.median(np.diff(track.times)))) > _FRAME_TIME:
        unit = "milliseconds" if frame < 1e3 else "microseconds or nanoseconds"
        raise ValueError(
            f"time: {frame:g} s between two poses of {name}, expected at most {_FRAME_TIME:g} s; "
            f"the times look like {unit}"
        )


def _check(what: str, numbers: Doubles, limit: float, unit: str, hint: str) -> None:
    """Refuse numbers beyond a limit."""
    if numbers.size and (most := float(np.abs(numbers).max())) > limit:
        raise ValueError(
            f"{what}: expected at most {limit:.4g} {unit}, got {most:g}; it looks like {hint}"
        )

"""Closed form of a ball that slides and rolls, as the simulator has it."""

from __future__ import annotations

import numpy as np

from rsoccer.arrays import Doubles


def rolled(deceleration: float, drag: float, speed: float, times: Doubles) -> Doubles:
    """Return the distance (m) that a ball rolls in some times, before its stop.

    Args:
        deceleration: rolling deceleration, m/s².
        drag: further deceleration by speed, 1/s.
        speed: speed at the time 0, m/s.
        times: times, s.
    """
    fade = drag * times
    small = np.abs(fade) < 1e-3
    exact = (np.exp(-fade) - 1.0 + fade) / np.where(small, 1.0, fade) ** 2
    integral = np.where(small, 0.5 - fade / 6.0, exact)
    distance: Doubles = speed * times - (deceleration + drag * speed) * times**2 * integral
    return distance


def slid_and_rolled(floor: Doubles, speed: float, rolling_speed: float, times: Doubles) -> Doubles:
    """Return the distance (m) of a ball that slides down to a speed, and then rolls.

    Args:
        floor: sliding deceleration (m/s²), rolling deceleration (m/s²) and drag (1/s).
        speed: speed at the time 0, m/s.
        rolling_speed: speed from which it rolls, m/s; one above `speed` leaves out the sliding.
        times: times, s; not negative.
    """
    sliding, rolling, drag = floor.tolist()
    end = max(speed - rolling_speed, 0.0) / sliding
    slid = np.minimum(times, end)
    first = speed * slid - sliding * slid**2 / 2.0
    begin = min(rolling_speed, speed)
    distance: Doubles = first + rolled(rolling, drag, begin, np.maximum(times - end, 0.0))
    return distance

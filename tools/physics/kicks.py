"""Closed forms of kicks that are fitted, and the figures of the fit."""

from pathlib import Path

import numpy as np

from rsoccer.arrays import Array
from tools.physics.rolling import Rolling

FIGURES = Path(__file__).with_name("kicks.json")  # written by `tools.fit_kicks`


def rolled(law: Rolling, speed: float, times: Array) -> Array:
    """Return the distance (m) that a ball rolls in some times (s); after its stop it comes back."""
    fade = law.drag * times
    small = fade < 1e-3
    exact = (np.exp(-fade) - 1 + fade) / np.where(small, 1, fade) ** 2
    integral = np.where(small, 0.5 - fade / 6, exact)
    distance: Array = speed * times - (law.deceleration + law.drag * speed) * times**2 * integral
    return distance


def slid_then_rolled(floor: tuple[float, float, Rolling], kick: float, times: Array) -> Array:
    """Return the distance (m) of a kick (m/s) without spin after some times (s); 0 before it.

    `floor` are the sliding deceleration (m/s²), the share of the speed at which the ball rolls, and
    the law of rolling.
    """
    deceleration, share, law = floor
    times = np.maximum(times, 0)
    end = kick * (1 - share) / deceleration
    sliding = np.minimum(times, end)
    slid = kick * sliding - deceleration * sliding**2 / 2
    distance: Array = slid + rolled(law, share * kick, np.maximum(times - end, 0))
    return distance

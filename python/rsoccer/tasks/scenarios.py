"""Official initial states of the SSL hardware challenges of 2021.

The numbers are those of the rules (ssl-hardware-challenge-rules, `rules.adoc` and `scenarios-*`),
where the attack goes to -x. The functions return them rotated by 180 degrees, to attack +x.
"""

from typing import Final

import numpy as np

from rsoccer.arrays import Array
from rsoccer.tasks.ssl import rotated_180

Pose = tuple[float, float, float]
"""x, y, m, and heading, rad."""

# Challenge 1: position of the ball, then poses of the opponents.
_STATIC: Final[tuple[tuple[tuple[float, float], tuple[Pose, ...]], ...]] = (
    ((-0.2, -1.8), ((-2.9, 0, -0.785), (-2, -0.75, 0), (-2, -0.55, 0))),
    ((-0.9, 0), ((-2.9, 0.175, 0.785), (-2, -0.175, 0), (-1.5, 0, 0))),
    ((-0.2, 0), ((-2.9, 0, 0), (-2, 0.5, 0), (-2, -0.5, 0), (-1, 0, 0))),
    ((-1.35, 0), ((-2.9, 0, 0), (-1.95, 0.5, 0), (-1.95, 0, 0), (-1.95, -0.5, 0))),
    (
        (-2.85, 1.75),
        (
            (-2.9, -0.2, -0.785),
            (-2.85, 1.1, 1.571),
            (-2, 0.5, 0),
            (-2, 0, 0),
            (-1.45, 1.75, 3.14),
        ),
    ),
    (
        (-0.95, -1.55),
        (
            (-2.9, 0, 0),
            (-2, 0.95, 0.785),
            (-2.4, 1.25, 0.785),
            (-2, 0.36, -0.785),
            (-1.45, -1.21, 0),
        ),
    ),
    (
        (-2.8, -1.8),
        (
            (-2.91, -0.3, -1.571),
            (-2.6, 1.2, 1.571),
            (-1.7, -0.35, 0),
            (-2.3, -1.3, -2.356),
            (-2, 0.3, 0),
        ),
    ),
    (
        (-0.2, 1.8),
        (
            (-2.9, 0.1, 0),
            (-2.25, 1.2, 0.785),
            (-2.05, 0.8, 0),
            (-2.05, 0.4, 0),
            (-2.05, -0.4, 0),
            (-2.05, -0.8, 0),
        ),
    ),
    (
        (-2.8, -1.75),
        (
            (-2.91, -0.3, -1.571),
            (-2.05, 1.05, 0),
            (-0.8, 1, -0.785),
            (-1.35, 0.35, 0),
            (-1.55, -0.6, 0),
            (-2.2, -1.2, 0.785),
        ),
    ),
    (
        (-1.3, 0.65),
        (
            (-2.9, -0.15, 0),
            (-2.4, 1.25, 0.785),
            (-2, 0.45, 0),
            (-1.3, 0, 1.571),
            (-1.85, -0.3, -0.785),
            (-2, -0.9, 0),
        ),
    ),
)

# Challenge 2: poses of the opponent, which has the ball in its mouth, and of the attacker.
_CONTESTED: Final[tuple[tuple[Pose, Pose], ...]] = (
    ((-1, 0, 0), (-0.5, 0, np.pi)),
    ((-1, -1.25, -0.785), (-0.647, -1.604, 2.36)),
    ((-0.5, 1.5, 0.785), (-0.146, 1.854, -2.356)),
    ((-2, -1.2, -0.785), (-1.646, -1.554, 2.36)),
    ((-2.74, 1.25, 1.57), (-2.74, 1.75, -1.57)),
)

N_STATIC_DEFENDERS: Final = len(_STATIC)
"""Number of scenarios of challenge 1."""
N_CONTESTED_POSSESSION: Final = len(_CONTESTED)
"""Number of scenarios of challenge 2."""


def static_defenders(scenario: int) -> tuple[Array, Array]:
    """Return an initial state of challenge 1.

    Args:
        scenario: number in the rules, 1 to `N_STATIC_DEFENDERS`.

    Returns:
        (2,) position of the ball, m; and (k, 3) poses of the opponents: x, y, m, and heading, rad.
    """
    ball, opponents = _STATIC[scenario - 1]
    return -np.asarray(ball), rotated_180(np.asarray(opponents))


def contested_possession(scenario: int) -> tuple[Array, Array]:
    """Return an initial state of challenge 2.

    Args:
        scenario: number in the rules, 1 to `N_CONTESTED_POSSESSION`.

    Returns:
        (3,) pose of the opponent with the ball and (3,) pose of the attacker: x, y, m, and
        heading, rad.
    """
    opponent, attacker = _CONTESTED[scenario - 1]
    return rotated_180(np.asarray(opponent)), rotated_180(np.asarray(attacker))

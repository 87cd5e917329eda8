"""Official scenarios of the SSL hardware challenges of 2021, turned to attack +x.

Poses are x, y (m), heading (rad). Facts of the rules (ssl-hardware-challenge-rules, `rules.adoc`
and `scenarios-*`), which attack -x.
"""

from typing import Final

import numpy as np

from rsoccer.frame import Array
from rsoccer.tasks.ssl import half_turned

Pose = tuple[float, float, float]

# Challenge 1: the ball, then the opponents.
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

# Challenge 2: the opponent, whose mouth holds the ball, and the attacker.
_CONTESTED: Final[tuple[tuple[Pose, Pose], ...]] = (
    ((-1, 0, 0), (-0.5, 0, np.pi)),
    ((-1, -1.25, -0.785), (-0.647, -1.604, 2.36)),
    ((-0.5, 1.5, 0.785), (-0.146, 1.854, -2.356)),
    ((-2, -1.2, -0.785), (-1.646, -1.554, 2.36)),
    ((-2.74, 1.25, 1.57), (-2.74, 1.75, -1.57)),
)

STATIC_SCENARIOS: Final = len(_STATIC)
CONTESTED_SCENARIOS: Final = len(_CONTESTED)


def static_defenders(scenario: int) -> tuple[Array, Array]:
    """Ball (2,) and opponents (k, 3) of scenario 1 to STATIC_SCENARIOS."""
    ball, opponents = _STATIC[scenario - 1]
    return -np.asarray(ball), half_turned(np.asarray(opponents))


def contested_possession(scenario: int) -> tuple[Array, Array]:
    """Poses (3,) of the opponent that holds the ball and of the attacker, 1 to CONTESTED_SCENARIOS."""
    opponent, attacker = _CONTESTED[scenario - 1]
    return half_turned(np.asarray(opponent)), half_turned(np.asarray(attacker))

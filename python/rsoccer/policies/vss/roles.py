"""Who does what in a VSSS side: a keeper, an attacker, and support.

Each robot works it out for the whole of its side from what all of them see, so teammates agree without
a word, whoever drives them.
"""

from typing import Final

import numpy as np

from rsoccer.frame import Array, Floats, length
from rsoccer.policies.vss.driving import Place
from rsoccer.policies.vss.pitch import Pitch
from rsoccer.view import View

NONE, KEEPER, ATTACKER, SUPPORT = 0, 1, 2, 3  # a second support is SUPPORT + 1, and so on

FORESIGHT: Final = np.float32(0.15)  # seconds ahead that the ball counts from
KEEP_X: Final = np.float32(0.10)  # metres from the goal line to where the keeper stands
RUN_UP: Final = np.float32(0.14)  # metres behind the ball from which an attacker runs at it
BEFORE: Final = np.float32(0.15)  # metres of way that being on the far side of the ball counts for
STAY: Final = np.float32(0.10)  # metres that another must be nearer by to take a role over
TILT: Final = np.float32(1e-4), np.float32(0.7e-4)  # by place, so that no two are equally near

SPOTS: Final = ((0.35, 0.4), (0.2, -0.7), (0.5, -0.3))
"""Where support waits: metres behind the ball, at which share of its y; the last for all others."""
SPREAD: Final = np.float32(0.5)  # metres from the middle, along x and along y, that it keeps to


def spot(which: int, ball: Place) -> Place:
    """Where the `which`-th support waits, by where the ball is."""
    behind, share = SPOTS[min(which, len(SPOTS) - 1)]
    x, y = ball[0] - np.float32(behind), ball[1] * np.float32(share)
    return (
        np.minimum(np.maximum(x, -SPREAD), SPREAD),
        np.minimum(np.maximum(y, -SPREAD), SPREAD),
    )


def assign(pitch: Pitch, view: View, last: Array) -> None:
    """Write into `last` (n, robots, side), the roles of old, those of now: mine, then my teammates'."""
    team = slice(0, 1 + view.n_teammates)
    x, y = view.robots.position[:, :, team, 0], view.robots.position[:, :, team, 1]
    present = np.broadcast_to(view.present[:, team], x.shape)
    several = present.sum(axis=2, keepdims=True) > 1  # who has no teammate attacks
    ball = pitch.rolled(view.ball, FORESIGHT)
    ways = [(KEEPER, _to_keep(pitch, x, y)), (ATTACKER, _to_attack(pitch, x, y, ball))]
    for which in range(view.n_teammates - 1):
        at_x, at_y = spot(which, ball)
        ways.append((SUPPORT + which, length(x - at_x[..., None], y - at_y[..., None])))
    roles = np.full_like(last, NONE)
    for role, way in ways:
        stay = np.where(last == role, STAY, np.float32(0.0))
        cost = way + TILT[0] * x + TILT[1] * y - stay
        free = present & (roles == NONE) & (several | (role != KEEPER))
        nearest = np.where(free, cost, np.float32(np.inf)).argmin(axis=2)[..., None]
        chosen = free & (np.arange(x.shape[2]) == nearest)
        roles[chosen] = role
    last[:] = roles


def _to_keep(pitch: Pitch, x: Floats, y: Floats) -> Floats:
    """Metres to the goal, (n, robots, side)."""
    return length(x + pitch.half_length - KEEP_X, y)


def _to_attack(pitch: Pitch, x: Floats, y: Floats, ball: Place) -> Floats:
    """Metres to where a run at the ball starts, (n, robots, side)."""
    u_x, u_y = (part[..., None] for part in pitch.course(*ball))
    from_x, from_y = x - ball[0][..., None], y - ball[1][..., None]
    round_it = np.where(from_x * u_x + from_y * u_y > 0.0, BEFORE, np.float32(0.0))
    return length(from_x + RUN_UP * u_x, from_y + RUN_UP * u_y) + round_it

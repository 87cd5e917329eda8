"""How a script takes the ball out of an opponent's mouth: nose to nose, and then aside.

Straight back the dribblers pull alike and neither wins. From some degrees off the opponent's axis its
front is a wedge with ours: sliding along it drags the ball out at the side, in our own mouth.
"""

from typing import Final

import numpy as np

from rsoccer.frame import Floats, Mask
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.paths import Ground
from rsoccer.view import View

OFF: Final = np.float32(np.radians(20.0))  # between the opponent's axis and the way we come
ASIDE: Final = np.float32(0.4)  # m/s along its front; a crash counts from 0.5 m/s
INWARD: Final = np.float32(0.1)  # m/s towards it meanwhile, so as not to lose touch
UNDECIDED: Final = np.float32(
    -0.23
)  # metres inwards from which on it slides to the opponent's left
NOSE: Final = np.float32(-0.8)  # cosine between the headings of two that are nose to nose

_COS: Final = np.cos(OFF)
_SIN: Final = np.sin(OFF)


def held(view: View) -> Mask:
    """Whether an opponent has the ball in its mouth, (n, robots)."""
    held: Mask = view.opponents.infrared.max(axis=-1) > 0.5
    return held


def stealing(
    mover: motion.Mover,
    view: View,
    robots: tuple[Floats, Floats],
    ground: Ground,
    fastest: float,
) -> tuple[Floats, Floats, Floats]:
    """Velocity (m/s) and turn rate (rad/s) towards the ball that an opponent holds, and then aside."""
    ego, ball = view.ego, view.ball
    at, (opponent_x, opponent_y) = _holder(view)
    # The side to slide to: to the opponent's left (1) or right (-1), inwards from the lines; by where
    # the opponent is, for the ball moves, and not right between the two.
    left_x, left_y = -opponent_y, opponent_x
    inwards = left_x * (np.float32(0.5) * ground.high[0] - at[0]) - left_y * at[1]
    side = np.where(inwards > UNDECIDED, np.float32(1.0), np.float32(-1.0))
    u_x = left_x * side * _SIN - opponent_x * _COS
    u_y = left_y * side * _SIN - opponent_y * _COS
    moves = ball.position, ball.velocity * np.float32(0.0)
    v_x, v_y, spin = motion.fetching(mover, ego, moves, robots, ground, fastest, (u_x, u_y))
    touches = mover.has(view)
    touches &= ego.heading[..., 0] * opponent_x + ego.heading[..., 1] * opponent_y < NOSE
    out_x = left_x * side * ASIDE - opponent_x * INWARD
    out_y = left_y * side * ASIDE - opponent_y * INWARD
    v_x, v_y = np.where(touches, out_x, v_x), np.where(touches, out_y, v_y)
    return v_x, v_y, np.where(touches, motion.turning(ego, u_x, u_y, 4.0), spin)


def _holder(view: View) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
    """Place and heading of the opponent that has the ball (or of some opponent), (n, robots) each."""
    which = np.argmax(view.opponents.infrared, axis=-1)[..., None]

    def chosen(of_opponents: Floats) -> tuple[Floats, Floats]:
        x, y = (np.take_along_axis(of_opponents[..., i], which, -1)[..., 0] for i in (0, 1))
        return x, y

    return chosen(view.opponents.position), chosen(view.opponents.heading)

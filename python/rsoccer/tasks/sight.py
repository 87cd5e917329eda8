"""The game from where a robot stands and faces: what a small network would have to work out.

Ahead and left in place of x and y. It says nothing that the absolute state does not, but turning
vectors takes products, which networks learn slowly.
"""

from typing import Final

import numpy as np

from rsoccer.frame import Array, Floats, RobotColumns, length
from rsoccer.view import View

NEAR: Final = np.float32(8.0)  # per metre: at 12 cm the ball is a third as near as at none
TINY: Final = np.float32(1e-6)  # metres; keeps directions finite


def from_me(
    view: View, goal: Floats, per_metre: np.float32, per_speed: np.float32
) -> dict[str, Array]:
    """Blocks of an observation; `goal` (2,) is the middle of the goal attacked, metres."""
    me, ball = view.me, view.ball
    places = np.concatenate([ball.position[:, :, None], view.robots.position[:, :, 1:]], axis=2)
    places = places - me.position[:, :, None]  # (n, seers, ball and others, 2)
    motions = np.stack([me.velocity, ball.velocity], axis=2)
    return {
        "ball_from_me": _polar(me, places[:, :, 0], per_metre),  # (n, seers, 3)
        "goal_from_me": _polar(me, goal - me.position, per_metre),  # (n, seers, 3)
        "shot": _shot(me, places[:, :, 0], goal - ball.position),  # (n, seers, 4)
        "motion_from_me": _turned(me, motions) * per_speed,  # (n, seers, 2, 2)
        "places_from_me": _turned(me, places) * per_metre,  # (n, seers, ball and others, 2)
    }


def _turned(me: RobotColumns, vectors: Floats) -> Floats:
    """Vectors (n, seers, k, 2) along and across each seer's heading."""
    cos, sin = me.heading[..., None, 0], me.heading[..., None, 1]
    x, y = vectors[..., 0], vectors[..., 1]
    turned = np.empty_like(vectors)
    np.add(x * cos, y * sin, out=turned[..., 0])
    np.subtract(y * cos, x * sin, out=turned[..., 1])
    return turned


def _polar(me: RobotColumns, offset: Floats, per_metre: np.float32) -> Floats:
    """Distance, and cosine and sine of the bearing, of what lies `offset` (n, seers, 2) away."""
    distance = length(offset[..., 0], offset[..., 1])
    polar = np.empty((*distance.shape, 3), np.float32)
    np.multiply(distance, per_metre, out=polar[..., 0])
    bearing = _turned(me, offset[:, :, None])[:, :, 0]
    np.divide(bearing, np.maximum(distance, TINY)[..., None], out=polar[..., 1:])
    return polar


def _shot(me: RobotColumns, to_ball: Floats, to_goal: Floats) -> Floats:
    """Bearing of the goal from the ball, how near I am to it, and how well I stand behind it.

    (n, seers, 4): cosine and sine; 1 at the ball, falling to 0; the latter times 1 where ball and
    goal lie in one direction, -1 where in opposite ones.
    """
    shot = np.empty((*to_goal.shape[:2], 4), np.float32)
    way = np.maximum(length(to_goal[..., 0], to_goal[..., 1]), TINY)
    distance = np.maximum(length(to_ball[..., 0], to_ball[..., 1]), TINY)
    np.divide(_turned(me, to_goal[:, :, None])[:, :, 0], way[..., None], out=shot[..., :2])
    np.exp(distance * -NEAR, out=shot[..., 2])
    along = to_ball[..., 0] * to_goal[..., 0] + to_ball[..., 1] * to_goal[..., 1]
    np.multiply(shot[..., 2], along / (way * distance), out=shot[..., 3])
    return shot

"""Interception of a rolling ball: the point of its line to go to."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.vectors import norm, reciprocal, rotate_into
from rsoccer.view import View

MIN_BALL_SPEED: Final = np.float32(0.5)
"""Speed of a ball that is on its way, m/s."""


def point_on_ball_line(
    view: View, min_speed: np.float32 = MIN_BALL_SPEED
) -> tuple[Mask, Floats, Floats]:
    """Return whether the ball rolls toward each robot, and the nearest point of its line.

    Args:
        view: view of the robots.
        min_speed: speed from which a ball is on its way, m/s.

    Returns:
        (n, robots) whether the ball is fast and the robot ahead of it; x and y of the point, m.
    """
    position, ball = view.ego.position, view.ball
    speed = norm(ball.velocity[..., 0], ball.velocity[..., 1])
    scale = reciprocal(speed, min_speed)
    u_x, u_y = ball.velocity[..., 0] * scale, ball.velocity[..., 1] * scale
    from_x, from_y = (position[..., i] - ball.position[..., i] for i in (0, 1))
    ahead, left = rotate_into(from_x, from_y, u_x, u_y)
    coming: Mask = (speed > min_speed) & (ahead > 0.0)
    return coming, position[..., 0] + left * u_y, position[..., 1] - left * u_x

"""Geometry of a team around the ball, for the scripted policies of both leagues."""

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.vectors import norm
from rsoccer.view import View


def team_from_ball(view: View) -> tuple[Floats, Floats, Floats]:
    """Return the positions of the own team's robots relative to the ball.

    Args:
        view: view of the robots.

    Returns:
        x, y and distance (m), each (n, robots, team); ego comes first. The distance of an empty
        slot and of an absent robot is infinite.
    """
    team = slice(0, 1 + view.n_teammates)
    x = view.robots.position[:, :, team, 0] - view.ball.position[..., None, 0]
    y = view.robots.position[:, :, team, 1] - view.ball.position[..., None, 1]
    return x, y, np.where(view.present[:, :, team], norm(x, y), np.float32(np.inf))

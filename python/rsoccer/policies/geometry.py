"""Plane geometry on batched arrays, for the scripted policies of both leagues."""

from typing import Final

import numpy as np

from rsoccer.frame import Floats, length
from rsoccer.view import View

XY = tuple[Floats, Floats]
"""x and y of points (m) or vectors, one array each, usually (n, robots)."""

TINY: Final = np.float32(1e-6)
"""Lower bound of divisors: m or m²."""


def reciprocal(lengths: Floats, minimum: np.float32 = TINY) -> Floats:
    """Return 1 / max(lengths, minimum), which is finite for a length of 0.

    Args:
        lengths: (...) lengths or squared lengths, at least 0.
        minimum: lower bound of the divisor, above 0.
    """
    result: Floats = np.divide(np.float32(1.0), np.maximum(lengths, minimum))
    return result


def unit(x: Floats, y: Floats) -> XY:
    """Return unit vectors in the direction of vectors; zero vectors stay zero.

    Args:
        x: (...) components along x.
        y: (...) components along y.
    """
    scale = reciprocal(length(x, y), TINY)
    return x * scale, y * scale


def rotate_into(x: Floats, y: Floats, u_x: Floats, u_y: Floats) -> XY:
    """Return the components of vectors in axes that are rotated to a direction.

    Args:
        x: (...) components along x.
        y: (...) components along y.
        u_x: (...) x of the unit vector of the new first axis.
        u_y: (...) y of the unit vector of the new first axis.

    Returns:
        Components along the direction, and 90 degrees to its left.
    """
    return x * u_x + y * u_y, y * u_x - x * u_y


def team_from_ball(view: View) -> tuple[Floats, Floats, Floats]:
    """Return the positions of the own team's robots relative to the ball.

    Args:
        view: view of the robots.

    Returns:
        x, y and distance (m), each (n, robots, team); ego comes first. The distance of an empty
        slot is infinite.
    """
    team = slice(0, 1 + view.n_teammates)
    x = view.robots.position[:, :, team, 0] - view.ball.position[..., None, 0]
    y = view.robots.position[:, :, team, 1] - view.ball.position[..., None, 1]
    return x, y, np.where(view.present[:, team], length(x, y), np.float32(np.inf))

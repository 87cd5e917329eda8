"""Room for bodies that are placed into each other by a little, as old environments do.

The old simulator took any start and let its solver push bodies out of each other over the first
steps. Here they are moved apart before the match starts, and what is deeper is refused.
"""

from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.entities import Doubles

DEPTH: Final = 0.01
"""Metres by which two robots may overlap: squares at 0.1 m, corner to corner, do by 6 mm."""

ROUNDS: Final = 20  # one that is moved out of one body may get into the next
ROUNDING: Final = 1e-9  # metres; also keeps from dividing by nothing


def make_room(
    ball: Doubles, robots: Doubles, headings: Doubles, model: RobotModel, radius: float
) -> tuple[Doubles, Doubles]:
    """Places of the ball (2,) and of the robots (n, 2) such that none overlap; others stay.

    Robots give way to each other alike. A ball gives way to a robot, straight out of its front if
    it is before it, unless its centre is inside. What is deeper stays where it is.
    """
    ball, robots = ball.copy(), robots.copy()
    for _ in range(ROUNDS):
        parted = _part(robots, headings, model)
        freed = _free(ball, robots, headings, model, radius)
        if not (parted or freed):
            break
    return ball, robots


def _part(robots: Doubles, headings: Doubles, model: RobotModel) -> bool:
    """Move robots out of each other; whether any moved."""
    offsets = robots[None] - robots[:, None]
    near = np.hypot(offsets[..., 0], offsets[..., 1]) < 2.0 * model.bounding_radius
    moved = False
    for i, j in np.argwhere(np.triu(near, 1)):
        offset = robots[j] - robots[i]
        if model.drive == "differential":
            depth, way = _squares(offset, headings[i], headings[j], model.side / 2.0)
        else:
            depth, way = _discs(offset, model.radius)
        if 0.0 < depth <= DEPTH:
            robots[i] -= way * (depth / 2.0)
            robots[j] += way * (depth / 2.0)
            moved |= depth > ROUNDING
    return moved


def _free(
    ball: Doubles, robots: Doubles, headings: Doubles, model: RobotModel, radius: float
) -> bool:
    """Move the ball out of robots; whether it moved."""
    moved = False
    for robot, ahead in zip(robots, headings, strict=True):
        aside = np.array([-ahead[1], ahead[0]])
        local = np.array([(ball - robot) @ ahead, (ball - robot) @ aside])
        gap = local - _nearest(local, model)
        distance = float(np.hypot(*gap))
        if 0.0 < distance < radius:
            way = (gap[0] * ahead + gap[1] * aside) / distance
            ball += way * (radius - distance)
            moved |= radius - distance > ROUNDING
    return moved


def _squares(offset: Doubles, a: Doubles, b: Doubles, half: float) -> tuple[float, Doubles]:
    """How deep two squares are in each other, and the way out for the one at `offset`."""
    axes = np.array([a, [-a[1], a[0]], b, [-b[1], b[0]]])
    reach = half * np.abs(axes @ axes.T).sum(axis=1)
    along = axes @ offset
    depths = reach - np.abs(along)
    least = int(depths.argmin())
    return float(depths[least]), axes[least] * np.copysign(1.0, along[least])


def _discs(offset: Doubles, radius: float) -> tuple[float, Doubles]:
    """The same of two discs; none is the way out of the very same place."""
    distance = float(np.hypot(*offset))
    return 2.0 * radius - distance, offset / max(distance, ROUNDING)


def _nearest(local: Doubles, model: RobotModel) -> Doubles:
    """The point of a robot's body nearest to `local`, a point in its frame."""
    if model.drive == "differential":
        return np.clip(local, -model.side / 2.0, model.side / 2.0)
    half_front = np.sqrt(model.radius**2 - model.front**2)
    if local[0] > 0.0 and abs(local[1]) <= half_front:
        return np.array([min(local[0], model.front), local[1]])
    return local * min(1.0, model.radius / max(float(np.hypot(*local)), ROUNDING))

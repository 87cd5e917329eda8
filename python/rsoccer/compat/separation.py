"""Separation of bodies that overlap slightly at a start, as in environments for rSim.

rSim (rc-robosim 1.2) took any start, and its solver pushed bodies apart over the first steps. Here
bodies are moved apart before the match starts; deeper overlaps are left for the simulator to
refuse.
"""

from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles

MAX_OVERLAP: Final = 0.01
"""Deepest overlap of two robots that is resolved, meters: squares at 0.1 m overlap corner to corner
by 6 mm."""

MAX_ROUNDS: Final = 20  # a body moved out of one body may overlap the next
TOLERANCE: Final = 1e-9  # meters; also keeps from dividing by zero


def separate(
    ball: Doubles, robots: Doubles, headings: Doubles, model: RobotModel, radius: float
) -> tuple[Doubles, Doubles]:
    """Move bodies that overlap slightly apart.

    Two robots move by the same distance. A ball moves out of a robot: straight ahead from its
    front, outward elsewhere. Robots that overlap by more than `MAX_OVERLAP`, and a ball whose
    center is inside a robot, stay.

    Args:
        ball: position of the ball (2,), meters.
        robots: positions of the robots (n, 2), meters.
        headings: headings of the robots (n, 2), cosine and sine.
        model: the model of all robots.
        radius: radius of the ball, meters.

    Returns:
        New positions of the ball (2,) and of the robots (n, 2), meters.
    """
    ball, robots = ball.copy(), robots.copy()
    for _ in range(MAX_ROUNDS):
        robots_moved = _separate_robots(robots, headings, model)
        ball_moved = _separate_ball(ball, robots, headings, model, radius)
        if not (robots_moved or ball_moved):
            break
    return ball, robots


def _separate_robots(robots: Doubles, headings: Doubles, model: RobotModel) -> bool:
    """Move robots out of each other in place; return whether any moved."""
    offsets = robots[None] - robots[:, None]
    near = np.hypot(offsets[..., 0], offsets[..., 1]) < 2.0 * model.bounding_radius
    moved = False
    for i, j in np.argwhere(np.triu(near, 1)):
        offset = robots[j] - robots[i]
        if model.drive == "differential":
            depth, normal = _square_overlap(
                offset, headings[i], headings[j], model.side_length / 2.0
            )
        else:
            depth, normal = _disc_overlap(offset, model.radius)
        if 0.0 < depth <= MAX_OVERLAP:
            robots[i] -= normal * (depth / 2.0)
            robots[j] += normal * (depth / 2.0)
            moved |= depth > TOLERANCE
    return moved


def _separate_ball(
    ball: Doubles, robots: Doubles, headings: Doubles, model: RobotModel, radius: float
) -> bool:
    """Move the ball out of robots in place; return whether it moved."""
    moved = False
    for robot, forward in zip(robots, headings, strict=True):
        left = np.array([-forward[1], forward[0]])
        local = np.array([(ball - robot) @ forward, (ball - robot) @ left])
        gap = local - _nearest_point(local, model)
        distance = float(np.hypot(*gap))
        if 0.0 < distance < radius:
            normal = (gap[0] * forward + gap[1] * left) / distance
            ball += normal * (radius - distance)
            moved |= radius - distance > TOLERANCE
    return moved


def _square_overlap(offset: Doubles, a: Doubles, b: Doubles, half: float) -> tuple[float, Doubles]:
    """Overlap of two squares with headings `a` and `b`, and the way out for the one at `offset`."""
    axes = np.array([a, [-a[1], a[0]], b, [-b[1], b[0]]])
    reach = half * np.abs(axes @ axes.T).sum(axis=1)
    along = axes @ offset
    depths = reach - np.abs(along)
    shallowest = int(depths.argmin())
    return float(depths[shallowest]), axes[shallowest] * np.copysign(1.0, along[shallowest])


def _disc_overlap(offset: Doubles, radius: float) -> tuple[float, Doubles]:
    """Overlap of two discs, and the way out for the one at `offset`; zero at equal centers."""
    distance = float(np.hypot(*offset))
    return 2.0 * radius - distance, offset / max(distance, TOLERANCE)


def _nearest_point(local: Doubles, model: RobotModel) -> Doubles:
    """The point of a robot's body nearest to `local`, both in the body frame."""
    if model.drive == "differential":
        return np.clip(local, -model.side_length / 2.0, model.side_length / 2.0)
    half_front = np.sqrt(model.radius**2 - model.front_distance**2)
    if local[0] > 0.0 and abs(local[1]) <= half_front:
        return np.array([min(local[0], model.front_distance), local[1]])
    return local * min(1.0, model.radius / max(float(np.hypot(*local)), TOLERANCE))

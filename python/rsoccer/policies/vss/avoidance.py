"""Obstacle avoidance of VSSS scripts: waypoints past the ball and past other robots."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.vectors import FAR, TINY, XY, norm, reciprocal, rotate_into, unit
from rsoccer.view import View

WAYPOINT_DISTANCE: Final = np.float32(0.25)  # m from the robot to the waypoint of a detour
ROBOT_CLEARANCE: Final = np.float32(0.08)  # m between centers of robots: about a width
AVOID_RANGE: Final = np.float32(0.2)  # m ahead in which other robots are avoided
DUEL_RADIUS: Final = np.float32(0.15)  # m from the ball in which an attacker pushes other robots


def avoid_obstacle(
    position: Floats, target: XY, obstacle: XY, radius: np.float32, active: Mask
) -> XY:
    """Return the next waypoint on the way to a target past one round obstacle.

    Args:
        position: (n, robots, 2) positions of the robots, m.
        target: target positions.
        obstacle: centers of the obstacles.
        radius: distance to keep from the center, m.
        active: (n, robots) whether a robot avoids its obstacle.

    Returns:
        The target, or a waypoint on the tangent to the circle around the obstacle.
    """
    to_x, to_y = obstacle[0] - position[..., 0], obstacle[1] - position[..., 1]
    path_x, path_y = target[0] - position[..., 0], target[1] - position[..., 1]
    toward = to_x * path_x + to_y * path_y
    share = toward * reciprocal(path_x * path_x + path_y * path_y, TINY)
    share = np.minimum(np.maximum(share, 0.0), np.float32(1.0))
    blocked = norm(to_x - share * path_x, to_y - share * path_y) < radius
    blocked &= (toward > 0.0) & active
    distance = np.maximum(norm(to_x, to_y), TINY)
    u_x, u_y = to_x / distance, to_y / distance
    # Along the tangent to the circle; from inside the circle, perpendicular to its center.
    sin = np.minimum(radius / distance, np.float32(1.0))
    ahead = np.sqrt(np.float32(1.0) - sin * sin)
    right = np.copysign(sin, path_x * to_y - path_y * to_x)  # of the obstacle, if that is shorter
    x = position[..., 0] + WAYPOINT_DISTANCE * (u_x * ahead + u_y * right)
    y = position[..., 1] + WAYPOINT_DISTANCE * (u_y * ahead - u_x * right)
    return np.where(blocked, x, target[0]), np.where(blocked, y, target[1])


def avoid_robots(view: View, target: XY, attacking: Mask) -> XY:
    """Return the next waypoint on the way to a target past the nearest robot in the way.

    Args:
        view: view of the robots.
        target: target positions.
        attacking: (n, robots) whether a robot attacks; it does not avoid robots at the ball.

    Returns:
        The target, or a waypoint past the robot.
    """
    position, others = view.ego.position, view.robots.position[:, :, 1:]
    ball = view.ball.position[:, :, None]
    if not others.shape[2]:
        return target
    x, y = others[..., 0], others[..., 1]
    path_x, path_y = target[0] - position[..., 0], target[1] - position[..., 1]
    u_x, u_y = (part[..., None] for part in unit(path_x, path_y))
    to_x, to_y = x - position[..., None, 0], y - position[..., None, 1]
    ahead, left = rotate_into(to_x, to_y, u_x, u_y)
    avoid_range = np.minimum(norm(path_x, path_y), AVOID_RANGE)[..., None]
    blocks = (ahead > 0.0) & (ahead < avoid_range) & (np.abs(left) < ROBOT_CLEARANCE)
    blocks &= view.present[:, :, 1:]
    duel = norm(x - ball[..., 0], y - ball[..., 1]) < DUEL_RADIUS
    blocks &= ~(duel & attacking[..., None])
    nearest = np.argmin(np.where(blocks, ahead, FAR), axis=2)[..., None]
    next_x, next_y = (np.take_along_axis(part, nearest, 2)[..., 0] for part in (x, y))
    blocked = np.asarray(blocks.any(axis=2))
    return avoid_obstacle(position, target, (next_x, next_y), ROBOT_CLEARANCE, blocked)

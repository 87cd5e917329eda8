"""Path planning of SSL scripts: the shortest path with at most one corner past obstacles."""

from typing import Final, NamedTuple

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.ssl.region import Region
from rsoccer.vectors import FAR, XY, norm, reciprocal
from rsoccer.view import View

COLLISION_COST: Final = np.float32(20.0)  # m of detour, per m too near to an obstacle
CORNER_SCALE: Final = np.float32(1.15)  # distance of a corner, per distance to keep
CORNERS: Final = 8  # candidate corners around each obstacle

_ANGLES = np.arange(CORNERS) * (2.0 * np.pi / CORNERS)
_CIRCLE: Final = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1).astype(np.float32)


class Obstacles(NamedTuple):
    """Obstacles of each robot, (n, robots, obstacles) each."""

    x: Floats
    """x of the center, m."""
    y: Floats
    """y of the center, m."""
    clearance: Floats
    """Distance to keep from the center, m."""


def other_robots(view: View, which: slice = slice(None)) -> XY:
    """Return the positions of other robots, (n, robots, others).

    Empty slots and absent robots are far away; without slots there is one far away.

    Args:
        view: view of the robots.
        which: slots of the other robots, those of teammates first; default: all.
    """
    present = view.present[:, :, 1:][:, :, which]
    position = view.robots.position[:, :, 1:][:, :, which]
    x, y = np.where(present, position[..., 0], FAR), np.where(present, position[..., 1], FAR)
    if not x.shape[2]:
        x = y = np.full((*x.shape[:2], 1), FAR, np.float32)
    return x, y


def teammate_positions(view: View) -> XY:
    """Return the positions of teammates, (n, robots, teammates); see `other_robots`.

    Args:
        view: view of the robots.
    """
    return other_robots(view, slice(view.n_teammates))


def opponent_positions(view: View) -> XY:
    """Return the positions of opponents, (n, robots, opponents); see `other_robots`.

    Args:
        view: view of the robots.
    """
    return other_robots(view, slice(view.n_teammates, None))


def segment_distance(start: XY, end: XY, x: Floats, y: Floats) -> Floats:
    """Return the distances (m) of points from segments.

    Args:
        start: (...) starts of the segments, m.
        end: (...) ends of the segments, m.
        x: (..., k) points, m.
        y: (..., k) points, m.
    """
    path_x, path_y = (end[0] - start[0])[..., None], (end[1] - start[1])[..., None]
    to_x, to_y = x - start[0][..., None], y - start[1][..., None]
    scale = reciprocal(path_x * path_x + path_y * path_y)
    share = np.minimum(np.maximum((to_x * path_x + to_y * path_y) * scale, 0.0), 1.0)
    return norm(to_x - share * path_x, to_y - share * path_y)


def next_waypoint(
    position: Floats, target: XY, obstacles: Obstacles, region: Region
) -> tuple[Floats, Floats, Floats]:
    """Plan paths to targets with at most one corner.

    Args:
        position: (n, robots, 2) positions of the robots, m.
        target: (n, robots) target positions, m.
        obstacles: obstacles on the way.
        region: allowed positions.

    Returns:
        x and y of the next waypoint, which is the corner or the target, and the length of the
        whole path; m, (n, robots) each.
    """
    corner = _candidate_corners(*target, obstacles, region)
    start = position[..., 0][..., None], position[..., 1][..., None]
    end = target[0][..., None], target[1][..., None]
    path = norm(corner[0] - start[0], corner[1] - start[1])
    path = path + norm(corner[0] - end[0], corner[1] - end[1])
    collision = np.maximum(
        _missing_clearance(start, corner, obstacles), _missing_clearance(corner, end, obstacles)
    )
    collision = collision + region.distance_outside(*corner)
    collision = collision + region.length_in_goal_area(start, corner)
    collision = collision + region.length_in_goal_area(corner, end)
    best = np.argmin(path + COLLISION_COST * collision, axis=-1)[..., None]
    x, y, distance = (np.take_along_axis(part, best, -1)[..., 0] for part in (*corner, path))
    return x, y, distance


def _candidate_corners(x: Floats, y: Floats, obstacles: Obstacles, region: Region) -> XY:
    """Candidates (n, robots, corners): the target, around obstacles, and beside the goal area."""
    shape = (*x.shape, -1)
    radius = obstacles.clearance[..., None] * CORNER_SCALE
    around_x = (obstacles.x[..., None] + radius * _CIRCLE[:, 0]).reshape(shape)
    around_y = (obstacles.y[..., None] + radius * _CIRCLE[:, 1]).reshape(shape)
    front = np.broadcast_to(np.minimum(region.area_x, region.high[0]), x.shape)[..., None]
    side = np.broadcast_to(region.area_y, x.shape)[..., None]
    corner_x = np.concatenate([x[..., None], front, front, around_x], axis=-1)
    return corner_x, np.concatenate([y[..., None], side, -side, around_y], axis=-1)


def _missing_clearance(start: XY, end: XY, obstacles: Obstacles) -> Floats:
    """Distance (m) by which segments (n, robots, corners) come too near to an obstacle."""
    x, y, clearance = (part[:, :, None] for part in obstacles)
    missing = clearance - segment_distance(start, end, x, y)
    largest: Floats = np.maximum(missing.max(axis=-1), np.float32(0.0))
    return largest

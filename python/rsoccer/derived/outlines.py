"""Outlines of robots from above, and the gaps between them and the ball.

A robot is a square, or a disc with a flat front for the ball. Discs meet other robots as full
discs, as in the simulator.
"""

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.vectors import norm, reciprocal, rotate_into_body

CONTACT_GAP: Final = 0.0005
"""Gap up to which two bodies touch, m: above the rounding of exact poses. With the noise of a
camera it is to be about as large as the noise."""
SHARES: Final = np.linspace(0.0, 1.0, 6, dtype=np.float32)[:, None, None]
"""(times, 1, 1) times at which gaps are computed, as shares of the time between two frames."""
_CORNER: Final = np.float32(0.1)
"""Sine of the angle between two faces, up to which they meet face to face rather than at a
corner."""


Indices = NDArray[np.intp]


class Poses(NamedTuple):
    """Positions and headings of robots at one time."""

    position: Floats
    """(..., robots, 2) centers, m."""
    heading: Floats
    """(..., robots, 2) cosines and sines."""


class Separation(NamedTuple):
    """Distance of two robots, and the place where they meet."""

    gap: Floats
    """(...) distance of the outlines, m; negative where they overlap. The distance of two corners
    is understated."""
    normal: Floats
    """(..., 2) unit vector from the first robot to the second, along which they are nearest."""
    point: Floats
    """(..., 2) point where they meet, or would, m."""


class Outlines:
    """Outlines of the robots of a configuration, as arrays over the robots.

    Attributes:
        square: (robots,) whether a robot is a square.
        size: (robots,) half the side of a square, or the radius of a disc, m.
        front: (robots,) distance of the front from the center, m.
        bounding: (robots,) radius of the circle around a robot, m.
        height: (robots,) height of a robot, m.
        half_mouth: (robots,) half the width of the mouth, m; -1 without one.
        beam_distance: (robots,) distance of the break beam before the front, m.
        beam_height: (robots,) height of the break beam, m.
        ball_radius: radius of the ball, m.
    """

    def __init__(self, config: SimConfig) -> None:
        """Read the sizes.

        Args:
            config: robots and ball.
        """
        sides = [getattr(robot, "side_length", None) for robot in config.robots]
        sizes = [
            (robot.radius, robot.front_distance) if side is None else (side / 2, side / 2)
            for robot, side in zip(config.robots, sides, strict=True)
        ]
        self.square: Mask = np.array([side is not None for side in sides], np.bool_)
        self.size, self.front = np.array(sizes, np.float32).reshape(-1, 2).T
        self.bounding = np.array([robot.bounding_radius for robot in config.robots], np.float32)
        mouths = [
            (model.mouth_width / 2, model.beam_distance, model.beam_height)
            if model.has_mouth
            else (-1.0, 0.0, 0.0)
            for model in config.robots
        ]
        self.half_mouth, self.beam_distance, self.beam_height = (
            np.array(mouths, np.float32).reshape(-1, 3).T
        )
        self.height = np.array([robot.height for robot in config.robots], np.float32)
        self.ball_radius = np.float32(config.ball.radius)

    def ball_gaps(self, robots: Poses, ball: Floats) -> Floats:
        """Compute the distances between the ball and the robots, as seen from above.

        Args:
            robots: poses (..., robots, 2).
            ball: (..., 2) positions of the ball, m.

        Returns:
            (..., robots) m; negative where they overlap.
        """
        offset = ball[..., None, :] - robots.position
        x, y = rotate_into_body(offset[..., 0], offset[..., 1], robots.heading)
        ahead, aside = np.abs(x) - self.size, np.abs(y) - self.size
        outside = norm(np.maximum(ahead, 0.0), np.maximum(aside, 0.0))
        box = outside + np.minimum(np.maximum(ahead, aside), 0.0)
        disc = np.maximum(norm(x, y) - self.size, x - self.front)
        gaps: Floats = np.where(self.square, box, disc) - self.ball_radius
        return gaps

    def separation(self, robots: Poses, first: Indices, second: Indices) -> Separation:
        """Compute how far pairs of robots are apart.

        Convex outlines are apart by the greatest gap between their projections. The candidates are
        the normals of the faces of both robots, and the line between their centers.

        Args:
            robots: poses (..., robots, 2).
            first: (pairs,) indices of the first robot of each pair.
            second: (pairs,) indices of the second robot of each pair.

        Returns:
            Arrays (..., pairs) and (..., pairs, 2).
        """
        offset = robots.position[..., second, :] - robots.position[..., first, :]
        a, b = robots.heading[..., first, :], robots.heading[..., second, :]
        between = offset * reciprocal(norm(offset[..., 0], offset[..., 1]))[..., None]
        axes = np.stack([a, _left(a), b, _left(b), between], axis=-2)
        along = (axes * offset[..., None, :]).sum(axis=-1)
        axes = np.where(along < 0.0, np.float32(-1.0), np.float32(1.0))[..., None] * axes
        gaps = np.abs(along) - self._extents(first, a, axes) - self._extents(second, b, axes)
        best = np.argmax(gaps, axis=-1)[..., None]
        gap = np.take_along_axis(gaps, best, axis=-1)[..., 0]
        normal = np.take_along_axis(axes, best[..., None], axis=-2)[..., 0, :]
        of_first = robots.position[..., first, :] + self._support(first, a, normal)
        of_second = robots.position[..., second, :] + self._support(second, b, -normal)
        point = np.where(best < 2, of_second, of_first)  # a corner meets the other robot's face
        return Separation(gap, normal, point)

    def _extents(self, robots: Indices, heading: Floats, axes: Floats) -> Floats:
        """Half the lengths (..., pairs, axes) of the outlines' projections, m."""
        ahead = np.abs((axes * heading[..., None, :]).sum(axis=-1))
        aside = np.abs((axes * _left(heading)[..., None, :]).sum(axis=-1))
        factor = np.where(self.square[robots][:, None], ahead + aside, np.float32(1.0))
        extents: Floats = self.size[robots][:, None] * factor
        return extents

    def _support(self, robots: Indices, heading: Floats, direction: Floats) -> Floats:
        """Offset (..., pairs, 2) of the outlines' farthest point in a direction, m.

        It is the middle of a face that is at right angles to the direction.
        """
        left = _left(heading)
        ahead = np.clip((direction * heading).sum(axis=-1) / _CORNER, -1.0, 1.0)[..., None]
        aside = np.clip((direction * left).sum(axis=-1) / _CORNER, -1.0, 1.0)[..., None]
        corner = ahead * heading + aside * left
        chosen = np.where(self.square[robots][:, None], corner, direction)
        support: Floats = self.size[robots][:, None] * chosen
        return support


@lru_cache(maxsize=32)
def outlines_of(config: SimConfig) -> Outlines:
    """Return the outlines of the robots of a configuration, computed once.

    Args:
        config: robots and ball.
    """
    return Outlines(config)


def _left(vectors: Floats) -> Floats:
    """Vectors (..., 2) turned by 90 degrees counterclockwise."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)

"""Vectors in the plane on batched arrays."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats

XY = tuple[Floats, Floats]
"""x and y of points (m) or vectors, one array each, usually (n, robots)."""

TINY: Final = np.float32(1e-6)
"""Lower bound of divisors: m or m²."""

FAR: Final = np.float32(100.0)
"""Coordinate or distance beyond everything on any field, m."""


def norm(x: Floats, y: Floats) -> Floats:
    """Return the Euclidean lengths of vectors (x, y).

    The result does not depend on the batch; `np.hypot` and `np.linalg.norm` are slower.

    Args:
        x: first components, any shape.
        y: second components, of the same shape.
    """
    lengths: Floats = np.sqrt(x * x + y * y)
    return lengths


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
    scale = reciprocal(norm(x, y), TINY)
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


def rotate_into_body(x: Floats, y: Floats, heading: Floats) -> XY:
    """Return the components of vectors ahead of robots and to their left.

    Args:
        x: (...) components along x.
        y: (...) components along y.
        heading: (..., 2) cosine and sine of the robots' headings.

    Returns:
        Components ahead and to the left, (...) each.
    """
    return rotate_into(x, y, heading[..., 0], heading[..., 1])

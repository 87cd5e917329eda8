"""Free places of the field: where a ball or a robot can be put beside other robots."""

import numpy as np

from rsoccer.arrays import Floats, Mask


def is_free(positions: Floats, robots: Floats, clearance: float) -> Mask:
    """Return the positions that are clear of robots.

    Args:
        positions: (..., m, 2) positions, m.
        robots: (..., r, 2) positions of robots, m.
        clearance: least distance to the center of a robot, m.

    Returns:
        (..., m).
    """
    offset = positions[..., :, None, :] - robots[..., None, :, :]
    squared = offset[..., 0] * offset[..., 0] + offset[..., 1] * offset[..., 1]
    least = np.float32(clearance)
    free: Mask = np.logical_not((squared < least * least).any(axis=-1))
    return free


def grid(max_x: float, max_y: float, spacing: float) -> Floats:
    """Return the positions of a grid that is symmetric about the center of the field.

    Args:
        max_x: greatest x, m.
        max_y: greatest y, m.
        spacing: distance between neighbors, m.

    Returns:
        (m, 2), from the corner of the greatest x and y to the opposite one, m.
    """
    x, y = (
        np.arange(int(greatest / spacing), -int(greatest / spacing) - 1, -1)
        for greatest in (max_x, max_y)
    )
    columns = np.repeat(x, len(y)), np.tile(y, len(x))
    return np.stack(columns, axis=-1).astype(np.float32) * np.float32(spacing)


def nearest(positions: Floats, free: Mask, target: Floats) -> Floats:
    """Return the free position that is nearest to a target, the first of several.

    Args:
        positions: (m, 2) positions, m.
        free: (m,) whether they are free; at least one is.
        target: (2,) target, m.

    Returns:
        (2,) position, m.
    """
    offset = positions - target
    squared = offset[:, 0] * offset[:, 0] + offset[:, 1] * offset[:, 1]
    squared[~free] = np.inf
    position: Floats = positions[np.argmin(squared)]
    return position

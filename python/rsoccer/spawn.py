"""Random initial states: positions without overlap, headings and velocities.

Each world draws from its own random stream only, so its start does not depend on the number of
worlds.
"""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from rsoccer._core import BallModel, Field, SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import BallColumns, Frame
from rsoccer.rng import WorldRng

Box = tuple[Sequence[float] | Floats, Sequence[float] | Floats]
"""Lower and upper corner (x, y) of a rectangle, m."""

MAX_DRAWS: Final = 1000
"""Draws per world before the search for positions fails."""
FRESH_DRAWS: Final = 50
"""Draws after which all discs of a world are drawn anew, and not only those that are rejected."""
MARGIN: Final = 1e-3
"""Meters added to each radius, for differences in rounding between float32 and the simulator."""


def random_frame(rng: WorldRng, config: SimConfig, min_distance: float) -> Frame:
    """Draw a frame with ball and robots at rest anywhere in the field, with random headings.

    Args:
        rng: (n,) random streams.
        config: field, ball and robots.
        min_distance: least distance between centers, m; robots and ball never overlap.

    Returns:
        A frame of n worlds.

    Raises:
        ValueError: no free positions were found.
    """
    frame = Frame.empty(len(rng), config.n_blue, config.n_yellow)
    radii = [config.ball.radius, *(robot.bounding_radius for robot in config.robots)]
    drawn = positions(rng, config.field, radii, min_distance)
    frame.ball.position[:] = drawn[:, 0]
    frame.robots.position[:] = drawn[:, 1:]
    frame.robots.heading[:] = headings(rng, config.n_robots)
    return frame


def positions(
    rng: WorldRng, field: Field, radii: Sequence[float], min_distance: float = 0.0
) -> Floats:
    """Draw positions of discs in the field that overlap neither each other nor the walls.

    The blocks in the corners of a VSSS field count as walls. Rejection sampling: discs that do not
    fit are drawn again, in their world only.

    Args:
        rng: (n,) random streams.
        field: limits of the positions.
        radii: radius of each disc, m.
        min_distance: least distance between centers, m.

    Returns:
        (n, len(radii), 2) positions, m.

    Raises:
        ValueError: no free positions were found in `MAX_DRAWS` draws.
    """
    radius = np.asarray(radii, np.float32) + np.float32(MARGIN)
    box = np.array([field.half_length, field.half_width], np.float32) - radius[:, None]
    # The face of a corner block is the line |x| + |y| = const at 45 degrees, hence the root of 2.
    diagonal = field.half_length + field.half_width - field.corner_leg - np.float32(2**0.5) * radius

    def in_corner(drawn: Floats) -> Mask:
        beyond: Mask = np.abs(drawn[..., 0]) + np.abs(drawn[..., 1]) > diagonal
        return beyond

    region = f"in a field of {field.length} x {field.width} m"
    return _rejection_sample(rng, (-box, box), radii, min_distance, in_corner, region)


def positions_in_box(
    rng: WorldRng,
    box: Box,
    radii: Sequence[float],
    min_distance: float = 0.0,
    forbidden: Callable[[Floats], Mask] | None = None,
) -> Floats:
    """Draw positions of discs with their centers in a rectangle, without overlap.

    Args:
        rng: (n,) random streams.
        box: lower and upper corner of the rectangle, m, for all discs (2,) or each (len(radii), 2).
        radii: radius of each disc, m.
        min_distance: least distance between centers, m.
        forbidden: maps positions (n, len(radii), 2) to a mask (n, len(radii)) of those to reject;
            None allows all.

    Returns:
        (n, len(radii), 2) positions, m.

    Raises:
        ValueError: no free positions were found in `MAX_DRAWS` draws.
    """
    shape = (len(radii), 2)
    corners = tuple(np.broadcast_to(np.asarray(corner, np.float32), shape) for corner in box)
    rejected = forbidden or (lambda drawn: np.zeros(drawn.shape[:2], np.bool_))
    region = f"between {tuple(box[0])} and {tuple(box[1])} m"
    return _rejection_sample(rng, (corners[0], corners[1]), radii, min_distance, rejected, region)


def headings(rng: WorldRng, robots: int) -> Floats:
    """Draw uniform headings.

    Args:
        rng: (n,) random streams.
        robots: number of robots in each world.

    Returns:
        (n, robots, 2) cosine and sine.
    """
    angle = rng.uniform(-np.pi, np.pi, (robots,))
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def velocities(rng: WorldRng, max_speed: float) -> Floats:
    """Draw velocities with uniform direction and uniform speed.

    Args:
        rng: (n,) random streams.
        max_speed: upper bound of the speed, m/s.

    Returns:
        (n, 2) velocities, m/s.
    """
    speed = rng.uniform(0.0, max_speed)
    return speed[:, None] * headings(rng, 1)[:, 0]


def set_rolling_spin(ball: BallColumns, model: BallModel) -> None:
    """Set the spin of balls on the floor to rolling without slip; with no spin a ball slides first.

    Args:
        ball: balls (...), whose velocity is read and whose spin is overwritten.
        model: gives the radius.
    """
    per_meter = np.float32(1.0 / model.radius)
    ball.spin[..., 0] = -ball.velocity[..., 1] * per_meter
    ball.spin[..., 1] = ball.velocity[..., 0] * per_meter


def _rejection_sample(
    rng: WorldRng,
    box: tuple[Floats, Floats],
    radii: Sequence[float],
    min_distance: float,
    forbidden: Callable[[Floats], Mask],
    region: str,
) -> Floats:
    """Positions (n, discs, 2) in boxes (discs, 2), redrawn until none is rejected.

    A world draws in each turn in which one of its discs is rejected, so its positions follow from
    its own stream alone.
    """
    radius = np.asarray(radii, np.float32) + np.float32(MARGIN)
    distances = np.maximum(radius[:, None] + radius, np.float32(min_distance))
    distances = np.tril(distances, -1)  # of two discs that are too close, the later is redrawn
    drawn = _uniform(rng, box)
    for draw in range(1, MAX_DRAWS + 1):
        rejected = _too_close(drawn, distances) | forbidden(drawn)
        worlds = np.flatnonzero(rejected.any(axis=1))
        if not len(worlds):
            return drawn
        if draw % FRESH_DRAWS == 0:  # the earlier discs may leave no room for the later ones
            rejected[worlds] = True
        streams = rng[worlds]
        drawn[worlds] = np.where(rejected[worlds, :, None], _uniform(streams, box), drawn[worlds])
        rng.put(worlds, streams)
    raise ValueError(
        f"no free positions for {len(radii)} discs of radii {list(radii)} m, "
        f"{min_distance} m apart, {region}"
    )


def _uniform(rng: WorldRng, box: tuple[Floats, Floats]) -> Floats:
    low, high = box
    middle, half = (low + high) * np.float32(0.5), (high - low) * np.float32(0.5)
    return middle + rng.uniform(-1.0, 1.0, low.shape) * half


def _too_close(drawn: Floats, distances: Floats) -> Mask:
    """Mask (n, discs) of the discs that are too close to an earlier one."""
    x, y = drawn[..., 0], drawn[..., 1]
    d_x = x[:, :, None] - x[:, None, :]
    d_y = y[:, :, None] - y[:, None, :]
    close = np.less(d_x * d_x + d_y * d_y, distances * distances)
    too_close: Mask = close.any(axis=2)
    return too_close

"""Starts: where things are when an episode begins. Each world draws from its own stream only."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer._core import BallModel, Field
from rsoccer.frame import BallColumns, Floats, Mask
from rsoccer.rng import WorldRng

TRIES: Final = 1000
MARGIN: Final = 1e-3  # metres; what float32 and the simulator may see differently


def apart(rng: WorldRng, field: Field, radii: Sequence[float], min_distance: float = 0.0) -> Floats:
    """Random places (n, things, 2) in the field for things of these radii, metres.

    Centres are `min_distance` apart or more, nothing touches, and all keep clear of the walls
    and of the blocks in the corners. What does not fit is drawn again, in that world only.
    """
    radius = np.asarray(radii, np.float32) + np.float32(MARGIN)
    box = np.array([field.half_length, field.half_width], np.float32) - radius[:, None]
    gaps = np.maximum(radius[:, None] + radius, np.float32(min_distance))
    # A block's face is the line |x| + |y| = const at 45 degrees, hence the root of two.
    reach = field.half_length + field.half_width - field.corner - np.float32(2**0.5) * radius
    gaps = np.tril(gaps, -1)  # of two that are too close, the later one is drawn again
    places = _draw(rng, box)
    for _ in range(TRIES):
        bad = _misplaced(places, gaps, reach)
        worlds = np.flatnonzero(bad.any(axis=1))
        if not len(worlds):
            return places
        part = rng[worlds]
        places[worlds] = np.where(bad[worlds, :, None], _draw(part, box), places[worlds])
        rng.put(worlds, part)
    raise ValueError(
        f"no room for {len(radii)} things of radii {list(radii)} m, {min_distance} m apart, "
        f"in a field of {field.length} x {field.width} m"
    )


def headings(rng: WorldRng, robots: int) -> Floats:
    """Random directions (n, robots, 2): cosine and sine."""
    angle = rng.uniform(-np.pi, np.pi, (robots,))
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def velocities(rng: WorldRng, top_speed: float) -> Floats:
    """Random velocities (n, 2), m/s: any direction, any speed up to `top_speed`."""
    speed = rng.uniform(0.0, top_speed)
    return speed[:, None] * headings(rng, 1)[:, 0]


def roll(ball: BallColumns, model: BallModel) -> None:
    """Give balls that move along the floor the spin of rolling; without it they slide first."""
    per_metre = np.float32(1.0 / model.radius)
    ball.spin[..., 0] = -ball.velocity[..., 1] * per_metre
    ball.spin[..., 1] = ball.velocity[..., 0] * per_metre


def _draw(rng: WorldRng, box: Floats) -> Floats:
    return rng.uniform(-1.0, 1.0, box.shape) * box


def _misplaced(places: Floats, gaps: Floats, reach: Floats) -> Mask:
    """(n, things) which are too close to an earlier one, or in a corner."""
    x, y = places[..., 0], places[..., 1]
    across = x[:, :, None] - x[:, None, :]
    along = y[:, :, None] - y[:, None, :]
    close = across * across + along * along < gaps * gaps
    cornered = np.abs(x) + np.abs(y) > reach
    return close.any(axis=2) | cornered

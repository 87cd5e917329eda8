"""Starts: where things are when an episode begins. Each world draws from its own stream only."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from rsoccer._core import BallModel, Field, SimConfig
from rsoccer.frame import BallColumns, Floats, Frame, Mask
from rsoccer.rng import WorldRng

TRIES: Final = 1000
Box = tuple[Sequence[float] | Floats, Sequence[float] | Floats]

MARGIN: Final = 1e-3  # metres; what float32 and the simulator may see differently


def anywhere(rng: WorldRng, config: SimConfig, min_distance: float) -> Frame:
    """Ball and robots at rest anywhere in the field, apart; robots face anywhere."""
    frame = Frame.empty(len(rng), config.n_blue, config.n_yellow)
    radii = [config.ball.radius, *(robot.bounding_radius for robot in config.robots)]
    places = apart(rng, config.field, radii, min_distance)
    frame.ball.position[:] = places[:, 0]
    frame.robots.position[:] = places[:, 1:]
    frame.robots.heading[:] = headings(rng, config.n_robots)
    return frame


def apart(rng: WorldRng, field: Field, radii: Sequence[float], min_distance: float = 0.0) -> Floats:
    """Random places (n, things, 2) in the field for things of these radii, metres.

    Centres are `min_distance` apart or more, nothing touches, and all keep clear of the walls
    and of the blocks in the corners. What does not fit is drawn again, in that world only.
    """
    radius = np.asarray(radii, np.float32) + np.float32(MARGIN)
    box = np.array([field.half_length, field.half_width], np.float32) - radius[:, None]
    # A block's face is the line |x| + |y| = const at 45 degrees, hence the root of two.
    reach = field.half_length + field.half_width - field.corner - np.float32(2**0.5) * radius

    def cornered(places: Floats) -> Mask:
        beyond: Mask = np.abs(places[..., 0]) + np.abs(places[..., 1]) > reach
        return beyond

    where = f"in a field of {field.length} x {field.width} m"
    return _scattered(rng, (-box, box), radii, min_distance, cornered, where)


def inside(
    rng: WorldRng,
    box: Box,
    radii: Sequence[float],
    min_distance: float = 0.0,
    forbidden: Callable[[Floats], Mask] | None = None,
) -> Floats:
    """Random places (n, things, 2) of things of these radii in a box, metres.

    `box` is its least and its greatest corner; `forbidden` says of places (n, things, 2) which are
    not allowed (n, things). Otherwise as `apart`.
    """
    shape = (len(radii), 2)
    corners = tuple(np.broadcast_to(np.asarray(corner, np.float32), shape) for corner in box)
    none = forbidden or (lambda places: np.zeros(places.shape[:2], np.bool_))
    where = f"between {tuple(box[0])} and {tuple(box[1])} m"
    return _scattered(rng, (corners[0], corners[1]), radii, min_distance, none, where)


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


def _scattered(
    rng: WorldRng,
    box: tuple[Floats, Floats],
    radii: Sequence[float],
    min_distance: float,
    forbidden: Callable[[Floats], Mask],
    where: str,
) -> Floats:
    """Places (n, things, 2) in boxes (things, 2), drawn until nothing is misplaced."""
    radius = np.asarray(radii, np.float32) + np.float32(MARGIN)
    gaps = np.maximum(radius[:, None] + radius, np.float32(min_distance))
    gaps = np.tril(gaps, -1)  # of two that are too close, the later one is drawn again
    places = _draw(rng, box)
    for _ in range(TRIES):
        bad = _too_close(places, gaps) | forbidden(places)
        worlds = np.flatnonzero(bad.any(axis=1))
        if not len(worlds):
            return places
        part = rng[worlds]
        places[worlds] = np.where(bad[worlds, :, None], _draw(part, box), places[worlds])
        rng.put(worlds, part)
    raise ValueError(
        f"no room for {len(radii)} things of radii {list(radii)} m, {min_distance} m apart, {where}"
    )


def _draw(rng: WorldRng, box: tuple[Floats, Floats]) -> Floats:
    low, high = box
    middle, half = (low + high) * np.float32(0.5), (high - low) * np.float32(0.5)
    return middle + rng.uniform(-1.0, 1.0, low.shape) * half


def _too_close(places: Floats, gaps: Floats) -> Mask:
    """(n, things) which are too close to an earlier one."""
    x, y = places[..., 0], places[..., 1]
    across = x[:, :, None] - x[:, None, :]
    along = y[:, :, None] - y[:, None, :]
    close = np.less(across * across + along * along, gaps * gaps)
    too_close: Mask = close.any(axis=2)
    return too_close

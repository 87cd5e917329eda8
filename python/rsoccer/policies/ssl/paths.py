"""Ways round robots that stand: where to drive next so as not to touch them."""

from typing import Final

import numpy as np

from rsoccer._core import Field
from rsoccer.frame import Floats, length
from rsoccer.policies.vectors import inverse
from rsoccer.view import View

FAR: Final = np.float32(100.0)  # metres; where robots are that are not there
DEAR: Final = np.float32(20.0)  # metres of detour that a metre too near to something is worth
WIDER: Final = np.float32(1.15)  # of the distance to keep: where corners of ways are
CORNERS: Final = 8  # places round each robot that a way may turn at

_ANGLES = np.arange(CORNERS) * (2.0 * np.pi / CORNERS)
_CIRCLE: Final = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1).astype(np.float32)


class Ground:
    """Where a robot's centre may be: a box, less an area before the goal that it attacks."""

    def __init__(self, low: tuple[float, float], high: tuple[float, float]) -> None:
        """Least and greatest x and y, metres; no area."""
        self.low, self.high = np.array(low, np.float32), np.array(high, np.float32)
        self.area_x, self.area_y = FAR, np.float32(0.0)

    @classmethod
    def field(cls, field: Field, room: float) -> "Ground":
        """The whole field, `room` metres inside its lines."""
        far = (field.half_length - room, field.half_width - room)
        return cls((-far[0], -far[1]), far)

    def without_area(self, field: Field, room: float) -> "Ground":
        """The same, keeping `room` metres from the area before the goal."""
        self.area_x = np.float32(field.half_length - field.goal_area_depth - room)
        self.area_y = np.float32(field.goal_area_width / 2 + room)
        return self

    def outside(self, x: Floats, y: Floats) -> Floats:
        """Metres by which places are not inside."""
        over = np.maximum(self.low[0] - x, x - self.high[0])
        over = np.maximum(over, np.maximum(self.low[1] - y, y - self.high[1]))
        over = np.maximum(over, np.minimum(x - self.area_x, self.area_y - np.abs(y)))
        missing: Floats = np.maximum(over, np.float32(0.0))
        return missing

    def inside(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """The nearest places in the box, and out of the area by its front or its nearer side."""
        x = np.minimum(np.maximum(x, self.low[0]), self.high[0])
        y = np.minimum(np.maximum(y, self.low[1]), self.high[1])
        deep, beside = x - self.area_x, self.area_y - np.abs(y)
        within = np.minimum(deep, beside) > 0.0
        x = np.where(within & (deep <= beside), self.area_x, x)
        return x, np.where(within & (deep > beside), np.copysign(self.area_y, y), y)

    def through_area(self, a: tuple[Floats, Floats], b: tuple[Floats, Floats]) -> Floats:
        """Metres of the ways from `a` to `b` that lie in the area."""
        way_x, way_y = b[0] - a[0], b[1] - a[1]
        per_x = np.copysign(inverse(np.abs(way_x)), way_x)
        per_y = np.copysign(inverse(np.abs(way_y)), way_y)
        xs = (self.area_x - a[0]) * per_x, (FAR + FAR - a[0]) * per_x
        ys = (-self.area_y - a[1]) * per_y, (self.area_y - a[1]) * per_y
        enter = np.maximum(np.minimum(*xs), np.maximum(np.minimum(*ys), np.float32(0.0)))
        leave = np.minimum(np.maximum(*xs), np.minimum(np.maximum(*ys), np.float32(1.0)))
        part: Floats = np.maximum(leave - enter, np.float32(0.0)) * length(way_x, way_y)
        return part


def others(view: View, *, teammates: bool = True) -> tuple[Floats, Floats]:
    """Where all others are, (n, robots, others) x and y; far away where there is none."""
    first = 1 if teammates else 1 + view.n_teammates
    there = view.present[:, first:]
    at = view.robots.position[:, :, first:]
    x, y = np.where(there, at[..., 0], FAR), np.where(there, at[..., 1], FAR)
    if not x.shape[2]:
        x = y = np.full((*x.shape[:2], 1), FAR, np.float32)
    return x, y


def clearance(a: tuple[Floats, Floats], b: tuple[Floats, Floats], x: Floats, y: Floats) -> Floats:
    """Least distance of places x, y (..., k) to the straight ways from `a` to `b` (...)."""
    way_x, way_y = (b[0] - a[0])[..., None], (b[1] - a[1])[..., None]
    to_x, to_y = x - a[0][..., None], y - a[1][..., None]
    per = inverse(way_x * way_x + way_y * way_y)
    share = np.minimum(np.maximum((to_x * way_x + to_y * way_y) * per, 0.0), 1.0)
    least: Floats = length(to_x - share * way_x, to_y - share * way_y).min(axis=-1)
    return least


def around(
    ego: Floats, x: Floats, y: Floats, things: tuple[Floats, Floats, Floats], ground: Ground
) -> tuple[Floats, Floats, Floats]:
    """Where to drive next on the way to x, y (n, robots): at once, or past one corner.

    `things` are x, y and the distance to keep from each, (n, robots, things). The third is how
    far it is in all.
    """
    mine = ego[..., 0], ego[..., 1]
    turn_x, turn_y = _corners(x, y, things, ground)
    start = mine[0][..., None], mine[1][..., None]
    end = x[..., None], y[..., None]
    far = length(turn_x - start[0], turn_y - start[1]) + length(turn_x - end[0], turn_y - end[1])
    turn = turn_x, turn_y
    near = np.maximum(_too_near(start, turn, things), _too_near(turn, end, things))
    near = near + ground.outside(*turn) + ground.through_area(start, turn)
    near = near + ground.through_area(turn, end)
    best = np.argmin(far + DEAR * near, axis=-1)[..., None]
    chosen = (np.take_along_axis(part, best, -1)[..., 0] for part in (turn_x, turn_y, far))
    next_x, next_y, distance = chosen
    return next_x, next_y, distance


def _corners(
    x: Floats, y: Floats, things: tuple[Floats, Floats, Floats], ground: Ground
) -> tuple[Floats, Floats]:
    """Where ways may turn, (n, robots, places): the target itself, round things and the area."""
    shape = (*x.shape, -1)
    radius = things[2][..., None] * WIDER
    round_x = (things[0][..., None] + radius * _CIRCLE[:, 0]).reshape(shape)
    round_y = (things[1][..., None] + radius * _CIRCLE[:, 1]).reshape(shape)
    front = np.broadcast_to(np.minimum(ground.area_x, ground.high[0]), x.shape)[..., None]
    side = np.broadcast_to(ground.area_y, x.shape)[..., None]
    turn_x = np.concatenate([x[..., None], front, front, round_x], axis=-1)
    return turn_x, np.concatenate([y[..., None], side, -side, round_y], axis=-1)


def _too_near(
    a: tuple[Floats, Floats], b: tuple[Floats, Floats], things: tuple[Floats, Floats, Floats]
) -> Floats:
    """Metres by which ways (n, robots, places) come too near to any of the things."""
    x, y, keep = (part[:, :, None] for part in things)
    way_x, way_y = (b[0] - a[0])[..., None], (b[1] - a[1])[..., None]
    to_x, to_y = x - a[0][..., None], y - a[1][..., None]
    per = inverse(way_x * way_x + way_y * way_y)
    share = np.minimum(np.maximum((to_x * way_x + to_y * way_y) * per, 0.0), 1.0)
    missing = keep - length(to_x - share * way_x, to_y - share * way_y)
    most: Floats = np.maximum(missing.max(axis=-1), np.float32(0.0))
    return most

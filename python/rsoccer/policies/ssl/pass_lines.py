"""Lines of passes: how far opponents are from them, and the speed of a kick along them."""

from typing import Final

import numpy as np

from rsoccer._core import BallModel
from rsoccer.arrays import Floats
from rsoccer.policies.rolling import RollingLaw
from rsoccer.policies.ssl.path_planning import segment_distance
from rsoccer.vectors import XY, norm

REACH_PER_METER: Final = np.float32(0.4)
"""Distance that an opponent covers while a pass goes a meter, m."""


class PassSpeed:
    """Speed of a flat kick that arrives at a distance with a speed."""

    def __init__(self, ball: BallModel) -> None:
        """Read the numbers of a ball.

        Args:
            ball: ball with the floor that it rolls on.
        """
        self._ratio = ball.slide_to_roll_ratio
        # A kicked ball slides until its speed is the rolling share of the kick: v² = k² - 2 d s.
        self._slides = np.float32((1.0 - self._ratio**2) / (2.0 * ball.sliding_deceleration))
        self._rolling = RollingLaw(ball)

    def kick(self, distance: Floats, arrival: Floats) -> Floats:
        """Return the speed of a kick, m/s.

        Args:
            distance: way of the ball, m, of any shape.
            arrival: speed on arrival, m/s.
        """
        return self._rolling.kick_speed(distance, arrival, self._ratio, self._slides)


def openness(
    start: XY, end: XY, opponents: XY, reach: Floats | np.float32 = REACH_PER_METER
) -> Floats:
    """Return how open passes are: the distance that opponents lack to reach their lines, m.

    An opponent far along the line has more time to get there. Negative values are lines that it
    reaches before the ball.

    Args:
        start: (n, robots, 1) starts of the passes, m.
        end: (n, robots, k) ends of the passes, m.
        opponents: (n, robots, o) positions of opponents, m.
        reach: way of an opponent for each m of the ball's, which broadcasts to (n, robots, k, o).

    Returns:
        (n, robots, k) meters, over all opponents the least.
    """
    x, y = (part[:, :, None] for part in opponents)
    starts = np.broadcast_to(start[0], end[0].shape), np.broadcast_to(start[1], end[1].shape)
    distance = segment_distance(starts, end, x, y)
    along = norm(x - starts[0][..., None], y - starts[1][..., None])
    length = norm(end[0] - starts[0], end[1] - starts[1])[..., None]
    gap: Floats = (distance - reach * np.minimum(along, length)).min(axis=-1)
    return gap

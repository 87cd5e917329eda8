"""The law of a rolling ball, as scripts predict it."""

from typing import Final

import numpy as np

from rsoccer._core import BallModel
from rsoccer.arrays import Array, Floats
from rsoccer.vectors import TINY

NEWTON_STEPS: Final = 4  # of the speed of a kick: each squares the relative error


class RollingLaw:
    """Deceleration of a rolling ball: a constant, and a drag that grows with the speed."""

    def __init__(self, ball: BallModel) -> None:
        """Read the numbers.

        Args:
            ball: ball with the floor that it rolls on.
        """
        self.deceleration = np.maximum(np.float32(ball.rolling_deceleration), TINY)
        """At rest, m/s²."""
        self.drag = np.float32(ball.rolling_drag)
        """By speed, 1/s."""

    def slowing(
        self, speed: Floats, seconds: Floats | np.float32
    ) -> tuple[Floats | np.float32, Floats]:
        """Return how far a ball stays behind one without friction.

        Args:
            speed: speed of the ball, m/s, of any shape.
            seconds: time ahead, s.

        Returns:
            The time until then or until the ball stops, s, and the distance, m.
        """
        if self.drag == 0:
            seconds = np.minimum(seconds, speed / self.deceleration)
            behind: Floats = np.float32(0.5) * self.deceleration * seconds * seconds
            return seconds, behind
        seconds = np.minimum(seconds, np.log1p(self.drag * speed / self.deceleration) / self.drag)
        fade = np.float64(self.drag) * seconds
        way = (speed + self.deceleration / self.drag) * -np.expm1(-fade) / self.drag
        way -= self.deceleration / self.drag * seconds
        return seconds, np.asarray(speed * seconds - way, np.float32)

    def kick_speed(
        self, distance: Floats, arrival: Floats, slide_to_roll_ratio: float, slides: np.float32
    ) -> Floats:
        """Return the speed of a kick that arrives at a distance with a speed, m/s.

        Args:
            distance: distance, m, of any shape.
            arrival: speed on arrival, m/s.
            slide_to_roll_ratio: share of the kick's speed at which the ball rolls.
            slides: distance that it slides before, m, by the square of the kick's speed, m²/s².
        """
        twice = np.float32(2.0 * self.deceleration)
        share = np.float32(slide_to_roll_ratio**2)
        square = arrival * arrival + twice * distance
        kick: Floats = np.sqrt(square / (share + twice * slides))
        if self.drag == 0:
            return kick
        goal, exact = distance + self._way(arrival), kick.astype(np.float64)
        for _ in range(NEWTON_STEPS):
            rolls = slide_to_roll_ratio * exact
            missing = goal - slides * exact * exact - self._way(rolls)
            slope = rolls / (self.deceleration + self.drag * rolls) * slide_to_roll_ratio
            exact += missing / (2 * slides * exact + slope)
        return exact.astype(np.float32)

    def _way(self, speed: Array | Floats) -> Array:
        """Distance (m) in which a ball with drag rolls to rest, in double precision."""
        drag = np.float64(self.drag)
        rest = self.deceleration / drag
        way: Array = (speed - rest * np.log1p(speed / rest)) / drag
        return way

"""Closed form of a rolling ball: dv/dt = -(deceleration + drag v), in double precision."""

from dataclasses import dataclass
from math import exp, log


@dataclass(frozen=True)
class Rolling:
    """Law of a rolling ball."""

    deceleration: float  # m/s²
    drag: float  # 1/s; 0 for a uniform deceleration

    def stop_time(self, speed: float) -> float:
        """Return the time (s) until a ball of a speed (m/s) stops."""
        if self.drag == 0:
            return speed / self.deceleration
        return log(1 + self.drag * speed / self.deceleration) / self.drag

    def distance(self, first: float, last: float) -> float:
        """Return the distance (m) in which the ball slows from one speed to another (m/s)."""
        if self.drag == 0:
            return (first**2 - last**2) / (2 * self.deceleration)
        rest = self.deceleration / self.drag
        return (first - last - rest * log((rest + first) / (rest + last))) / self.drag

    def speed_at(self, speed: float, distance: float) -> float | None:
        """Return the speed (m/s) after a distance (m); None if the ball stops before."""
        if self.distance(speed, 0.0) <= distance:
            return None
        slow, fast = 0.0, speed
        for _ in range(60):  # bisection: the further, the slower
            middle = (slow + fast) / 2
            slow, fast = (
                (middle, fast) if self.distance(speed, middle) > distance else (slow, middle)
            )
        return slow

    def after(self, speed: float, time: float) -> tuple[float, float]:
        """Return distance (m) and speed (m/s) after a time (s) before the ball stops."""
        if self.drag == 0:
            slower = speed - self.deceleration * time
            return (speed + slower) / 2 * time, slower
        rest = self.deceleration / self.drag
        slower = (speed + rest) * exp(-self.drag * time) - rest
        return (speed - slower) / self.drag - rest * time, slower

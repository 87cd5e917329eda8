"""Closed forms of a ball on the floor, in the air and bouncing, in double precision."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from rsoccer.arrays import Array
from tools.physics.cited import SOLID_SPHERE, Ball, G
from tools.physics.rolling import Rolling


@dataclass(frozen=True)
class StraightKick:
    """Straight kick without spin: the ball slides, then rolls with a smaller deceleration."""

    ball: Ball
    kick: float  # m/s

    @property
    def rolling_speed(self) -> float:
        """Speed at the start of rolling, m/s."""
        return self.ball.slide_to_roll_ratio * self.kick

    @property
    def slide_time(self) -> float:
        """Duration of sliding, s."""
        return (self.kick - self.rolling_speed) / self.ball.sliding_deceleration

    @property
    def slide_distance(self) -> float:
        """Distance of sliding, m."""
        return (self.kick**2 - self.rolling_speed**2) / (2 * self.ball.sliding_deceleration)

    @property
    def rolling(self) -> Rolling:
        """The law of rolling."""
        return Rolling(self.ball.rolling_deceleration, self.ball.rolling_drag)

    @property
    def stop_time(self) -> float:
        """Time until the ball stops, s."""
        return self.slide_time + self.rolling.stop_time(self.rolling_speed)

    @property
    def stop_distance(self) -> float:
        """Stopping distance, m."""
        return self.slide_distance + self.rolling.distance(self.rolling_speed, 0.0)

    def speed_at(self, distance: float) -> float | None:
        """Return the speed (m/s) after a distance (m); None if the ball stops before."""
        if distance < self.slide_distance:
            return sqrt(self.kick**2 - 2 * self.ball.sliding_deceleration * distance)
        return self.rolling.speed_at(self.rolling_speed, distance - self.slide_distance)

    def after(self, time: float) -> tuple[float, float]:
        """Return distance (m) and speed (m/s) after a time (s)."""
        sliding = min(time, self.slide_time)
        speed = self.kick - self.ball.sliding_deceleration * sliding
        distance = (self.kick + speed) / 2 * sliding
        rolled, slower = self.rolling.after(speed, min(time, self.stop_time) - sliding)
        return distance + rolled, slower


def floor(ball: Ball, velocity: Array, spin: Array, time: float) -> tuple[Array, Array, Array]:
    """Return displacement (m), velocity (m/s) and spin (rad/s), each xyz, after a time (s).

    Friction opposes the slip of the ball's lowest point until the slip is zero. It changes velocity
    and surface speed such that a ball without spin starts to roll at its rolling share.
    """
    rim = np.array([spin[1], -spin[0], 0.0]) * ball.radius
    slip = velocity - rim
    slipping = float(np.linalg.norm(slip))
    gain = ball.slide_to_roll_ratio / (1 - ball.slide_to_roll_ratio)
    sliding = 0.0
    displacement = np.zeros(3)
    if slipping > 1e-9:
        sliding = min(time, slipping / (ball.sliding_deceleration * (1 + gain)))
        braking = slip / slipping * ball.sliding_deceleration
        displacement = velocity * sliding - braking * sliding**2 / 2
        velocity = velocity - braking * sliding
        rim = rim + braking * gain * sliding
    if (rolling := time - sliding) > 0:
        speed = float(np.linalg.norm(velocity))
        law = Rolling(ball.rolling_deceleration, ball.rolling_drag)
        distance, slower = law.after(speed, rolling)
        displacement = displacement + velocity / speed * distance
        rim = velocity = velocity / speed * slower
    about_z = np.sign(spin[2]) * max(abs(spin[2]) - ball.spin_deceleration * time, 0.0)
    return displacement, velocity, np.array([-rim[1] / ball.radius, rim[0] / ball.radius, about_z])


@dataclass(frozen=True)
class Surface:
    """Surface that the ball bounces off."""

    restitution: float
    friction: float  # friction coefficient
    inverse_mass: float = 0.0  # 1/kg, along the normal; 0 for a wall, above 0 for a robot
    inverse_mass_across: float = 0.0  # 1/kg, along the surface


def bounce(
    ball: Ball, surface: Surface, velocity: Array, spin: Array, normal: Array
) -> tuple[Array, Array]:
    """Return velocity (m/s) and spin (rad/s) after an impact on a surface at rest.

    Coulomb friction: the tangential impulse stops the slip of the contact point, limited to the
    friction coefficient times the normal impulse.
    """
    arm = -normal * ball.radius
    normal_impulse = (
        -(1 + surface.restitution) * (velocity @ normal) / (1 / ball.mass + surface.inverse_mass)
    )
    slip = velocity + np.cross(spin, arm)
    slip = slip - normal * (slip @ normal)
    slipping = float(np.linalg.norm(slip))
    inertia = SOLID_SPHERE * ball.mass * ball.radius**2
    stopping = slipping / (1 / ball.mass + ball.radius**2 / inertia + surface.inverse_mass_across)
    friction = min(stopping, surface.friction * normal_impulse)
    impulse = normal * normal_impulse - slip / max(slipping, 1e-12) * friction
    return velocity + impulse / ball.mass, spin + np.cross(arm, impulse) / inertia


def apex(rise: float) -> float:
    """Return the apex height (m) for a vertical speed (m/s)."""
    return rise**2 / (2 * G)


def rise_to(height: Array | float, time: float) -> Array:
    """Return the vertical speed (m/s) that leads to a height (m) after a time (s)."""
    rise: Array = np.asarray(height) / time + G * time / 2
    return rise

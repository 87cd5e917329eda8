"""Textbook mechanics of a ball on a floor, in the air and off a surface; in double precision."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from rsoccer.frame import Array
from tools.physics.cited import SOLID_SPHERE, Ball, G


@dataclass(frozen=True)
class RollOut:
    """A straight kick without spin: it slides, decelerating, then rolls, decelerating less."""

    ball: Ball
    kick: float  # m/s

    @property
    def rolls(self) -> float:
        """Speed at which it comes to roll, m/s."""
        return self.ball.rolling_share * self.kick

    @property
    def slide_time(self) -> float:
        """Length of the slide, s."""
        return (self.kick - self.rolls) / self.ball.sliding_deceleration

    @property
    def slide_way(self) -> float:
        """Length of the slide, m."""
        return (self.kick**2 - self.rolls**2) / (2 * self.ball.sliding_deceleration)

    @property
    def stop_time(self) -> float:
        """When it stops, s."""
        return self.slide_time + self.rolls / self.ball.rolling_deceleration

    @property
    def stop(self) -> float:
        """Where it stops, m."""
        return self.slide_way + self.rolls**2 / (2 * self.ball.rolling_deceleration)

    def speed_at(self, way: float) -> float | None:
        """Speed after so many metres; None where it does not get so far."""
        if way < self.slide_way:
            return sqrt(self.kick**2 - 2 * self.ball.sliding_deceleration * way)
        left = self.rolls**2 - 2 * self.ball.rolling_deceleration * (way - self.slide_way)
        return sqrt(left) if left > 0 else None

    def after(self, time: float) -> tuple[float, float]:
        """Way and speed at a time."""
        sliding = min(time, self.slide_time)
        speed = self.kick - self.ball.sliding_deceleration * sliding
        way = (self.kick + speed) / 2 * sliding
        rolling = min(time, self.stop_time) - sliding
        slower = speed - self.ball.rolling_deceleration * rolling
        return way + (speed + slower) / 2 * rolling, slower


def floor(ball: Ball, velocity: Array, spin: Array, time: float) -> tuple[Array, Array, Array]:
    """Way, velocity and spin (each x, y, z) of a ball on the floor after a time.

    Friction acts against the slip of the lowest point until there is none. It takes from the
    velocity and gives to the rim so that a ball without spin keeps its rolling share.
    """
    rim = np.array([spin[1], -spin[0], 0.0]) * ball.radius
    slip = velocity - rim
    slipping = float(np.linalg.norm(slip))
    gain = ball.rolling_share / (1 - ball.rolling_share)
    sliding = 0.0
    way = np.zeros(3)
    if slipping > 1e-9:
        sliding = min(time, slipping / (ball.sliding_deceleration * (1 + gain)))
        braking = slip / slipping * ball.sliding_deceleration
        way = velocity * sliding - braking * sliding**2 / 2
        velocity = velocity - braking * sliding
        rim = rim + braking * gain * sliding
    if (rolling := time - sliding) > 0:
        speed = float(np.linalg.norm(velocity))
        braking = velocity / speed * ball.rolling_deceleration
        way = way + velocity * rolling - braking * rolling**2 / 2
        velocity = velocity - braking * rolling
        rim = velocity
    about_z = np.sign(spin[2]) * max(abs(spin[2]) - ball.spin_deceleration * time, 0.0)
    return way, velocity, np.array([-rim[1] / ball.radius, rim[0] / ball.radius, about_z])


@dataclass(frozen=True)
class Surface:
    """What a ball bounces off. A robot gives way: along the normal and across it, 1/kg."""

    restitution: float
    friction: float
    yields: float = 0.0
    yields_across: float = 0.0


def bounce(
    ball: Ball, surface: Surface, velocity: Array, spin: Array, normal: Array
) -> tuple[Array, Array]:
    """Velocity and spin after an impact on a surface at rest, by Coulomb's law of friction.

    Friction stops the slip of the point of contact, or is the friction coefficient times the
    impulse along the normal if that is less.
    """
    arm = -normal * ball.radius
    pressing = -(1 + surface.restitution) * (velocity @ normal) / (1 / ball.mass + surface.yields)
    slip = velocity + np.cross(spin, arm)
    slip = slip - normal * (slip @ normal)
    slipping = float(np.linalg.norm(slip))
    inertia = SOLID_SPHERE * ball.mass * ball.radius**2
    stopping = slipping / (1 / ball.mass + ball.radius**2 / inertia + surface.yields_across)
    friction = min(stopping, surface.friction * pressing)
    impulse = normal * pressing - slip / max(slipping, 1e-12) * friction
    return velocity + impulse / ball.mass, spin + np.cross(arm, impulse) / inertia


def apex(rise: float) -> float:
    """Height that a vertical speed leads to, m."""
    return rise**2 / (2 * G)


def rise_to(height: Array | float, time: float) -> Array:
    """Vertical speed of what is so high after a time, m/s."""
    rise: Array = np.asarray(height) / time + G * time / 2
    return rise

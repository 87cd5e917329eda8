//! Bodies in the solver.

use crate::bodies::Acceleration;
use crate::body_parameters::InverseInertia;
use crate::geometry::motion::{Motion, rotated};
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::{Rotation, Vector};

/// A body or wall, on a straight path within a sub-step.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::engine) struct SolverBody {
    /// m.
    pub(in crate::engine) position: Vector,
    /// Cosine and sine of the heading.
    pub(in crate::engine) heading: Vector,
    /// m/s.
    pub(in crate::engine) velocity: Vector,
    /// rad/s.
    pub(in crate::engine) angular_velocity: f32,
    /// 1/kg, and 1/(kg m²); 0 for a wall.
    pub(in crate::engine) inverse_mass: f32,
    pub(in crate::engine) inverse_inertia: f32,
    /// Time, s, by which it gains its speed later than at the start of a sub-step.
    pub(in crate::engine) lag: f32,
}

impl SolverBody {
    pub(in crate::engine) fn of(motion: &Motion, inverse: InverseInertia) -> Self {
        Self {
            position: motion.position,
            heading: motion.heading,
            velocity: motion.velocity,
            angular_velocity: motion.angular_velocity,
            inverse_mass: inverse.mass,
            inverse_inertia: inverse.inertia,
            lag: 0.0,
        }
    }

    pub(in crate::engine) fn of_wall(place: &PlacedOutline) -> Self {
        Self {
            position: place.position,
            heading: Vector::new(place.heading.re, place.heading.im),
            velocity: Vector::ZERO,
            angular_velocity: 0.0,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            lag: 0.0,
        }
    }

    pub(in crate::engine) fn motion(&self) -> Motion {
        let Self { position, heading, velocity, angular_velocity, .. } = *self;
        Motion { position, heading, velocity, angular_velocity }
    }

    /// Outline of the body where it is.
    pub(in crate::engine) fn placed(&self, outline: Outline) -> PlacedOutline {
        let heading = Rotation { re: self.heading.x, im: self.heading.y };
        PlacedOutline { outline, position: self.position, heading }
    }

    /// Accelerates the body for `time` (s); with nothing within reach, it moves as if it gained its speed
    /// later by `lag` (s).
    pub(in crate::engine) fn accelerate(
        &mut self,
        acceleration: Acceleration,
        time: f32,
        lag: f32,
    ) {
        self.velocity += acceleration.linear * time;
        self.angular_velocity += acceleration.angular * time;
        self.lag = lag;
    }

    /// Notes that another body or a wall is within reach, against which a sub-step corrects its speed at the start.
    pub(super) fn come_within_reach(&mut self) {
        self.lag = 0.0;
    }

    /// Moves the body for `time` (s), to the end of which `acceleration` has changed its velocity.
    pub(in crate::engine) fn advance(&mut self, acceleration: Acceleration, time: f32) {
        self.position += (self.velocity - acceleration.linear * self.lag) * time;
        let angular_velocity = self.angular_velocity - acceleration.angular * self.lag;
        self.heading = rotated(self.heading, angular_velocity * time);
    }
}

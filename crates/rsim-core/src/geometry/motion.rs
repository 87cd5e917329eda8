//! Position and motion of a body in the plane.

use serde::{Deserialize, Serialize};

use crate::math::{Rotation, Vector};

/// Position and velocity of a body in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Motion {
    /// m.
    pub(crate) position: Vector,
    /// Cosine and sine of the heading.
    pub(crate) heading: Vector,
    /// m/s.
    pub(crate) velocity: Vector,
    /// Angular velocity, rad/s, counterclockwise.
    pub(crate) angular_velocity: f32,
}

impl Motion {
    /// A body at rest.
    pub(crate) fn at_rest(position: Vector, heading: Vector) -> Self {
        Self { position, heading, velocity: Vector::ZERO, angular_velocity: 0.0 }
    }

    /// Heading as a rotation.
    pub(crate) fn rotation(&self) -> Rotation {
        rotation(self.heading)
    }
}

/// The rotation of a heading, given as cosine and sine.
pub(crate) fn rotation(heading: Vector) -> Rotation {
    Rotation { re: heading.x, im: heading.y }
}

/// The unit vector in the direction of an angle, rad: the same on every platform.
pub(crate) fn direction(angle: f32) -> Vector {
    let (sin, cos) = libm::sincosf(angle);
    Vector::new(cos, sin)
}

/// A heading rotated by `angle`, a fraction of a radian, to first order as the solver rotates bodies.
pub(crate) fn rotated(heading: Vector, angle: f32) -> Vector {
    Vector::new(heading.x - angle * heading.y, heading.y + angle * heading.x).normalize()
}

//! State of the ball beyond the plane: height and spin.

use serde::{Deserialize, Serialize};

use crate::math::Vec3;

/// State of the ball that the planar engine does not have.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct BallState {
    /// Height of the lowest point, m.
    pub(crate) z: f32,
    /// Vertical velocity, m/s.
    pub(crate) v_z: f32,
    /// Spin about the field's axes, rad/s.
    pub(crate) spin: Vec3,
    /// Number of touch-downs since take-off.
    pub(crate) hops: u8,
}

impl BallState {
    /// Whether the ball lies on the floor, so that it meets other bodies in the plane.
    pub(crate) fn is_down(&self) -> bool {
        self.z <= 0.0 && self.v_z == 0.0
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.z.is_finite() && self.v_z.is_finite() && self.spin.is_finite()
    }
}

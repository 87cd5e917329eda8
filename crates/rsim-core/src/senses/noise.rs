//! Noise of detections that filters count with.

use crate::models::sensing::Sensing;

/// Least standard deviations, m and rad: cameras without noise leave rounding.
const MIN_DEVIATION: f32 = 0.000_3;
const MIN_HEADING_DEVIATION: f32 = 0.002;

/// Standard deviations of detections.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise {
    /// Of the ball in each direction, m.
    pub(super) ball: f32,
    /// Of robots in each direction, m.
    pub(super) robot: f32,
    /// Of headings, rad.
    pub(super) heading: f32,
}

impl Noise {
    /// The noise of some senses.
    pub(super) fn of(sensing: &Sensing) -> Self {
        Self {
            ball: sensing.ball_position_noise.max(MIN_DEVIATION),
            robot: sensing.robot_position_noise.max(MIN_DEVIATION),
            heading: sensing.heading_noise.max(MIN_HEADING_DEVIATION),
        }
    }
}

//! Constants of the world that the rules read: field, sizes of bodies, time step.

use serde::{Deserialize, Serialize};

use crate::lines::Lines;

/// Field, sizes of bodies and time step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pitch {
    /// Lines of the field.
    pub lines: Lines,
    /// Radius of a robot, m.
    pub robot_radius: f32,
    /// Radius of the ball, m.
    pub ball_radius: f32,
    /// Duration of a control step, s.
    pub time_step: f32,
}

impl Pitch {
    /// Control steps in a time of at least 0 s; rounded.
    #[allow(clippy::cast_possible_truncation)] // far below 2^31
    pub fn steps(&self, seconds: f32) -> i32 {
        (seconds / self.time_step + 0.5) as i32
    }

    /// Seconds in control steps.
    #[allow(clippy::cast_precision_loss)] // below 2^24
    pub fn seconds(&self, steps: i32) -> f32 {
        steps as f32 * self.time_step
    }
}

//! Commands of omnidirectional robots from actions, numbers in [-1, 1].

use crate::columns::OMNI_COLUMNS;
use crate::math::{Rotation, Vector};

/// Size of an action: velocity along two axes, angular velocity, kick (none up to 0), dribbler (off up to 0).
pub const ACTION_SIZE: usize = 5;

/// Mapping from actions to commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Steering {
    /// Commands at an action of 1: m/s, m/s, rad/s, m/s of a kick, dribbler speed from 0 to 1.
    pub scales: [f32; ACTION_SIZE],
    /// Whether velocities are along the axes of the field in the view of the robot's team; otherwise
    /// along the robot's own.
    pub field_frame: bool,
}

impl Steering {
    /// Writes the command of an action, in the order of [`OMNI_COLUMNS`], for a robot with this heading
    /// (cosine and sine) on the field. `rotated` says whether the robot's team views the field rotated by
    /// 180 degrees.
    ///
    /// # Panics
    /// If `action` or `out` has another length.
    pub fn command(&self, action: &[f32], heading: [f32; 2], rotated: bool, out: &mut [f32]) {
        assert_eq!((action.len(), out.len()), (ACTION_SIZE, OMNI_COLUMNS.len()), "sizes");
        let scaled = |index: usize| action[index] * self.scales[index];
        let mut velocity = Vector::new(scaled(0), scaled(1));
        if self.field_frame {
            let sign = if rotated { -1.0 } else { 1.0 };
            let facing = Rotation { re: heading[0] * sign, im: heading[1] * sign };
            velocity = facing.inverse() * velocity;
        }
        let dribbler = if action[4] > 0.0 { self.scales[4] } else { 0.0 };
        out.copy_from_slice(&[
            velocity.x,
            velocity.y,
            scaled(2),
            scaled(3).max(0.0),
            0.0,
            dribbler,
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIELD_FRAME: Steering =
        Steering { scales: [3.0, 3.0, 10.0, 6.5, 1.0], field_frame: true };

    fn command(
        steering: &Steering,
        action: [f32; 5],
        heading: [f32; 2],
        rotated: bool,
    ) -> Vec<f32> {
        let mut out = vec![f32::NAN; OMNI_COLUMNS.len()];
        steering.command(&action, heading, rotated, &mut out);
        out
    }

    #[test]
    fn a_robot_that_faces_left_drives_along_the_field_to_its_right() {
        let ahead = [1.0, 0.0, 0.1, -0.5, 0.0];
        for (heading, rotated) in [([0.0, 1.0], false), ([0.0, -1.0], true)] {
            assert_eq!(
                command(&FIELD_FRAME, ahead, heading, rotated),
                [0.0, -3.0, 1.0, 0.0, 0.0, 0.0]
            );
        }
        let own = Steering { field_frame: false, ..FIELD_FRAME };
        assert_eq!(command(&own, ahead, [0.0, 1.0], false), [3.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn kicks_and_the_dribbler_are_off_below_zero() {
        for (number, kick, dribbler) in [(-0.2, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 3.25, 1.0)] {
            let command = command(&FIELD_FRAME, [0.0, 0.0, 0.0, number, number], [1.0, 0.0], false);
            assert_eq!(command[3..], [kick, 0.0, dribbler]);
        }
    }
}

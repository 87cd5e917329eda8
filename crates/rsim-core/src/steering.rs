//! What actions, numbers in [-1, 1], ask of robots that are told their body's velocity.

use rapier2d::math::{Rotation, Vector};

use crate::columns::OMNI_COLUMNS;

/// Numbers of an action: velocity along two axes, turn rate, kick (none below 0), dribbler (off up
/// to 0).
pub const ACTION_SIZE: usize = 5;

/// What actions ask for.
#[derive(Debug, Clone, PartialEq)]
pub struct Steering {
    /// What a 1 asks for: m/s, m/s, rad/s, m/s of a kick, share of the dribbler's speed.
    pub scales: [f32; ACTION_SIZE],
    /// Whether velocities are along the axes of the field as the robot's side sees it; else along
    /// the robot's own.
    pub along_field: bool,
}

impl Steering {
    /// Writes the command, in the order of [`OMNI_COLUMNS`], that an action is for a robot with this
    /// heading (cosine and sine) on the field; `turned` if its side sees the field turned half round.
    ///
    /// # Panics
    /// When a slice has another length.
    pub fn command(&self, action: &[f32], heading: [f32; 2], turned: bool, out: &mut [f32]) {
        assert_eq!((action.len(), out.len()), (ACTION_SIZE, OMNI_COLUMNS.len()), "sizes");
        let asked = |index: usize| action[index] * self.scales[index];
        let mut velocity = Vector::new(asked(0), asked(1));
        if self.along_field {
            let sign = if turned { -1.0 } else { 1.0 };
            let facing = Rotation { re: heading[0] * sign, im: heading[1] * sign };
            velocity = facing.inverse() * velocity;
        }
        let dribbler = if action[4] > 0.0 { self.scales[4] } else { 0.0 };
        out.copy_from_slice(&[velocity.x, velocity.y, asked(2), asked(3).max(0.0), 0.0, dribbler]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALONG_FIELD: Steering =
        Steering { scales: [3.0, 3.0, 10.0, 6.5, 1.0], along_field: true };

    fn command(steering: &Steering, action: [f32; 5], heading: [f32; 2], turned: bool) -> Vec<f32> {
        let mut out = vec![f32::NAN; OMNI_COLUMNS.len()];
        steering.command(&action, heading, turned, &mut out);
        out
    }

    #[test]
    fn who_faces_the_own_left_drives_ahead_to_its_right() {
        let ahead = [1.0, 0.0, 0.1, -0.5, 0.0];
        for (heading, turned) in [([0.0, 1.0], false), ([0.0, -1.0], true)] {
            assert_eq!(
                command(&ALONG_FIELD, ahead, heading, turned),
                [0.0, -3.0, 1.0, 0.0, 0.0, 0.0]
            );
        }
        let own = Steering { along_field: false, ..ALONG_FIELD };
        assert_eq!(command(&own, ahead, [0.0, 1.0], false), [3.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn kicks_and_the_dribbler_are_off_below_zero() {
        for (number, kick, dribbler) in [(-0.2, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 3.25, 1.0)] {
            let told = command(&ALONG_FIELD, [0.0, 0.0, 0.0, number, number], [1.0, 0.0], false);
            assert_eq!(told[3..], [kick, 0.0, dribbler]);
        }
    }
}

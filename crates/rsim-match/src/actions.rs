//! Actions of the tasks as commands: numbers from -1 to 1 for each robot.

use rsim_core::columns::{BALL_COLUMNS, DIFFERENTIAL_COLUMNS, OMNI_COLUMNS, ROBOT_COLUMNS};
use rsim_core::{Drive, RobotModel, SimConfig, Steering};

use crate::error::MatchError;

/// Angular velocity of a full deflection, rad/s; the tasks of `python/rsoccer/tasks/ssl.py` have it.
const MAX_ANGULAR_VELOCITY: f32 = 10.0;
/// Speed limit of a kick, m/s: SSL rules.
const MAX_LEGAL_KICK_SPEED: f32 = 6.5;
/// Index in an action of the kick speed, and of the switch of a chip kick.
const KICK: usize = 3;
const CHIP: usize = 5;
/// Places of a kick's parts in a command.
const KICK_ALONG: usize = 3;
const KICK_UP: usize = 4;

/// Mapping from actions to commands.
#[derive(Debug, Clone)]
pub(crate) enum Actions {
    /// Wheel speeds, of which this is the greatest, rad/s.
    Wheels(f32),
    /// Velocities, and the speed of a full chip, m/s.
    Omni(Steering, f32),
}

impl Actions {
    /// The mapping for the robots of a configuration, which are all of one model.
    ///
    /// # Errors
    /// Robots that are driven by their four wheels, or none.
    pub(crate) fn new(config: &SimConfig) -> Result<Self, MatchError> {
        let expected = "robots with a differential or an omnidirectional drive";
        let Some(robot) = config.robots().next() else {
            return Err(MatchError::argument("robots", expected, &"none"));
        };
        match robot.drive {
            Drive::Differential(drive) => Ok(Self::Wheels(drive.max_wheel_speed)),
            Drive::Omni(_) => Ok(Self::omni(robot)),
            Drive::OmniWheels(_) => Err(MatchError::argument("robots", expected, &robot.name)),
        }
    }

    fn omni(robot: &RobotModel) -> Self {
        let top = robot.top_speed();
        let of_mouth = |number: fn(&rsim_core::Mouth) -> f32| {
            robot.mouth.as_ref().map_or(0.0, number).min(MAX_LEGAL_KICK_SPEED)
        };
        let (kick, chip) =
            (of_mouth(|mouth| mouth.max_kick_speed), of_mouth(|mouth| mouth.max_chip_speed));
        let scales = [top, top, MAX_ANGULAR_VELOCITY, kick, 1.0];
        Self::Omni(Steering { scales, field_frame: true }, chip)
    }

    /// Numbers in an action, with and without the switch of a chip kick.
    pub(crate) fn sizes(&self) -> &'static [usize] {
        match self {
            Self::Wheels(_) => &[2],
            Self::Omni(..) => &[5, 6],
        }
    }

    /// Numbers in a command.
    pub(crate) fn command_size(&self) -> usize {
        match self {
            Self::Wheels(_) => DIFFERENTIAL_COLUMNS.len(),
            Self::Omni(..) => OMNI_COLUMNS.len(),
        }
    }

    /// Writes the command of an action for a robot of a row. `rotated` says whether its team attacks -x.
    pub(crate) fn command(
        &self,
        action: &[f32],
        row: &[f32],
        robot: usize,
        rotated: bool,
        out: &mut [f32],
    ) {
        match self {
            Self::Wheels(speed) => {
                for (out, action) in out.iter_mut().zip(action) {
                    *out = action * speed;
                }
            }
            Self::Omni(steering, chip_speed) => {
                let columns = &row[BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len()..];
                steering.command(&action[..CHIP], [columns[2], columns[3]], rotated, out);
                if action.get(CHIP).is_some_and(|chip| *chip > 0.0) {
                    let speed = action[KICK].max(0.0) * chip_speed;
                    // Both parts are equal at 45 degrees.
                    out[KICK_ALONG] = speed * std::f32::consts::FRAC_1_SQRT_2;
                    out[KICK_UP] = speed * std::f32::consts::FRAC_1_SQRT_2;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chip_flies_at_45_degrees_and_wheels_turn_at_their_speed() {
        let config = SimConfig::ssl(1, 1);
        let actions = Actions::new(&config).expect("omnidirectional");
        let mut row = vec![0.0; config.row_size()];
        row[BALL_COLUMNS.len() + 2] = 1.0;
        let mut out = vec![f32::NAN; actions.command_size()];
        actions.command(&[0.0, 0.0, 0.0, 1.0, -1.0, 1.0], &row, 0, false, &mut out);
        assert!(out[KICK_ALONG] > 1.0 && (out[KICK_ALONG] - out[KICK_UP]).abs() < 1e-6);
        actions.command(&[0.0, 0.0, 0.0, 1.0, -1.0, -1.0], &row, 0, false, &mut out);
        assert!((out[KICK_ALONG] - 6.5).abs() < 1e-6 && out[KICK_UP].abs() < 1e-9);
        let config = SimConfig::vss(1, 1);
        let actions = Actions::new(&config).expect("differential");
        let mut out = [0.0; 2];
        actions.command(&[1.0, -0.5], &vec![0.0; config.row_size()], 0, false, &mut out);
        assert!(out[0] > 10.0 && (out[0] + 2.0 * out[1]).abs() < 1e-5);
    }
}

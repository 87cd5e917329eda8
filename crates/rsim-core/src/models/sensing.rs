//! Senses and commands of robots as data: what robots know late, wrongly or not at all, and how well they
//! obey. [`crate::models::sensing_presets`] has the presets.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::error::ConfigError;
use crate::models::numbers::{Number, check_all, find, listed, numbers};

numbers! {
    /// Senses and commands of robots: noise, delay and loss of what they know and do.
    ///
    /// Cameras above the field see all robots and the ball; a frame of theirs arrives after a delay. Errors
    /// named noise are drawn for each detection, those named error once for an episode. All are normal
    /// distributions, whose standard deviations are given, unless a number says otherwise. A camera at a
    /// height sees a flying ball where its ray meets the floor, and no ball that a robot hides.
    #[derive(Clone, PartialEq, Serialize, Deserialize)]
    pub struct Sensing, "sensing";
    fields {
        /// Name of the preset.
        name: Cow<'static, str>,
    }
    numbers {
        /// Frame rate of the cameras; 0 for a frame in each control step.
        frame_rate: NotNegative, "Hz";
        /// Time from the exposure of a frame to its arrival.
        delay: NotNegative, "s";
        /// Maximum deviation, at most that time. Frames keep their order.
        delay_jitter: NotNegative, "s";
        /// Probability that a frame is lost.
        frame_loss: Fraction, "1";
        /// Noise of the ball's detected position, in each direction.
        ball_position_noise: NotNegative, "m";
        /// Noise of a robot's detected position, in each direction.
        robot_position_noise: NotNegative, "m";
        /// Noise of a robot's detected heading.
        heading_noise: NotNegative, "rad";
        /// Probability that a heading is misread by 90 degrees.
        misread_headings: Fraction, "1";
        /// Probability that a camera misses the ball in a frame.
        missing_balls: Fraction, "1";
        /// Probability that a camera misses a robot in a frame.
        missing_robots: Fraction, "1";
        /// Rate of balls that a camera wrongly sees at a robot's mouth.
        ghost_balls: NotNegative, "1/s";
        /// Height of the cameras; 0 for one that looks straight down everywhere.
        camera_height: NotNegative, "m";
        /// Part of the ball that a camera must see to detect it.
        visible_part: Fraction, "1";
        /// Number of cameras along the field; 0 is 1.
        cameras_along: NotNegative, "1";
        /// Number of cameras across the field; 0 is 1.
        cameras_across: NotNegative, "1";
        /// Width of the strip that two neighboring cameras both see.
        camera_overlap: NotNegative, "m";
        /// Error of all positions of a camera, in each direction.
        camera_offset_error: NotNegative, "m";
        /// 1 for cameras of each team's own, 0 for the same that both teams see by.
        #[serde(default)]
        own_cameras: Fraction, "1";
        /// 1 to filter detections, 0 to take each with its true velocity.
        tracker: Fraction, "1";
        /// Time from a robot's own measurement to its arrival.
        feedback_delay: NotNegative, "s";
        /// Probability that a report of a robot's own sensors is lost.
        feedback_loss: Fraction, "1";
        /// Probability in a control step that a break beam misses the ball.
        beam_misses: Fraction, "1";
        /// Probability in a control step of a break beam's false alarm.
        beam_false_alarms: Fraction, "1";
        /// 1 to know velocities from wheels and gyroscopes, 0 from cameras.
        odometry: Fraction, "1";
        /// Noise of a robot's own velocity by its wheels, in each direction.
        odometry_noise: NotNegative, "m/s";
        /// Noise of a robot's own angular velocity by its gyroscope.
        gyroscope_noise: NotNegative, "rad/s";
        /// Error of the gyroscope's zero.
        gyroscope_error: NotNegative, "rad/s";
        /// Mean time from a command to its arrival, at the start of a tick.
        command_delay: NotNegative, "s";
        /// Maximum deviation, at most that time. Commands keep their order.
        command_jitter: NotNegative, "s";
        /// Probability that a robot misses a command, and keeps the last.
        command_loss: Fraction, "1";
        /// Time after which a robot that has heard no command stops; 0 for never.
        command_timeout: NotNegative, "s";
        /// Error of the speed of each wheel, as a part of it.
        wheel_error: Fraction, "1";
        /// Commanded speed of a wheel's rim below which the wheel stands.
        wheel_dead_zone: NotNegative, "m/s";
        /// Noise of the speed of a kick, as a part of it.
        kick_speed_noise: Fraction, "1";
        /// Noise of the direction of a kick.
        kick_direction_noise: NotNegative, "rad";
        /// Probability that a kicker does not obey a command.
        kick_failures: Fraction, "1";
        /// Probability that a dribbler does not obey a command.
        dribbler_failures: Fraction, "1";
        /// Part of top and kick speeds lost in a second, down to half.
        battery_sag: NotNegative, "1/s";
        /// 1 to know the state in which the next commands act, by a forecast.
        #[serde(default)]
        forecast: Fraction, "1";
        /// 1 if a forecast knows the commands of both teams, 0 for a team's own.
        #[serde(default)]
        forecast_others: Fraction, "1";
    }
}

impl Sensing {
    /// Time without commands after which robots stop, s; `None` for never.
    pub(crate) fn timeout(&self) -> Option<f64> {
        (self.command_timeout > 0.0).then_some(f64::from(self.command_timeout))
    }

    /// All numbers of senses and commands.
    pub fn numbers() -> Vec<Number> {
        listed(Self::NUMBERS).collect()
    }

    /// A number by name; `None` if there is none of that name.
    pub fn number_mut(&mut self, name: &str) -> Option<&mut f32> {
        (find(Self::NUMBERS, name)?.get_mut)(self)
    }

    /// Values of all numbers, in the order of [`Self::numbers`].
    pub fn values(&self) -> Vec<f32> {
        Self::NUMBERS.iter().filter_map(|field| (field.get)(self)).collect()
    }

    /// The same with other values of all numbers, in the order of [`Self::numbers`].
    ///
    /// # Errors
    /// As [`Self::validate`].
    pub fn with_values(&self, values: &[f32]) -> Result<Self, ConfigError> {
        debug_assert_eq!(values.len(), Self::NUMBERS.len());
        let mut changed = self.clone();
        for (field, value) in Self::NUMBERS.iter().zip(values) {
            if let Some(number) = (field.get_mut)(&mut changed) {
                *number = *value;
            }
        }
        changed.validate()?;
        Ok(changed)
    }

    /// Whether robots know the true state and obey exactly.
    pub fn is_off(&self) -> bool {
        self.values().iter().all(|value| *value == 0.0)
    }

    /// Checks every number against its range, numbers that set how much work a step is against limits, and
    /// errors against what trackers, robots and kicks can follow.
    ///
    /// # Errors
    /// [`ConfigError`] with the name of the first wrong number.
    pub fn validate(&self) -> Result<(), ConfigError> {
        check_all(Self::NUMBERS, self)?;
        let limits = [
            ("sensing.frame_rate", self.frame_rate, MAX_FRAME_RATE, "at most 1000 Hz"),
            ("sensing.delay", self.delay, MAX_DELAY, "at most 1 s"),
            ("sensing.delay_jitter", self.delay_jitter, MAX_DELAY, "at most 1 s"),
            ("sensing.feedback_delay", self.feedback_delay, MAX_DELAY, "at most 1 s"),
            ("sensing.command_delay", self.command_delay, MAX_DELAY, "at most 1 s"),
            ("sensing.command_jitter", self.command_jitter, MAX_DELAY, "at most 1 s"),
            ("sensing.cameras_along", self.cameras_along, MAX_CAMERAS, "at most 8"),
            ("sensing.cameras_across", self.cameras_across, MAX_CAMERAS, "at most 8"),
            ("sensing.ball_position_noise", self.ball_position_noise, MAX_ERROR, "at most 100 m"),
            ("sensing.robot_position_noise", self.robot_position_noise, MAX_ERROR, "at most 100 m"),
            ("sensing.heading_noise", self.heading_noise, MAX_ERROR, "at most 100 rad"),
            ("sensing.camera_offset_error", self.camera_offset_error, MAX_ERROR, "at most 100 m"),
            ("sensing.odometry_noise", self.odometry_noise, MAX_ERROR, "at most 100 m/s"),
            ("sensing.gyroscope_noise", self.gyroscope_noise, MAX_ERROR, "at most 100 rad/s"),
            ("sensing.gyroscope_error", self.gyroscope_error, MAX_ERROR, "at most 100 rad/s"),
            (
                "sensing.kick_direction_noise",
                self.kick_direction_noise,
                MAX_ERROR,
                "at most 100 rad",
            ),
        ];
        for (name, got, limit, expected) in limits {
            if got > limit {
                return Err(ConfigError::Number { name, expected, got });
            }
        }
        for (name, got) in [
            ("sensing.cameras_along", self.cameras_along),
            ("sensing.cameras_across", self.cameras_across),
        ] {
            if got.fract() != 0.0 {
                return Err(ConfigError::Number { name, expected: "a whole number", got });
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Sensing {
    /// Writes the name, and the numbers that differ from those of the preset.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut written = formatter.debug_struct("Sensing");
        written.field("name", &self.name);
        let preset = Self::preset(&self.name).unwrap_or(Self::OFF);
        for ((field, value), usual) in Self::NUMBERS.iter().zip(self.values()).zip(preset.values())
        {
            if value.to_bits() != usual.to_bits() {
                written.field(field.number.name, &value);
            }
        }
        written.finish_non_exhaustive()
    }
}

/// Maximum number of frames in a second: five in a tick of 5 ms.
const MAX_FRAME_RATE: f32 = 1000.0;
/// Maximum delays: what is on its way is kept.
const MAX_DELAY: f32 = 1.0;
/// Maximum number of cameras in each direction.
const MAX_CAMERAS: f32 = 8.0;
/// Maximum errors, far beyond all fields, speeds and turns: the tracker's squares of larger ones overflow, own
/// velocities become infinite and kicked balls NaN, which robots would know.
const MAX_ERROR: f32 = 100.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_follow_the_numbers() {
        let presets = Sensing::PRESETS;
        let values = presets[2].values();
        assert_eq!(presets[0].with_values(&values).expect("in range").values(), values);
        assert!(presets[0].is_off() && !presets[2].is_off());
    }

    #[test]
    fn numbers_that_cost_time_or_make_no_sense_have_limits() {
        for (name, wrong) in [
            ("delay", 1.5),
            ("frame_rate", 2000.0),
            ("cameras_along", 9.0),
            ("cameras_along", 1.5),
            ("missing_balls", 1.1),
            ("ball_position_noise", 101.0),
            ("robot_position_noise", 1e20),
            ("heading_noise", 1e10),
            ("camera_offset_error", 101.0),
            ("odometry_noise", 3e38),
            ("gyroscope_noise", 101.0),
            ("gyroscope_error", 101.0),
            ("kick_direction_noise", 1e9),
        ] {
            let mut sensing = Sensing::OFF;
            *sensing.number_mut(name).expect("a number") = wrong;
            let error = sensing.validate().expect_err("out of range").to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}

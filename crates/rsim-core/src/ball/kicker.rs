//! Kickers that do not obey exactly.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::rotated;
use crate::math::Vector;
use crate::streams::{STRIDE, mixed, normals};

/// Errors of a kick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kicker {
    /// Factor on the speed.
    pub(crate) gain: f32,
    /// Direction in the robot's frame, a unit vector.
    pub(crate) direction: Vector,
}

/// Errors of all kicks that a command of a control step asks for. They are drawn when a ball is kicked, which is seldom.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct KickErrors {
    /// Word of the command, of which the random numbers are made.
    pub(crate) word: u64,
    /// Factor on all speeds.
    pub(crate) gain: f32,
    /// Standard deviations: of the speed by itself, and of the direction, rad.
    pub(crate) speed_noise: f32,
    pub(crate) direction_noise: f32,
}

impl KickErrors {
    /// Kickers that obey exactly.
    pub(crate) const NONE: Self =
        Self { word: 0, gain: 1.0, speed_noise: 0.0, direction_noise: 0.0 };

    /// Errors of the kick of a robot.
    pub(crate) fn of(&self, robot: usize) -> Kicker {
        if self.speed_noise == 0.0 && self.direction_noise == 0.0 {
            return Kicker { gain: self.gain, direction: Vector::X };
        }
        let nth = robot as u64 + 1;
        let [speed, direction] = normals(mixed(self.word.wrapping_add(STRIDE.wrapping_mul(nth))));
        Kicker {
            gain: self.gain * (1.0 + self.speed_noise * speed).max(0.0),
            direction: rotated(Vector::X, self.direction_noise * direction),
        }
    }
}

//! Kickers that do not obey exactly.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::direction as direction_of;
use crate::math::Vector;
use crate::streams::{STRIDE, mixed, normals};

/// A kicker as it obeys in one kick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kicker {
    /// Factor on the speed.
    pub(crate) gain: f32,
    /// Direction in the robot's frame, a unit vector.
    pub(crate) direction: Vector,
}

/// Obedience of kickers to the commands of a control step. Errors are drawn when a ball is kicked, which is seldom.
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

    /// The kicker of a robot.
    pub(crate) fn of(&self, robot: usize) -> Kicker {
        if self.speed_noise == 0.0 && self.direction_noise == 0.0 {
            return Kicker { gain: self.gain, direction: Vector::X };
        }
        let nth = robot as u64 + 1;
        let [speed, direction] = normals(mixed(self.word.wrapping_add(STRIDE.wrapping_mul(nth))));
        Kicker {
            gain: self.gain * (1.0 + self.speed_noise * speed).max(0.0),
            direction: direction_of(self.direction_noise * direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_have_errors_of_their_own_and_a_weak_battery_weakens_all_kicks() {
        let errors = KickErrors { word: 5, gain: 0.5, speed_noise: 0.1, direction_noise: 0.1 };
        let all: Vec<Kicker> = (0..64).map(|robot| errors.of(robot)).collect();
        for (nth, one) in all.iter().enumerate() {
            assert!(!all[..nth].contains(one) && errors.of(nth) == *one);
            assert!((one.gain - 0.5).abs() < 0.3 && (one.direction.length() - 1.0).abs() < 1e-6);
        }
        let exact = KickErrors { gain: 0.5, ..KickErrors::NONE };
        assert_eq!(exact.of(3), Kicker { gain: 0.5, direction: Vector::X });
        let wild = KickErrors { speed_noise: 1.0, ..errors };
        let gains: Vec<f32> = (0..64).map(|robot| wild.of(robot).gain).collect();
        assert!(gains.contains(&0.0) && gains.iter().all(|gain| *gain >= 0.0), "{gains:?}");
    }
}

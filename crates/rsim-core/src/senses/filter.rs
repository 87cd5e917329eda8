//! Constants of the alpha-beta filters of trackers: by which part of its distance from the prediction a
//! detection corrects an estimate.
//!
//! The state is position and velocity. A detection corrects both by fixed parts of its distance from the
//! prediction: `alpha`, and `beta` by the time since the last one. The parts are those of the stationary Kalman
//! filter whose process noise is an acceleration that is constant between two detections (Kalata, IEEE
//! Transactions on Aerospace and Electronic Systems 20(2), 1984). After a push, such as a kick, they are those
//! of a least-squares line through the detections since, until these are smaller (Bar-Shalom, Li and
//! Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001, section 3.5).

use serde::{Deserialize, Serialize};

use crate::blocks::{Lanes, larger};

/// Number of detections of a body that has been watched for some time: by then no line corrects more.
pub(super) const LONG: f32 = 15.0;

/// Squared distance from the prediction, in standard deviations, beyond which a body was pushed: a
/// detection is farther away once in 3,000.
pub(super) const GATE: f32 = 16.0;

/// Parts of a difference by which a detection corrects a position, and by the time since the last one a velocity.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Parts {
    pub(super) alpha: f32,
    pub(super) beta: f32,
}

impl Parts {
    /// Those of the stationary filter for a tracking index: the distance by an acceleration from one detection to the
    /// next, in the noise's.
    pub(super) fn stationary(index: f32) -> Self {
        let root = (index * index + 8.0 * index).sqrt();
        Self {
            alpha: -(index * index + 8.0 * index - (index + 4.0) * root) / 8.0,
            beta: (index * index + 4.0 * index - index * root) / 4.0,
        }
    }
}

/// Parts of the differences of four bodies, and the squared differences that tell of a push.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gains {
    pub(super) alpha: Lanes,
    pub(super) beta: Lanes,
    pub(super) gate: Lanes,
}

/// Constants of a filter.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Filter {
    stationary: Parts,
    /// Squared distance of a push from an exact prediction.
    gate: f32,
    /// Variance of the difference from the stationary prediction, in the noise's.
    steady: f32,
    /// Time between two detections, s.
    period: f32,
}

impl Filter {
    /// The filter for detections with a `deviation` (m or rad), one each `period` (s), of a body that changes
    /// its velocity by `acceleration` (m/s² or rad/s²) without a push.
    pub(super) fn new(deviation: f32, period: f32, acceleration: f32) -> Self {
        let stationary = Parts::stationary(acceleration * period * period / deviation);
        let steady = 1.0 / (1.0 - stationary.alpha).max(0.01);
        Self { stationary, gate: GATE * deviation * deviation, steady, period }
    }

    /// Inverse of the time since the last detection, 1/s, by which a distance from the prediction corrects a
    /// velocity. After a shorter time than usual the distance is noise: it would make a robot turn once in
    /// each frame, which no later frame could tell from standing still.
    pub(super) fn rate(&self, time: Lanes) -> Lanes {
        Lanes::ONE / larger(time, Lanes::splat(self.period))
    }

    /// Time of a number of periods, s.
    pub(super) fn after(&self, periods: f32) -> f32 {
        periods * self.period
    }

    /// The gains for bodies of which `counts` detections have come since a push.
    pub(super) fn gains(&self, counts: Lanes) -> Gains {
        let (alpha, beta) =
            (Lanes::splat(self.stationary.alpha), Lanes::splat(self.stationary.beta));
        let (gate, steady) = (Lanes::splat(self.gate), Lanes::splat(self.steady));
        let watched = counts.simd_ge(Lanes::splat(LONG));
        if watched.all() {
            return Gains { alpha, beta, gate: gate * steady };
        }
        let [two, four, six] = [2.0, 4.0, 6.0].map(Lanes::splat);
        // This detection is one more.
        let number = counts + Lanes::ONE;
        let inverse = Lanes::ONE / (number * (number + Lanes::ONE));
        let line_alpha = (four * number - two) * inverse;
        let is_line = !watched & line_alpha.simd_gt(alpha);
        // Variance of the difference from a line through the detections before; one detection makes none.
        let spread = (four * counts + two) / (counts * (counts - Lanes::ONE)) + Lanes::ONE;
        let has_line = counts.simd_gt(Lanes::ONE);
        let spread = has_line.bitselect(spread, Lanes::splat(f32::INFINITY));
        Gains {
            alpha: is_line.bitselect(line_alpha, alpha),
            beta: is_line.bitselect(six * inverse, beta),
            gate: gate * is_line.bitselect(larger(spread, steady), steady),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_are_those_of_a_line_and_then_of_the_stationary_filter() {
        // The ball under RC2021: the stationary parts for an index of 0.675 by Kalata's equations.
        let filter = Filter::new(0.001, 0.015, 3.0);
        let of = |count: f32| {
            let Gains { alpha, beta, gate } = filter.gains(Lanes::from([count, LONG, 1.0, 3.0]));
            [alpha, beta, gate].map(|lanes| lanes.as_array()[0])
        };
        // Two detections make a line, and any second one fits.
        let [alpha, beta, gate] = of(1.0);
        assert!((alpha - 1.0).abs() < 1e-6 && (beta - 1.0).abs() < 1e-6 && gate.is_infinite());
        let [alpha, beta, gate] = of(LONG);
        assert!((alpha - 0.682).abs() < 0.001 && (beta - 0.3805).abs() < 0.001);
        let steady = filter.gains(Lanes::splat(LONG)).gate.as_array()[0];
        assert_eq!((gate - steady).to_bits(), 0);
        let alphas: Vec<f32> = (1..16_u8).map(|count| of(f32::from(count))[0]).collect();
        assert!(alphas.windows(2).all(|pair| pair[1] <= pair[0]), "{alphas:?}");
    }
}

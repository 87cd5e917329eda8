//! Estimates of one quantity from its detections: alpha-beta filters of a nearly constant velocity.
//!
//! The state is position and velocity. A detection corrects both by fixed parts of its distance from the
//! prediction: `alpha`, and `beta` by the time since the last one. The parts are those of the stationary Kalman
//! filter whose process noise is an acceleration that is constant between two detections (Kalata, IEEE
//! Transactions on Aerospace and Electronic Systems 20(2), 1984). After a push, such as a kick, they are those
//! of a least-squares line through the detections since, until these are smaller (Bar-Shalom, Li and
//! Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001, section 3.5).

use serde::{Deserialize, Serialize};

use crate::math::Vector;

/// Number of detections after a push for which there are parts of their own.
const COUNTS: usize = LONG as usize;

/// Squared distance from the prediction, in standard deviations, beyond which a body was pushed: a
/// detection is farther away once in 3,000.
pub(super) const GATE: f32 = 16.0;

/// Parts of a difference that correct a state, and the squared difference that tells of a push.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Gain {
    alpha: f32,
    beta: f32,
    gate: f32,
}

/// Parts of a difference by which a detection corrects a position, and by the time since the last one a velocity.
#[derive(Debug, Clone, Copy)]
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

/// Constants of a filter: gains by the number of detections since a push.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Filter {
    gains: [Gain; COUNTS],
    /// Time between two detections, s.
    period: f32,
}

impl Filter {
    /// The filter for detections with a `deviation` (m or rad), one each `period` (s), of a body that changes
    /// its velocity by `acceleration` (m/s² or rad/s²) without a push.
    pub(super) fn new(deviation: f32, period: f32, acceleration: f32) -> Self {
        let Parts { alpha, beta } = Parts::stationary(acceleration * period * period / deviation);
        let variance = deviation * deviation;
        let mut gains = [Gain::default(); COUNTS];
        let mut count = 1.0_f32;
        for gain in &mut gains {
            let line_alpha = 2.0 * (2.0 * count - 1.0) / (count * (count + 1.0));
            let line_beta = 6.0 / (count * (count + 1.0));
            // Variance of the difference from a line through the detections before, in the noise's.
            let before = count - 1.0;
            let line = if before < 2.0 {
                f32::INFINITY
            } else {
                1.0 + 2.0 * (2.0 * before + 1.0) / (before * (before - 1.0))
            };
            let steady = 1.0 / (1.0 - alpha).max(0.01);
            let is_line = line_alpha > alpha && count < 15.5;
            *gain = if is_line {
                Gain {
                    alpha: line_alpha,
                    beta: line_beta,
                    gate: GATE * variance * line.max(steady),
                }
            } else {
                Gain { alpha, beta, gate: GATE * variance * steady }
            };
            count += 1.0;
        }
        Self { gains, period }
    }

    /// Inverse of the time since the last detection, 1/s, by which a distance from the prediction corrects a
    /// velocity. After a shorter time than usual the distance is noise: it would make a robot turn once in
    /// each frame, which no later frame could tell from standing still.
    pub(super) fn rate(&self, time: f32) -> f32 {
        1.0 / time.max(self.period)
    }

    fn gain(&self, count: u8) -> &Gain {
        &self.gains[usize::from(count).min(COUNTS - 1)]
    }
}

/// Number of detections of a body that has been watched for some time.
const LONG: u8 = 16;

/// Estimated position and velocity of a body.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct PositionTrack {
    pub(super) position: Vector,
    pub(super) velocity: Vector,
    /// Number of detections since a push.
    count: u8,
}

impl PositionTrack {
    /// A body that has been watched for some time.
    pub(super) fn new(position: Vector, velocity: Vector) -> Self {
        Self { position, velocity, count: LONG }
    }

    pub(super) fn predict(&mut self, time: f32) {
        self.position += self.velocity * time;
    }

    /// Whether a detection is where the body would be without a push.
    pub(super) fn expects(&self, detected: Vector, filter: &Filter) -> bool {
        (detected - self.position).length_squared() <= filter.gain(self.count).gate
    }

    /// Takes in a detection by another camera at the instant of the last one.
    pub(super) fn average(&mut self, detected: Vector, filter: &Filter) {
        let part = 0.5 * filter.gain(self.count).alpha;
        self.position += (detected - self.position) * part;
    }

    /// Takes in a detection; `rate` is that of [`Filter::rate`], 1/s. One that is not expected tells of a push
    /// since the last one, in whose middle the velocity changed.
    pub(super) fn update(&mut self, detected: Vector, rate: f32, filter: &Filter) {
        let difference = detected - self.position;
        let gain = filter.gain(self.count);
        if difference.length_squared() > gain.gate {
            self.position = detected;
            self.velocity += difference * (PUSH_PART * rate);
            self.count = 1;
            return;
        }
        self.position += difference * gain.alpha;
        self.velocity += difference * (gain.beta * rate);
        self.count = (self.count + 1).min(LONG);
    }
}

/// Change of the velocity by a push at an unknown instant of an interval, by the mean change over it.
const PUSH_PART: f32 = 1.5;

/// Estimated heading and angular velocity of a robot.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct HeadingTrack {
    /// Cosine and sine.
    pub(super) heading: Vector,
    pub(super) angular_velocity: f32,
    count: u8,
    /// Number of detections in a row that were taken for misread ones.
    refused: u8,
}

/// Cosine of the difference beyond which a heading is misread: 50 degrees, which no robot turns unexpectedly
/// between two frames.
const MISREAD: f32 = 0.643;

/// Number of detections in a row after which a heading is not misread, but has changed.
const BELIEVED: u8 = 4;

impl HeadingTrack {
    /// A robot that has been watched for some time. `heading` may have any length.
    pub(super) fn new(heading: Vector, angular_velocity: f32) -> Self {
        Self { heading: unit(heading), angular_velocity, count: LONG, refused: 0 }
    }

    pub(super) fn predict(&mut self, time: f32) {
        self.heading = turned(self.heading, self.angular_velocity * time);
    }

    /// Takes in a detection; `rate` is that of [`Filter::rate`], 1/s.
    pub(super) fn update(&mut self, detected: Vector, rate: f32, filter: &Filter) {
        let (cos, sin) = (self.heading.dot(detected), self.heading.perp_dot(detected));
        if cos < MISREAD {
            self.refused += 1;
            if self.refused >= BELIEVED {
                *self = Self { count: 1, ..Self::new(detected, 0.0) };
            }
            return;
        }
        self.refused = 0;
        // The angle of a sine up to that of the limit, to a hundredth.
        let difference = sin * (1.0 + sin * sin * (1.0 / 6.0 + sin * sin * (3.0 / 40.0)));
        let gain = filter.gain(self.count);
        if difference * difference > gain.gate {
            self.heading = unit(detected);
            self.angular_velocity += difference * (PUSH_PART * rate);
            self.count = 1;
            return;
        }
        self.heading = turned(self.heading, difference * gain.alpha);
        self.angular_velocity += difference * (gain.beta * rate);
        self.count = (self.count + 1).min(LONG);
    }
}

/// A heading of length 1. One that already has it keeps its bits.
pub(super) fn unit(heading: Vector) -> Vector {
    let is_unit = (heading.length_squared() - 1.0).abs() < 1e-6;
    if is_unit { heading } else { heading.normalize() }
}

/// A heading turned by `angle`, rad. Cosine and sine are series, to a ten-thousandth up to half a radian; the
/// length stays 1 by a step of Newton's method.
fn turned(heading: Vector, angle: f32) -> Vector {
    let (sin, cos) = if angle.abs() <= 0.5 {
        let square = angle * angle;
        (angle * (1.0 - square * (1.0 / 6.0)), 1.0 - square * (0.5 - square * (1.0 / 24.0)))
    } else {
        libm::sincosf(angle)
    };
    let turned = Vector::new(heading.x * cos - heading.y * sin, heading.y * cos + heading.x * sin);
    turned * (1.5 - 0.5 * turned.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::senses::random::{Draws, Purpose};

    const PERIOD: f32 = 0.015;

    /// The ball under RC2021.
    fn ball() -> Filter {
        Filter::new(0.001, PERIOD, 3.0)
    }

    /// Error of the estimated speed after `frames` frames of a ball at `speed` (m/s), by its speed, over many
    /// sequences of detections; the ball was kicked before the first frame if `kicked`.
    fn errors(speed: f32, frames: u8, kicked: bool) -> f32 {
        let (count, filter) = (200_u8, ball());
        let mut sum = 0.0;
        for run in 0..count {
            let mut draws = Draws::of(9, Purpose::Frame, u64::from(run));
            let before = if kicked { 0.0 } else { speed };
            let mut track = PositionTrack::new(Vector::ZERO, Vector::new(before, 0.0));
            // The kick is somewhere between the last frame and the first that shows it.
            let start = if kicked { PERIOD * draws.uniform() } else { 0.0 };
            for frame in 1..=frames {
                let x = speed * (f32::from(frame) * PERIOD - start);
                let seen = Vector::new(x + draws.normal(0.001), draws.normal(0.001));
                track.predict(PERIOD);
                track.update(seen, 1.0 / PERIOD, &filter);
            }
            sum += (track.velocity.length() / speed - 1.0).powi(2);
        }
        (sum / f32::from(count)).sqrt()
    }

    #[test]
    fn speed_is_right_three_frames_after_a_kick_and_settles() {
        assert!(errors(4.0, 3, true) < 0.05, "{}", errors(4.0, 3, true));
        assert!(errors(4.0, 20, true) < 0.01, "{}", errors(4.0, 20, true));
        assert!(errors(4.0, 100, false) < 0.01, "{}", errors(4.0, 100, false));
    }

    #[test]
    fn noise_is_seldom_taken_for_a_push() {
        let filter = ball();
        let mut track = PositionTrack::new(Vector::ZERO, Vector::ZERO);
        let mut pushes = 0;
        let mut draws = Draws::of(3, Purpose::Frame, 0);
        for _ in 0..10_000 {
            track.predict(PERIOD);
            let seen = Vector::new(draws.normal(0.001), draws.normal(0.001));
            pushes += u32::from(!track.expects(seen, &filter));
            track.update(seen, 1.0 / PERIOD, &filter);
        }
        assert!(pushes < 30, "{pushes}");
    }

    #[test]
    fn the_parts_are_those_of_a_line_and_then_of_the_stationary_filter() {
        // Two detections make a line; the stationary parts for an index of 0.675 by Kalata's equations.
        let filter = ball();
        assert_eq!((filter.gain(1).alpha, filter.gain(1).beta), (1.0, 1.0));
        let last = filter.gain(LONG);
        assert!((last.alpha - 0.682).abs() < 0.001 && (last.beta - 0.3805).abs() < 0.001);
        let alphas: Vec<f32> = (0..LONG).map(|count| filter.gain(count).alpha).collect();
        assert!(alphas.windows(2).all(|pair| pair[1] <= pair[0]), "{alphas:?}");
    }

    #[test]
    fn a_turning_heading_is_followed_and_a_misread_one_ignored() {
        let filter = Filter::new(0.01, PERIOD, 50.0);
        let mut track = HeadingTrack::new(Vector::X, 0.0);
        let at = |angle: f32| Vector::new(libm::cosf(angle), libm::sinf(angle));
        let (mut angle, mut since) = (0.0, 0.0);
        for frame in 0..60 {
            angle += 8.0 * PERIOD;
            since += PERIOD;
            track.predict(PERIOD);
            let misread = frame % 10 == 5;
            track.update(at(if misread { angle + 1.57 } else { angle }), 1.0 / since, &filter);
            since = if misread { since } else { 0.0 };
        }
        assert!((track.angular_velocity - 8.0).abs() < 0.3, "{}", track.angular_velocity);
        assert!(track.heading.dot(at(angle)) > 0.999);
    }

    #[test]
    fn a_heading_that_stays_changed_is_believed() {
        let filter = Filter::new(0.01, PERIOD, 50.0);
        let mut track = HeadingTrack::new(Vector::X, 0.0);
        for _ in 0..BELIEVED {
            assert!(track.heading.x > 0.99);
            track.predict(PERIOD);
            track.update(Vector::Y, 1.0 / PERIOD, &filter);
        }
        assert!(track.heading.y > 0.99);
    }

    #[test]
    fn turns_are_accurate() {
        for angle in [-2.0, -0.5, -0.1, 0.0, 0.3, 0.5, 1.3] {
            let turned = turned(Vector::new(0.6, 0.8), angle);
            let expected = libm::atan2f(0.8, 0.6) + angle;
            let (sin, cos) = libm::sincosf(expected);
            assert!((turned - Vector::new(cos, sin)).length() < 1e-3, "{angle}");
        }
    }
}

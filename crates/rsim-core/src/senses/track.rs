//! Estimates of one quantity from its detections: Kalman filters of a nearly constant velocity.
//!
//! This is the filter that teams use: state position and velocity, process noise a white acceleration of
//! given density, measurements of the position alone (Bar-Shalom, Li and Kirubarajan, Estimation with
//! Applications to Tracking and Navigation, 2001, section 6.2.2).

use serde::{Deserialize, Serialize};

use crate::geometry::motion::rotated;
use crate::math::Vector;

/// Covariance of a position and its velocity along one axis.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Uncertainty {
    position: f32,
    both: f32,
    velocity: f32,
}

/// Part of a difference that goes into the position and into the velocity (1/s).
#[derive(Debug, Clone, Copy)]
struct Gain {
    position: f32,
    velocity: f32,
}

impl Uncertainty {
    /// Of a body that has been watched for some time: a detection's variance, and a velocity known to
    /// `deviation`.
    fn known(variance: f32, deviation: f32) -> Self {
        Self { position: variance, both: 0.0, velocity: deviation * deviation }
    }

    /// Later by `time`, s. `density` is that of the acceleration, (m/s²)²/Hz.
    fn predict(&mut self, time: f32, density: f32) {
        self.position += time * (2.0 * self.both + time * self.velocity);
        self.both += time * self.velocity;
        self.add_acceleration(time, density);
    }

    /// Adds the effect of an acceleration of this density within the last `time`, s.
    fn add_acceleration(&mut self, time: f32, density: f32) {
        self.position += density * time * time * time * (1.0 / 3.0);
        self.both += density * time * time * 0.5;
        self.velocity += density * time;
    }

    /// Takes in a detection.
    fn update(&mut self, variance: f32) -> Gain {
        let total = self.position + variance;
        let gain = Gain { position: self.position / total, velocity: self.both / total };
        self.velocity -= gain.velocity * self.both;
        self.both *= 1.0 - gain.position;
        self.position *= 1.0 - gain.position;
        gain
    }
}

/// Constants of a filter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Filter {
    /// Variance of a detection, m² or rad².
    pub(super) variance: f32,
    /// Density of the acceleration of a body that goes its way, (m/s²)²/Hz.
    pub(super) density: f32,
    /// The same where a detection is too far from the prediction: the body was pushed or kicked.
    pub(super) pushed: f32,
}

/// Squared distance from the prediction, in standard deviations, beyond which a body was pushed: a
/// detection is farther away once in 3,000.
const GATE: f32 = 16.0;

/// Speed of a detected velocity at the start, m/s or rad/s: how well it is known.
const START_DEVIATION: f32 = 0.02;

/// Estimated position and velocity of a body.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct PositionTrack {
    pub(super) position: Vector,
    pub(super) velocity: Vector,
    uncertainty: Uncertainty,
    /// Time since the last prediction step, whose noise a push raises, s.
    last: f32,
}

impl PositionTrack {
    pub(super) fn new(position: Vector, velocity: Vector, filter: &Filter) -> Self {
        let uncertainty = Uncertainty::known(filter.variance, START_DEVIATION);
        Self { position, velocity, uncertainty, last: 0.0 }
    }

    pub(super) fn predict(&mut self, time: f32, filter: &Filter) {
        self.position += self.velocity * time;
        self.uncertainty.predict(time, filter.density);
        self.last = time;
    }

    /// Squared distance of a detection from the prediction, in standard deviations.
    pub(super) fn distance(&self, detected: Vector, filter: &Filter) -> f32 {
        let total = self.uncertainty.position + filter.variance;
        (detected - self.position).length_squared() / total
    }

    /// Whether a detection is where the body would be without a push.
    pub(super) fn expects(&self, detected: Vector, filter: &Filter) -> bool {
        self.distance(detected, filter) <= GATE
    }

    /// Takes in a detection. One that is not expected tells of a push since the last frame.
    pub(super) fn update(&mut self, detected: Vector, filter: &Filter) {
        if !self.expects(detected, filter) {
            self.uncertainty.add_acceleration(self.last, filter.pushed - filter.density);
        }
        let difference = detected - self.position;
        let gain = self.uncertainty.update(filter.variance);
        self.position += difference * gain.position;
        self.velocity += difference * gain.velocity;
    }
}

/// Estimated heading and angular velocity of a robot.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct HeadingTrack {
    /// Cosine and sine.
    pub(super) heading: Vector,
    pub(super) angular_velocity: f32,
    uncertainty: Uncertainty,
    last: f32,
    /// Number of detections in a row that were taken for misread ones.
    refused: u8,
}

/// Cosine of the difference beyond which a heading is misread: 50 degrees, which no robot turns unexpectedly
/// between two frames.
const MISREAD: f32 = 0.643;

/// Number of detections in a row after which a heading is not misread, but has changed.
const BELIEVED: u8 = 4;

impl HeadingTrack {
    pub(super) fn new(heading: Vector, angular_velocity: f32, filter: &Filter) -> Self {
        let uncertainty = Uncertainty::known(filter.variance, START_DEVIATION);
        Self { heading, angular_velocity, uncertainty, last: 0.0, refused: 0 }
    }

    pub(super) fn predict(&mut self, time: f32, filter: &Filter) {
        self.heading = turned(self.heading, self.angular_velocity * time);
        self.uncertainty.predict(time, filter.density);
        self.last = time;
    }

    pub(super) fn update(&mut self, detected: Vector, filter: &Filter) {
        let (cos, sin) = (self.heading.dot(detected), self.heading.perp_dot(detected));
        if cos < MISREAD && self.refused + 1 < BELIEVED {
            self.refused += 1;
            return;
        }
        if cos < MISREAD {
            *self = Self::new(detected, 0.0, filter);
            return;
        }
        self.refused = 0;
        // The angle of a sine up to that of the limit, to a thousandth.
        let difference = sin * (1.0 + sin * sin * (1.0 / 6.0 + sin * sin * (3.0 / 40.0)));
        let total = self.uncertainty.position + filter.variance;
        if difference * difference > GATE * total {
            self.uncertainty.add_acceleration(self.last, filter.pushed - filter.density);
        }
        let gain = self.uncertainty.update(filter.variance);
        self.heading = rotated(self.heading, tangent(difference * gain.position));
        self.angular_velocity += difference * gain.velocity;
    }
}

/// A heading turned by `angle`, rad, in parts that first-order turns are accurate for.
fn turned(heading: Vector, angle: f32) -> Vector {
    if angle.abs() <= 0.5 {
        return rotated(heading, tangent(angle));
    }
    let (sin, cos) = libm::sincosf(angle);
    Vector::new(heading.x * cos - heading.y * sin, heading.y * cos + heading.x * sin)
}

/// Tangent of an angle up to 0.9 rad, to a thousandth.
fn tangent(angle: f32) -> f32 {
    let square = angle * angle;
    angle * (1.0 + square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::senses::random::{Draws, Purpose};

    /// The ball under RC2021.
    const BALL: Filter = Filter { variance: 1e-6, density: 0.1, pushed: 1e4 };
    const PERIOD: f32 = 0.015;

    /// Mean and spread of the estimated speed after `frames` frames of a ball at `speed` (m/s), over many
    /// sequences of detections, that was kicked before the first frame if `kicked`.
    fn errors(speed: f32, frames: u8, kicked: bool) -> f32 {
        let count: u8 = 200;
        let mut sum = 0.0;
        for run in 0..count {
            let mut draws = Draws::of(9, Purpose::Frame, u64::from(run));
            let before = if kicked { 0.0 } else { speed };
            let mut track = PositionTrack::new(Vector::ZERO, Vector::new(before, 0.0), &BALL);
            // The kick is somewhere between the last frame and the first that shows it.
            let start = if kicked { PERIOD * draws.uniform() } else { 0.0 };
            for frame in 1..=frames {
                let x = speed * (f32::from(frame) * PERIOD - start);
                let seen = Vector::new(x + draws.normal(0.001), draws.normal(0.001));
                track.predict(PERIOD, &BALL);
                track.update(seen, &BALL);
            }
            sum += (track.velocity.length() / speed - 1.0).powi(2);
        }
        (sum / f32::from(count)).sqrt()
    }

    #[test]
    fn speed_is_right_three_frames_after_a_kick_and_settles() {
        assert!(errors(4.0, 3, true) < 0.10, "{}", errors(4.0, 3, true));
        assert!(errors(4.0, 20, true) < 0.02, "{}", errors(4.0, 20, true));
        assert!(errors(4.0, 100, false) < 0.01, "{}", errors(4.0, 100, false));
    }

    #[test]
    fn a_turning_heading_is_followed_and_a_misread_one_ignored() {
        let filter = Filter { variance: 1e-4, density: 400.0, pushed: 1e6 };
        let mut track = HeadingTrack::new(Vector::X, 0.0, &filter);
        let at = |angle: f32| Vector::new(libm::cosf(angle), libm::sinf(angle));
        let mut angle = 0.0;
        for frame in 0..60 {
            angle += 8.0 * PERIOD;
            track.predict(PERIOD, &filter);
            let seen = at(if frame % 10 == 5 { angle + 1.57 } else { angle });
            track.update(seen, &filter);
        }
        assert!((track.angular_velocity - 8.0).abs() < 0.3, "{}", track.angular_velocity);
        assert!(track.heading.dot(at(angle)) > 0.999);
    }

    #[test]
    fn a_heading_that_stays_changed_is_believed() {
        let filter = Filter { variance: 1e-4, density: 400.0, pushed: 1e6 };
        let mut track = HeadingTrack::new(Vector::X, 0.0, &filter);
        for _ in 0..BELIEVED {
            assert!(track.heading.x > 0.99);
            track.predict(PERIOD, &filter);
            track.update(Vector::Y, &filter);
        }
        assert!(track.heading.y > 0.99);
    }

    #[test]
    fn turns_are_accurate() {
        for angle in [-2.0, -0.5, -0.1, 0.0, 0.3, 0.5, 1.3] {
            let turned = turned(Vector::new(0.6, 0.8), angle);
            let expected = libm::atan2f(0.8, 0.6) + angle;
            let (sin, cos) = libm::sincosf(expected);
            assert!((turned - Vector::new(cos, sin)).length() < 1e-4, "{angle}");
        }
    }
}

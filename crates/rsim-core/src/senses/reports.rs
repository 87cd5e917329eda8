//! Robots' own sensors: break beams, odometry and gyroscopes, and their reports on the way.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::ball::mouth::beam_is_cut;
use crate::blocks::{BALL, robot, set_bits};
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::sensing::Sensing;
use crate::senses::cameras::ROUNDING;
use crate::senses::random::{Draws, Purpose};
use crate::state::State;

/// Motion that a robot measures itself.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct OwnMotion {
    /// Velocity forward and to the left, m/s.
    pub(super) velocity: Vector,
    /// rad/s.
    pub(super) angular_velocity: f32,
}

/// Reports of all robots at the end of a control step.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Report {
    /// Time of arrival, s.
    due: f64,
    /// Robots whose beams are cut, and robots whose reports are lost, one bit each.
    cut: u64,
    lost: u64,
    /// Own motions of all robots; empty without odometry.
    motions: Vec<OwnMotion>,
}

/// Known values of the robots' own sensors, and reports on their way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Reports {
    under_way: VecDeque<Report>,
    /// Number of control steps that reported.
    number: u64,
    /// Errors of the gyroscopes' zeros, rad/s.
    gyroscope_errors: Vec<f32>,
    /// Robots whose beams are known to be cut, one bit each.
    pub(super) cut: u64,
    /// Known motions; empty without odometry.
    pub(super) motions: Vec<OwnMotion>,
    /// Memory for reports to come.
    #[serde(skip)]
    spare: Vec<Vec<OwnMotion>>,
}

impl Reports {
    /// Before the first report of `robots` robots.
    pub(super) fn new(robots: usize, sensing: &Sensing, draws: &mut Draws) -> Self {
        let count = if sensing.odometry >= 0.5 { robots } else { 0 };
        Self {
            under_way: VecDeque::new(),
            number: 0,
            gyroscope_errors: (0..count).map(|_| draws.normal(sensing.gyroscope_error)).collect(),
            cut: 0,
            motions: vec![OwnMotion::default(); count],
            spare: Vec::new(),
        }
    }

    /// Begins anew with a state that has lasted for some time.
    pub(super) fn begin(&mut self, state: &State, parameters: &BodyParameters) {
        self.under_way.clear();
        self.cut = cut_beams(state, parameters);
        for (index, motion) in self.motions.iter_mut().enumerate() {
            *motion = own_motion(&state.bodies.motion(robot(index)));
        }
    }

    /// Sends the reports of a control step that ends at `now`, s.
    pub(super) fn send(
        &mut self,
        now: f64,
        (sensing, key): (&Sensing, u64),
        state: &State,
        parameters: &BodyParameters,
    ) {
        let mut draws = Draws::of(key, Purpose::Report, self.number);
        self.number += 1;
        let (robots, cut) = (parameters.robots.len(), cut_beams(state, parameters));
        let missed = draws.which(sensing.beam_misses, robots) & cut;
        let alarms = set_bits(draws.which(sensing.beam_false_alarms, robots) & !cut)
            .filter(|&index| parameters.robots[index].model.mouth.is_some())
            .fold(0, |all, index| all | 1 << index);
        let mut motions = self.spare.pop().unwrap_or_default();
        motions.clear();
        for (index, error) in self.gyroscope_errors.iter().enumerate() {
            let mut motion = own_motion(&state.bodies.motion(robot(index)));
            motion.velocity += draws.normals(sensing.odometry_noise);
            motion.angular_velocity += error + draws.normal(sensing.gyroscope_noise);
            motions.push(motion);
        }
        self.under_way.push_back(Report {
            due: now + f64::from(sensing.feedback_delay),
            cut: cut & !missed | alarms,
            lost: draws.which(sensing.feedback_loss, robots),
            motions,
        });
    }

    /// Takes in the reports that have arrived at `now`, s.
    pub(super) fn receive(&mut self, now: f64) {
        while self.under_way.front().is_some_and(|report| report.due <= now + ROUNDING) {
            let Some(report) = self.under_way.pop_front() else { return };
            self.cut = self.cut & report.lost | report.cut & !report.lost;
            for (index, motion) in report.motions.iter().enumerate() {
                if report.lost >> index & 1 == 0 {
                    self.motions[index] = *motion;
                }
            }
            self.spare.push(report.motions);
        }
    }
}

/// Robots whose beams the ball cuts, one bit each.
fn cut_beams(state: &State, parameters: &BodyParameters) -> u64 {
    let ball = state.bodies.motion(BALL).position;
    let is_cut = |index: usize| {
        let model = &parameters.robots[index].model;
        let motion = state.bodies.motion(robot(index));
        model.mouth.is_some() && beam_is_cut(model, &motion, &parameters.ball, ball, &state.ball)
    };
    (0..parameters.robots.len()).fold(0, |all, index| all | u64::from(is_cut(index)) << index)
}

/// A motion in the robot's own frame.
fn own_motion(motion: &Motion) -> OwnMotion {
    let Motion { heading, velocity, angular_velocity, .. } = *motion;
    let velocity = Vector::new(velocity.dot(heading), velocity.dot(heading.perp()));
    OwnMotion { velocity, angular_velocity }
}

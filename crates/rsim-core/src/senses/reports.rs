//! Robots' own sensors: break beams, odometry and gyroscopes, and their reports on the way.

use serde::{Deserialize, Serialize};

use crate::ball::mouth::beam_is_cut;
use crate::blocks::{
    BALL, Lanes, VectorLanes, bits_of, blocks_of, lanes_of_robots, mask_of_bits, robot, set_bits,
};
use crate::body_parameters::BodyParameters;
use crate::geometry::motion_block::MotionBlock;
use crate::models::sensing::Sensing;
use crate::senses::cameras::ROUNDING;
use crate::senses::fetch::Fetched;
use crate::senses::queue::remove_first;
use crate::senses::random::{Draws, Purpose};
use crate::state::State;

/// Motions that the robots of a block measure themselves.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct OwnMotions {
    /// Velocities forward and to the left, m/s.
    pub(super) velocity: VectorLanes,
    /// rad/s.
    pub(super) angular_velocity: Lanes,
}

impl OwnMotions {
    /// The motions of a block in the robots' own frames.
    fn of(block: &MotionBlock) -> Self {
        let velocity = block.velocity.seen_from(block.heading);
        Self { velocity, angular_velocity: block.angular_velocity }
    }
}

/// Reports of robots that have arrived: whose beams are cut, a bit each, and motions by block; none without odometry.
#[derive(Clone, Copy)]
pub(super) struct Reported<'a> {
    pub(super) cut: u64,
    pub(super) motions: &'a [OwnMotions],
}

/// Reports of all robots at the end of a control step.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Report {
    /// Time of arrival, s.
    due: f64,
    /// Robots whose beams are cut, and robots whose reports are lost, one bit each.
    cut: u64,
    lost: u64,
}

/// Known values of the robots' own sensors, and reports on their way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Reports {
    under_way: Vec<Report>,
    /// Own motions of all blocks in the reports on their way, one after the other; empty without odometry.
    queued: Vec<OwnMotions>,
    /// Number of control steps that reported.
    number: u64,
    /// Errors of the gyroscopes' zeros by block, rad/s; empty without odometry.
    gyroscope_errors: Vec<Lanes>,
    /// Robots whose beams are known to be cut, one bit each.
    pub(super) cut: u64,
    /// Known motions by block; empty without odometry.
    motions: Vec<OwnMotions>,
}

impl Reports {
    /// Fetches what is known and what is on its way.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.under_way.iter().for_each(|report| fetched.number(report.cut));
        let motions = self.queued.iter().chain(&self.motions);
        motions.for_each(|own| fetched.lanes(&own.angular_velocity));
        self.gyroscope_errors.iter().for_each(|error| fetched.lanes(error));
    }

    /// Before the first report, with memory for those of a number of control steps.
    pub(super) fn new(
        parameters: &BodyParameters,
        sensing: &Sensing,
        draws: &mut Draws,
        steps: usize,
    ) -> Self {
        let robots = parameters.robots.len();
        let blocks = if sensing.odometry >= 0.5 { blocks_of(robots) } else { 0 };
        let error = |_| draws.normal_lanes(sensing.gyroscope_error);
        Self {
            under_way: Vec::with_capacity(steps),
            queued: Vec::with_capacity(steps * blocks),
            number: 0,
            gyroscope_errors: (0..blocks).map(error).collect(),
            cut: 0,
            motions: vec![OwnMotions::default(); blocks],
        }
    }

    /// Begins anew with a state that has lasted for some time.
    pub(super) fn begin(&mut self, state: &State, parameters: &BodyParameters) {
        self.under_way.clear();
        self.queued.clear();
        self.cut = cut_beams(state, parameters);
        for (motions, block) in self.motions.iter_mut().zip(&state.bodies.blocks) {
            *motions = OwnMotions::of(&block.motion);
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
        if parameters.mouths == 0 && self.motions.is_empty() {
            return;
        }
        let mut draws = Draws::of(key, Purpose::Report, self.number);
        self.number += 1;
        let (robots, cut) = (parameters.robots.len(), cut_beams(state, parameters));
        let missed = draws.which_of(sensing.beam_misses, parameters.mouths) & cut;
        let alarms = draws.which_of(sensing.beam_false_alarms, parameters.mouths) & !cut;
        for (error, block) in self.gyroscope_errors.iter().zip(&state.bodies.blocks) {
            let mut motions = OwnMotions::of(&block.motion);
            let odometry_noise = Lanes::splat(sensing.odometry_noise);
            let noise = draws.poses(odometry_noise, sensing.gyroscope_noise);
            motions.velocity += noise.place;
            motions.angular_velocity += *error + noise.turn;
            self.queued.push(motions);
        }
        self.under_way.push(Report {
            due: now + f64::from(sensing.feedback_delay),
            cut: cut & !missed | alarms,
            lost: draws.which(sensing.feedback_loss, robots),
        });
    }

    /// Takes in the reports that have arrived at `now`, s.
    pub(super) fn receive(&mut self, now: f64) {
        let has_come = |report: &&Report| report.due <= now + ROUNDING;
        let arrived = self.under_way.iter().take_while(has_come).count();
        let blocks = self.motions.len();
        for (nth, &Report { cut, lost, .. }) in self.under_way[..arrived].iter().enumerate() {
            self.cut = self.cut & lost | cut & !lost;
            let reported = self.queued[nth * blocks..].iter().zip(&mut self.motions);
            for (block, (new, known)) in reported.enumerate() {
                let lost = mask_of_bits(lanes_of_robots(lost, block).into());
                known.velocity = known.velocity.where_else(lost, new.velocity);
                known.angular_velocity =
                    lost.bitselect(known.angular_velocity, new.angular_velocity);
            }
        }
        remove_first(&mut self.under_way, arrived);
        remove_first(&mut self.queued, arrived * blocks);
    }

    /// Reports that have arrived.
    pub(super) fn known(&self) -> Reported<'_> {
        Reported { cut: self.cut, motions: &self.motions }
    }
}

/// Robots whose beams the ball cuts, one bit each.
fn cut_beams(state: &State, parameters: &BodyParameters) -> u64 {
    let ball = state.bodies.motion(BALL).position;
    let is_cut = |index: &usize| {
        let motion = state.bodies.motion(robot(*index));
        let model = &parameters.robots[*index].model;
        beam_is_cut(model, &motion, &parameters.ball, ball, &state.ball)
    };
    bits_of(set_bits(parameters.mouths).filter(is_cut))
}

//! Senses and commands of the robots of a match: cameras, tracker and reports on the way from the true state
//! to what robots know, and a link and actuators on the way from commands to what they do.
//!
//! The true state never changes here. Everything that the future depends on is in [`Senses`]; random
//! numbers follow from its key and from counters.

mod actuators;
mod block_ring;
mod cameras;
mod detections;
mod driven;
pub(crate) mod exposed;
pub(crate) mod fetch;
mod filter;
mod followed;
pub(crate) mod frames;
mod held;
mod jitter;
mod link;
mod noise;
mod queue;
mod random;
mod reports;
mod resting;
mod row;
mod track;
mod tracker;
mod tracks;
mod visibility;
mod vision;
pub(crate) mod vision_tracker;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::body_parameters::BodyParameters;
use crate::forecast::commands::CommandLog;
use crate::forecast::{Knowledge, MAX_FORECAST};
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::actuators::{Actuators, Heard};
use crate::senses::driven::Orders;
use crate::senses::exposed::Film;
use crate::senses::fetch::Fetched;
use crate::senses::frames::CameraFrame;
use crate::senses::held::Beams;
use crate::senses::link::Link;
use crate::senses::queue::most_under_way;
use crate::senses::random::{Draws, Purpose};
use crate::senses::reports::{Reported, Reports};
use crate::senses::vision::Vision;
use crate::state::{Setup, State};
use crate::tick::StepCommands;

/// Differs the keys of the teams' own cameras.
const SECOND_TEAM: u64 = 0x9e37_79b9_7f4a_7c15;

/// Senses and commands of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Senses {
    /// Those of the configuration are in one place for all matches.
    sensing: Arc<Sensing>,
    /// Key of all random numbers.
    key: u64,
    /// Physics ticks since the senses began.
    ticks: u64,
    /// Ticks after which a robot that hears nothing stops; `None` for never.
    timeout: Option<u64>,
    /// Ticks at whose end the next frame is exposed.
    next_exposure: u64,
    /// Number of looks at a state that was placed.
    looks: u64,
    /// Vision systems that watch the field: one for both teams, or one for each of them.
    visions: Vec<Vision>,
    reports: Reports,
    link: Link,
    actuators: Actuators,
    /// Commands that forecasts need; empty without them.
    sent: CommandLog,
}

/// Constants of the match that its senses need.
#[derive(Clone, Copy)]
pub(crate) struct Watched<'a> {
    pub(crate) config: &'a SimConfig,
    pub(crate) parameters: &'a BodyParameters,
    pub(crate) state: &'a State,
}

impl Senses {
    /// The senses of a match that begins in this state. `key` makes its errors its own.
    pub(crate) fn new(sensing: Arc<Sensing>, key: u64, watched: Watched<'_>) -> Self {
        let (robots, columns) = (watched.config.n_robots(), watched.config.command_columns());
        // Memory for all that is on its way from the start: what a match has lies in one place then, and comes into a
        // processor's cache together.
        let step = watched.config.time_step;
        let reports = most_under_way(sensing.feedback_delay, step);
        let commands = most_under_way(sensing.command_delay + sensing.command_jitter, step);
        let mut draws = Draws::of(key, Purpose::Episode, 0);
        let mut visions = vec![Vision::new(watched.config, &sensing, key, &mut draws)];
        if sensing.own_cameras >= 0.5 {
            let key = key ^ SECOND_TEAM;
            let mut draws = Draws::of(key, Purpose::Episode, 0);
            visions.push(Vision::new(watched.config, &sensing, key, &mut draws));
        }
        let mut senses = Self {
            next_exposure: next_exposure(&visions),
            visions,
            reports: Reports::new(watched.parameters, &sensing, &mut draws, reports),
            link: Link::new(robots, columns, commands),
            actuators: Actuators::new(watched.parameters, &sensing, &mut draws),
            sent: CommandLog::default(),
            timeout: timeout(&sensing, watched.config.tick),
            sensing,
            key,
            ticks: 0,
            looks: 0,
        };
        senses.look(watched);
        senses
    }

    /// Fetches most of what a step needs.
    pub(crate) fn fetch(&self, fetched: &mut Fetched) {
        self.visions.iter().for_each(|vision| vision.fetch(fetched));
        self.reports.fetch(fetched);
        self.link.fetch(fetched);
        self.actuators.fetch(fetched);
    }

    /// Looks at bodies that were placed, as if they had been watched for some time.
    pub(crate) fn look(&mut self, watched: Watched<'_>) {
        let now = self.now(watched.config);
        for vision in &mut self.visions {
            let mut draws = Draws::of(vision.key, Purpose::Look, self.looks);
            vision.look(now, &self.sensing, &mut draws, watched);
        }
        self.looks += 1;
        self.reports.begin(watched.state, watched.parameters);
        self.actuators.begin();
    }

    /// Sends the commands of a control step.
    pub(crate) fn send(&mut self, commands: &[f32], config: &SimConfig) {
        if self.sensing.forecast >= 0.5 {
            // A team knows when it sent its commands and how long they take in the mean, not more.
            let acts = self.now(config) + f64::from(self.expected(config).command_delay);
            let seen = self.visions.iter().map(|vision| vision.tracker.time());
            let oldest = seen.fold(f64::INFINITY, f64::min);
            self.sent.forget_before(oldest.max(acts - MAX_FORECAST));
            self.sent.add(acts, commands);
        }
        let lengths = [config.tick, config.time_step];
        self.link.send(self.ticks, lengths, (&self.sensing, self.key), commands);
    }

    /// Lets robots hear what arrives at the start of a tick, and obey it.
    pub(crate) fn receive(
        &mut self,
        setup: &Setup,
        parameters: &BodyParameters,
        state: &mut State,
    ) {
        let arrived = self.link.receive(self.ticks, self.timeout);
        if arrived.is_none() && !self.actuators.are_stale() {
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "battery time needs no more digits")]
        let seconds = self.now(&setup.config) as f32;
        let heard = Heard {
            arrived,
            commands: self.link.commands(),
            columns: setup.command_columns.max(1),
            seconds,
        };
        self.actuators.hear(heard, (&self.sensing, self.key), parameters, state);
    }

    /// Commands as the robots obey them.
    pub(crate) fn obeyed(&self) -> &StepCommands {
        self.actuators.obeyed()
    }

    /// Watches the state after a tick.
    pub(crate) fn watch(&mut self, watched: Watched<'_>, film: &mut Film) {
        self.ticks += 1;
        if self.ticks < self.next_exposure {
            return;
        }
        let now = (self.now(watched.config), watched.config.tick);
        for vision in &mut self.visions {
            vision.expose(now, watched.state, film);
        }
        self.next_exposure = next_exposure(&self.visions);
    }

    /// Ends a control step with the exposures of its ticks: robots report, and what has arrived is taken in. `models`
    /// are the parameters that teams take robots to have.
    pub(crate) fn end_step(&mut self, film: &Film, watched: Watched<'_>, models: &BodyParameters) {
        let Watched { config, parameters, state } = watched;
        let now = self.now(config);
        self.reports.send(now, (&self.sensing, self.key), state, parameters);
        self.reports.receive(now);
        let beams = Beams { cut: self.reports.cut, parameters };
        let expected = expected(config, &self.sensing);
        let orders = || Orders::new(&self.sent, config, expected, models);
        for vision in &mut self.visions {
            vision.receive(now, film, &self.sensing, beams, orders);
        }
    }

    /// The frames that arrived in the last control step, in the order of their arrival: of all cameras, or of
    /// those of the first team.
    pub(crate) fn camera_frames(&self) -> Vec<CameraFrame> {
        self.visions[0].camera_frames()
    }

    /// Writes the row of what the robots of a team know.
    pub(crate) fn write_row(&self, knowledge: Knowledge, state: &State, out: &mut [f32]) {
        row::write(&self.vision(knowledge).tracker, self.reports.known(), state, out);
    }

    /// Writes the row of what a team knows at the last frame, velocities too. It knows the commands of `robots`, one
    /// bit each.
    pub(crate) fn write_row_by_cameras(
        &self,
        knowledge: Knowledge,
        robots: u64,
        state: &State,
        out: &mut [f32],
    ) {
        let vision = self.vision(knowledge);
        let reported = Reported { cut: self.reports.cut, motions: &[] };
        row::write(&vision.tracker, reported, state, out);
        if let Some(driven) = &vision.driven {
            row::write_driven(driven, robots, !state.absent, out);
        }
    }

    /// Takes the numbers from one place for all matches, if they are the same.
    pub(crate) fn share(&mut self, shared: &Arc<Sensing>) {
        if *self.sensing == **shared {
            self.sensing = Arc::clone(shared);
        }
    }

    /// Numbers of the senses.
    pub(crate) fn sensing(&self) -> &Sensing {
        &self.sensing
    }

    /// Numbers of the senses as teams take them to be: those of the configuration, also where the match has
    /// others of its own.
    pub(crate) fn expected<'a>(&'a self, config: &'a SimConfig) -> &'a Sensing {
        expected(config, &self.sensing)
    }

    /// Commands that were sent, for forecasts.
    pub(crate) fn sent(&self) -> &CommandLog {
        &self.sent
    }

    /// Time of the last frame that has arrived at a team, s.
    pub(crate) fn seen_at(&self, knowledge: Knowledge) -> f64 {
        self.vision(knowledge).tracker.time()
    }

    /// Cameras and tracker of a team: the first one's for the knowledge of all.
    fn vision(&self, knowledge: Knowledge) -> &Vision {
        let index = usize::from(knowledge == Knowledge::Yellow).min(self.visions.len() - 1);
        &self.visions[index]
    }

    /// Time since the senses began, s.
    pub(crate) fn now(&self, config: &SimConfig) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "no match has 2^52 ticks")]
        let ticks = self.ticks as f64;
        ticks * f64::from(config.tick)
    }
}

/// Numbers of the senses as teams take them to be, of a match with its `own`.
fn expected<'a>(config: &'a SimConfig, own: &'a Sensing) -> &'a Sensing {
    config.sensing.as_ref().unwrap_or(own)
}

/// Ticks at whose end some cameras expose their next frame.
fn next_exposure(visions: &[Vision]) -> u64 {
    visions.iter().map(Vision::due).min().unwrap_or(u64::MAX)
}

/// Ticks after which a robot that hears nothing stops; `None` for never. `tick` is the length of one, s.
fn timeout(sensing: &Sensing, tick: f32) -> Option<u64> {
    let ticks = sensing.command_timeout / tick;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
    let whole = ticks.round() as u64;
    (ticks > 0.0).then_some(whole.max(1))
}

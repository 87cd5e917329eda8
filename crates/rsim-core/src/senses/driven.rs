//! Estimates of the robots whose commands a team knows.
//!
//! Between two frames the drives of the models follow these commands, where the tracker takes velocities to be
//! constant. What is left to a filter is the error of a model, so it averages the noise of cameras over a longer
//! time (a Kalman filter with a control input: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to
//! Tracking and Navigation, 2001, section 5.2).

use serde::{Deserialize, Serialize};

use crate::blocks::{Lanes, blocks_of, place_of, robot};
use crate::body_parameters::BodyParameters;
use crate::drive::{BlockCommands, BlockTargets, DriveState};
use crate::forecast::commands::{Acting, CommandLog, is_same};
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::frames::Frame;
use crate::senses::held::{Beams, Held};
use crate::senses::resting::Resting;
use crate::senses::track::LOST;
use crate::senses::tracks::{Filters, Tracks};

/// Accelerations that the filters count with, m/s² and rad/s²: errors of models, and pushes below those that
/// show in a single frame.
const ACCELERATION: f32 = 1.5;
const ANGULAR_ACCELERATION: f32 = 10.0;

/// Part of a tick that counts as none.
const ROUNDING: f32 = 0.01;

/// The commands that a team knows, and the robots that follow them.
#[derive(Clone, Copy)]
pub(super) struct Orders<'a> {
    sent: &'a CommandLog,
    /// Time without commands after which robots stop, s; `None` for never.
    timeout: Option<f64>,
    parameters: &'a BodyParameters,
    /// Length of a tick, s.
    tick: f32,
    /// Numbers of a robot's command.
    columns: usize,
}

impl<'a> Orders<'a> {
    /// Commands that were sent to robots with these parameters, by a link as in `sensing`.
    pub(super) fn new(
        sent: &'a CommandLog,
        config: &SimConfig,
        sensing: &Sensing,
        parameters: &'a BodyParameters,
    ) -> Self {
        let columns = config.command_columns().max(1);
        Self { sent, timeout: sensing.timeout(), parameters, tick: config.tick, columns }
    }
}

/// A frame, and the rest that a tracker knows of it.
#[derive(Clone, Copy)]
pub(super) struct Tracked<'a> {
    pub(super) frame: Frame<'a>,
    /// The ball, if the tracker takes a robot to hold it.
    pub(super) held: Option<Held>,
    /// Break beams; `None` where robots report nothing.
    pub(super) beams: Option<Beams<'a>>,
    pub(super) sensing: &'a Sensing,
}

/// Estimates of all robots at the instant of the last frame; each is that of a team that knows its commands.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct DrivenRobots {
    tracks: Tracks,
    /// State of the wheels, by block.
    wheels: Vec<DriveState>,
    /// The ball, if a robot holds it.
    held: Option<Held>,
    /// Robots that stand, of those whose commands are unknown.
    resting: Resting,
    filters: Filters,
    /// Time of the last frame, s.
    time: f64,
}

impl DrivenRobots {
    /// Estimates of `robots` robots by frames of some senses, one each `period` (s), before the first.
    pub(super) fn new(robots: usize, sensing: &Sensing, period: f32) -> Self {
        let filters = Filters::of(sensing, period, ACCELERATION, ANGULAR_ACCELERATION);
        let wheels = vec![DriveState::AT_REST; blocks_of(robots)];
        let resting = Resting::new(robots, period);
        Self { tracks: Tracks::new(robots), wheels, held: None, resting, filters, time: 0.0 }
    }

    /// Begins anew with the bodies of a first frame, which have been watched before.
    pub(super) fn begin(&mut self, frame: Frame<'_>) {
        self.time = frame.time;
        self.held = self.held.filter(|_| frame.balls.is_empty());
        self.resting.begin(frame);
        self.tracks.begin(frame);
        for (index, _) in frame.moving_robots() {
            let (block, lane) = place_of(robot(index));
            self.wheels[block].clear(lane);
        }
    }

    /// Takes in a frame, which is of no use if it is older than the last.
    pub(super) fn take(&mut self, tracked: Tracked<'_>, orders: Orders<'_>) {
        let Tracked { frame, held, beams, sensing } = tracked;
        #[expect(clippy::cast_possible_truncation, reason = "time between two frames")]
        let elapsed = (frame.time - self.time) as f32;
        if elapsed < 0.0 {
            return;
        }
        self.drive(elapsed, orders);
        self.time = frame.time;
        self.tracks.update(frame, &self.filters);
        // The model was wrong for these, perhaps in taking them to skid.
        for (wheels, track) in self.wheels.iter_mut().zip(&self.tracks.blocks) {
            wheels.set_upright(track.pushed());
        }
        self.resting.take(frame, elapsed, sensing);
        let known = self.held;
        self.held = beams.zip(held).map(|(beams, held)| {
            // The tracker's hold has taken in this frame.
            let Some(mut own) = known.filter(|known| known.robot == held.robot) else {
                return held;
            };
            let holder = self.tracks.motion(robot(own.robot));
            if own.take(frame.balls, &holder, beams, sensing, elapsed) { own } else { held }
        });
    }

    /// The ball, if a robot holds it.
    pub(super) fn held(&self) -> Option<Held> {
        self.held
    }

    /// Robots that stand.
    pub(super) fn resting(&self) -> &Resting {
        &self.resting
    }

    /// The estimated motion of a robot.
    pub(super) fn motion(&self, index: usize) -> Motion {
        self.tracks.motion(robot(index))
    }

    /// Lets all robots drive for a time, s. Nobody knows where robots are that no frame has shown for long.
    fn drive(&mut self, elapsed: f32, orders: Orders<'_>) {
        let blocks = &mut self.tracks.blocks;
        let mut motions: Vec<MotionBlock> = blocks.iter().map(|block| *block.motions()).collect();
        let mut drives = Drives { orders, targets: Vec::new(), acting: None };
        let (time, mut passed) = (elapsed.min(LOST), 0.0);
        while time - passed > ROUNDING * orders.tick {
            let part = orders.tick.min(time - passed);
            let now = self.time + f64::from(passed + part / 2.0);
            drives.follow(&mut motions, &mut self.wheels, now, part);
            passed += part;
        }
        for (known, motion) in blocks.iter_mut().zip(&motions) {
            known.go_on(elapsed, motion);
        }
    }
}

/// The drives of all robots, which follow known commands.
struct Drives<'a> {
    orders: Orders<'a>,
    /// Targets of the wheels, by block.
    targets: Vec<BlockTargets>,
    /// The commands that these are; `None` before the first.
    acting: Option<Acting<'a>>,
}

impl Drives<'_> {
    /// Lets robots drive for a tick or a part of one (s) with its middle at `now`, s.
    fn follow(
        &mut self,
        motions: &mut [MotionBlock],
        wheels: &mut [DriveState],
        now: f64,
        part: f32,
    ) {
        let Orders { sent, timeout, parameters, columns, .. } = self.orders;
        let acting = sent.acting(now, timeout);
        if self.acting.is_none_or(|last| !is_same(last, acting)) {
            let commands = acting.unwrap_or_default();
            let read =
                |(block, wheels)| BlockCommands::read(commands, columns, block).targets(wheels);
            self.targets.clear();
            self.targets.extend(parameters.wheels.iter().enumerate().map(read));
            self.acting = Some(acting);
        }
        let time = Lanes::splat(part);
        let models = parameters.wheels.iter().zip(&self.targets);
        for ((motion, wheels), (model, targets)) in motions.iter_mut().zip(wheels).zip(models) {
            let gain = wheels.accelerate(model, targets, motion);
            motion.advance(gain.linear * time, gain.angular * time, part, 1);
        }
    }
}

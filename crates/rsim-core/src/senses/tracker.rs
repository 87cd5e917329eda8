//! Tracker: estimates of all bodies at the instant of the last frame.

use serde::{Deserialize, Serialize};

use crate::blocks::{BALL, robot};
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::{Vec3, Vector};
use crate::models::sensing::Sensing;
use crate::senses::detections::{BallMotion, DetectedBall};
use crate::senses::fetch::Fetched;
use crate::senses::filter::Filter;
use crate::senses::followed::PATIENCE;
use crate::senses::frames::Frame;
use crate::senses::held::{Beams, Held};
use crate::senses::track::{LOST, TrackBlock};
use crate::senses::tracks::{Filters, Tracks};

/// Accelerations of robots that speed up, which the filters count with, m/s² and rad/s².
const ROBOT_ACCELERATION: f32 = 5.0;
const ANGULAR_ACCELERATION: f32 = 50.0;

/// Speed that no ball exceeds, m/s, and the distance of a detection that is always possible, m: a detection
/// farther away is another thing.
const MAX_BALL_SPEED: f32 = 12.0;
const MIN_REACH: f32 = 0.1;

/// Greatest distance between the places at which two cameras see one ball, m; a ball farther away has moved.
const MAX_CAMERA_ERROR: f32 = 0.1;

/// Number of frames in a row without the ball where it can be after which it is believed where it is seen.
const BELIEVED: u8 = 8;

/// Estimate of the ball beside its motion.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Ball {
    /// Height of the lowest point, m, and vertical velocity, m/s.
    height: [f32; 2],
    spin: Vec3,
    /// Number of frames in a row whose balls were too far away.
    refused: u8,
    /// The camera that it is followed by; see [`crate::senses::followed`].
    camera: u8,
    /// The robot in whose mouth it is.
    held: Option<Held>,
}

/// Estimates of all bodies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Tracker {
    ball: Ball,
    tracks: Tracks,
    /// Time of the last frame, s.
    time: f64,
    filters: Filters,
}

impl Tracker {
    /// The tracker of `robots` robots for frames of some senses, one each `period` (s), before it has seen
    /// any.
    pub(super) fn new(robots: usize, sensing: &Sensing, period: f32) -> Self {
        let ball = Ball { height: [0.0; 2], spin: Vec3::ZERO, refused: 0, camera: 0, held: None };
        let filters = Filters::of(sensing, period, ROBOT_ACCELERATION, ANGULAR_ACCELERATION);
        Self { ball, tracks: Tracks::new(robots), time: 0.0, filters }
    }

    /// Fetches all estimates.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        fetched.number(self.time.to_bits());
        self.tracks.fetch(fetched);
    }

    /// Begins anew from a first frame, whose bodies have been watched before.
    pub(super) fn begin(&mut self, frame: Frame<'_>) {
        self.time = frame.time;
        for (seen, BallMotion { velocity, v_z, spin }) in frame.moving_balls() {
            let (block, lane) = self.tracks.of(BALL);
            block.move_to(lane, seen.position, velocity);
            let camera = seen.camera;
            self.ball = Ball { height: [seen.z, v_z], spin, refused: 0, camera, held: None };
        }
        self.tracks.begin(frame);
    }

    /// The ball, if a robot holds it.
    pub(super) fn held(&self) -> Option<Held> {
        self.ball.held
    }

    /// Time of the last frame, s.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// The estimated motion of a body.
    pub(super) fn motion(&self, body: usize) -> Motion {
        self.tracks.motion(body)
    }

    /// The estimated motions of all bodies, by block.
    pub(super) fn motions(&self) -> impl Iterator<Item = &MotionBlock> {
        self.tracks.blocks.iter().map(TrackBlock::motions)
    }

    /// Height of the ball's lowest point (m), its vertical velocity (m/s) and its spin (rad/s).
    pub(super) fn ball(&self) -> ([f32; 2], Vec3) {
        (self.ball.height, self.ball.spin)
    }

    /// Takes in a frame. One that is older than the last is of no use. `beams` are `None` where robots report
    /// nothing.
    pub(super) fn take(
        &mut self,
        sensing: &Sensing,
        frame: Frame<'_>,
        ball_radius: f32,
        beams: Option<Beams<'_>>,
    ) {
        #[expect(clippy::cast_possible_truncation, reason = "time between two frames")]
        let elapsed = (frame.time - self.time) as f32;
        if elapsed < 0.0 {
            return;
        }
        self.time = frame.time;
        if sensing.tracker < 0.5 {
            return self.copy(frame);
        }
        for block in &mut self.tracks.blocks {
            block.coast(elapsed);
        }
        self.tracks.update(frame, &self.filters);
        self.take_ball(sensing, frame.balls, elapsed, beams);
        let velocity = self.tracks.motion(BALL).velocity;
        self.ball.spin = (velocity.perp() / ball_radius).extend(0.0);
    }

    /// Takes in the balls of a frame, `elapsed` (s) after the last, once its robots are taken in.
    fn take_ball(
        &mut self,
        sensing: &Sensing,
        balls: &[DetectedBall],
        elapsed: f32,
        beams: Option<Beams<'_>>,
    ) {
        let Some(beams) = beams else {
            self.ball.held = None;
            return self.see(balls);
        };
        let tracks = &self.tracks;
        self.ball.held = self.ball.held.and_then(|mut held| {
            let holder = tracks.motion(robot(held.robot));
            held.take(balls, &holder, beams, sensing, elapsed).then_some(held)
        });
        if self.ball.held.is_none() {
            self.see(balls);
            // Where a ball was seen that cannot be this one, neither place is believed yet.
            if beams.cut != 0 && (balls.is_empty() || self.ball.refused == 0) {
                let motion = |index: usize| self.tracks.motion(robot(index));
                let ball = self.tracks.motion(BALL).position;
                self.ball.held = Held::find(ball, motion, beams, sensing);
            }
        }
        if let Some(held) = self.ball.held {
            let (position, velocity) = held.motion(&self.tracks.motion(robot(held.robot)));
            let (block, lane) = self.tracks.of(BALL);
            block.move_to(lane, position, velocity);
            (self.ball.height, self.ball.refused) = ([0.0; 2], 0);
        }
    }

    /// Takes in the balls of a frame, of which some may be ghosts, for a ball that nobody holds: the nearest one of the
    /// camera that follows the ball, or of any where that one has not seen it for some time.
    fn see(&mut self, balls: &[DetectedBall]) {
        self.ball.height = [0.0; 2];
        let (filter, ball) = (&self.filters.ball, &mut self.ball);
        let (block, lane) = self.tracks.of(BALL);
        let (expected, unseen) = (block.motion(lane).position, block.unseen(lane));
        let is_own = |seen: &&DetectedBall| seen.camera == ball.camera;
        let own_alone = unseen < filter.after(PATIENCE) || balls.iter().any(|seen| is_own(&seen));
        let distance = |seen: &&DetectedBall| (seen.position - expected).length_squared();
        let candidates = balls.iter().filter(|seen| !own_alone || is_own(seen));
        let nearest = candidates.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(nearest) = nearest else { return };
        let (distance, reach) = (distance(&nearest), MIN_REACH + MAX_BALL_SPEED * unseen);
        if distance > reach * reach {
            ball.refused += 1;
            if ball.refused >= BELIEVED {
                block.move_to(lane, nearest.position, Vector::ZERO);
                (ball.refused, ball.camera) = (0, nearest.camera);
            }
            return;
        }
        let is_shift =
            !is_own(&nearest) && unseen <= LOST && distance <= MAX_CAMERA_ERROR * MAX_CAMERA_ERROR;
        (ball.refused, ball.camera) = (0, nearest.camera);
        if is_shift {
            block.shift(lane, nearest.position);
        } else {
            update_ball(block, lane, nearest.position, filter);
        }
    }

    /// Takes detections as they are: of each body the first one.
    fn copy(&mut self, frame: Frame<'_>) {
        if let Some((seen, BallMotion { velocity, v_z, spin })) = frame.moving_balls().next() {
            let (block, lane) = self.tracks.of(BALL);
            block.move_to(lane, seen.position, velocity);
            (self.ball.height, self.ball.spin) = ([seen.z, v_z], spin);
        }
        self.tracks.begin(frame);
    }
}

/// Takes in a ball: the first one at its instant, or one more.
fn update_ball(block: &mut TrackBlock, lane: usize, position: Vector, filter: &Filter) {
    if block.unseen(lane) > 0.0 {
        block.update_position(lane, position, filter);
        block.limit_speed(lane, MAX_BALL_SPEED);
    } else {
        block.average(lane, position, filter);
    }
}

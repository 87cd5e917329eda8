//! Tracker: estimates of all bodies at the instant of the last frame.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};
use crate::models::sensing::Sensing;
use crate::senses::detections::{DetectedBall, DetectedRobot, Detections};
use crate::senses::held::{Beams, Held};
use crate::senses::noise::Noise;
use crate::senses::track::{Filter, HeadingTrack, PositionTrack, unit};

/// Accelerations that the filters count with, m/s² and rad/s²: of a ball that slides (3 m/s²), and of robots
/// that speed up.
const BALL_ACCELERATION: f32 = 3.0;
const ROBOT_ACCELERATION: f32 = 5.0;
const ANGULAR_ACCELERATION: f32 = 50.0;

/// Speed that no ball exceeds, m/s, and the distance of a detection that is always possible, m: a detection
/// farther away is another thing.
const MAX_BALL_SPEED: f32 = 12.0;
const MIN_REACH: f32 = 0.1;

/// Number of frames in a row without the ball where it can be after which it is believed where it is seen.
const BELIEVED: u8 = 8;

/// Time without a detection after which a body is taken to stand still, s.
pub(super) const LOST: f32 = 0.3;

/// Estimate of the ball.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Ball {
    pub(super) track: PositionTrack,
    pub(super) height: [f32; 2],
    pub(super) spin: Vec3,
    /// Time since the last detection, s.
    unseen: f32,
    /// Number of frames in a row whose balls were too far away.
    refused: u8,
    /// The robot in whose mouth it is.
    held: Option<Held>,
}

/// Estimate of a robot.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Robot {
    pub(super) track: PositionTrack,
    pub(super) heading: HeadingTrack,
    /// Time since the last detection, s.
    unseen: f32,
}

/// Estimates of all bodies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Tracker {
    pub(super) ball: Ball,
    pub(super) robots: Vec<Robot>,
    /// Time of the last frame, s.
    time: f64,
    filters: Filters,
}

/// Filters of the ball, of robots and of headings.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Filters {
    ball: Filter,
    robot: Filter,
    heading: Filter,
}

impl Filters {
    /// The filters for the noise of some senses, with a frame each `period` (s), and for robots that accelerate as
    /// given (m/s² and rad/s²) where nobody expects it.
    pub(super) fn of(sensing: &Sensing, period: f32, robot: f32, angular: f32) -> Self {
        let noise = Noise::of(sensing);
        Self {
            ball: Filter::new(noise.ball, period, BALL_ACCELERATION),
            robot: Filter::new(noise.robot, period, robot),
            heading: Filter::new(noise.heading, period, angular),
        }
    }
}

impl Tracker {
    /// The tracker of `robots` robots for frames of some senses, one each `period` (s), before it has seen
    /// any.
    pub(super) fn new(robots: usize, sensing: &Sensing, period: f32) -> Self {
        let track = PositionTrack::new(Vector::ZERO, Vector::ZERO);
        let ball =
            Ball { track, height: [0.0; 2], spin: Vec3::ZERO, unseen: 0.0, refused: 0, held: None };
        let filters = Filters::of(sensing, period, ROBOT_ACCELERATION, ANGULAR_ACCELERATION);
        Self { ball, robots: vec![Robot::new(); robots], time: 0.0, filters }
    }

    /// Begins anew from a first frame, whose bodies have been watched before.
    pub(super) fn begin(&mut self, frame: &Detections) {
        self.time = frame.time;
        for ball in &frame.balls {
            self.ball.begin(ball);
        }
        for seen in &frame.robots {
            self.robots[seen.robot].begin(&seen.motion);
        }
    }

    /// The ball, if a robot holds it.
    pub(super) fn held(&self) -> Option<Held> {
        self.ball.held
    }

    /// Time of the last frame, s.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// Takes in a frame. One that is older than the last is of no use. `beams` are `None` where robots report
    /// nothing.
    pub(super) fn take(
        &mut self,
        sensing: &Sensing,
        frame: &Detections,
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
        for robot in &mut self.robots {
            robot.coast(elapsed);
        }
        for seen in &frame.robots {
            self.robots[seen.robot].update(&seen.motion, &self.filters);
        }
        self.take_ball(sensing, &frame.balls, elapsed, beams);
        let velocity = self.ball.track.velocity;
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
        let (ball, robots) = (&mut self.ball, &self.robots);
        let Some(beams) = beams else {
            ball.held = None;
            return ball.take(elapsed, balls, &self.filters.ball);
        };
        ball.held = ball.held.and_then(|mut held| {
            let robot = robots[held.robot].motion();
            held.take(balls, &robot, beams, sensing, elapsed).then_some(held)
        });
        if ball.held.is_none() {
            ball.take(elapsed, balls, &self.filters.ball);
            // Where a ball was seen that cannot be this one, neither place is believed yet.
            if balls.is_empty() || ball.refused == 0 {
                let motion = |robot: usize| robots[robot].motion();
                ball.held = Held::find(ball.track.position, motion, beams, sensing);
            }
        }
        if let Some(held) = ball.held {
            let (position, velocity) = held.motion(&robots[held.robot].motion());
            ball.track = PositionTrack::new(position, velocity);
            (ball.height, ball.unseen, ball.refused) = ([0.0; 2], 0.0, 0);
        }
    }

    /// Takes detections as they are: of the ball the first one, of a robot the last.
    fn copy(&mut self, frame: &Detections) {
        if let Some(seen) = frame.balls.first() {
            let ball = &mut self.ball;
            (ball.track.position, ball.track.velocity) = (seen.position, seen.velocity);
            (ball.height, ball.spin) = (seen.height, seen.spin);
        }
        for DetectedRobot { robot, motion } in &frame.robots {
            let robot = &mut self.robots[*robot];
            (robot.track.position, robot.track.velocity) = (motion.position, motion.velocity);
            robot.heading.heading = unit(motion.heading);
            robot.heading.angular_velocity = motion.angular_velocity;
        }
    }
}

impl Ball {
    fn begin(&mut self, seen: &DetectedBall) {
        self.track = PositionTrack::new(seen.position, seen.velocity);
        (self.height, self.spin) = (seen.height, seen.spin);
        (self.unseen, self.refused, self.held) = (0.0, 0, None);
    }

    /// Goes on by `elapsed` to a frame with these balls, of which some may be ghosts.
    fn take(&mut self, elapsed: f32, seen: &[DetectedBall], filter: &Filter) {
        self.track.predict(elapsed);
        self.height = [0.0; 2];
        self.unseen += elapsed;
        let predicted = self.track;
        let is_expected = |ball: &DetectedBall| predicted.expects(ball.position, filter);
        if seen.iter().any(is_expected) {
            for ball in seen.iter().filter(|ball| is_expected(ball)) {
                self.update(ball.position, filter);
            }
            return;
        }
        let distance = |ball: &&DetectedBall| (ball.position - predicted.position).length_squared();
        let Some(nearest) = seen.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
            if self.unseen > LOST {
                self.track.velocity = Vector::ZERO;
            }
            return;
        };
        let reach = MIN_REACH + MAX_BALL_SPEED * self.unseen;
        if distance(&nearest) <= reach * reach {
            return self.update(nearest.position, filter);
        }
        self.refused += 1;
        if self.refused >= BELIEVED {
            self.track = PositionTrack::new(nearest.position, Vector::ZERO);
            (self.unseen, self.refused) = (0.0, 0);
        }
    }

    fn update(&mut self, position: Vector, filter: &Filter) {
        if self.unseen <= 0.0 {
            return self.track.average(position, filter);
        }
        self.track.update(position, filter.rate(self.unseen), filter);
        (self.unseen, self.refused) = (0.0, 0);
    }
}

impl Robot {
    /// A robot that was never seen.
    pub(super) fn new() -> Self {
        let track = PositionTrack::new(Vector::ZERO, Vector::ZERO);
        Self { track, heading: HeadingTrack::new(Vector::X, 0.0), unseen: 0.0 }
    }

    /// The estimated motion.
    pub(super) fn motion(&self) -> Motion {
        Motion {
            position: self.track.position,
            heading: self.heading.heading,
            velocity: self.track.velocity,
            angular_velocity: self.heading.angular_velocity,
        }
    }

    pub(super) fn begin(&mut self, seen: &Motion) {
        self.track = PositionTrack::new(seen.position, seen.velocity);
        self.heading = HeadingTrack::new(seen.heading, seen.angular_velocity);
        self.unseen = 0.0;
    }

    /// Goes on by `elapsed`, s, with a constant velocity.
    fn coast(&mut self, elapsed: f32) {
        self.unseen += elapsed;
        if self.unseen > LOST {
            self.track.velocity = Vector::ZERO;
            self.heading.angular_velocity = 0.0;
        }
        self.track.predict(elapsed);
        self.heading.predict(elapsed);
    }

    /// Goes on by `elapsed`, s, to a predicted motion.
    pub(super) fn go_on(&mut self, elapsed: f32, predicted: &Motion) {
        self.unseen += elapsed;
        if self.unseen > LOST {
            return self.coast(0.0);
        }
        (self.track.position, self.track.velocity) = (predicted.position, predicted.velocity);
        (self.heading.heading, self.heading.angular_velocity) =
            (predicted.heading, predicted.angular_velocity);
    }

    pub(super) fn update(&mut self, seen: &Motion, filters: &Filters) {
        if self.unseen <= 0.0 {
            return self.track.average(seen.position, &filters.robot);
        }
        self.track.update(seen.position, filters.robot.rate(self.unseen), &filters.robot);
        self.heading.update(seen.heading, filters.heading.rate(self.unseen), &filters.heading);
        self.unseen = 0.0;
    }
}

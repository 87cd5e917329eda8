//! Tracker: what is known of all bodies at the instant of the last frame.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};
use crate::models::sensing::Sensing;
use crate::senses::detections::{DetectedBall, DetectedRobot, Detections};
use crate::senses::track::{Filter, HeadingTrack, PositionTrack};

/// Standard deviation of a detection that the filter counts with at least, m and rad.
const MIN_DEVIATION: f32 = 0.000_3;
const MIN_HEADING_DEVIATION: f32 = 0.002;

/// Densities of accelerations, (m/s²)²/Hz and (rad/s²)²/Hz. A ball that slides loses 3 m/s², of which some
/// 20 ms are not known; a robot changes its acceleration by up to 5 m/s² and 50 rad/s² within 50 ms.
const BALL_DENSITY: f32 = 0.1;
const ROBOT_DENSITY: f32 = 1.0;
const HEADING_DENSITY: f32 = 100.0;

/// The same for pushes: 10 m/s, 2 m/s and 20 rad/s within a frame of 15 ms.
const KICK_DENSITY: f32 = 6000.0;
const PUSH_DENSITY: f32 = 260.0;
const SPIN_DENSITY: f32 = 26_000.0;

/// Speed that no ball exceeds, m/s, and the distance of a detection that is always possible, m: a detection
/// farther away is another thing.
const MAX_BALL_SPEED: f32 = 12.0;
const MIN_REACH: f32 = 0.1;

/// Number of frames in a row without the ball where it can be after which it is believed where it is seen.
const BELIEVED: u8 = 8;

/// Time without a detection after which a body is taken to stand still, s.
const LOST: f32 = 0.3;

/// What is known of the ball.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Ball {
    pub(super) track: PositionTrack,
    pub(super) height: [f32; 2],
    pub(super) spin: Vec3,
    /// Time since the last detection, s.
    unseen: f32,
    /// Number of frames in a row whose balls were too far away.
    refused: u8,
}

/// What is known of a robot.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Robot {
    pub(super) track: PositionTrack,
    pub(super) heading: HeadingTrack,
    unseen: f32,
}

/// Estimates of all bodies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Tracker {
    pub(super) ball: Ball,
    pub(super) robots: Vec<Robot>,
    /// Time of the last frame, s.
    time: f64,
}

/// Filters of the ball, of robots and of headings for the noise of some senses.
struct Filters {
    ball: Filter,
    robot: Filter,
    heading: Filter,
}

impl Filters {
    fn of(sensing: &Sensing) -> Self {
        let variance = |noise: f32, least: f32| noise.max(least).powi(2);
        Self {
            ball: Filter {
                variance: variance(sensing.ball_position_noise, MIN_DEVIATION),
                density: BALL_DENSITY,
                pushed: KICK_DENSITY,
            },
            robot: Filter {
                variance: variance(sensing.robot_position_noise, MIN_DEVIATION),
                density: ROBOT_DENSITY,
                pushed: PUSH_DENSITY,
            },
            heading: Filter {
                variance: variance(sensing.heading_noise, MIN_HEADING_DEVIATION),
                density: HEADING_DENSITY,
                pushed: SPIN_DENSITY,
            },
        }
    }
}

impl Tracker {
    /// What is known of `robots` robots before anything was seen.
    pub(super) fn new(robots: usize) -> Self {
        let filter = Filter { variance: 1.0, density: 1.0, pushed: 1.0 };
        let track = PositionTrack::new(Vector::ZERO, Vector::ZERO, &filter);
        let heading = HeadingTrack::new(Vector::X, 0.0, &filter);
        let ball = Ball { track, height: [0.0; 2], spin: Vec3::ZERO, unseen: 0.0, refused: 0 };
        let robot = Robot { track, heading, unseen: 0.0 };
        Self { ball, robots: vec![robot; robots], time: 0.0 }
    }

    /// Begins anew from a first frame, whose bodies have been watched before.
    pub(super) fn begin(&mut self, sensing: &Sensing, frame: &Detections) {
        let filters = Filters::of(sensing);
        self.time = frame.time;
        for ball in &frame.balls {
            self.ball.begin(ball, &filters);
        }
        for seen in &frame.robots {
            self.robots[seen.robot].begin(&seen.motion, &filters);
        }
    }

    /// Takes in a frame. One that is older than the last is of no use.
    pub(super) fn take(&mut self, sensing: &Sensing, frame: &Detections, ball_radius: f32) {
        #[expect(clippy::cast_possible_truncation, reason = "time between two frames")]
        let elapsed = (frame.time - self.time) as f32;
        if elapsed < 0.0 {
            return;
        }
        self.time = frame.time;
        if sensing.tracker < 0.5 {
            return self.copy(frame);
        }
        let filters = Filters::of(sensing);
        self.ball.take(elapsed, &frame.balls, &filters.ball);
        let velocity = self.ball.track.velocity;
        self.ball.spin = (velocity.perp() / ball_radius).extend(0.0);
        for robot in &mut self.robots {
            robot.predict(elapsed, &filters);
        }
        for seen in &frame.robots {
            self.robots[seen.robot].update(&seen.motion, &filters);
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
            robot.heading.heading = motion.heading;
            robot.heading.angular_velocity = motion.angular_velocity;
        }
    }
}

impl Ball {
    fn begin(&mut self, seen: &DetectedBall, filters: &Filters) {
        self.track = PositionTrack::new(seen.position, seen.velocity, &filters.ball);
        (self.height, self.spin) = (seen.height, seen.spin);
        (self.unseen, self.refused) = (0.0, 0);
    }

    /// Goes on by `elapsed` to a frame with these balls, of which some may be ghosts.
    fn take(&mut self, elapsed: f32, seen: &[DetectedBall], filter: &Filter) {
        self.track.predict(elapsed, filter);
        self.height = [0.0; 2];
        self.unseen += elapsed;
        let reach = MIN_REACH + MAX_BALL_SPEED * self.unseen;
        let start = self.track;
        let is_expected = |ball: &&DetectedBall| start.expects(ball.position, filter);
        if seen.iter().any(|ball| is_expected(&ball)) {
            for ball in seen.iter().filter(is_expected) {
                self.track.update(ball.position, filter);
            }
            (self.unseen, self.refused) = (0.0, 0);
            return;
        }
        let distance = |ball: &&DetectedBall| (ball.position - start.position).length_squared();
        let nearest = seen.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match nearest {
            Some(ball) if distance(&ball) <= reach * reach => {
                self.track.update(ball.position, filter);
                (self.unseen, self.refused) = (0.0, 0);
            }
            Some(ball) => {
                self.refused += 1;
                if self.refused >= BELIEVED {
                    self.track = PositionTrack::new(ball.position, Vector::ZERO, filter);
                    (self.unseen, self.refused) = (0.0, 0);
                }
            }
            None if self.unseen > LOST => self.track.velocity = Vector::ZERO,
            None => {}
        }
    }
}

impl Robot {
    fn begin(&mut self, seen: &Motion, filters: &Filters) {
        self.track = PositionTrack::new(seen.position, seen.velocity, &filters.robot);
        self.heading = HeadingTrack::new(seen.heading, seen.angular_velocity, &filters.heading);
        self.unseen = 0.0;
    }

    fn predict(&mut self, elapsed: f32, filters: &Filters) {
        self.unseen += elapsed;
        if self.unseen > LOST {
            self.track.velocity = Vector::ZERO;
            self.heading.angular_velocity = 0.0;
        }
        self.track.predict(elapsed, &filters.robot);
        self.heading.predict(elapsed, &filters.heading);
    }

    fn update(&mut self, seen: &Motion, filters: &Filters) {
        self.unseen = 0.0;
        self.track.update(seen.position, &filters.robot);
        self.heading.update(seen.heading, &filters.heading);
    }
}

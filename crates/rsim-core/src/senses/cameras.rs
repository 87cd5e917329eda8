//! Cameras above the field: when they expose a frame, and what each of them sees.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::blocks::{BALL, robot};
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::detections::{DetectedBall, DetectedRobot, Detections};
use crate::senses::random::{Draws, Purpose};
use crate::senses::visibility::{Lens, Obstacle};
use crate::state::State;

/// The cameras of a match, with the frames on their way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Cameras {
    all: Vec<Camera>,
    /// Time between exposures, s.
    period: f64,
    /// Time of the first exposure, s.
    phase: f64,
    /// Number of exposures.
    exposures: u64,
    /// Time of the next exposure, s.
    next: f64,
    /// Frames that have not arrived, in the order of their arrival.
    under_way: VecDeque<Detections>,
    /// Memory for frames to come.
    #[serde(skip)]
    spare: Vec<Detections>,
    /// Memory for the motions of all bodies at an exposure.
    #[serde(skip)]
    motions: Vec<Motion>,
}

/// A camera above the middle of its part of the field.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Camera {
    middle: Vector,
    /// Corners of what it sees.
    from: Vector,
    to: Vector,
    /// Error of all its positions, m.
    offset: Vector,
}

/// A part of the field along an axis: what a row of cameras is responsible for, m.
struct Part {
    middle: f32,
    from: f32,
    to: f32,
}

/// The equal parts of a side of `size` for `count` cameras. The outer ones see beyond the lines.
fn parts(size: f32, count: f32, overlap: f32) -> Vec<Part> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "validated: 0 to 8"
    )]
    let count = count.max(1.0) as u8;
    let each = size / f32::from(count);
    let border = |nth: u8| match nth {
        0 => f32::NEG_INFINITY,
        _ if nth == count => f32::INFINITY,
        _ => each * f32::from(nth) - size / 2.0,
    };
    let part = |nth: u8| Part {
        middle: each * (f32::from(nth) + 0.5) - size / 2.0,
        from: border(nth) - overlap / 2.0,
        to: border(nth + 1) + overlap / 2.0,
    };
    (0..count).map(part).collect()
}

/// Tolerance of times, s: far below a tick, and far above the rounding of an hour.
pub(super) const ROUNDING: f64 = 1e-7;

/// The bodies at the instant of an exposure.
struct Exposed<'a> {
    state: &'a State,
    parameters: &'a BodyParameters,
    /// Time since the exposure, s.
    age: f32,
    /// Motions of all bodies at the exposure.
    motions: &'a [Motion],
}

/// A motion as it was before a time `age`, s.
fn earlier(now: Motion, age: f32) -> Motion {
    if age == 0.0 {
        return now;
    }
    Motion {
        position: now.position - now.velocity * age,
        heading: now.heading - now.heading.perp() * (now.angular_velocity * age),
        ..now
    }
}

impl Exposed<'_> {
    /// A body's motion at the exposure.
    fn motion(&self, body: usize) -> &Motion {
        &self.motions[body]
    }

    /// Height of the ball's lowest point, m.
    fn height(&self) -> f32 {
        (self.state.ball.z - self.state.ball.v_z * self.age).max(0.0)
    }
}

impl Cameras {
    /// The cameras of a match that begins.
    pub(super) fn new(config: &SimConfig, sensing: &Sensing, draws: &mut Draws) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "a step has few ticks")]
        let step = f64::from(config.tick) * config.ticks_per_step() as f64;
        let (period, phase) = if sensing.frame_rate > 0.0 {
            let period = 1.0 / f64::from(sensing.frame_rate);
            (period, period * f64::from(draws.uniform()))
        } else {
            (step, (-f64::from(sensing.delay)).rem_euclid(step))
        };
        // The state at the start is known; the first frame shows a later one.
        let phase = if phase <= ROUNDING { phase + period } else { phase };
        let all = Camera::all(config, sensing, draws);
        Self {
            all,
            period,
            phase,
            exposures: 0,
            next: phase,
            under_way: VecDeque::new(),
            spare: Vec::new(),
            motions: Vec::new(),
        }
    }

    /// Time between exposures, s.
    pub(super) fn period(&self) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let period = self.period as f32;
        period
    }

    /// Forgets the frames on their way: they show bodies that have been moved since.
    pub(super) fn forget(&mut self) {
        self.spare.extend(self.under_way.drain(..));
    }

    /// Exposes the frames of the tick that ended at `now` (s) with this state.
    pub(super) fn expose(
        &mut self,
        now: f64,
        (sensing, key): (&Sensing, u64),
        state: &State,
        parameters: &BodyParameters,
    ) {
        while self.next <= now + ROUNDING {
            let time = self.next;
            let mut draws = Draws::of(key, Purpose::Frame, self.exposures);
            self.exposures += 1;
            #[expect(clippy::cast_precision_loss, reason = "no match has 2^52 frames")]
            let exposures = self.exposures as f64;
            self.next = self.phase + self.period * exposures;
            if draws.happens(sensing.frame_loss) {
                continue;
            }
            #[expect(clippy::cast_possible_truncation, reason = "less than a tick")]
            let age = (now - time).max(0.0) as f32;
            self.motions.clear();
            let bodies = 0..state.bodies.len();
            self.motions.extend(bodies.map(|body| earlier(state.bodies.motion(body), age)));
            let exposed = Exposed { state, parameters, age, motions: &self.motions };
            let jitter = f64::from(sensing.delay_jitter);
            let jitter = if jitter > 0.0 { jitter * f64::from(draws.deviation()) } else { 0.0 };
            let due = (time + f64::from(sensing.delay) + jitter).max(time);
            let due = self.under_way.back().map_or(due, |last| due.max(last.due));
            let mut frame = self.spare.pop().unwrap_or_default();
            frame.begin(time, due);
            for camera in &self.all {
                camera.detect(&exposed, sensing, self.period, &mut draws, &mut frame);
                frame.end_camera();
            }
            self.under_way.push_back(frame);
        }
    }

    /// The next frame that has arrived at `now`, s.
    pub(super) fn arrived(&mut self, now: f64) -> Option<Detections> {
        let has_come = self.under_way.front().is_some_and(|frame| frame.due <= now + ROUNDING);
        if has_come { self.under_way.pop_front() } else { None }
    }

    /// Takes back the memory of a frame that was used.
    pub(super) fn recycle(&mut self, frame: Detections) {
        self.spare.push(frame);
    }

    /// A frame of the state at a start, of which nothing is missing.
    pub(super) fn look(
        &self,
        now: f64,
        sensing: &Sensing,
        draws: &mut Draws,
        state: &State,
        parameters: &BodyParameters,
    ) -> Detections {
        let motions: Vec<Motion> =
            (0..state.bodies.len()).map(|body| state.bodies.motion(body)).collect();
        let exposed = Exposed { state, parameters, age: 0.0, motions: &motions };
        let mut frame = Detections { time: now, due: now, ..Detections::default() };
        let nearest = |position: Vector| {
            let all = self.all.iter();
            let distance = |camera: &&Camera| (camera.middle - position).length_squared();
            all.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("at least one")
        };
        let ball = exposed.motion(BALL).position;
        frame.balls.push(nearest(ball).detect_ball(&exposed, sensing, draws));
        for index in 0..parameters.robots.len() {
            if !state.is_absent(index) {
                let motion = exposed.motion(robot(index));
                let seen = nearest(motion.position).detect_robot(motion, sensing, draws, false);
                frame.robots.push(DetectedRobot { robot: index, motion: seen });
            }
        }
        frame
    }
}

impl Camera {
    /// All cameras of a field, with their errors.
    fn all(config: &SimConfig, sensing: &Sensing, draws: &mut Draws) -> Vec<Self> {
        let overlap = sensing.camera_overlap;
        let columns = parts(config.field.length, sensing.cameras_along, overlap);
        let rows = parts(config.field.width, sensing.cameras_across, overlap);
        let mut all = Vec::with_capacity(columns.len() * rows.len());
        for column in &columns {
            for row in &rows {
                let error = sensing.camera_offset_error;
                all.push(Self {
                    middle: Vector::new(column.middle, row.middle),
                    from: Vector::new(column.from, row.from),
                    to: Vector::new(column.to, row.to),
                    offset: Vector::new(draws.normal(error), draws.normal(error)),
                });
            }
        }
        all
    }

    /// Whether the camera sees a point of the floor.
    fn sees(&self, point: Vector) -> bool {
        point.cmpge(self.from).all() && point.cmple(self.to).all()
    }

    /// Adds what the camera detects to a frame.
    fn detect(
        &self,
        exposed: &Exposed,
        sensing: &Sensing,
        period: f64,
        draws: &mut Draws,
        frame: &mut Detections,
    ) {
        let ball = exposed.motion(BALL).position;
        if self.sees(ball)
            && !draws.happens(sensing.missing_balls)
            && !self.is_hidden(exposed, sensing)
        {
            frame.balls.push(self.detect_ball(exposed, sensing, draws));
        }
        #[expect(clippy::cast_possible_truncation, reason = "a duration")]
        let ghost = sensing.ghost_balls * period as f32;
        let robots = exposed.parameters.robots.len();
        let missing = draws.which(sensing.missing_robots, robots);
        let misread = draws.which(sensing.misread_headings, robots);
        let ghosts = draws.which(ghost, robots);
        for (index, motion) in exposed.motions[1..].iter().enumerate() {
            if !self.sees(motion.position) || exposed.state.is_absent(index) {
                continue;
            }
            if missing >> index & 1 == 0 {
                let is_misread = misread >> index & 1 == 1;
                let seen = self.detect_robot(motion, sensing, draws, is_misread);
                frame.robots.push(DetectedRobot { robot: index, motion: seen });
            }
            if ghosts >> index & 1 == 1 {
                let body = &exposed.parameters.robots[index].model;
                let front = body.front_distance() + exposed.parameters.ball.radius;
                let position = motion.position + motion.heading * front;
                frame.balls.push(DetectedBall {
                    position,
                    velocity: motion.velocity,
                    height: [0.0; 2],
                    spin: Vec3::ZERO,
                });
            }
        }
    }

    fn lens(&self, height: f32) -> Lens {
        Lens { below: self.middle, height }
    }

    /// Whether robots hide too much of the ball.
    fn is_hidden(&self, exposed: &Exposed, sensing: &Sensing) -> bool {
        if sensing.visible_part == 0.0 || sensing.camera_height == 0.0 {
            return false;
        }
        let lens = self.lens(sensing.camera_height);
        let radius = exposed.parameters.ball.radius;
        let (ball, z) = (exposed.motion(BALL).position, exposed.height() + radius);
        (0..exposed.parameters.robots.len()).any(|index| {
            let body = &exposed.parameters.robots[index];
            let position = exposed.motion(robot(index)).position;
            // Quick test: a shadow is shorter than the robot is far from the camera, in the ratio of heights.
            let reach = body.bounding_radius + radius + REACH;
            if (position - ball).length_squared() > reach * reach || exposed.state.is_absent(index)
            {
                return false;
            }
            let obstacle =
                Obstacle { position, radius: body.bounding_radius, height: body.model.height };
            lens.visible_part(ball, z, radius, obstacle) < sensing.visible_part
        })
    }

    /// The ball as the camera detects it.
    fn detect_ball(&self, exposed: &Exposed, sensing: &Sensing, draws: &mut Draws) -> DetectedBall {
        let motion = exposed.motion(BALL);
        let noise = draws.normals(sensing.ball_position_noise);
        if sensing.camera_height == 0.0 {
            return DetectedBall {
                position: motion.position + self.offset + noise,
                velocity: motion.velocity,
                height: [exposed.height(), exposed.state.ball.v_z],
                spin: exposed.state.ball.spin,
            };
        }
        let seen = self.lens(sensing.camera_height).on_floor(motion.position, exposed.height());
        let rolling = motion.velocity.perp() / exposed.parameters.ball.radius;
        DetectedBall {
            position: seen + self.offset + noise,
            velocity: motion.velocity,
            height: [0.0; 2],
            spin: rolling.extend(0.0),
        }
    }

    /// A robot as the camera detects it.
    fn detect_robot(
        &self,
        motion: &Motion,
        sensing: &Sensing,
        draws: &mut Draws,
        is_misread: bool,
    ) -> Motion {
        let noise = draws.normals(sensing.robot_position_noise);
        let turned = draws.normal(sensing.heading_noise);
        let mut heading = motion.heading;
        if turned != 0.0 {
            heading += heading.perp() * turned;
        }
        if is_misread {
            heading = if draws.uniform() < 0.5 { heading.perp() } else { -heading.perp() };
        }
        Motion { position: motion.position + self.offset + noise, heading, ..*motion }
    }
}

/// Reach of shadows beyond the radius of a robot, m: a robot of 0.15 m hides 0.3 m at 8 m from a camera of
/// 4 m.
const REACH: f32 = 0.3;

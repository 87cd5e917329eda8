//! Cameras above the field: when they expose a frame, and what each of them sees.

use serde::{Deserialize, Serialize};

use crate::blocks::{
    BALL, LANES, Lanes, VectorLanes, lanes_of_robots, mask_of_bits, robot, robot_at, set_bits,
};
use crate::geometry::motion::{Motion, direction};
use crate::math::Vector;
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::Watched;
use crate::senses::detections::{BallMotion, DetectedBall, DetectedBlock, DetectedRobot};
use crate::senses::exposed::{Exposed, ExposureId, Film};
use crate::senses::fetch::Fetched;
use crate::senses::followed::Followed;
use crate::senses::frames::Frames;
use crate::senses::jitter::Jitter;
use crate::senses::random::{Draws, PoseNoise, Purpose};
use crate::senses::track::turned;
use crate::senses::visibility::{Lens, Obstacle};
use crate::state::State;

/// The cameras of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Cameras {
    all: Vec<Camera>,
    /// Time between exposures, s.
    period: f64,
    /// Time of the first exposure, s.
    phase: f64,
    /// Number of exposures.
    exposures: u64,
    /// Time of the next exposure, s, and the number of ticks at whose end it has come.
    next: f64,
    due: u64,
}

impl Cameras {
    /// Fetches all cameras.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.all.iter().for_each(|camera| fetched.number(camera.index.into()));
    }
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
    index: u8,
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

/// Number of ticks of a length (s) until a time (s) since the senses began.
fn ticks_until(time: f64, tick: f32) -> u64 {
    let ticks = (time - ROUNDING) / f64::from(tick);
    #[expect(clippy::cast_possible_truncation, reason = "no match has 2^52 ticks")]
    let begun = ticks as i64;
    #[expect(clippy::cast_precision_loss, reason = "no match has 2^52 ticks")]
    let is_whole = begun as f64 >= ticks;
    u64::try_from(begun + i64::from(!is_whole)).unwrap_or(0)
}

/// Tolerance of times, s: far below a tick, and far above the rounding of an hour.
pub(super) const ROUNDING: f64 = 1e-7;

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
        let due = ticks_until(phase, config.tick);
        Self { all, period, phase, exposures: 0, next: phase, due }
    }

    /// Number of cameras.
    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// Number of ticks at whose end the next frame is exposed.
    pub(super) fn due(&self) -> u64 {
        self.due
    }

    /// Time between exposures, s.
    pub(super) fn period(&self) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let period = self.period as f32;
        period
    }

    /// Exposes the frames of the tick of length `tick` (s) that ended at `now` (s). `key` is that of the random numbers.
    pub(super) fn expose(
        &mut self,
        (now, tick): (f64, f32),
        key: u64,
        state: &State,
        film: &mut Film,
    ) {
        while self.next <= now + ROUNDING {
            #[expect(clippy::cast_possible_truncation, reason = "less than a tick")]
            let age = (now - self.next).max(0.0) as f32;
            film.expose(ExposureId { time: self.next, number: self.exposures, key }, age, state);
            self.exposures += 1;
            #[expect(clippy::cast_precision_loss, reason = "no match has 2^52 frames")]
            let exposures = self.exposures as f64;
            self.next = self.phase + self.period * exposures;
        }
        self.due = ticks_until(self.next, tick);
    }

    /// Adds the frames of the step that ended: what the cameras detect in its exposures. Of several detections of a robot
    /// the one by the camera that it is `followed` by counts, if any does.
    pub(super) fn develop<'a>(
        &self,
        exposures: impl Iterator<Item = Exposed<'a>>,
        sensing: &Sensing,
        mut followed: Option<&mut Followed>,
        frames: &mut Frames,
    ) {
        for exposed in exposures {
            let ExposureId { time, number, key } = exposed.id();
            let mut draws = Draws::of(key, Purpose::Frame, number);
            if draws.happens(sensing.frame_loss) {
                continue;
            }
            let jitter = Jitter::of(sensing.delay_jitter, sensing.delay, self.period());
            let jitter = jitter.of_nth(number, key, Purpose::FrameDelay, &mut draws);
            let due = (time + f64::from(sensing.delay) + f64::from(jitter)).max(time);
            let mut of_ball = Some(add_robots(exposed, sensing, &mut draws, frames));
            for camera in &self.all {
                let noise = (&mut draws, &mut of_ball);
                camera.detect(exposed, sensing, self.period, noise, frames);
            }
            if let Some(followed) = &mut followed {
                frames.choose(time, followed);
            }
            frames.end_frame(time, due);
        }
    }

    /// Exposes a frame of the state at a start, of which nothing is missing and all motions are known.
    pub(super) fn look(
        &self,
        now: f64,
        sensing: &Sensing,
        draws: &mut Draws,
        watched: Watched<'_>,
        frames: &mut Frames,
    ) {
        let mut film = Film::default();
        film.expose(ExposureId { time: now, number: 0, key: 0 }, 0.0, watched.state);
        let exposed = film.of(0, watched.parameters).next().expect("an exposure");
        let nearest = |position: Vector| {
            let all = self.all.iter();
            let distance = |camera: &&Camera| (camera.middle - position).length_squared();
            all.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("at least one")
        };
        let motion = exposed.motion(BALL);
        let noise = draws.normals(sensing.ball_position_noise);
        let (ball, motion) = nearest(motion.position).detect_ball(exposed, &motion, sensing, noise);
        frames.add_ball(ball, Some(motion));
        for block in 0..exposed.motions().len() {
            let mut detected = DetectedBlock::NONE;
            for lane in set_bits(lanes_of_robots(exposed.robots_on_field(), block).into()) {
                let index = robot_at(block, lane);
                let motion = exposed.motion(robot(index));
                let camera = nearest(motion.position);
                detected.set(lane, &camera.detect_robot(index, &motion, sensing, draws, false));
            }
            frames.blocks()[block] = detected;
            frames.add_velocities(exposed.velocities(block));
        }
        frames.end_frame(now, now);
    }
}

/// Adds all robots to a frame as cameras without errors of their own would detect them, but none as detected yet.
/// Returns the noise of the ball's first detection, m.
fn add_robots(
    exposed: Exposed<'_>,
    sensing: &Sensing,
    draws: &mut Draws,
    frames: &mut Frames,
) -> Vector {
    let mut of_ball = Vector::ZERO;
    let mut deviations = [sensing.robot_position_noise; LANES];
    deviations[BALL] = sensing.ball_position_noise;
    let blocks = frames.blocks();
    for (block, true_motion) in exposed.motions().iter().enumerate() {
        let PoseNoise { place, turn } = draws.poses(Lanes::from(deviations), sensing.heading_noise);
        if block == 0 {
            of_ball = place.get(BALL);
            deviations[BALL] = sensing.robot_position_noise;
        }
        let position = true_motion.position + place;
        let mut heading = true_motion.heading;
        if sensing.heading_noise > 0.0 {
            heading = turned(heading, turn);
        }
        blocks[block] = DetectedBlock { position, heading, ..DetectedBlock::NONE };
    }
    if knows_motions(sensing) {
        for block in 0..exposed.motions().len() {
            frames.add_velocities(exposed.velocities(block));
        }
    }
    of_ball
}

/// Whether robots know the motions of what is detected: without a tracker.
fn knows_motions(sensing: &Sensing) -> bool {
    sensing.tracker < 0.5
}

impl Camera {
    /// All cameras of a field, with their errors.
    fn all(config: &SimConfig, sensing: &Sensing, draws: &mut Draws) -> Vec<Self> {
        let overlap = sensing.camera_overlap;
        let columns = parts(config.field.length, sensing.cameras_along, overlap);
        let rows = parts(config.field.width, sensing.cameras_across, overlap);
        let mut all = Vec::with_capacity(columns.len() * rows.len());
        let mut index = 0;
        for column in &columns {
            for row in &rows {
                let error = sensing.camera_offset_error;
                all.push(Self {
                    middle: Vector::new(column.middle, row.middle),
                    from: Vector::new(column.from, row.from),
                    to: Vector::new(column.to, row.to),
                    offset: Vector::new(draws.normal(error), draws.normal(error)),
                    index,
                });
                index += 1;
            }
        }
        all
    }

    /// Whether the camera sees points of the floor.
    fn sees(&self, points: VectorLanes) -> Lanes {
        let Self { from, to, .. } = self;
        let along = points.x.simd_ge(Lanes::splat(from.x)) & points.x.simd_le(Lanes::splat(to.x));
        let across = points.y.simd_ge(Lanes::splat(from.y)) & points.y.simd_le(Lanes::splat(to.y));
        along & across
    }

    /// Adds what the camera detects to a frame. `of_ball` is the noise of the ball's first detection, m.
    fn detect(
        &self,
        exposed: Exposed<'_>,
        sensing: &Sensing,
        period: f64,
        (draws, of_ball): (&mut Draws, &mut Option<Vector>),
        frames: &mut Frames,
    ) {
        let has_motions = knows_motions(sensing);
        let parameters = exposed.parameters;
        let ball = exposed.motion(BALL);
        if self.sees(VectorLanes::splat(ball.position)).any()
            && !draws.happens(sensing.missing_balls)
            && !self.is_hidden(exposed, ball.position, sensing)
        {
            let noise =
                of_ball.take().unwrap_or_else(|| draws.normals(sensing.ball_position_noise));
            let (seen, motion) = self.detect_ball(exposed, &ball, sensing, noise);
            frames.add_ball(seen, has_motions.then_some(motion));
        }
        #[expect(clippy::cast_possible_truncation, reason = "a duration")]
        let ghost = sensing.ghost_balls * period as f32;
        let robots = parameters.robots.len();
        let missing = draws.which(sensing.missing_robots, robots);
        let misread = draws.which(sensing.misread_headings, robots);
        let ghosts = draws.which(ghost, robots);
        let on_field = exposed.robots_on_field();
        for (block, motions) in exposed.motions().iter().enumerate() {
            let inside = self.sees(motions.position).to_bitmask();
            let there = lanes_of_robots(on_field, block);
            #[expect(clippy::cast_possible_truncation, reason = "four bits")]
            let inside = inside as u8 & there;
            let seen = inside & !lanes_of_robots(missing, block);
            let detected = &mut frames.blocks()[block];
            let (first, again) = (seen & !detected.bodies, seen & detected.bodies);
            if first != 0 {
                self.add_first(detected, first);
            }
            for lane in set_bits((first & lanes_of_robots(misread, block)).into()) {
                let heading = detected.heading.get(lane);
                detected.heading.set(lane, misread_heading(heading, draws));
            }
            for lane in set_bits(again.into()) {
                let index = robot_at(block, lane);
                let motion = exposed.motion(robot(index));
                let is_misread = misread >> index & 1 == 1;
                frames.add_again(self.detect_robot(index, &motion, sensing, draws, is_misread));
            }
            for lane in set_bits((inside & lanes_of_robots(ghosts, block)).into()) {
                let index = robot_at(block, lane);
                let motion = exposed.motion(robot(index));
                let front =
                    parameters.robots[index].model.front_distance() + parameters.ball.radius;
                let position = motion.position + motion.heading * front;
                let ghost = DetectedBall { position, z: 0.0, camera: self.index };
                let moving = BallMotion { velocity: motion.velocity, ..BallMotion::default() };
                frames.add_ball(ghost, has_motions.then_some(moving));
            }
        }
    }

    /// Takes the robots of `lanes`, one bit each, of a block for detected by this camera.
    fn add_first(&self, detected: &mut DetectedBlock, lanes: u8) {
        detected.bodies |= lanes;
        if self.index > 0 {
            set_bits(lanes.into()).for_each(|lane| detected.cameras[lane] = self.index);
        }
        if self.offset != Vector::ZERO {
            let mask = mask_of_bits(lanes.into());
            let moved = detected.position + VectorLanes::splat(self.offset);
            detected.position = moved.where_else(mask, detected.position);
        }
    }

    fn lens(&self, height: f32) -> Lens {
        Lens { below: self.middle, height }
    }

    /// Whether robots hide too much of the ball.
    fn is_hidden(&self, exposed: Exposed<'_>, ball: Vector, sensing: &Sensing) -> bool {
        if sensing.visible_part == 0.0 || sensing.camera_height == 0.0 {
            return false;
        }
        let parameters = exposed.parameters;
        let radius = parameters.ball.radius;
        let (lens, z) = (self.lens(sensing.camera_height), exposed.height() + radius);
        // A robot that hides the ball is nearer to the camera, or touches it.
        let reach = radius + lens.shadow(parameters.highest) * (ball - self.middle).length();
        let near = exposed.robots_near(ball, reach);
        set_bits(near).any(|index| {
            let body = &parameters.robots[index];
            let position = exposed.motion(robot(index)).position;
            let obstacle =
                Obstacle { position, radius: body.bounding_radius, height: body.model.height };
            lens.visible_part(ball, z, radius, obstacle) < sensing.visible_part
        })
    }

    /// The ball as the camera detects it with `noise` (m), and its motion.
    fn detect_ball(
        &self,
        exposed: Exposed<'_>,
        ball: &Motion,
        sensing: &Sensing,
        noise: Vector,
    ) -> (DetectedBall, BallMotion) {
        let (velocity, camera) = (ball.velocity, self.index);
        let z = exposed.height();
        if sensing.camera_height == 0.0 {
            let position = ball.position + self.offset + noise;
            let (v_z, spin) = exposed.ball_motion();
            let motion = BallMotion { velocity, v_z, spin };
            return (DetectedBall { position, z, camera }, motion);
        }
        let seen = self.lens(sensing.camera_height).on_floor(ball.position, z);
        let rolling = velocity.perp() / exposed.parameters.ball.radius;
        let motion = BallMotion { velocity, v_z: 0.0, spin: rolling.extend(0.0) };
        (DetectedBall { position: seen + self.offset + noise, z: 0.0, camera }, motion)
    }

    /// Robot `index` as the camera detects it.
    fn detect_robot(
        &self,
        index: usize,
        motion: &Motion,
        sensing: &Sensing,
        draws: &mut Draws,
        is_misread: bool,
    ) -> DetectedRobot {
        let noise = draws.normals(sensing.robot_position_noise);
        let turn = draws.normal(sensing.heading_noise);
        let mut heading = motion.heading;
        if turn != 0.0 {
            heading = heading.rotate(direction(turn));
        }
        if is_misread {
            heading = misread_heading(heading, draws);
        }
        #[expect(clippy::cast_possible_truncation, reason = "at most 63 robots")]
        let robot = index as u8;
        let position = motion.position + self.offset + noise;
        DetectedRobot { position, heading, robot, camera: self.index }
    }
}

/// A heading that is misread by 90 degrees.
fn misread_heading(heading: Vector, draws: &mut Draws) -> Vector {
    if draws.uniform() < 0.5 { heading.perp() } else { -heading.perp() }
}

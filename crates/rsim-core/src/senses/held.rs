//! The ball in a robot's mouth, as trackers of teams know it: a cut break beam tells that it is there, and
//! then it moves with the robot.
//!
//! Cameras see it badly there: the robot may hide it, and the noise of both bodies gives it a velocity
//! relative to the robot that it does not have.

use serde::{Deserialize, Serialize};

use crate::blocks::set_bits;
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::sensing::Sensing;
use crate::senses::detections::DetectedBall;
use crate::senses::filter::Parts;
use crate::senses::noise::Noise;

/// Acceleration of a held ball in the mouth that its filter counts with, m/s²: it slips along the dribbler when the
/// robot turns.
const ACCELERATION: f32 = 2.0;

/// Distance of an estimate from the mouth up to which a cut beam tells of this ball, in standard deviations of
/// a detection in the robot's frame, and at least, m.
const DEVIATIONS: f32 = 4.0;
const MIN_MARGIN: f32 = 0.01;

/// Time between two detections that a velocity is computed with at least, s.
const MIN_PERIOD: f32 = 0.001;

/// Time without a detection after which nobody knows where the ball slips, s: two frames at 60 Hz and some more.
const SLIP_LOST: f32 = 0.04;

/// Break beams that are known to be cut, and the robots.
#[derive(Clone, Copy)]
pub(super) struct Beams<'a> {
    /// A bit for each robot.
    pub(super) cut: u64,
    pub(super) parameters: &'a BodyParameters,
}

/// A ball that a robot holds.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Held {
    /// The robot, by its index.
    pub(super) robot: usize,
    /// Place in the robot's frame, m, and velocity there, m/s.
    place: Vector,
    velocity: Vector,
    /// Time since the last detection, s.
    unseen: f32,
}

/// Part of a mouth in which the center of a held ball can be, in the robot's frame, m.
struct Room {
    from: Vector,
    to: Vector,
    /// Standard deviation of a detection of the ball there that filters count with, m.
    deviation: f32,
}

impl Room {
    /// The room of a robot; `None` without a mouth.
    fn of(robot: usize, beams: Beams<'_>, sensing: &Sensing) -> Option<Self> {
        let model = &beams.parameters.robots[robot].model;
        let mouth = model.mouth.as_ref()?;
        let (front, radius) = (model.front_distance(), beams.parameters.ball.radius);
        let side = mouth.mouth_width / 2.0;
        let noise = Noise::of(sensing);
        let turned = noise.heading * (front + radius);
        let variance = noise.ball * noise.ball + noise.robot * noise.robot + turned * turned;
        Some(Self {
            from: Vector::new(front + radius, -side),
            to: Vector::new(front + radius + mouth.beam_distance, side),
            deviation: variance.sqrt(),
        })
    }

    /// Distance from the room up to which the ball may be detected, m.
    fn margin(&self) -> f32 {
        (DEVIATIONS * self.deviation).max(MIN_MARGIN)
    }

    fn distance(&self, place: Vector) -> f32 {
        (place - place.clamp(self.from, self.to)).length()
    }
}

/// A point of the field in a robot's frame, m.
fn in_frame(point: Vector, robot: &Motion) -> Vector {
    let offset = point - robot.position;
    Vector::new(offset.dot(robot.heading), offset.dot(robot.heading.perp()))
}

impl Held {
    /// The ball, if it is estimated at `ball` and a beam is cut there. `robots` are the estimates of all robots.
    pub(super) fn find(
        ball: Vector,
        robots: impl Fn(usize) -> Motion,
        beams: Beams<'_>,
        sensing: &Sensing,
    ) -> Option<Self> {
        set_bits(beams.cut).find_map(|robot| {
            let room = Room::of(robot, beams, sensing)?;
            let place = in_frame(ball, &robots(robot));
            let is_there = room.distance(place) <= room.margin();
            let place = place.clamp(room.from, room.to);
            is_there.then_some(Self { robot, place, velocity: Vector::ZERO, unseen: 0.0 })
        })
    }

    /// Takes in the balls of a frame, `period` (s) after the last. Returns whether the robot, which is estimated at
    /// `robot`, still holds the ball: not where a ball is seen elsewhere, whatever the beam says.
    pub(super) fn take(
        &mut self,
        balls: &[DetectedBall],
        robot: &Motion,
        beams: Beams<'_>,
        sensing: &Sensing,
        period: f32,
    ) -> bool {
        if beams.cut >> self.robot & 1 == 0 {
            return false;
        }
        let Some(room) = Room::of(self.robot, beams, sensing) else { return false };
        let predicted = self.place + self.velocity * period;
        self.unseen += period;
        let places = balls.iter().map(|ball| in_frame(ball.position, robot));
        let nearest = places.min_by(|a, b| room.distance(*a).total_cmp(&room.distance(*b)));
        let Some(place) = nearest else {
            self.place = predicted.clamp(room.from, room.to);
            if self.unseen > SLIP_LOST {
                self.velocity = Vector::ZERO;
            }
            return true;
        };
        if room.distance(place) > room.margin() {
            return false;
        }
        let time = self.unseen.min(SLIP_LOST);
        let parts = Parts::stationary(ACCELERATION * time * time / room.deviation);
        let difference = place - predicted;
        self.place = (predicted + difference * parts.alpha).clamp(room.from, room.to);
        self.velocity += difference * (parts.beta / time.max(MIN_PERIOD));
        self.unseen = 0.0;
        true
    }

    /// Position and velocity of the ball, with those of the robot, m and m/s.
    pub(super) fn motion(&self, robot: &Motion) -> (Vector, Vector) {
        let arm = robot.heading * self.place.x + robot.heading.perp() * self.place.y;
        let own = robot.heading * self.velocity.x + robot.heading.perp() * self.velocity.y;
        (robot.position + arm, robot.velocity + arm.perp() * robot.angular_velocity + own)
    }
}

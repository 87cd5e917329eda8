//! Checks of the rows that matches start from.

mod overlaps;
mod reading;

use crate::ball::state::BallState;
use crate::blocks::{BALL, robot, set_bits};
use crate::body_parameters::BodyParameters;
use crate::columns::{
    BALL_COLUMNS, MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED,
    MAX_PLACED_SPIN, ROBOT_COLUMNS,
};
use crate::engine::Shape;
use crate::error::PlaceError;
use crate::geometry::arena::{Wall, position_limit};
use crate::geometry::bench::bench_place;
use crate::geometry::motion::Motion;
use crate::math::{Pose, Vec3, Vector};
use crate::models::config::SimConfig;
use crate::models::field::Field;
use crate::models::robot::RobotModel;
use crate::world::line_up::line_up;

/// Maximum overlap of two bodies, m: the overlap in running matches under pressure, so that each of
/// their states can be placed again.
pub(super) const TOLERANCE: f32 = 0.01;

/// Allowed error of the length of a heading, which is then normalized.
const HEADING_TOLERANCE: f32 = 1e-3;

/// Error of the squared length of a heading by rounding, up to which it is unchanged, so that a state
/// that was read can be placed again exactly.
const HEADING_ERROR: f32 = 1e-5;

/// A vector that was drawn up to a maximum may be a rounding error above it.
const ROUNDED: f32 = 1.0 + 1e-6;

/// Motions of all bodies in a row.
#[derive(Debug, Clone)]
pub(super) struct Start {
    /// Ball, then robots.
    pub(super) motions: Vec<Motion>,
    pub(super) ball: BallState,
    /// Robots that are not on the field, one bit each.
    pub(super) absent: u64,
}

impl Start {
    /// Indices among the bodies of the robots on the field.
    pub(super) fn present(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        let (bodies, absent) = (self.motions.len(), self.absent << robot(0));
        (robot(0)..bodies).filter(move |body| absent >> body & 1 == 0)
    }
}

/// Motion and state of the ball in its columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct BallStart {
    pub(super) motion: Motion,
    pub(super) ball: BallState,
}

/// Checks starting rows against the field and the models.
pub(super) struct Placement {
    field: Field,
    pub(super) walls: Vec<(Wall, Shape)>,
    ball_radius: f32,
    robots: Vec<Shape>,
    /// Places of absent robots.
    benches: Vec<Motion>,
    /// Radii of circles around all bodies, m.
    bounding_radii: Vec<f32>,
    pub(super) line_up: Vec<Motion>,
    names: Vec<String>,
}

impl Placement {
    pub(super) fn new(config: &SimConfig, walls: &[Wall]) -> Self {
        let names = (0..config.n_robots()).map(|index| config.robot_name(index));
        Self {
            field: config.field.clone(),
            walls: walls.iter().map(|wall| (wall.clone(), Shape::of_wall(wall))).collect(),
            ball_radius: config.ball.radius,
            robots: config.robots().map(|model| Shape::of_robot(model.body)).collect(),
            benches: benches(config),
            bounding_radii: std::iter::once(config.ball.radius)
                .chain(config.robots().map(RobotModel::bounding_radius))
                .collect(),
            line_up: line_up(config),
            names: std::iter::once("ball".to_owned()).chain(names).collect(),
        }
    }

    /// Reads and checks a start row. `parameters` has the heights of robots in that world.
    pub(super) fn read(
        &self,
        row: &[f32],
        parameters: &BodyParameters,
    ) -> Result<Start, PlaceError> {
        let mut start = self.parse(row)?;
        self.check(&mut start, parameters)?;
        Ok(start)
    }

    /// Checks a start against the field and the models, and normalizes headings.
    pub(super) fn check(
        &self,
        start: &mut Start,
        parameters: &BodyParameters,
    ) -> Result<(), PlaceError> {
        self.check_ball_alone(&mut start.motions[BALL], &start.ball)?;
        for who in start.present() {
            self.check_robot_alone(who, &mut start.motions[who])?;
        }
        start.present().try_for_each(|who| self.check_among_first(who, start, parameters))
    }

    /// Checks a robot against the ball and the robots before it.
    fn check_among_first(
        &self,
        who: usize,
        start: &Start,
        parameters: &BodyParameters,
    ) -> Result<(), PlaceError> {
        self.check_ball(who, &start.motions, &start.ball, parameters)?;
        let mut before = start.present().take_while(|first| *first < who);
        before.try_for_each(|first| {
            self.check_overlap([first, who], self.overlap([first, who], &start.motions))
        })
    }

    /// Reads and checks new states of robots, with the ball and all other robots as in `start`. Only
    /// the robots of `mask`, one bit each, are read from the row and checked.
    pub(super) fn read_robots(
        &self,
        row: &[f32],
        mask: u64,
        mut start: Start,
        parameters: &BodyParameters,
    ) -> Result<Start, PlaceError> {
        let robots = &row[BALL_COLUMNS.len()..];
        for index in set_bits(mask) {
            let columns = &robots[index * ROBOT_COLUMNS.len()..][..ROBOT_COLUMNS.len()];
            let (motion, is_absent) = self.parse_robot(index, columns)?;
            start.motions[robot(index)] = motion;
            start.absent = start.absent & !(1 << index) | u64::from(is_absent) << index;
        }
        for index in set_bits(mask & !start.absent) {
            let who = robot(index);
            self.check_robot_alone(who, &mut start.motions[who])?;
            self.check_ball(who, &start.motions, &start.ball, parameters)?;
            for other in start.present().filter(|other| *other != who) {
                let pair = [who.min(other), who.max(other)];
                self.check_overlap(pair, self.overlap(pair, &start.motions))?;
            }
        }
        Ok(start)
    }

    /// Reads and checks a start of the ball, with all other bodies as in `motions`. The first of
    /// `motions` is the ball's own and is ignored.
    pub(super) fn read_ball(
        &self,
        columns: &[f32],
        mut motions: Vec<Motion>,
        parameters: &BodyParameters,
    ) -> Result<BallStart, PlaceError> {
        let mut start = self.parse_ball(columns)?;
        self.check_ball_alone(&mut start.motion, &start.ball)?;
        motions[BALL] = start.motion;
        (1..motions.len())
            .try_for_each(|who| self.check_ball(who, &motions, &start.ball, parameters))?;
        Ok(start)
    }

    /// Checks the ball against the limits of a start and the field.
    fn check_ball_alone(&self, motion: &mut Motion, ball: &BallState) -> Result<(), PlaceError> {
        if ball.z < 0.0 {
            return Err(PlaceError::Below { z: ball.z });
        }
        if ball.z > MAX_PLACED_HEIGHT {
            return Err(PlaceError::TooHigh { z: ball.z });
        }
        self.check_speed(BALL, "v_x, v_y, v_z", motion.velocity.extend(ball.v_z))?;
        let spin = length(ball.spin);
        if spin > MAX_PLACED_SPIN * ROUNDED {
            return Err(PlaceError::SpinsTooFast { spin });
        }
        self.check_alone(BALL, motion, ball.z)
    }

    /// Checks a robot against the limits of a start and the field.
    fn check_robot_alone(&self, who: usize, motion: &mut Motion) -> Result<(), PlaceError> {
        self.check_speed(who, "v_x, v_y", motion.velocity.extend(0.0))?;
        let angular_velocity = motion.angular_velocity;
        if angular_velocity.abs() > MAX_PLACED_ANGULAR_VELOCITY * ROUNDED {
            let who = self.names[who].clone();
            return Err(PlaceError::TurnsTooFast { who, angular_velocity });
        }
        self.check_alone(who, motion, 0.0)
    }

    fn check_speed(
        &self,
        who: usize,
        columns: &'static str,
        velocity: Vec3,
    ) -> Result<(), PlaceError> {
        let speed = length(velocity);
        if speed > MAX_PLACED_SPEED * ROUNDED {
            return Err(PlaceError::TooFast { who: self.names[who].clone(), columns, speed });
        }
        Ok(())
    }

    /// Checks a body against the field, and normalizes its heading.
    pub(super) fn check_alone(
        &self,
        who: usize,
        motion: &mut Motion,
        z: f32,
    ) -> Result<(), PlaceError> {
        let name = || self.names[who].clone();
        let Motion { position, heading, .. } = *motion;
        if (heading.length() - 1.0).abs() > HEADING_TOLERANCE {
            return Err(PlaceError::Heading { who: name(), cos: heading.x, sin: heading.y });
        }
        if (heading.length_squared() - 1.0).abs() > HEADING_ERROR {
            motion.heading = heading.normalize();
        }
        let in_wall = |(wall, shape): &(Wall, Shape)| match who {
            BALL => self.ball_and_wall(wall, position, z).distance < -TOLERANCE,
            _ if !wall.stands_on_floor() => false,
            _ => self.shape(who).overlap(&pose(motion), shape, &wall.pose) > TOLERANCE,
        };
        let inside = position.abs().cmple(self.limit(who, z)).all();
        if !inside || self.walls.iter().any(in_wall) {
            return Err(PlaceError::Outside { who: name(), x: position.x, y: position.y });
        }
        Ok(())
    }

    /// Maximum distance of a body from the center, m; of the ball at height `z`.
    pub(super) fn limit(&self, who: usize, z: f32) -> Vector {
        position_limit(&self.field, if who == BALL { z + self.ball_radius } else { 0.0 })
    }

    /// Radius of a circle around a body, m.
    pub(super) fn bounding_radius(&self, body: usize) -> f32 {
        self.bounding_radii[body]
    }

    /// Shape of a robot, by its index among the bodies.
    pub(super) fn shape(&self, body: usize) -> &Shape {
        &self.robots[body - 1]
    }
}

/// Places of the robots of a match while they are absent.
fn benches(config: &SimConfig) -> Vec<Motion> {
    let teams = [(&config.blue, true), (&config.yellow, false)];
    let places = teams.into_iter().flat_map(|(team, is_blue)| {
        (0..team.len()).map(move |index| bench_place(&config.field, is_blue, index))
    });
    places.collect()
}

/// Length of a vector; squares of absurd numbers are still finite.
pub(super) fn length(vector: Vec3) -> f32 {
    let squares = vector.to_array().map(|part| f64::from(part) * f64::from(part));
    #[allow(clippy::cast_possible_truncation)]
    // at most the largest number of f32 times the root of 3
    let length = squares.iter().sum::<f64>().sqrt() as f32;
    length
}

pub(super) fn pose(motion: &Motion) -> Pose {
    Pose::from_parts(motion.position, motion.rotation())
}

//! Checks of the rows that matches start from.

use crate::ball::state::BallState;
use crate::blocks::BALL;
use crate::body_params::BodyParams;
use crate::columns::{
    BALL_COLUMNS, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED, MAX_PLACED_SPIN, MAX_PLACED_TURN_RATE,
    ROBOT_COLUMNS,
};
use crate::engine::Shape;
use crate::error::PlaceError;
use crate::geometry::arena::{Wall, position_limit};
use crate::geometry::clearance::Clearance;
use crate::geometry::motion::Motion;
use crate::math::{Pose, Vec3, Vector};
use crate::models::config::SimConfig;
use crate::models::field::Field;

/// Maximum overlap of two bodies, m: the overlap in running matches under pressure, so that each of
/// their states can be placed again.
const TOLERANCE: f32 = 0.01;

/// Allowed error of the length of a heading, which is then normalised.
const HEADING_TOLERANCE: f32 = 1e-3;

/// Error of the squared length of a heading by rounding, up to which it is unchanged, so that a state
/// that was read can be placed again exactly.
const HEADING_ERROR: f32 = 1e-5;

/// Number of columns of the ball, and of a robot, that a match starts from.
const PLACED_OF_BALL: usize = 9;
const PLACED_OF_ROBOT: usize = 7;

/// A vector that was drawn up to a maximum may be a rounding error above it.
const ROUNDED: f32 = 1.0 + 1e-6;

/// Motions of all bodies in a row.
#[derive(Debug, Clone)]
pub(super) struct Start {
    /// Ball, then robots.
    pub(super) motions: Vec<Motion>,
    pub(super) ball: BallState,
}

/// Motion and state of the ball in its columns.
#[derive(Debug, Clone)]
pub(super) struct BallStart {
    pub(super) motion: Motion,
    pub(super) ball: BallState,
}

/// Checks starting rows against the field and the models.
pub(super) struct Placement {
    field: Field,
    walls: Vec<(Wall, Shape)>,
    ball_radius: f32,
    robots: Vec<Shape>,
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
            names: std::iter::once("ball".to_owned()).chain(names).collect(),
        }
    }

    /// Reads and checks a start row. `params` has the heights of robots in that world.
    pub(super) fn read(&self, row: &[f32], params: &BodyParams) -> Result<Start, PlaceError> {
        let (columns, robots) = row.split_at(BALL_COLUMNS.len());
        let BallStart { motion, ball } = self.read_ball_alone(columns)?;
        let mut motions = vec![motion];
        for (who, columns) in (1..).zip(robots.chunks_exact(ROBOT_COLUMNS.len())) {
            motions.push(self.read_robot_alone(who, columns)?);
        }
        for second in 1..motions.len() {
            self.check_ball(second, &motions, &ball, params)?;
            for first in 1..second {
                let [a, b] = [first, second].map(|who| (pose(&motions[who]), self.shape(who)));
                self.check_overlap([first, second], a.1.overlap(&a.0, b.1, &b.0))?;
            }
        }
        Ok(Start { motions, ball })
    }

    /// Reads and checks a start of the ball, with all other bodies as in `motions`. The first of
    /// `motions` is the ball's own and is ignored.
    pub(super) fn read_ball(
        &self,
        columns: &[f32],
        mut motions: Vec<Motion>,
        params: &BodyParams,
    ) -> Result<BallStart, PlaceError> {
        let start = self.read_ball_alone(columns)?;
        motions[BALL] = start.motion;
        (1..motions.len())
            .try_for_each(|who| self.check_ball(who, &motions, &start.ball, params))?;
        Ok(start)
    }

    /// Reads a start of the ball and checks it against the field.
    fn read_ball_alone(&self, columns: &[f32]) -> Result<BallStart, PlaceError> {
        self.check_finite(BALL, &BALL_COLUMNS[..PLACED_OF_BALL], columns)?;
        let (mut motion, ball) = read_ball(columns);
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
        self.check_alone(BALL, &mut motion, ball.z)?;
        Ok(BallStart { motion, ball })
    }

    /// Reads a start of a robot and checks it against the field.
    fn read_robot_alone(&self, who: usize, columns: &[f32]) -> Result<Motion, PlaceError> {
        self.check_finite(who, &ROBOT_COLUMNS[..PLACED_OF_ROBOT], columns)?;
        let mut motion = read_robot(columns);
        self.check_speed(who, "v_x, v_y", motion.velocity.extend(0.0))?;
        let rate = motion.spin;
        if rate.abs() > MAX_PLACED_TURN_RATE * ROUNDED {
            return Err(PlaceError::TurnsTooFast { who: self.names[who].clone(), rate });
        }
        self.check_alone(who, &mut motion, 0.0)?;
        Ok(motion)
    }

    /// Checks that the values of these columns are finite.
    fn check_finite(
        &self,
        who: usize,
        names: &[&'static str],
        columns: &[f32],
    ) -> Result<(), PlaceError> {
        let mut wrong = names.iter().zip(columns).filter(|(_, value)| !value.is_finite());
        wrong.next().map_or(Ok(()), |(column, got)| {
            Err(PlaceError::NotFinite { who: self.names[who].clone(), column, got: *got })
        })
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

    /// Checks a body against the field, and normalises its heading.
    fn check_alone(&self, who: usize, motion: &mut Motion, z: f32) -> Result<(), PlaceError> {
        let name = || self.names[who].clone();
        let Motion { position, heading, .. } = *motion;
        if (heading.length() - 1.0).abs() > HEADING_TOLERANCE {
            return Err(PlaceError::Heading { who: name(), cos: heading.x, sin: heading.y });
        }
        if (heading.length_squared() - 1.0).abs() > HEADING_ERROR {
            motion.heading = heading.normalize();
        }
        let in_wall = |(wall, shape): &(Wall, Shape)| match who {
            BALL => self.gap_to_wall(wall, position, z) < -TOLERANCE,
            _ if !wall.stands_on_floor() => false,
            _ => self.shape(who).overlap(&pose(motion), shape, &wall.pose) > TOLERANCE,
        };
        let limit =
            position_limit(&self.field, if who == BALL { z + self.ball_radius } else { 0.0 });
        let inside = position.abs().cmple(limit).all();
        if !inside || self.walls.iter().any(in_wall) {
            return Err(PlaceError::Outside { who: name(), x: position.x, y: position.y });
        }
        Ok(())
    }

    /// Checks the overlap of the ball with a robot, which it may fly over.
    fn check_ball(
        &self,
        who: usize,
        motions: &[Motion],
        ball: &BallState,
        params: &BodyParams,
    ) -> Result<(), PlaceError> {
        let (robot, motion) = (&params.robots[who - 1], &motions[who]);
        let center = motions[BALL].position;
        let nearest = robot.outline.nearest_at(motion.position, motion.rotation(), center);
        let heights = [0.0, robot.model.height];
        let radius = self.ball_radius;
        let clearance = Clearance::of_upright(&nearest, heights, ball.z + radius, radius);
        self.check_overlap([BALL, who], -clearance.distance)
    }

    /// Distance of a ball at height `z` from a wall, m; negative inside.
    fn gap_to_wall(&self, wall: &Wall, center: Vector, z: f32) -> f32 {
        let nearest = wall.placed().nearest(center);
        let radius = self.ball_radius;
        Clearance::of_upright(&nearest, [wall.bottom, wall.top], z + radius, radius).distance
    }

    fn check_overlap(&self, [first, second]: [usize; 2], depth: f32) -> Result<(), PlaceError> {
        if depth > TOLERANCE {
            return Err(PlaceError::Overlap {
                first: self.names[first].clone(),
                second: self.names[second].clone(),
                depth_mm: depth * 1000.0,
            });
        }
        Ok(())
    }

    /// Shape of a robot, by its index among the bodies.
    fn shape(&self, body: usize) -> &Shape {
        &self.robots[body - 1]
    }
}

/// Length of a vector; squares of absurd numbers are still finite.
fn length(vector: Vec3) -> f32 {
    let squares = vector.to_array().map(|part| f64::from(part) * f64::from(part));
    #[allow(clippy::cast_possible_truncation)]
    // at most the largest number of f32 times the root of 3
    let length = squares.iter().sum::<f64>().sqrt() as f32;
    length
}

fn pose(motion: &Motion) -> Pose {
    Pose::from_parts(motion.position, motion.rotation())
}

fn read_ball(columns: &[f32]) -> (Motion, BallState) {
    let [x, y, z, v_x, v_y, v_z, spin_x, spin_y, spin_z, ..] = columns else {
        unreachable!("a ball has {BALL_COLUMNS:?}")
    };
    let at_rest = Motion::at_rest(Vector::new(*x, *y), Vector::X);
    let motion = Motion { velocity: Vector::new(*v_x, *v_y), ..at_rest };
    let spin = Vec3::new(*spin_x, *spin_y, *spin_z);
    (motion, BallState { z: *z, v_z: *v_z, spin, hops: 0 })
}

fn read_robot(columns: &[f32]) -> Motion {
    let [x, y, cos, sin, v_x, v_y, v_theta, ..] = columns else {
        unreachable!("a robot has {ROBOT_COLUMNS:?}")
    };
    Motion {
        position: Vector::new(*x, *y),
        heading: Vector::new(*cos, *sin),
        velocity: Vector::new(*v_x, *v_y),
        spin: *v_theta,
    }
}

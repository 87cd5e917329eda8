//! Whether a row is a state that a match can start from. Checked before anything moves.

use rapier2d::math::{Pose, Rotation, Vector};
use rapier2d::parry::query;
use rapier2d::parry::shape::{Ball, Cuboid, Shape};

use crate::arena::{Wall, walls};
use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::engine::Motion;
use crate::{PlaceError, SimConfig};

/// Depth up to which bodies may overlap, m: what a running match may show under pressure, so that
/// each of its states can be placed again.
const TOLERANCE: f32 = 2e-3;

/// Allowed error of the length of a heading; it is made exact afterwards.
const HEADING_TOLERANCE: f32 = 1e-3;

/// Error of a heading that is left as it is: what rounding makes of a unit vector. So a state that
/// was read can be placed again without a change.
const HEADING_ERROR: f32 = 1e-5;

/// Checks starting rows against the field and the models.
pub(crate) struct Placement {
    walls: Vec<Wall>,
    ball: Ball,
    robot: Cuboid,
    reach: Vector,
    names: Vec<String>,
}

impl Placement {
    pub(crate) fn new(config: &SimConfig) -> Self {
        let field = &config.field;
        let robots = (0..config.n_robots()).map(|index| config.robot_name(index));
        Self {
            walls: walls(field),
            ball: Ball::new(config.ball.radius),
            robot: Cuboid::new(Vector::splat(config.robot.size / 2.0)),
            reach: Vector::new(field.half_length() + field.goal_depth, field.half_width()),
            names: std::iter::once("ball".to_owned()).chain(robots).collect(),
        }
    }

    /// The motions that `row` asks for, ball first.
    pub(crate) fn read(&self, row: &[f32]) -> Result<Vec<Motion>, PlaceError> {
        let (ball, robots) = row.split_at(BALL_COLUMNS.len());
        let mut motions = vec![ball_motion(ball)];
        motions.extend(robots.chunks_exact(ROBOT_COLUMNS.len()).map(robot_motion));
        for (who, motion) in motions.iter_mut().enumerate() {
            self.check_alone(who, motion)?;
        }
        for second in 0..motions.len() {
            for first in 0..second {
                self.check_pair(first, second, &motions)?;
            }
        }
        Ok(motions)
    }

    /// Checks a body by itself, and makes its heading a unit vector.
    fn check_alone(&self, who: usize, motion: &mut Motion) -> Result<(), PlaceError> {
        let name = || self.names[who].clone();
        let Motion { position, heading, velocity, spin } = *motion;
        if !(position.is_finite()
            && heading.is_finite()
            && velocity.is_finite()
            && spin.is_finite())
        {
            return Err(PlaceError::NotFinite { who: name() });
        }
        if (heading.length() - 1.0).abs() > HEADING_TOLERANCE {
            return Err(PlaceError::Heading { who: name(), cos: heading.x, sin: heading.y });
        }
        if (heading.length_squared() - 1.0).abs() > HEADING_ERROR {
            motion.heading = heading.normalize();
        }
        let inside = position.abs().cmple(self.reach).all();
        if !inside
            || self.walls.iter().any(|wall| self.depth_in_wall(who, motion, wall) > TOLERANCE)
        {
            return Err(PlaceError::Outside { who: name(), x: position.x, y: position.y });
        }
        Ok(())
    }

    fn check_pair(
        &self,
        first: usize,
        second: usize,
        motions: &[Motion],
    ) -> Result<(), PlaceError> {
        let (a, b) = (&motions[first], &motions[second]);
        let depth = depth(&pose(a), self.shape(first), &pose(b), self.shape(second));
        if depth > TOLERANCE {
            return Err(PlaceError::Overlap {
                first: self.names[first].clone(),
                second: self.names[second].clone(),
                depth_mm: depth * 1000.0,
            });
        }
        Ok(())
    }

    fn depth_in_wall(&self, who: usize, motion: &Motion, wall: &Wall) -> f32 {
        depth(&pose(motion), self.shape(who), &wall.pose, &wall.shape)
    }

    fn shape(&self, who: usize) -> &dyn Shape {
        if who == 0 { &self.ball } else { &self.robot }
    }
}

/// How deep two shapes are in each other, m; 0 when apart.
fn depth(pose_a: &Pose, a: &dyn Shape, pose_b: &Pose, b: &dyn Shape) -> f32 {
    let contact = query::contact(pose_a, a, pose_b, b, 0.0);
    // Every pair of these shapes has a contact query; `Err` says that one has not.
    contact.ok().flatten().map_or(0.0, |contact| -contact.dist)
}

fn pose(motion: &Motion) -> Pose {
    Pose::from_parts(motion.position, Rotation { re: motion.heading.x, im: motion.heading.y })
}

fn ball_motion(columns: &[f32]) -> Motion {
    let [x, y, v_x, v_y, ..] = columns else { unreachable!("a ball has {BALL_COLUMNS:?}") };
    Motion {
        position: Vector::new(*x, *y),
        heading: Vector::X,
        velocity: Vector::new(*v_x, *v_y),
        spin: 0.0,
    }
}

fn robot_motion(columns: &[f32]) -> Motion {
    let [x, y, cos, sin, v_x, v_y, v_theta] = columns else {
        unreachable!("a robot has {ROBOT_COLUMNS:?}")
    };
    Motion {
        position: Vector::new(*x, *y),
        heading: Vector::new(*cos, *sin),
        velocity: Vector::new(*v_x, *v_y),
        spin: *v_theta,
    }
}

//! Whether a row is a state that a match can start from. Checked before anything moves.

use rapier2d::glamx::Vec3;
use rapier2d::math::{Pose, Vector};
use rapier2d::parry::query;
use rapier2d::parry::shape::{Ball as Disc, Cuboid, Shape, SharedShape};

use crate::arena::{Wall, wall_reach};
use crate::ball::Ball;
use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::engine::{BALL, Motion, rotation};
use crate::obstacle::Near;
use crate::physique::Physique;
use crate::robot_model::Body;
use crate::{Field, PlaceError, SimConfig};

/// Depth up to which bodies may overlap, m: what a running match may show under pressure, so that
/// each of its states can be placed again.
const TOLERANCE: f32 = 0.01;

/// Fastest that a body may move at the start, m/s. Kicks reach 14 m/s with the robot's own speed.
pub const FASTEST: f32 = 20.0;

/// Allowed error of the length of a heading; it is made exact afterwards.
const HEADING_TOLERANCE: f32 = 1e-3;

/// Error of a heading that is left as it is: what rounding makes of a unit vector. So a state that
/// was read can be placed again without a change.
const HEADING_ERROR: f32 = 1e-5;

/// Where everything is and how it moves, as a row asks for it.
#[derive(Debug, Clone)]
pub(crate) struct Start {
    /// Ball, then robots.
    pub(crate) motions: Vec<Motion>,
    pub(crate) ball: Ball,
}

/// Where the ball is and how it moves, as its columns ask for it.
#[derive(Debug, Clone)]
pub(crate) struct BallStart {
    pub(crate) motion: Motion,
    pub(crate) ball: Ball,
}

/// Checks starting rows against the field and the models.
pub(crate) struct Placement {
    field: Field,
    walls: Vec<(Wall, Cuboid)>,
    ball: Disc,
    robots: Vec<SharedShape>,
    names: Vec<String>,
}

impl Placement {
    pub(crate) fn new(config: &SimConfig, walls: &[Wall]) -> Self {
        let names = (0..config.n_robots()).map(|index| config.robot_name(index));
        let shapes = config.robots().map(|model| match model.body {
            Body::Square { side } => SharedShape::cuboid(side / 2.0, side / 2.0),
            Body::Round { radius, .. } => SharedShape::ball(radius),
        });
        Self {
            field: config.field.clone(),
            walls: walls.iter().map(|wall| (wall.clone(), wall.shape())).collect(),
            ball: Disc::new(config.ball.radius),
            robots: shapes.collect(),
            names: std::iter::once("ball".to_owned()).chain(names).collect(),
        }
    }

    /// The start that `row` asks for. `physique` says how high robots are in that world.
    pub(crate) fn read(&self, row: &[f32], physique: &Physique) -> Result<Start, PlaceError> {
        let (columns, robots) = row.split_at(BALL_COLUMNS.len());
        let BallStart { motion, ball } = self.read_ball_alone(columns)?;
        let mut motions = vec![motion];
        motions.extend(robots.chunks_exact(ROBOT_COLUMNS.len()).map(read_robot));
        for (who, motion) in motions.iter_mut().enumerate().skip(1) {
            self.check_alone(who, motion, 0.0)?;
        }
        for second in 1..motions.len() {
            self.check_ball(second, &motions, &ball, physique)?;
            for first in 1..second {
                let [a, b] = [first, second].map(|who| (&motions[who], self.shape(who)));
                self.refuse_depth([first, second], depth(&pose(a.0), a.1, &pose(b.0), b.1))?;
            }
        }
        Ok(Start { motions, ball })
    }

    /// The ball that `columns` ask for, where the others stay as they are in `motions`, of which the
    /// first is the ball's own and does not count.
    pub(crate) fn read_ball(
        &self,
        columns: &[f32],
        mut motions: Vec<Motion>,
        physique: &Physique,
    ) -> Result<BallStart, PlaceError> {
        let start = self.read_ball_alone(columns)?;
        motions[BALL] = start.motion;
        (1..motions.len())
            .try_for_each(|who| self.check_ball(who, &motions, &start.ball, physique))?;
        Ok(start)
    }

    /// The ball that `columns` ask for, if the field has room for it.
    fn read_ball_alone(&self, columns: &[f32]) -> Result<BallStart, PlaceError> {
        let (mut motion, ball) = read_ball(columns);
        if !(ball.z.is_finite() && ball.v_z.is_finite() && ball.spin.is_finite()) {
            return Err(PlaceError::NotFinite { who: self.names[BALL].clone() });
        }
        if ball.z < 0.0 {
            return Err(PlaceError::Below { z: ball.z });
        }
        self.check_alone(BALL, &mut motion, ball.z)?;
        Ok(BallStart { motion, ball })
    }

    /// Checks a body by itself, and makes its heading a unit vector.
    fn check_alone(&self, who: usize, motion: &mut Motion, z: f32) -> Result<(), PlaceError> {
        let name = || self.names[who].clone();
        let Motion { position, heading, .. } = *motion;
        if !motion.is_finite() {
            return Err(PlaceError::NotFinite { who: name() });
        }
        let speed = motion.velocity.length();
        // Who draws velocities up to that speed may be a rounding error above it.
        if speed > FASTEST * (1.0 + 1e-6) {
            return Err(PlaceError::TooFast { who: name(), speed });
        }
        if (heading.length() - 1.0).abs() > HEADING_TOLERANCE {
            return Err(PlaceError::Heading { who: name(), cos: heading.x, sin: heading.y });
        }
        if (heading.length_squared() - 1.0).abs() > HEADING_ERROR {
            motion.heading = heading.normalize();
        }
        let in_wall = |(wall, shape): &(Wall, Cuboid)| match who {
            BALL => self.gap_to_wall(wall, position, z) < -TOLERANCE,
            _ if !wall.stands_on_floor() => false,
            _ => depth(&pose(motion), self.shape(who), &wall.pose, shape) > TOLERANCE,
        };
        let reach = wall_reach(&self.field, if who == BALL { z + self.ball.radius } else { 0.0 });
        let inside = position.abs().cmple(reach).all();
        if !inside || self.walls.iter().any(in_wall) {
            return Err(PlaceError::Outside { who: name(), x: position.x, y: position.y });
        }
        Ok(())
    }

    /// Checks the ball against a robot, which it may fly over.
    fn check_ball(
        &self,
        who: usize,
        motions: &[Motion],
        ball: &Ball,
        physique: &Physique,
    ) -> Result<(), PlaceError> {
        let (robot, motion) = (&physique.robots[who - 1], &motions[who]);
        let center = motions[BALL].position;
        let heading = rotation(motion.heading);
        let nearest = robot.outline.nearest_at(motion.position, heading, center);
        let heights = [0.0, robot.model.height];
        let radius = self.ball.radius;
        let near = Near::of_upright(&nearest, heights, ball.z + radius, radius);
        self.refuse_depth([BALL, who], -near.distance)
    }

    /// From a ball at height `z` to a wall, m; negative inside.
    fn gap_to_wall(&self, wall: &Wall, center: Vector, z: f32) -> f32 {
        let nearest = wall.placed().nearest(center);
        let radius = self.ball.radius;
        Near::of_upright(&nearest, [wall.bottom, wall.top], z + radius, radius).distance
    }

    fn refuse_depth(&self, [first, second]: [usize; 2], depth: f32) -> Result<(), PlaceError> {
        if depth > TOLERANCE {
            return Err(PlaceError::Overlap {
                first: self.names[first].clone(),
                second: self.names[second].clone(),
                depth_mm: depth * 1000.0,
            });
        }
        Ok(())
    }

    fn shape(&self, who: usize) -> &dyn Shape {
        if who == BALL { &self.ball } else { &*self.robots[who - 1] }
    }
}

/// How deep two shapes are in each other, m; 0 when apart.
fn depth(pose_a: &Pose, a: &dyn Shape, pose_b: &Pose, b: &dyn Shape) -> f32 {
    let contact = query::contact(pose_a, a, pose_b, b, 0.0);
    // Every pair of these shapes has a contact query; `Err` says that one has not.
    contact.ok().flatten().map_or(0.0, |contact| -contact.dist)
}

fn pose(motion: &Motion) -> Pose {
    Pose::from_parts(motion.position, rotation(motion.heading))
}

fn read_ball(columns: &[f32]) -> (Motion, Ball) {
    let [x, y, z, v_x, v_y, v_z, spin_x, spin_y, spin_z, ..] = columns else {
        unreachable!("a ball has {BALL_COLUMNS:?}")
    };
    let motion = Motion {
        position: Vector::new(*x, *y),
        heading: Vector::X,
        velocity: Vector::new(*v_x, *v_y),
        spin: 0.0,
    };
    let spin = Vec3::new(*spin_x, *spin_y, *spin_z);
    (motion, Ball { z: *z, v_z: *v_z, spin, hops: 0 })
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

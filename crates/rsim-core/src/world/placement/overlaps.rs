//! Overlaps of two bodies, and of the ball with a wall.

use super::{Placement, TOLERANCE, pose};
use crate::ball::state::BallState;
use crate::blocks::BALL;
use crate::body_parameters::BodyParameters;
use crate::error::PlaceError;
use crate::geometry::arena::Wall;
use crate::geometry::clearance::Clearance;
use crate::geometry::motion::Motion;
use crate::math::Vector;

impl Placement {
    /// Checks the overlap of the ball with a robot, which it may fly over.
    pub(in crate::world) fn check_ball(
        &self,
        who: usize,
        motions: &[Motion],
        ball: &BallState,
        parameters: &BodyParameters,
    ) -> Result<(), PlaceError> {
        let clearance = self.ball_and_robot(who, motions, ball.z, parameters);
        self.check_overlap([BALL, who], -clearance.distance)
    }

    /// Clearance of a ball at height `z` from a robot.
    pub(in crate::world) fn ball_and_robot(
        &self,
        who: usize,
        motions: &[Motion],
        z: f32,
        parameters: &BodyParameters,
    ) -> Clearance {
        let (robot, motion) = (&parameters.robots[who - 1], &motions[who]);
        let center = motions[BALL].position;
        let nearest = robot.outline.nearest_at(motion.position, motion.rotation(), center);
        let (heights, radius) = ([0.0, robot.model.height], self.ball_radius);
        Clearance::of_upright(&nearest, heights, z + radius, radius)
    }

    /// Clearance of a ball at height `z` from a wall.
    pub(in crate::world) fn ball_and_wall(&self, wall: &Wall, center: Vector, z: f32) -> Clearance {
        let nearest = wall.placed().nearest(center);
        let radius = self.ball_radius;
        Clearance::of_upright(&nearest, [wall.bottom, wall.top], z + radius, radius)
    }

    /// Depth by which two robots overlap, m; 0 when they are apart.
    pub(super) fn overlap(&self, pair: [usize; 2], motions: &[Motion]) -> f32 {
        let [a, b] = pair.map(|who| (pose(&motions[who]), self.shape(who)));
        a.1.overlap(&a.0, b.1, &b.0)
    }

    pub(super) fn check_overlap(
        &self,
        [first, second]: [usize; 2],
        depth: f32,
    ) -> Result<(), PlaceError> {
        if depth > TOLERANCE {
            return Err(PlaceError::Overlap {
                first: self.names[first].clone(),
                second: self.names[second].clone(),
                depth_mm: depth * 1000.0,
            });
        }
        Ok(())
    }
}

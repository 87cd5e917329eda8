//! Shapes of bodies in the plane for the contact engine, and the overlap of two.

use rapier2d::parry::query;
use rapier2d::parry::shape::SharedShape;

use crate::geometry::arena::Wall;
use crate::math::Pose;
use crate::models::robot::Body;

/// A shape in the plane.
pub(crate) struct Shape(pub(super) SharedShape);

impl Shape {
    /// A robot among robots and walls: a square, or the disc without its flat front, which is cheaper
    /// than the true outline. The ball meets the true outline.
    pub(crate) fn of_robot(body: Body) -> Self {
        Self(match body {
            Body::Square { side_length } => {
                SharedShape::cuboid(side_length / 2.0, side_length / 2.0)
            }
            Body::Round { radius, .. } => SharedShape::ball(radius),
        })
    }

    /// A wall.
    pub(crate) fn of_wall(wall: &Wall) -> Self {
        Self(SharedShape::cuboid(wall.half.x, wall.half.y))
    }

    /// Depth by which this shape at a pose overlaps another, m; 0 when they are apart.
    pub(crate) fn overlap(&self, pose: &Pose, other: &Self, other_pose: &Pose) -> f32 {
        let contact = query::contact(pose, &*self.0, other_pose, &*other.0, 0.0);
        // All pairs of these shapes have a contact query; `Err` says that a pair has none.
        contact.ok().flatten().map_or(0.0, |contact| -contact.dist)
    }
}

//! Shapes of bodies in the plane for the contact engine, and the overlap of two.

use rapier2d::parry::query;
use rapier2d::parry::shape::SharedShape;

use crate::geometry::arena::Wall;
use crate::math::{Pose, Vector};
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
        self.penetration(pose, other, other_pose, 0.0).map_or(0.0, |(depth, _)| depth)
    }

    /// Depth (m) by which this shape at a pose overlaps another, and the unit vector from this one to the
    /// other along which it is measured; `None` up to a depth of `min` (m).
    pub(crate) fn penetration(
        &self,
        pose: &Pose,
        other: &Self,
        other_pose: &Pose,
        min: f32,
    ) -> Option<(f32, Vector)> {
        // All pairs of these shapes have a contact query; `Err` says that a pair has none.
        let contact = query::contact(pose, &*self.0, other_pose, &*other.0, 0.0).ok().flatten()?;
        (-contact.dist > min).then_some((-contact.dist, contact.normal1))
    }
}

/// Contact of two shapes by parry, for tests that compare.
#[cfg(test)]
pub(super) struct ParryContact {
    /// Unit vector from the first to the second.
    pub(super) normal: Vector,
    /// Points on the first (m) and their separations (m).
    pub(super) points: Vec<(Vector, f32)>,
}

#[cfg(test)]
impl Shape {
    /// A disc.
    pub(super) fn of_disc(radius: f32) -> Self {
        Self(SharedShape::ball(radius))
    }

    /// Contact with another shape that is at most `prediction` (m) away.
    pub(super) fn contact(
        &self,
        pose: &Pose,
        other: &Self,
        other_pose: &Pose,
        prediction: f32,
    ) -> Option<ParryContact> {
        use rapier2d::parry::query::{
            ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher,
        };
        let mut manifolds: Vec<ContactManifold<(), ()>> = Vec::new();
        let between = pose.inverse() * *other_pose;
        DefaultQueryDispatcher
            .contact_manifolds(&between, &*self.0, &*other.0, prediction, &mut manifolds, &mut None)
            .expect("parry has manifolds of these shapes");
        let manifold = manifolds.into_iter().find(|manifold| !manifold.points.is_empty())?;
        let normal = pose.rotation * manifold.local_n1;
        let points = manifold.points.iter();
        let points = points.map(|point| (pose.transform_point(point.local_p1), point.dist));
        Some(ParryContact { normal, points: points.collect() })
    }
}

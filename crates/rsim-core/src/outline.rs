//! Outlines seen from above: how far a point is from one, and in which direction.

use rapier2d::math::{Rotation, Vector};
use serde::{Deserialize, Serialize};

use crate::robot_model::Body;

/// A convex outline, around the origin of its own frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Outline {
    /// A rectangle with these half sides.
    Box { half: Vector },
    /// A disc cut off at `front` along x, so that its flat front is twice `half_flat` wide.
    CutDisc { radius: f32, front: f32, half_flat: f32 },
}

/// The point of an outline that is nearest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    /// m; negative when the other point is inside.
    pub(crate) distance: f32,
    /// From the outline outward, a unit vector.
    pub(crate) normal: Vector,
}

impl Outline {
    pub(crate) fn of(body: Body) -> Self {
        match body {
            Body::Square { side } => Self::Box { half: Vector::splat(side / 2.0) },
            Body::Round { radius, front } => {
                let half_flat = (radius * radius - front * front).max(0.0).sqrt();
                Self::CutDisc { radius, front, half_flat }
            }
        }
    }

    /// Nearest to `point`, in the outline's own frame.
    pub(crate) fn nearest(&self, point: Vector) -> Nearest {
        match *self {
            Self::Box { half } => nearest_of_box(half, point),
            Self::CutDisc { radius, front, half_flat } => {
                nearest_of_cut_disc(radius, front, half_flat, point)
            }
        }
    }

    /// Nearest to `point` of the field, for an outline that stands at `position` and faces
    /// `heading`.
    pub(crate) fn nearest_at(&self, position: Vector, heading: Rotation, point: Vector) -> Nearest {
        let found = self.nearest(heading.inverse() * (point - position));
        Nearest { normal: heading * found.normal, ..found }
    }
}

fn nearest_of_box(half: Vector, point: Vector) -> Nearest {
    let beyond = point.abs() - half;
    let sign = Vector::new(1.0_f32.copysign(point.x), 1.0_f32.copysign(point.y));
    if beyond.x > 0.0 && beyond.y > 0.0 {
        let distance = beyond.length();
        return Nearest { distance, normal: beyond / distance * sign };
    }
    if beyond.x > beyond.y {
        Nearest { distance: beyond.x, normal: Vector::new(sign.x, 0.0) }
    } else {
        Nearest { distance: beyond.y, normal: Vector::new(0.0, sign.y) }
    }
}

fn nearest_of_cut_disc(radius: f32, front: f32, half_flat: f32, point: Vector) -> Nearest {
    let from_center = point.length();
    let to_arc = from_center - radius;
    let to_flat = point.x - front;
    let faces_arc = point.x * radius <= from_center * front;
    if to_arc <= 0.0 && to_flat <= 0.0 {
        // Inside: out by the shorter way.
        return if to_flat > to_arc || from_center == 0.0 {
            Nearest { distance: to_flat, normal: Vector::X }
        } else {
            Nearest { distance: to_arc, normal: point / from_center }
        };
    }
    if faces_arc {
        return Nearest { distance: to_arc, normal: point / from_center };
    }
    if point.y.abs() <= half_flat {
        return Nearest { distance: to_flat, normal: Vector::X };
    }
    let corner = Vector::new(front, half_flat.copysign(point.y));
    let from_corner = point - corner;
    let distance = from_corner.length();
    Nearest { distance, normal: from_corner / distance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::uniform;

    const CUT_DISC: Body = Body::Round { radius: 0.09, front: 0.0715 };

    #[test]
    fn front_corner_and_back_of_a_robot_are_where_they_are() {
        let outline = Outline::of(CUT_DISC);
        let close = |at: [f32; 2], distance: f32, normal: [f32; 2]| {
            let found = outline.nearest(at.into());
            assert!((found.distance - distance).abs() < 1e-6, "{at:?}: {found:?}");
            assert!((found.normal - Vector::from(normal)).length() < 1e-4, "{at:?}: {found:?}");
        };
        close([0.093, 0.02], 0.0215, [1.0, 0.0]);
        close([-0.1, 0.0], 0.01, [-1.0, 0.0]);
        close([0.0, 0.2], 0.11, [0.0, 1.0]);
        close([0.07, 0.0], -0.0015, [1.0, 0.0]);
        let half_flat = (0.09_f32.powi(2) - 0.0715_f32.powi(2)).sqrt();
        close([0.0715 + 0.03, half_flat + 0.0004], 0.030_002_7, [1.0, 0.0133]);
    }

    #[test]
    fn a_step_along_the_normal_changes_the_distance_by_as_much() {
        for body in [CUT_DISC, Body::Square { side: 0.075 }] {
            let outline = Outline::of(body);
            for draw in 0..2000_u64 {
                let point = Vector::new(uniform(draw), uniform(draw + 10_000)) * 0.3;
                let found = outline.nearest(point);
                let stepped = outline.nearest(point + found.normal * 1e-3);
                assert!((found.normal.length() - 1.0).abs() < 1e-5);
                let outside = found.distance >= 0.0;
                let gained = stepped.distance - found.distance;
                assert!(!outside || (gained - 1e-3).abs() < 1e-5, "{body:?} {point:?}: {gained}");
            }
        }
    }
}

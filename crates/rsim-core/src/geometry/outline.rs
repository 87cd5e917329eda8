//! Outlines from above: distance and direction to a point, and distance of two outlines.

use serde::{Deserialize, Serialize};

use crate::math::{Rotation, Vector};
use crate::models::robot::Body;

/// A convex outline, around the origin of its own frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Outline {
    /// A rectangle with these half sides, m.
    Box { half: Vector },
    /// A disc cut off at `front` along x, with a flat front of width 2 `half_flat`, m.
    CutDisc { radius: f32, front: f32, half_flat: f32 },
    /// A disc: the ball, and round robots among themselves.
    Disc { radius: f32 },
}

/// The point of an outline that is nearest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearestPoint {
    /// Distance of the two points, m; negative inside the outline.
    pub(crate) distance: f32,
    /// Unit vector from the outline outward.
    pub(crate) normal: Vector,
}

impl Outline {
    pub(crate) fn of(body: Body) -> Self {
        match body {
            Body::Square { side_length } => Self::Box { half: Vector::splat(side_length / 2.0) },
            Body::Round { radius, front_distance: front } => {
                let half_flat = (radius * radius - front * front).max(0.0).sqrt();
                Self::CutDisc { radius, front, half_flat }
            }
        }
    }

    /// Distance from the origin to the farthest point, m.
    pub(crate) fn bounding_radius(&self) -> f32 {
        match *self {
            Self::Box { half } => half.length(),
            Self::CutDisc { radius, .. } | Self::Disc { radius } => radius,
        }
    }

    /// Distance from the origin to the farthest point that moves in a rotation, m; 0 for a disc.
    pub(crate) fn turning_radius(&self) -> f32 {
        if let Self::Disc { .. } = self { 0.0 } else { self.bounding_radius() }
    }

    /// The point nearest to `point`, in the outline's own frame.
    pub(crate) fn nearest(&self, point: Vector) -> NearestPoint {
        match *self {
            Self::Box { half } => nearest_of_box(half, point),
            Self::CutDisc { radius, front, half_flat } => {
                nearest_of_cut_disc(radius, front, half_flat, point)
            }
            Self::Disc { radius } => {
                let from_center = point.length();
                let normal = if from_center > 0.0 { point / from_center } else { Vector::X };
                NearestPoint { distance: from_center - radius, normal }
            }
        }
    }

    /// The point nearest to `point` of the field, for an outline at `position` with `heading`.
    pub(crate) fn nearest_at(
        &self,
        position: Vector,
        heading: Rotation,
        point: Vector,
    ) -> NearestPoint {
        let found = self.nearest(heading.inverse() * (point - position));
        NearestPoint { normal: heading * found.normal, ..found }
    }
}

/// An outline with position and heading.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedOutline {
    pub(crate) outline: Outline,
    pub(crate) position: Vector,
    pub(crate) heading: Rotation,
}

impl PlacedOutline {
    /// Lower bound of the distance to another outline, m: exact if one is a disc, otherwise the widest
    /// strip between the two along one of their sides. Not positive if they touch.
    pub(crate) fn gap(&self, other: &Self) -> f32 {
        match (self.outline, other.outline) {
            (Outline::Disc { radius }, _) => other.nearest(self.position).distance - radius,
            (_, Outline::Disc { radius }) => self.nearest(other.position).distance - radius,
            _ => self.strip_along_own_sides(other).max(other.strip_along_own_sides(self)),
        }
    }

    pub(crate) fn nearest(&self, point: Vector) -> NearestPoint {
        self.outline.nearest_at(self.position, self.heading, point)
    }

    fn strip_along_own_sides(&self, other: &Self) -> f32 {
        let apart = other.position - self.position;
        let side = Vector::new(self.heading.re, self.heading.im);
        let strip =
            |across: Vector| apart.dot(across).abs() - self.extent(across) - other.extent(across);
        strip(side).max(strip(side.perp()))
    }

    /// Distance from the middle to the farthest point in a direction, m; a flat front is ignored.
    fn extent(&self, direction: Vector) -> f32 {
        match self.outline {
            Outline::Box { half } => half.dot((self.heading.inverse() * direction).abs()),
            Outline::CutDisc { radius, .. } | Outline::Disc { radius } => radius,
        }
    }
}

fn nearest_of_box(half: Vector, point: Vector) -> NearestPoint {
    let beyond = point.abs() - half;
    let sign = Vector::new(1.0_f32.copysign(point.x), 1.0_f32.copysign(point.y));
    if beyond.x > 0.0 && beyond.y > 0.0 {
        let distance = beyond.length();
        return NearestPoint { distance, normal: beyond / distance * sign };
    }
    if beyond.x > beyond.y {
        NearestPoint { distance: beyond.x, normal: Vector::new(sign.x, 0.0) }
    } else {
        NearestPoint { distance: beyond.y, normal: Vector::new(0.0, sign.y) }
    }
}

fn nearest_of_cut_disc(radius: f32, front: f32, half_flat: f32, point: Vector) -> NearestPoint {
    let from_center = point.length();
    let to_arc = from_center - radius;
    let to_flat = point.x - front;
    let faces_arc = point.x * radius <= from_center * front;
    if to_arc <= 0.0 && to_flat <= 0.0 {
        // Inside: the nearer of arc and front.
        return if to_flat > to_arc || from_center == 0.0 {
            NearestPoint { distance: to_flat, normal: Vector::X }
        } else {
            NearestPoint { distance: to_arc, normal: point / from_center }
        };
    }
    if faces_arc {
        return NearestPoint { distance: to_arc, normal: point / from_center };
    }
    if point.y.abs() <= half_flat {
        return NearestPoint { distance: to_flat, normal: Vector::X };
    }
    let corner = Vector::new(front, half_flat.copysign(point.y));
    let from_corner = point - corner;
    let distance = from_corner.length();
    NearestPoint { distance, normal: from_corner / distance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::uniform;

    const CUT_DISC: Body = Body::Round { radius: 0.09, front_distance: 0.0715 };

    #[test]
    fn distances_to_front_corner_and_back_of_a_robot_are_exact() {
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

    fn placed(outline: Outline, position: [f32; 2], degrees: f32) -> PlacedOutline {
        PlacedOutline {
            outline,
            position: position.into(),
            heading: Rotation::new(degrees.to_radians()),
        }
    }

    #[test]
    fn gaps_are_the_measured_distances() {
        let square = Outline::of(Body::Square { side_length: 0.075 });
        let disc = Outline::Disc { radius: 0.09 };
        let wall = Outline::Box { half: Vector::new(1.0, 0.1) };
        let corner = 0.0375 * std::f32::consts::SQRT_2;
        for (a, b, gap) in [
            (placed(square, [0.0, 0.0], 0.0), placed(square, [0.1, 0.02], 90.0), 0.025),
            (placed(square, [0.0, 0.0], 45.0), placed(square, [0.1, 0.0], 0.0), 0.0625 - corner),
            (placed(square, [0.0, 0.0], 45.0), placed(wall, [0.5, -0.2], 0.0), 0.1 - corner),
            (placed(square, [0.0, 0.0], 0.0), placed(disc, [0.2, 0.0], 0.0), 0.0725),
            (placed(disc, [0.0, 0.0], 0.0), placed(disc, [0.0, -0.2], 10.0), 0.02),
            (placed(Outline::of(CUT_DISC), [0.0, 0.0], 0.0), placed(disc, [0.2, 0.0], 0.0), 0.0385),
            (placed(Outline::of(CUT_DISC), [0.0, 0.0], 0.0), placed(wall, [1.2, 0.0], 0.0), 0.11),
            (placed(square, [0.0, 0.0], 0.0), placed(square, [0.07, 0.0], 0.0), -0.005),
        ] {
            assert!((a.gap(&b) - gap).abs() < 1e-6, "{a:?} {b:?}: {}", a.gap(&b));
            assert!((b.gap(&a) - gap).abs() < 1e-6, "{b:?} {a:?}: {}", b.gap(&a));
        }
    }

    #[test]
    fn a_step_along_the_normal_changes_the_distance_by_as_much() {
        let square = Body::Square { side_length: 0.075 };
        let disc = Outline::Disc { radius: 0.05 };
        for outline in [Outline::of(CUT_DISC), Outline::of(square), disc] {
            for draw in 0..2000_u64 {
                let point = Vector::new(uniform(draw), uniform(draw + 10_000)) * 0.3;
                let found = outline.nearest(point);
                let stepped = outline.nearest(point + found.normal * 1e-3);
                assert!((found.normal.length() - 1.0).abs() < 1e-5);
                let outside = found.distance >= 0.0;
                let gained = stepped.distance - found.distance;
                assert!(
                    !outside || (gained - 1e-3).abs() < 1e-5,
                    "{outline:?} {point:?}: {gained}"
                );
            }
        }
    }
}

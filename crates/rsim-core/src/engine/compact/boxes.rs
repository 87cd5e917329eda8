//! Contact points of two rectangles within one sub-step.

use super::body::SolverBody;
use super::manifold::{Manifold, Point, TOUCHING, Window};
use crate::math::Vector;

/// Advantages that the faces of the second box need to become the reference, m and fraction of a
/// sub-step, so that the reference does not alternate.
const SEPARATION_BIAS: f32 = 1e-4;
const TIME_BIAS: f32 = 0.02;

/// A rectangle on its straight path.
#[derive(Clone, Copy)]
pub(super) struct Rectangle<'a> {
    pub(super) body: &'a SolverBody,
    /// Half sides, m.
    pub(super) half: Vector,
    /// Distance of the corners from the centre, m.
    pub(super) radius: f32,
}

/// A face of one of two rectangles, as the direction between them.
#[derive(Debug, Clone, Copy)]
struct Face {
    /// 0 for the faces along the box's x axis, 1 for y.
    axis: usize,
    /// Now, m.
    separation: f32,
    /// Time after which the boxes overlap along this direction, s, at most twice the sub-step; 0 if
    /// they do now.
    after: f32,
}

/// Contact of two rectangles that touch in the sub-step, or that are within the reach of a push.
pub(super) fn boxes(a: Rectangle, b: Rectangle, window: Window) -> Option<Manifold> {
    let [heading_a, heading_b] = [a.body.heading, b.body.heading];
    let apart = b.body.position - a.body.position;
    let velocity = b.body.velocity - a.body.velocity;
    // Bound of the speed by rotation at which the gap shrinks.
    let rim = a.body.spin.abs() * a.radius + b.body.spin.abs() * b.radius;
    let cos = heading_a.dot(heading_b).abs();
    let sin = heading_a.perp_dot(heading_b).abs();
    // Half the width of the other rectangle along this one's axes.
    let width =
        |half: Vector| Vector::new(half.x * cos + half.y * sin, half.x * sin + half.y * cos);
    let last = |heading: Vector, extent: Vector| {
        let x = face(0, heading, extent.x, apart, velocity, rim, window)?;
        let y = face(1, heading.perp(), extent.y, apart, velocity, rim, window)?;
        let y_is_later = y.after > x.after || y.after >= x.after && y.separation > x.separation;
        Some(if y_is_later { y } else { x })
    };
    let of_a = last(heading_a, a.half + width(b.half))?;
    let of_b = last(heading_b, b.half + width(a.half))?;
    let later = of_b.after - of_a.after;
    let b_is_reference = if later.abs() > TIME_BIAS * window.time {
        later > 0.0
    } else {
        of_b.separation > of_a.separation + SEPARATION_BIAS
    };
    if b_is_reference {
        b.clip(&a, of_b, window.time, 0).map(Manifold::reversed)
    } else {
        a.clip(&b, of_a, window.time, 1)
    }
}

/// The face along `direction`. The face along which the other rectangle comes to overlap last is the
/// one that it touches; of faces along which it overlaps already, the one of least depth. `None` if it
/// stays out of reach along this one.
fn face(
    axis: usize,
    direction: Vector,
    extent: f32,
    apart: Vector,
    velocity: Vector,
    rim: f32,
    window: Window,
) -> Option<Face> {
    let along = apart.dot(direction);
    let separation = along.abs() - extent;
    if separation <= TOUCHING {
        return Some(Face { axis, separation, after: 0.0 });
    }
    let closing = rim - velocity.dot(direction) * 1.0_f32.copysign(along);
    let meets = closing * window.time >= separation;
    let after = if meets { separation / closing } else { 2.0 * window.time };
    (meets || separation <= window.reach).then_some(Face { axis, separation, after })
}

impl Rectangle<'_> {
    fn axes(&self) -> [Vector; 2] {
        [self.body.heading, self.body.heading.perp()]
    }

    /// Contact points of another rectangle on a face of this one.
    fn clip(&self, other: &Self, face: Face, time: f32, tag: u32) -> Option<Manifold> {
        let (own, axes) = (self.axes(), other.axes());
        let center = other.body.position - self.body.position;
        let side = 1.0_f32.copysign(center.dot(own[face.axis]));
        let normal = own[face.axis] * side;
        let tangent = own[1 - face.axis];
        // The face of the other that is most nearly opposite.
        let facing = axes.map(|axis| normal.dot(axis));
        let opposite = usize::from(facing[1].abs() > facing[0].abs());
        let out = axes[opposite] * -1.0_f32.copysign(facing[opposite]);
        let along = axes[1 - opposite] * other.half[1 - opposite];
        let middle = center + out * other.half[opposite];
        let ends = [middle - along, middle + along];
        // Along the face when the boxes touch.
        let moved = (other.body.velocity - self.body.velocity) * face.after.min(time);
        let shift = moved.dot(tangent);
        let at = ends.map(|end| end.dot(tangent) + shift);
        let inverse_span = 1.0 / (at[1] - at[0]);
        let limit = self.half[1 - face.axis];
        #[allow(clippy::cast_possible_truncation)] // two axes
        let axes = (face.axis << 1 | opposite << 2) as u32;
        let mut manifold = Manifold::empty(normal);
        for (end, place) in [(0, at[0]), (1, at[1])] {
            let share = (place.clamp(-limit, limit) - at[0]) * inverse_span;
            // Past both ends of the face, the other touches it with no part of this edge.
            if !(-ROUNDING..=1.0 + ROUNDING).contains(&share) {
                continue;
            }
            let point = ends[0] + (ends[1] - ends[0]) * share;
            let separation = point.dot(normal) - self.half[face.axis];
            let position = self.body.position + point - normal * (0.5 * separation);
            let feature = tag | axes | end << 3 | POINT;
            manifold.push(Point { position, separation, feature });
        }
        (!manifold.points().is_empty()).then_some(manifold)
    }
}

/// Rounding of a share of an edge.
const ROUNDING: f32 = 1e-5;

/// Bit of all features, so that none is 0, which is no point.
const POINT: u32 = 1 << 4;

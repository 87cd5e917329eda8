//! Contact points of two rectangles within one sub-step.

use super::manifold::{Manifold, Moving, Point, TOUCHING};
use crate::math::Vector;

/// Advantages that the faces of the second box need to become the reference, m and fraction of a
/// sub-step, so that the reference does not alternate.
const SEPARATION_BIAS: f32 = 1e-4;
const TIME_BIAS: f32 = 0.02;

/// A rectangle with its axes.
struct Rectangle<'a> {
    moving: &'a Moving,
    half: Vector,
    axes: [Vector; 2],
}

/// A face of one of two rectangles as the direction between them.
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

/// Contact of two rectangles that touch within `time` (s), or that are at most `reach` (m) apart.
pub(super) fn boxes(
    (a, half_a): (&Moving, Vector),
    (b, half_b): (&Moving, Vector),
    time: f32,
    reach: f32,
) -> Option<Manifold> {
    let (a, b) = (Rectangle::of(a, half_a), Rectangle::of(b, half_b));
    let of_a = a.last_face(&b, time, reach)?;
    let of_b = b.last_face(&a, time, reach)?;
    let later = of_b.after - of_a.after;
    let b_is_reference = if later.abs() > TIME_BIAS * time {
        later > 0.0
    } else {
        of_b.separation > of_a.separation + SEPARATION_BIAS
    };
    if b_is_reference {
        b.clip(&a, of_b, time, 0).map(Manifold::reversed)
    } else {
        a.clip(&b, of_a, time, 1)
    }
}

impl<'a> Rectangle<'a> {
    fn of(moving: &'a Moving, half: Vector) -> Self {
        let heading = Vector::new(moving.place.heading.re, moving.place.heading.im);
        Self { moving, half, axes: [heading, heading.perp()] }
    }

    /// Position of another rectangle from this one, m.
    fn apart(&self, other: &Self) -> Vector {
        other.moving.place.position - self.moving.place.position
    }

    /// The face along which another rectangle comes to overlap last, which is the face that it
    /// touches; of faces along which it overlaps already, the one of least depth. `None` if it stays
    /// farther than `reach` away along one.
    fn last_face(&self, other: &Self, time: f32, reach: f32) -> Option<Face> {
        let apart = self.apart(other);
        let velocity = other.moving.velocity - self.moving.velocity;
        // Bound of the speed by rotation at which the gap shrinks.
        let rim = self.moving.spin.abs() * self.half.length()
            + other.moving.spin.abs() * other.half.length();
        let face = |axis: usize| {
            let direction = self.axes[axis];
            let extent = self.half[axis]
                + other.half.x * direction.dot(other.axes[0]).abs()
                + other.half.y * direction.dot(other.axes[1]).abs();
            let along = apart.dot(direction);
            let separation = along.abs() - extent;
            if separation <= TOUCHING {
                return Some(Face { axis, separation, after: 0.0 });
            }
            let closing = rim - velocity.dot(direction) * 1.0_f32.copysign(along);
            let meets = closing * time >= separation;
            let after = if meets { separation / closing } else { 2.0 * time };
            (meets || separation <= reach).then_some(Face { axis, separation, after })
        };
        let (x, y) = (face(0)?, face(1)?);
        let y_is_later =
            if x.after == y.after { y.separation > x.separation } else { y.after > x.after };
        Some(if y_is_later { y } else { x })
    }

    /// Contact points of another rectangle on a face of this one.
    fn clip(&self, other: &Self, face: Face, time: f32, tag: u32) -> Option<Manifold> {
        let center = self.apart(other);
        let side = 1.0_f32.copysign(center.dot(self.axes[face.axis]));
        let normal = self.axes[face.axis] * side;
        let tangent = self.axes[1 - face.axis];
        // The face of the other that is most nearly opposite.
        let facing = other.axes.map(|axis| normal.dot(axis));
        let opposite = usize::from(facing[1].abs() > facing[0].abs());
        let out = other.axes[opposite] * -1.0_f32.copysign(facing[opposite]);
        let along = other.axes[1 - opposite] * other.half[1 - opposite];
        let middle = center + out * other.half[opposite];
        let ends = [middle - along, middle + along];
        // Along the face when the boxes touch.
        let moved = (other.moving.velocity - self.moving.velocity) * face.after.min(time);
        let shift = moved.dot(tangent);
        let at = ends.map(|end| end.dot(tangent) + shift);
        let span = at[1] - at[0];
        let limit = self.half[1 - face.axis];
        #[allow(clippy::cast_possible_truncation)] // two axes
        let axes = (face.axis << 1 | opposite << 2) as u32;
        let mut manifold = Manifold::empty(normal);
        for (end, place) in [(0, at[0]), (1, at[1])] {
            let share = (place.clamp(-limit, limit) - at[0]) / span;
            // Not a number for an edge along the normal, which meets the face with its middle at most.
            if !(0.0..=1.0).contains(&share) {
                continue;
            }
            let point = ends[0] + (ends[1] - ends[0]) * share;
            let separation = point.dot(normal) - self.half[face.axis];
            let position = self.moving.place.position + point - normal * (0.5 * separation);
            let feature = tag | axes | end << 3 | POINT;
            manifold.push(Point { position, separation, feature });
        }
        (!manifold.points().is_empty()).then_some(manifold)
    }
}

/// Bit of all features, so that none is 0, which is no point.
const POINT: u32 = 1 << 4;

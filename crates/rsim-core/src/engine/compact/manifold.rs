//! Contact points of two outlines within one sub-step.
//!
//! Bodies move straight in a sub-step. A contact is where two outlines first touch on their paths, so
//! bodies that pass each other are not stopped, and none is missed. Outlines that touch already have
//! the contact of least depth.

use crate::engine::ball_contact::Approached;
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// Gap up to which outlines count as touching, m, whatever their velocities: contacts of robots that
/// push each other keep their impulses from one sub-step to the next.
const TOUCHING: f32 = 5e-5;

/// Depth advantage, m, that the faces of the second box need to become the reference, so that the
/// reference does not alternate.
const REFERENCE_BIAS: f32 = 1e-4;

/// Contact points of a pair, at most two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Manifold {
    /// Unit vector from the first to the second.
    pub(super) normal: Vector,
    points: [Point; 2],
    count: usize,
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    /// On the field, m.
    pub(super) position: Vector,
    /// Now, along the normal, m; negative for overlapping outlines.
    pub(super) separation: f32,
    /// Identifies the point from one sub-step to the next.
    pub(super) feature: u32,
}

impl Manifold {
    pub(super) fn of_point(normal: Vector, position: Vector, separation: f32) -> Self {
        let point = Point { position, separation, feature: 0 };
        Self { normal, points: [point, Point::default()], count: 1 }
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points[..self.count]
    }
}

/// An outline on its straight path through a sub-step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) place: PlacedOutline,
    /// m/s.
    pub(super) velocity: Vector,
    /// rad/s.
    pub(super) spin: f32,
}

/// Contact of two outlines within `time`, if they touch in it.
pub(super) fn meet(a: &Moving, b: &Moving, time: f32) -> Option<Manifold> {
    match (a.place.outline, b.place.outline) {
        (Outline::Disc { radius: first }, Outline::Disc { radius: second }) => {
            discs(a, first, b, second, time)
        }
        (Outline::Disc { radius }, _) => disc_and_outline(a, radius, b, time),
        (_, Outline::Disc { radius }) => disc_and_outline(b, radius, a, time).map(|found| {
            Manifold { normal: -found.normal, ..found }
        }),
        (Outline::Box { half: first }, Outline::Box { half: second }) => {
            boxes(a, first, b, second, time)
        }
        // Robots meet robots and walls as discs or boxes.
        _ => None,
    }
}

fn discs(a: &Moving, first: f32, b: &Moving, second: f32, time: f32) -> Option<Manifold> {
    let apart = b.place.position - a.place.position;
    let velocity = b.velocity - a.velocity;
    let reach = first + second;
    let distance = apart.length();
    let gap = distance - reach;
    let mut at_contact = apart;
    if gap > TOUCHING {
        // |apart + velocity t| = reach, the earlier solution.
        let closing = -apart.dot(velocity);
        let speed_squared = velocity.length_squared();
        let discriminant =
            closing * closing - speed_squared * (distance * distance - reach * reach);
        if closing <= 0.0 || discriminant <= 0.0 {
            return None;
        }
        let after = (closing - discriminant.sqrt()) / speed_squared;
        if after > time {
            return None;
        }
        at_contact = apart + velocity * after;
    }
    let length = at_contact.length();
    let normal = if length > 0.0 { at_contact / length } else { Vector::X };
    // The separation along the normal of the contact, which both approach.
    let separation = apart.dot(normal) - reach;
    let separation = if gap > TOUCHING { separation.max(0.0) } else { gap };
    let position = a.place.position + normal * (first + 0.5 * separation);
    Some(Manifold::of_point(normal, position, separation))
}

/// `a` is a disc.
fn disc_and_outline(a: &Moving, radius: f32, b: &Moving, time: f32) -> Option<Manifold> {
    let approached =
        Approached { place: b.place, velocity: a.velocity - b.velocity, spin: b.spin };
    let center = a.place.position;
    let touch = approached.touch(center, radius, time)?;
    let normal = -touch.normal;
    let position = center + normal * (radius + 0.5 * touch.distance);
    Some(Manifold::of_point(normal, position, touch.distance))
}

/// Separation of two boxes along a face of one of them.
#[derive(Debug, Clone, Copy)]
struct Face {
    /// Whether the face belongs to the first box.
    of_first: bool,
    /// 0 for the faces along the box's x axis, 1 for y.
    axis: usize,
    /// Now, m.
    separation: f32,
    /// Time after which the boxes overlap along this direction, s; 0 if they do now.
    after: f32,
}

fn boxes(a: &Moving, first: Vector, b: &Moving, second: Vector, time: f32) -> Option<Manifold> {
    let apart = b.place.position - a.place.position;
    let velocity = b.velocity - a.velocity;
    let rim = a.spin.abs() * first.length() + b.spin.abs() * second.length();
    let axes = |of: &Moving| {
        let heading = Vector::new(of.place.heading.re, of.place.heading.im);
        [heading, heading.perp()]
    };
    let (axes_a, axes_b) = (axes(a), axes(b));
    let mut reference: Option<Face> = None;
    for (of_first, own, other, own_half, other_half) in
        [(true, axes_a, axes_b, first, second), (false, axes_b, axes_a, second, first)]
    {
        for axis in 0..2 {
            let direction = own[axis];
            let extent = own_half[axis]
                + other_half.x * direction.dot(other[0]).abs()
                + other_half.y * direction.dot(other[1]).abs();
            let along = apart.dot(direction);
            let separation = along.abs() - extent;
            let mut after = 0.0;
            if separation > TOUCHING {
                let closing = rim - velocity.dot(direction) * 1.0_f32.copysign(along);
                if closing <= 0.0 {
                    return None;
                }
                after = separation / closing;
                if after > time {
                    return None;
                }
            }
            let face = Face { of_first, axis, separation, after };
            if reference.is_none_or(|best| is_later(&face, &best)) {
                reference = Some(face);
            }
        }
    }
    let face = reference?;
    let manifold = if face.of_first {
        clip(a, first, axes_a, b, second, axes_b, &face)
    } else {
        clip(b, second, axes_b, a, first, axes_a, &face)
    }?;
    Some(if face.of_first { manifold } else { Manifold { normal: -manifold.normal, ..manifold } })
}

/// Whether boxes touch later along a face than along the best so far: the last direction in which
/// they come to overlap is the contact's. Of directions in which they overlap already, the one of
/// least depth.
fn is_later(face: &Face, best: &Face) -> bool {
    if face.after > 0.0 || best.after > 0.0 {
        return face.after > best.after;
    }
    let bias = if face.of_first == best.of_first { 0.0 } else { REFERENCE_BIAS };
    face.separation > best.separation + bias
}

/// Contact points of a box `b` on a face of a box `a`.
fn clip(
    a: &Moving,
    half_a: Vector,
    axes_a: [Vector; 2],
    b: &Moving,
    half_b: Vector,
    axes_b: [Vector; 2],
    face: &Face,
) -> Option<Manifold> {
    let moved = (b.velocity - a.velocity) * face.after;
    let center = b.place.position - a.place.position;
    let side = 1.0_f32.copysign(center.dot(axes_a[face.axis]));
    let normal = axes_a[face.axis] * side;
    let tangent = axes_a[1 - face.axis];
    // The face of `b` that is most nearly opposite.
    let facing = [normal.dot(axes_b[0]), normal.dot(axes_b[1])];
    let axis_b = usize::from(facing[1].abs() > facing[0].abs());
    let out = axes_b[axis_b] * -1.0_f32.copysign(facing[axis_b]);
    let along_b = axes_b[1 - axis_b] * half_b[1 - axis_b];
    let middle = center + out * half_b[axis_b];
    let ends = [middle - along_b, middle + along_b];
    let limit = half_a[1 - face.axis];
    // Along the face when the boxes touch.
    let shift = moved.dot(tangent);
    let at = ends.map(|end| end.dot(tangent) + shift);
    let span = at[1] - at[0];
    let feature = |end: u32| {
        u32::from(face.of_first) | (face.axis as u32) << 1 | (axis_b as u32) << 2 | end << 3
    };
    let mut manifold = Manifold { normal, points: [Point::default(); 2], count: 0 };
    for (end, bound) in [(0, at[0]), (1, at[1])] {
        let clamped = bound.clamp(-limit, limit);
        let share = if span.abs() > f32::EPSILON { (clamped - at[0]) / span } else { 0.5 };
        if !(0.0..=1.0).contains(&share) {
            continue;
        }
        let point = ends[0] + (ends[1] - ends[0]) * share;
        let separation = point.dot(normal) - half_a[face.axis];
        let position = a.place.position + point - normal * (0.5 * separation);
        manifold.points[manifold.count] = Point { position, separation, feature: feature(end) };
        manifold.count += 1;
    }
    (manifold.count > 0).then_some(manifold)
}

//! Contact points of two rectangles within one sub-step.

use super::manifold::{Manifold, Point, TOUCHING, Window};
use super::rectangle::{Face, Met, Rectangle};
use super::sliding::{press, slide};
use crate::math::Vector;

/// Advantages that the faces of the second box need to become the reference, m and fraction of a
/// sub-step, so that the reference does not alternate.
const SEPARATION_BIAS: f32 = 1e-4;
const TIME_BIAS: f32 = 0.02;

/// Contact of two rectangles that touch in the sub-step, or that are within the reach of a push.
pub(in crate::engine) fn boxes(a: Rectangle, b: Rectangle, window: Window) -> Option<Manifold> {
    let [heading_a, heading_b] = [a.body.heading, b.body.heading];
    let apart = b.body.position - a.body.position;
    let velocity = b.body.velocity - a.body.velocity;
    // Bound of the speed by rotation at which the gap shrinks.
    let rim = a.body.angular_velocity.abs() * a.radius + b.body.angular_velocity.abs() * b.radius;
    let cos = heading_a.dot(heading_b).abs();
    let sin = heading_a.perp_dot(heading_b).abs();
    // Half the width of the other rectangle along this one's axes.
    let width =
        |half: Vector| Vector::new(half.x * cos + half.y * sin, half.x * sin + half.y * cos);
    let faces = |heading: Vector, extent: Vector| {
        let x = face(0, heading, extent.x, apart, velocity, rim, window)?;
        let y = face(1, heading.perp(), extent.y, apart, velocity, rim, window)?;
        Some([x, y])
    };
    let all_of_a = faces(heading_a, a.half + width(b.half))?;
    let all_of_b = faces(heading_b, b.half + width(a.half))?;
    let mut met = last_of_both(last(all_of_a), last(all_of_b), window.time);
    if !press(velocity, rim) {
        met = slide([&a, &b], &[all_of_a, all_of_b], met, window.time);
    }
    if met.of_second {
        b.clip(&a, met.face, window.time, 0).map(Manifold::reversed)
    } else {
        a.clip(&b, met.face, window.time, 1)
    }
}

/// The face along which two boxes come to overlap last, or least, of one face of each.
fn last_of_both(of_a: Face, of_b: Face, time: f32) -> Met {
    let later = of_b.after - of_a.after;
    let of_second = if later.abs() > TIME_BIAS * time {
        later > 0.0
    } else {
        of_b.separation > of_a.separation + SEPARATION_BIAS
    };
    Met { face: if of_second { of_b } else { of_a }, of_second }
}

/// The face of a box along which the other comes to overlap last, or least.
fn last([x, y]: [Face; 2]) -> Face {
    let y_is_later = y.after > x.after || y.after >= x.after && y.separation > x.separation;
    if y_is_later { y } else { x }
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
            let on_self = point + tangent * shift - normal * separation;
            let feature = tag | axes | end << 3 | POINT;
            manifold.push(Point { arms: [on_self, point - center], separation, feature });
        }
        (!manifold.points().is_empty()).then_some(manifold)
    }
}

/// Rounding of a share of an edge.
const ROUNDING: f32 = 1e-5;

/// Bit of all features, so that none is 0, which is no point.
const POINT: u32 = 1 << 4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::compact::body::SolverBody;
    use crate::engine::shapes::Shape;
    use crate::geometry::outline::Outline;
    use crate::geometry::outline::PlacedOutline;
    use crate::math::{Pose, Rotation};
    use crate::models::robot::Body;
    use crate::scenes::uniform;

    const SIDE: f32 = 0.075;
    const HALF: Vector = Vector::splat(SIDE / 2.0);

    fn body([x, y]: [f32; 2], angle: f32) -> SolverBody {
        SolverBody::of_wall(&PlacedOutline {
            outline: Outline::Box { half: HALF },
            position: Vector::new(x, y),
            heading: Rotation::new(angle),
        })
    }

    fn pose(body: &SolverBody) -> Pose {
        Pose::new(body.position, body.heading.y.atan2(body.heading.x))
    }

    fn meet(a: &SolverBody, b: &SolverBody, time: f32, reach: f32) -> Option<Manifold> {
        let of = |body| Rectangle { body, half: HALF, radius: HALF.length() };
        boxes(of(a), of(b), Window { time, reach })
    }

    #[test]
    fn contacts_of_squares_that_touch_are_those_of_parry() {
        let shape = Shape::of_robot(Body::Square { side_length: SIDE });
        let (mut compared, mut with_two) = (0, 0);
        for draw in 0..4000_u64 {
            let number = |part: u64| uniform(draw * 8 + part);
            let angle = if draw % 2 == 0 { 3.0 * number(3) } else { 0.02 * number(3) };
            let a = body([0.0, 0.0], 3.0 * number(0));
            let b = SolverBody {
                position: Rotation::new(3.0 * number(0)) * Vector::new(0.075, 0.06 * number(2)),
                ..body([0.0, 0.0], 3.0 * number(0) + angle)
            };
            let parry = shape.contact(&pose(&a), &shape, &pose(&b), 0.0);
            let found = meet(&a, &b, 1e-3, 0.0);
            let Some(parry) = parry else { continue };
            let deepest = |points: &mut dyn Iterator<Item = f32>| points.fold(0.0, f32::min);
            let depth = deepest(&mut parry.points.iter().map(|(_, distance)| *distance));
            if depth > -2e-4 {
                continue;
            }
            let found = found.unwrap_or_else(|| panic!("{draw}: no contact, parry has {depth}"));
            let own = deepest(&mut found.points().iter().map(|point| point.separation));
            assert!((own - depth).abs() < 1.1e-4, "{draw}: {own} deep, parry has {depth}");
            // Near 45 degrees and at corners several directions have almost the same depth.
            if found.normal.dot(parry.normal) < 0.999 {
                continue;
            }
            compared += 1;
            with_two += usize::from(found.points().len() == 2);
            for point in found.points().iter().filter(|point| point.separation < -1e-5) {
                let on_first = a.position + point.arms[0];
                let near = parry.points.iter().any(|(at, _)| (*at - on_first).length() < 1e-3);
                assert!(near, "{draw}: {point:?}, parry has {:?}", parry.points);
            }
        }
        assert!(compared > 1000 && with_two > 500, "{compared} {with_two}");
    }

    #[test]
    fn squares_that_meet_on_their_paths_have_the_face_that_they_meet() {
        // 20 mm apart along x, 5 mm along y: at 45 degrees they meet along x.
        let a = body([0.0, 0.0], 0.0);
        let fast = |velocity: [f32; 2]| SolverBody {
            velocity: velocity.into(),
            ..body([SIDE + 0.02, SIDE + 0.005], 0.0)
        };
        let found = meet(&a, &fast([-10.0, -10.0]), 4e-3, 0.0).expect("they meet");
        assert!((found.normal - Vector::X).length() < 1e-6, "{found:?}");
        assert!((found.points()[0].separation - 0.02).abs() < 1e-6, "{found:?}");
        // They pass each other, or are too slow.
        assert!(meet(&a, &fast([-10.0, 0.0]), 4e-3, 0.0).is_none());
        assert!(meet(&a, &fast([-4.0, -4.0]), 4e-3, 0.0).is_none());
    }

    #[test]
    fn squares_within_reach_of_a_push_have_a_contact() {
        let (a, b) = (body([0.0, 0.0], 0.0), body([SIDE + 0.003, 0.01], 0.0));
        assert!(meet(&a, &b, 1e-3, 0.002).is_none());
        let found = meet(&a, &b, 1e-3, 0.004).expect("within reach");
        assert_eq!(found.points().len(), 2, "{found:?}");
        assert!(found.points().iter().all(|point| (point.separation - 0.003).abs() < 1e-6));
    }
}

//! Contact points of two outlines within one sub-step.
//!
//! Bodies move straight in a sub-step. A contact is where two outlines first touch on their paths, so
//! bodies that pass each other are not stopped, and none is missed. Outlines that touch already have
//! the contact of least depth.

use super::boxes::boxes;
use crate::engine::ball_contact::{Approached, Touch};
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// Gap up to which outlines count as touching, m, whatever their velocities: contacts of robots that
/// push each other keep their impulses from one sub-step to the next.
pub(super) const TOUCHING: f32 = 5e-5;

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
    /// A manifold without points.
    pub(super) fn empty(normal: Vector) -> Self {
        Self { normal, points: [Point::default(); 2], count: 0 }
    }

    fn of_point(normal: Vector, position: Vector, separation: f32) -> Self {
        let mut manifold = Self::empty(normal);
        manifold.push(Point { position, separation, feature: 1 });
        manifold
    }

    pub(super) fn push(&mut self, point: Point) {
        self.points[self.count] = point;
        self.count += 1;
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points[..self.count]
    }

    /// The manifold with first and second exchanged.
    pub(super) fn reversed(self) -> Self {
        Self { normal: -self.normal, ..self }
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

/// Contact of two outlines that touch within `time` (s), or that are at most `reach` (m) apart.
pub(super) fn meet(a: &Moving, b: &Moving, time: f32, reach: f32) -> Option<Manifold> {
    match (a.place.outline, b.place.outline) {
        (Outline::Disc { radius: first }, Outline::Disc { radius: second }) => {
            discs(a, first, b, second, time, reach)
        }
        (Outline::Box { half: first }, Outline::Box { half: second }) => {
            boxes((a, first), (b, second), time, reach)
        }
        (_, Outline::Disc { radius }) => outline_and_disc(a, b, radius, time, reach),
        (Outline::Disc { radius }, _) => {
            outline_and_disc(b, a, radius, time, reach).map(Manifold::reversed)
        }
        // Robots meet robots and walls as discs or boxes.
        _ => None,
    }
}

/// Contact of the ball (`ball`) with a robot or wall; a squeezed ball has one with all around it.
pub(super) fn meet_ball(
    met: &Moving,
    ball: &Moving,
    squeezed: bool,
    time: f32,
) -> Option<Manifold> {
    let Outline::Disc { radius } = ball.place.outline else { return None };
    let center = ball.place.position;
    let touch = if squeezed {
        Touch::of(&met.place.nearest(center), center, radius)
    } else {
        approached(met, ball).touch(center, radius, time)?
    };
    Some(Manifold::of_point(touch.normal, center - touch.normal * radius, touch.distance))
}

fn approached(met: &Moving, disc: &Moving) -> Approached {
    Approached { place: met.place, velocity: disc.velocity - met.velocity, spin: met.spin }
}

fn discs(
    a: &Moving,
    first: f32,
    b: &Moving,
    second: f32,
    time: f32,
    reach: f32,
) -> Option<Manifold> {
    let apart = b.place.position - a.place.position;
    let radii = first + second;
    let distance_squared = apart.length_squared();
    let distance = distance_squared.sqrt();
    let gap = distance - radii;
    let (normal, separation) = if gap <= TOUCHING {
        (if distance > 0.0 { apart / distance } else { Vector::X }, gap)
    } else {
        let velocity = b.velocity - a.velocity;
        let closing = -apart.dot(velocity);
        let mut at = apart;
        let mut meets = false;
        if closing > 0.0 {
            // |apart + velocity t| = radii, the earlier solution; or the least distance.
            let speed_squared = velocity.length_squared();
            let excess = distance_squared - radii * radii;
            let discriminant = closing * closing - speed_squared * excess;
            let after = (closing - discriminant.max(0.0).sqrt()) / speed_squared;
            meets = discriminant > 0.0 && after <= time;
            at += velocity * after.min(time);
        }
        if !meets && gap > reach {
            return None;
        }
        // The separation along the normal of the contact, which both approach.
        let normal = at.normalize();
        (normal, (apart.dot(normal) - radii).max(0.0))
    };
    let position = a.place.position + normal * (first + 0.5 * separation);
    Some(Manifold::of_point(normal, position, separation))
}

/// `a` is no disc.
fn outline_and_disc(
    a: &Moving,
    b: &Moving,
    radius: f32,
    time: f32,
    reach: f32,
) -> Option<Manifold> {
    let center = b.place.position;
    let touch = approached(a, b).touch(center, radius, time).or_else(|| {
        let touch = Touch::of(&a.place.nearest(center), center, radius);
        (touch.distance <= reach).then_some(touch)
    })?;
    let position = center - touch.normal * (radius + 0.5 * touch.distance);
    Some(Manifold::of_point(touch.normal, position, touch.distance))
}

//! Contact point of a disc with another outline within one sub-step.

use super::manifold::{Manifold, Moving, TOUCHING};
use crate::engine::ball_contact::{Approached, Touch};
use crate::geometry::outline::Outline;
use crate::math::Vector;

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

/// Contact of two discs that touch within `time` (s), or that are at most `reach` (m) apart.
pub(super) fn discs(
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

/// Contact of another outline with a disc, as [`discs`].
pub(super) fn outline_and_disc(
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

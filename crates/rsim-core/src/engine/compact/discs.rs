//! Contact point of a disc with another outline within one sub-step.

use super::body::SolverBody;
use super::manifold::{Manifold, TOUCHING, Window};
use crate::engine::ball_contact::{Approached, Touch};
use crate::geometry::outline::Outline;
use crate::math::Vector;

/// A disc on its straight path.
#[derive(Clone, Copy)]
pub(super) struct Disc<'a> {
    pub(super) body: &'a SolverBody,
    /// m.
    pub(super) radius: f32,
}

/// Contact of the ball with a robot or wall; a squeezed ball has one with all around it.
pub(super) fn meet_ball(
    met: &SolverBody,
    outline: Outline,
    ball: Disc,
    squeezed: bool,
    time: f32,
) -> Option<Manifold> {
    let (center, radius) = (ball.body.position, ball.radius);
    let touch = if squeezed {
        Touch::of(&met.placed(outline).nearest(center), center, radius)
    } else {
        approached(met, outline, ball.body).touch(center, radius, time)?
    };
    Some(Manifold::of_point(touch.normal, center - touch.normal * radius, touch.distance))
}

fn approached(met: &SolverBody, outline: Outline, disc: &SolverBody) -> Approached {
    Approached {
        place: met.placed(outline),
        velocity: disc.velocity - met.velocity,
        spin: met.spin,
    }
}

/// Contact of two discs that touch in the sub-step, or that are within the reach of a push.
pub(super) fn discs(a: Disc, b: Disc, window: Window) -> Option<Manifold> {
    let apart = b.body.position - a.body.position;
    let radii = a.radius + b.radius;
    let distance_squared = apart.length_squared();
    let distance = distance_squared.sqrt();
    let gap = distance - radii;
    let (normal, separation) = if gap <= TOUCHING {
        (if distance > 0.0 { apart / distance } else { Vector::X }, gap)
    } else {
        let velocity = b.body.velocity - a.body.velocity;
        let closing = -apart.dot(velocity);
        let (mut at, mut meets) = (apart, false);
        if closing > 0.0 {
            // |apart + velocity t| = radii, the earlier solution; or the least distance.
            let speed_squared = velocity.length_squared();
            let excess = distance_squared - radii * radii;
            let discriminant = closing * closing - speed_squared * excess;
            let after = (closing - discriminant.max(0.0).sqrt()) / speed_squared;
            meets = discriminant > 0.0 && after <= window.time;
            at += velocity * after.min(window.time);
        }
        if !meets && gap > window.reach {
            return None;
        }
        // The separation along the normal of the contact, which both approach.
        let normal = at.normalize();
        (normal, (apart.dot(normal) - radii).max(0.0))
    };
    let position = a.body.position + normal * (a.radius + 0.5 * separation);
    Some(Manifold::of_point(normal, position, separation))
}

/// Contact of another outline with a disc, as [`discs`].
pub(super) fn outline_and_disc(
    a: &SolverBody,
    outline: Outline,
    b: Disc,
    window: Window,
) -> Option<Manifold> {
    let center = b.body.position;
    let touch =
        approached(a, outline, b.body).touch(center, b.radius, window.time).or_else(|| {
            let touch = Touch::of(&a.placed(outline).nearest(center), center, b.radius);
            (touch.distance <= window.reach).then_some(touch)
        })?;
    let position = center - touch.normal * (b.radius + 0.5 * touch.distance);
    Some(Manifold::of_point(touch.normal, position, touch.distance))
}

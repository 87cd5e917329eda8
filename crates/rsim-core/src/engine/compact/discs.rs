//! Contact point of a disc with another outline within one sub-step.

use super::body::SolverBody;
use super::manifold::{Manifold, TOUCHING, Window};
use crate::engine::ball_contact::{Approached, Touch};
use crate::engine::joints::Ball;
use crate::geometry::outline::Outline;
use crate::math::Vector;

/// A disc on its straight path.
#[derive(Clone, Copy)]
pub(super) struct Disc<'a> {
    pub(super) body: &'a SolverBody,
    /// m.
    pub(super) radius: f32,
}

/// Contact of the ball with a robot or wall, in a search that `ball` describes; a squeezed ball has one with
/// all around it. `others` are those beside which `met` may have a joint.
pub(super) fn meet_ball<'a>(
    met: (&SolverBody, Outline),
    body: &SolverBody,
    ball: Ball,
    others: impl Iterator<Item = (&'a SolverBody, Outline)>,
) -> Option<Manifold> {
    let (met, outline) = met;
    let Ball { center, radius, time } = ball;
    let touch = if time > 0.0 {
        approached(met, outline, body).touch(center, radius, time)?
    } else {
        Touch::of(&met.placed(outline).nearest(center), center, radius)
    };
    let others = others.map(|(other, outline)| approached(other, outline, body));
    let touch = ball.over_joints(touch, &approached(met, outline, body), others);
    Some(manifold_of(&touch, met, radius))
}

fn approached(met: &SolverBody, outline: Outline, disc: &SolverBody) -> Approached {
    Approached {
        place: met.placed(outline),
        velocity: disc.velocity - met.velocity,
        angular_velocity: met.angular_velocity,
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
    Some(Manifold::of_point(normal, [normal * a.radius, -normal * b.radius], separation))
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
    Some(manifold_of(&touch, a, b.radius))
}

/// The manifold of a disc of `radius` that touches `met`.
fn manifold_of(touch: &Touch, met: &SolverBody, radius: f32) -> Manifold {
    let on_disc = -touch.normal * radius;
    let arms = [touch.center + on_disc - met.position, on_disc];
    Manifold::of_point(touch.normal, arms, touch.distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::shapes::Shape;
    use crate::math::Pose;
    use crate::scenes::uniform;

    fn at([x, y]: [f32; 2], velocity: [f32; 2]) -> SolverBody {
        SolverBody {
            position: Vector::new(x, y),
            heading: Vector::X,
            velocity: velocity.into(),
            angular_velocity: 0.0,
            inverse_mass: 1.0,
            inverse_inertia: 1.0,
            lag: 0.0,
        }
    }

    fn meet(a: &SolverBody, b: &SolverBody, time: f32, reach: f32) -> Option<Manifold> {
        let of = |body| Disc { body, radius: 0.09 };
        discs(of(a), of(b), Window { time, reach })
    }

    #[test]
    fn contacts_of_discs_that_touch_are_those_of_parry() {
        let shape = Shape::of_disc(0.09);
        for draw in 0..1000_u64 {
            let place = |part: u64| [0.05 * uniform(draw * 8 + part), uniform(draw * 8 + part + 1)];
            let (a, b) = (at(place(0), [0.0; 2]), at(place(2).map(|part| part * 0.15), [0.0; 2]));
            let [pose_a, pose_b] = [a, b].map(|body| Pose::from_translation(body.position));
            let Some(parry) = shape.contact(&pose_a, &shape, &pose_b, 0.0) else { continue };
            let found = meet(&a, &b, 1e-3, 0.0).expect("parry has a contact");
            assert!((found.normal - parry.normal).length() < 1e-4, "{draw}: {found:?}");
            assert!((found.points()[0].separation - parry.points[0].1).abs() < 1e-6, "{draw}");
        }
    }

    #[test]
    fn discs_meet_on_their_paths_or_pass_each_other() {
        let a = at([0.0, 0.0], [0.0; 2]);
        let found = meet(&a, &at([0.19, 0.0], [-10.0, 0.0]), 2e-3, 0.0).expect("they meet");
        assert!((found.points()[0].separation - 0.01).abs() < 1e-6, "{found:?}");
        assert!(meet(&a, &at([0.19, 0.0], [-4.0, 0.0]), 2e-3, 0.0).is_none(), "too slow");
        assert!(meet(&a, &at([0.1, 0.185], [-10.0, 0.0]), 0.02, 0.0).is_none(), "passing");
        assert!(meet(&a, &at([0.185, 0.0], [0.0; 2]), 2e-3, 0.006).is_some(), "within reach");
    }
}

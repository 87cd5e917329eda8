//! What the contact engine must know of the ball beyond a disc: it may fly, it is fast for its size,
//! and robots have a flat front.

use rapier2d::math::{Rotation, Vector};
use rapier2d::pipeline::ModifiableContacts;
use rapier2d::prelude::*;

use super::{Partner, partner};
use crate::arena::Wall;
use crate::outline::Placed;
use crate::physique::Physique;

/// Surfaces nearer than this touch, m: then the contact is where it is. Farther ones are looked for
/// along the ball's way.
const TOUCHING: f32 = 1e-4;

/// How near the search along the way comes to the contact, m.
const FOUND: f32 = 1e-5;

/// The rules of one tick.
pub(crate) struct BallHooks<'a> {
    pub(crate) physique: &'a Physique,
    pub(crate) walls: &'a [Wall],
    /// In the air the ball meets others elsewhere: [`crate::flight`].
    pub(crate) flies: bool,
    /// s.
    pub(crate) tick: f32,
}

/// What the ball is about to meet: its outline where it is, and how it moves against the ball.
struct Obstacle {
    place: Placed,
    /// Velocity of the ball against it, m/s.
    velocity: Vector,
}

/// Where the ball will touch: nearest point at that instant, and the centre of the ball then.
struct Touch {
    normal: Vector,
    /// From here to there along the normal, m.
    distance: f32,
    center: Vector,
}

impl PhysicsHooks for BallHooks<'_> {
    // Only the ball's collider asks for hooks, so one of each pair is the ball.
    fn filter_contact_pair(&self, _context: &PairFilterContext) -> Option<SolverFlags> {
        (!self.flies).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }

    /// Puts the contact of the ball where it will be: the engine has the nearest points of now, and
    /// of a robot only the disc. A fast ball comes to another point, or to none.
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let colliders = [context.collider1, context.collider2].map(|of| &context.colliders[of]);
        let labels = colliders.map(|collider| partner(collider.user_data));
        let (with, other, ball, sign) = match labels {
            [Some(with), None] => (with, colliders[0], colliders[1], 1.0),
            [None, Some(with)] => (with, colliders[1], colliders[0], -1.0),
            _ => return,
        };
        let center = ball.translation();
        let outline = match with {
            Partner::Robot(index) => self.physique.robots[index].outline,
            Partner::Wall(index) => self.walls[index].outline(),
        };
        let velocity = |collider: &Collider| {
            let body = collider.parent().map(|handle| &context.bodies[handle]);
            body.map_or(Vector::ZERO, |body| body.velocity_at_point(center))
        };
        let pose = other.position();
        let obstacle = Obstacle {
            place: Placed { outline, position: pose.translation, heading: pose.rotation },
            velocity: velocity(ball) - velocity(other),
        };
        let radius = self.physique.ball.radius;
        let touch = obstacle.touch(center, radius, self.tick);
        if let ModifiableContacts::Rigid(manifold) = &mut context.contacts {
            let Some(touch) = touch else {
                manifold.solver_contacts.clear();
                return;
            };
            *manifold.normal = touch.normal * sign;
            for contact in manifold.solver_contacts.iter_mut() {
                let on_ball = center - touch.normal * radius;
                let on_other = touch.center - touch.normal * radius;
                contact.dist = touch.distance;
                (contact.anchor1, contact.anchor2) =
                    if sign > 0.0 { (on_other, on_ball) } else { (on_ball, on_other) };
            }
        }
    }
}

impl Obstacle {
    /// Where a ball at `center` touches within `time`, going straight. The distance to a convex
    /// outline is a convex function of time, so Newton's method comes up to the contact and never
    /// passes it.
    fn touch(&self, center: Vector, radius: f32, time: f32) -> Option<Touch> {
        let now = self.place.nearest(center);
        if now.distance - radius <= TOUCHING {
            // The point of the outline, seen as touched by a ball that is just there.
            let distance = now.distance - radius;
            let touching = center - now.normal * distance;
            return Some(Touch { normal: now.normal, distance, center: touching });
        }
        let (mut nearest, mut after) = (now, 0.0);
        for _ in 0..32 {
            let closing = -self.velocity.dot(nearest.normal);
            let gap = nearest.distance - radius;
            if closing <= 0.0 {
                return None;
            }
            if gap <= FOUND {
                break;
            }
            after += gap / closing;
            if after > time {
                return None;
            }
            nearest = self.place.nearest(center + self.velocity * after);
        }
        let way = self.velocity * after;
        let distance = -way.dot(nearest.normal);
        Some(Touch { normal: nearest.normal, distance, center: center + way })
    }
}

/// The rotation of a heading.
pub(crate) fn rotation(heading: Vector) -> Rotation {
    Rotation { re: heading.x, im: heading.y }
}

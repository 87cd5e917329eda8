//! What the contact engine must know of the ball beyond a disc: it may fly, it is fast for its size,
//! and robots have a flat front.

use rapier2d::math::{Rotation, Vector};
use rapier2d::pipeline::ModifiableContacts;
use rapier2d::prelude::*;

use super::{Partner, partner, turned};
use crate::arena::Wall;
use crate::outline::{Nearest, Placed};
use crate::physique::Physique;
use crate::squeeze::Squeeze;

/// Surfaces nearer than this touch, m: then the contact is where it is. Farther ones are looked for
/// along the ball's way.
const TOUCHING: f32 = 1e-4;

/// How near the search along the way comes to the contact, m.
const FOUND: f32 = 1e-5;

/// Most looks of that search. A slow ball beside a fast corner takes the most.
const LOOKS: usize = 32;

/// The rules of one tick.
pub(crate) struct BallHooks<'a> {
    pub(crate) physique: &'a Physique,
    pub(crate) walls: &'a [Wall],
    pub(crate) level: Level,
    /// If the ball is caught between others it stays in contact with all of them.
    pub(crate) squeeze: Option<Squeeze>,
    /// Length of what is solved, s.
    pub(crate) time: f32,
}

/// Where the ball is in a tick, which decides what it meets in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Level {
    Floor,
    /// It meets others elsewhere: [`crate::flight`].
    Air,
    /// In the air and caught between others, so that it meets what is as high as its centre.
    Caught {
        /// m.
        height: f32,
    },
}

/// What the ball is about to meet: its outline where it is, and how it moves.
struct Obstacle {
    place: Placed,
    /// Velocity of the ball against its middle, m/s.
    velocity: Vector,
    /// rad/s.
    spin: f32,
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
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let colliders = [context.collider1, context.collider2].map(|of| &context.colliders[of]);
        let met = colliders.iter().find_map(|collider| partner(collider.user_data));
        met.is_some_and(|with| self.meets(with)).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
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
        let motion = |collider: &Collider| {
            let body = collider.parent().map(|handle| &context.bodies[handle]);
            body.map_or((Vector::ZERO, 0.0), |body| (body.linvel(), body.angvel()))
        };
        let pose = other.position();
        let ((ball_velocity, _), (velocity, spin)) = (motion(ball), motion(other));
        let obstacle = Obstacle {
            place: Placed { outline, position: pose.translation, heading: pose.rotation },
            velocity: ball_velocity - velocity,
            spin,
        };
        let radius = self.physique.ball.radius;
        let touch = if self.squeeze.is_some() {
            Some(Touch::of(&obstacle.place.nearest(center), center, radius))
        } else {
            obstacle.touch(center, radius, self.time)
        };
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

impl BallHooks<'_> {
    /// Whether the ball meets something in the plane.
    fn meets(&self, with: Partner) -> bool {
        match self.level {
            Level::Floor => true,
            Level::Air => false,
            Level::Caught { height } => match with {
                Partner::Robot(index) => height < self.physique.robots[index].model.height,
                Partner::Wall(index) => height < self.walls[index].top,
            },
        }
    }
}

impl Touch {
    /// The point of an outline that is nearest, seen as touched by a ball that is just there.
    fn of(nearest: &Nearest, center: Vector, radius: f32) -> Self {
        let distance = nearest.distance - radius;
        Self { normal: nearest.normal, distance, center: center - nearest.normal * distance }
    }
}

impl Obstacle {
    /// Where a ball at `center` touches within `time`, as both go on straight and the obstacle turns on.
    ///
    /// Each look leads to a time before which they cannot touch: the distance to a convex outline
    /// shrinks no faster than along the normal, and by turning no faster than its farthest corner
    /// moves. So the search comes up to the contact and never passes it.
    fn touch(&self, center: Vector, radius: f32, time: f32) -> Option<Touch> {
        let mut nearest = self.place.nearest(center);
        if nearest.distance - radius <= TOUCHING {
            return Some(Touch::of(&nearest, center, radius));
        }
        let corner_speed = self.spin.abs() * self.place.outline.turning_radius();
        let (mut place, mut after) = (self.place, 0.0);
        for _ in 0..LOOKS {
            let gap = nearest.distance - radius;
            if gap <= FOUND {
                break;
            }
            let closing = corner_speed - self.velocity.dot(nearest.normal);
            if closing <= 0.0 {
                return None;
            }
            after += gap / closing;
            if after > time {
                return None;
            }
            let Rotation { re, im } = self.place.heading;
            place.heading = rotation(turned(Vector::new(re, im), self.spin * after));
            nearest = place.nearest(center + self.velocity * after);
        }
        let center = center + self.velocity * after;
        let arm = center - nearest.normal * radius - place.position;
        let closing = (arm.perp() * self.spin - self.velocity).dot(nearest.normal);
        let distance = (closing * after).max(0.0);
        Some(Touch { normal: nearest.normal, distance, center })
    }
}

/// The rotation of a heading.
pub(crate) fn rotation(heading: Vector) -> Rotation {
    Rotation { re: heading.x, im: heading.y }
}

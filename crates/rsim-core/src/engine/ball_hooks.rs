//! Contacts of the ball for the engine: the ball may fly, it is fast for its size, and robots have a
//! flat front.

use rapier2d::geometry::{Collider, SolverFlags};
use rapier2d::pipeline::{
    ContactModificationContext, ModifiableContacts, PairFilterContext, PhysicsHooks,
};

use super::contacts::{Partner, partner};
use crate::body_params::BodyParams;
use crate::geometry::arena::Wall;
use crate::geometry::motion::{rotated, rotation};
use crate::geometry::outline::{NearestPoint, PlacedOutline};
use crate::math::{Rotation, Vector};

/// Gap up to which surfaces touch, m: then the contact is at the nearest point. For a larger gap the
/// contact is searched along the ball's path.
const TOUCHING: f32 = 1e-4;

/// Gap at which the search along the path ends, m.
const FOUND: f32 = 1e-5;

/// Maximum number of iterations of that search. A slow ball beside a fast corner needs the most.
const MAX_ITERATIONS: usize = 32;

/// Contact rules of the ball in one tick, or in a part of it.
pub(crate) struct BallHooks<'a> {
    pub(crate) params: &'a BodyParams,
    pub(crate) walls: &'a [Wall],
    pub(crate) phase: BallPhase,
    /// Set for a squeezed ball, which stays in contact with all bodies around it.
    pub(crate) squeezed: Option<SqueezedBall>,
    /// Length of the tick or its part, s.
    pub(crate) time: f32,
}

/// Height of the ball in a tick, which decides its contacts in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum BallPhase {
    /// On the floor: contacts with everything.
    Floor,
    /// In the air: no contacts here; `tick::flight` solves them.
    Air,
    /// In the air and jammed: contacts with everything as high as its centre.
    JammedInAir {
        /// Height of the centre, m.
        height: f32,
    },
}

/// Settings of the solver for a squeezed ball.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SqueezedBall {
    /// Mass of the ball in the solver, kg.
    pub(crate) mass: f32,
    /// Whether the ball cannot slip out.
    pub(crate) jammed: bool,
}

/// A body or wall that the ball approaches.
struct Approached {
    place: PlacedOutline,
    /// Velocity of the ball relative to the centre of the approached body, m/s.
    velocity: Vector,
    /// Turn rate of the approached body, rad/s.
    spin: f32,
}

/// A predicted contact: normal, distance to it now, and the ball's centre at that instant.
struct Touch {
    normal: Vector,
    /// Distance along the normal, m.
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

    /// Moves the contact of the ball to where it will be. The engine has the nearest points of now, and
    /// of a round robot only the disc; a fast ball touches at another point, or not at all.
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
            Partner::Robot(index) => self.params.robots[index].outline,
            Partner::Wall(index) => self.walls[index].outline(),
        };
        let motion = |collider: &Collider| {
            let body = collider.parent().map(|handle| &context.bodies[handle]);
            body.map_or((Vector::ZERO, 0.0), |body| (body.linvel(), body.angvel()))
        };
        let pose = other.position();
        let ((ball_velocity, _), (velocity, spin)) = (motion(ball), motion(other));
        let approached = Approached {
            place: PlacedOutline { outline, position: pose.translation, heading: pose.rotation },
            velocity: ball_velocity - velocity,
            spin,
        };
        let radius = self.params.ball.radius;
        let touch = if self.squeezed.is_some() {
            Some(Touch::of(&approached.place.nearest(center), center, radius))
        } else {
            approached.touch(center, radius, self.time)
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
    /// Whether the ball can touch a robot or wall in the plane.
    fn meets(&self, with: Partner) -> bool {
        match self.phase {
            BallPhase::Floor => true,
            BallPhase::Air => false,
            BallPhase::JammedInAir { height } => match with {
                Partner::Robot(index) => height < self.params.robots[index].model.height,
                Partner::Wall(index) => height < self.walls[index].top,
            },
        }
    }
}

impl Touch {
    /// The nearest point of an outline, as touched by a ball that is just there.
    fn of(nearest: &NearestPoint, center: Vector, radius: f32) -> Self {
        let distance = nearest.distance - radius;
        Self { normal: nearest.normal, distance, center: center - nearest.normal * distance }
    }
}

impl Approached {
    /// The contact of a ball at `center` within `time`, if both move straight and the approached body
    /// keeps turning.
    ///
    /// Each iteration advances by a time before which the two cannot touch: the distance to a convex
    /// outline shrinks at most by the speed along the normal and, by rotation, by the speed of its
    /// farthest corner. So the search converges to the contact and never passes it.
    fn touch(&self, center: Vector, radius: f32, time: f32) -> Option<Touch> {
        let mut nearest = self.place.nearest(center);
        if nearest.distance - radius <= TOUCHING {
            return Some(Touch::of(&nearest, center, radius));
        }
        let corner_speed = self.spin.abs() * self.place.outline.turning_radius();
        let (mut place, mut after) = (self.place, 0.0);
        for _ in 0..MAX_ITERATIONS {
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
            place.heading = rotation(rotated(Vector::new(re, im), self.spin * after));
            nearest = place.nearest(center + self.velocity * after);
        }
        let center = center + self.velocity * after;
        let arm = center - nearest.normal * radius - place.position;
        let closing = (arm.perp() * self.spin - self.velocity).dot(nearest.normal);
        let distance = (closing * after).max(0.0);
        Some(Touch { normal: nearest.normal, distance, center })
    }
}

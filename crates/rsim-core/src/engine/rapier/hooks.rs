//! Hooks of rapier for contacts of the ball.

use rapier2d::dynamics::RigidBody;
use rapier2d::geometry::{Collider, SolverFlags};
use rapier2d::pipeline::{
    ContactModificationContext, ModifiableContacts, PairFilterContext, PhysicsHooks,
};

use super::report::partner;
use crate::engine::ball_contact::{Approached, BallRules, Touch};
use crate::engine::compact::{Manifold, Rectangle, SolverBody, Window, boxes};
use crate::engine::contacts::Partner;
use crate::engine::joints::Ball;
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// By how much the reach of a search for sliding boxes exceeds the distance that the engine has found, m:
/// along another face they may be farther apart.
const REACH: f32 = 5e-3;

/// Speed against each other, m/s, below which boxes keep the contact that the engine has found: in a crowd that
/// presses, a corner at a corner would change its face from tick to tick.
const PRESSING: f32 = 0.1;

/// Speed of corners by rotation, m/s, above which boxes keep that contact: the search takes headings to be
/// constant for a tick.
const TURNING: f32 = 0.5;

/// Cosine of the angle between two normals up to which they are of one face. Of two corners that pass each
/// other the engine finds a normal between those of their faces.
const SAME_FACE: f32 = 0.999;

impl PhysicsHooks for BallRules<'_> {
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
            [Some(first), Some(second)] => return self.slide([first, second], context),
            _ => return,
        };
        let center = ball.translation();
        let outline = self.outline_of(with);
        let motion = |collider: &Collider| {
            let body = collider.parent().map(|handle| &context.bodies[handle]);
            body.map_or((Vector::ZERO, 0.0), |body| (body.linvel(), body.angvel()))
        };
        let (ball_velocity, _) = motion(ball);
        let approached = |other: &Collider, outline: Outline| {
            let (pose, (velocity, angular_velocity)) = (other.position(), motion(other));
            Approached {
                place: PlacedOutline {
                    outline,
                    position: pose.translation,
                    heading: pose.rotation,
                },
                velocity: ball_velocity - velocity,
                angular_velocity,
            }
        };
        let met = approached(other, outline);
        let radius = self.parameters.ball.radius;
        let touch = if self.squeezed.is_some() {
            Some(Touch::of(&met.place.nearest(center), center, radius))
        } else {
            met.touch(center, radius, self.time)
        };
        let others = context.colliders.iter().filter_map(|(_, collider)| {
            let beside = partner(collider.user_data).filter(|beside| *beside != with)?;
            let outline = self.outline_of(beside);
            matches!(outline, Outline::Box { .. }).then(|| approached(collider, outline))
        });
        let time = if self.squeezed.is_some() { 0.0 } else { self.time };
        let touch =
            touch.map(|touch| Ball { center, radius, time }.over_joints(touch, &met, others));
        if let ModifiableContacts::Rigid(manifold) = &mut context.contacts {
            let Some(touch) = touch else {
                manifold.solver_contacts.clear();
                return;
            };
            *manifold.normal = touch.normal * sign;
            for contact in manifold.solver_contacts.iter_mut() {
                // Both along the normal from where they will touch: the lever of the impulse is between
                // them, and the ball may move far along the surface before it touches.
                let on_other = touch.center - touch.normal * radius;
                let on_ball = on_other + touch.normal * touch.distance;
                contact.dist = touch.distance;
                (contact.anchor1, contact.anchor2) =
                    if sign > 0.0 { (on_other, on_ball) } else { (on_ball, on_other) };
            }
        }
    }
}

impl BallRules<'_> {
    /// Lets two boxes slide over a joint, as the compact solver does.
    fn slide(&self, pair: [Partner; 2], context: &mut ContactModificationContext) {
        let ModifiableContacts::Rigid(manifold) = &mut context.contacts else { return };
        let nearest = manifold.solver_contacts.iter().map(|contact| contact.dist);
        let Some(distance) = nearest.reduce(f32::min) else { return };
        let [Outline::Box { half: first }, Outline::Box { half: second }] =
            pair.map(|partner| self.outline_of(partner))
        else {
            return;
        };
        let [a, b] = [context.collider1, context.collider2].map(|collider| {
            let collider = &context.colliders[collider];
            let pose = collider.position();
            let body = collider.parent().map(|handle| &context.bodies[handle]);
            SolverBody {
                position: pose.translation,
                heading: Vector::new(pose.rotation.re, pose.rotation.im),
                velocity: body.map_or(Vector::ZERO, RigidBody::linvel),
                angular_velocity: body.map_or(0.0, RigidBody::angvel),
                ..SolverBody::default()
            }
        });
        let [a, b] = [(&a, first), (&b, second)].map(|(body, half)| Rectangle {
            body,
            half,
            radius: half.length(),
        });
        let rims =
            a.body.angular_velocity.abs() * a.radius + b.body.angular_velocity.abs() * b.radius;
        let speed = (b.body.velocity - a.body.velocity).length();
        if speed + rims < PRESSING || rims > TURNING {
            return;
        }
        let window = Window { time: self.time, reach: distance.max(0.0) + REACH };
        let found = boxes(a, b, window);
        if found.as_ref().is_some_and(|found| found.normal.dot(*manifold.normal) > SAME_FACE) {
            return;
        }
        let found = found.unwrap_or(Manifold::empty(*manifold.normal));
        let count = found.points().len();
        manifold.solver_contacts.truncate(count);
        if count == 0 {
            return;
        }
        *manifold.normal = found.normal;
        for (contact, point) in manifold.solver_contacts.iter_mut().zip(found.points()) {
            contact.dist = point.separation;
            contact.anchor1 = a.body.position + point.arms[0];
            contact.anchor2 = b.body.position + point.arms[1];
        }
    }

    /// Outline of a robot or wall as the ball meets it.
    fn outline_of(&self, partner: Partner) -> Outline {
        match partner {
            Partner::Robot(index) => self.parameters.robots[index].outline,
            Partner::Wall(index) => self.walls[index].outline(),
        }
    }
}

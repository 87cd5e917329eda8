//! What the contact engine must know of the ball beyond a disc: it may fly, and robots have a flat
//! front.

use rapier2d::math::{Rotation, Vector};
use rapier2d::pipeline::ModifiableContacts;
use rapier2d::prelude::*;

use super::{Partner, partner};
use crate::outline::{Nearest, Outline};
use crate::physique::Physique;

/// The rules of one tick.
pub(crate) struct BallHooks<'a> {
    pub(crate) physique: &'a Physique,
    /// In the air the ball meets others elsewhere: [`crate::flight`].
    pub(crate) flies: bool,
}

impl PhysicsHooks for BallHooks<'_> {
    // Only the ball's collider asks for hooks, so one of each pair is the ball.
    fn filter_contact_pair(&self, _context: &PairFilterContext) -> Option<SolverFlags> {
        (!self.flies).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }

    /// Puts the contact of the ball with a robot, a disc for the engine, where its outline is.
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let colliders = [context.collider1, context.collider2].map(|of| &context.colliders[of]);
        let labels = colliders.map(|collider| partner(collider.user_data));
        let (index, robot, ball, sign) = match labels {
            [Some(Partner::Robot(index)), _] => (index, colliders[0], colliders[1], 1.0),
            [_, Some(Partner::Robot(index))] => (index, colliders[1], colliders[0], -1.0),
            _ => return,
        };
        let outline = &self.physique.robots[index].outline;
        if matches!(outline, Outline::Box { .. }) {
            return; // the engine's shape is the outline
        }
        let pose = robot.position();
        let center = ball.translation();
        let nearest = outline.nearest_at(pose.translation, pose.rotation, center);
        let radius = self.physique.ball.radius;
        if let ModifiableContacts::Rigid(manifold) = &mut context.contacts {
            *manifold.normal = nearest.normal * sign;
            for contact in manifold.solver_contacts.iter_mut() {
                place(contact, &nearest, center, radius, sign);
            }
        }
    }
}

/// Moves a contact between the ball, whose centre is `center`, and the nearest point of an outline.
/// `sign` is 1 when the robot is the first of the two.
fn place(contact: &mut SolverContact, nearest: &Nearest, center: Vector, radius: f32, sign: f32) {
    let on_robot = center - nearest.normal * nearest.distance;
    let on_ball = center - nearest.normal * radius;
    contact.dist = nearest.distance - radius;
    (contact.anchor1, contact.anchor2) =
        if sign > 0.0 { (on_robot, on_ball) } else { (on_ball, on_robot) };
}

/// The rotation of a heading.
pub(crate) fn rotation(heading: Vector) -> Rotation {
    Rotation { re: heading.x, im: heading.y }
}

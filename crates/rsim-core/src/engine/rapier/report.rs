//! Contacts of rapier's last step.

use rapier2d::geometry::NEW_CONTACT_BIT;
use rapier2d::parry::query::TrackedContact;
use rapier2d::prelude::{ContactData, ContactManifold, ContactPair};

use super::RapierSolver;
use crate::blocks::BALL;
use crate::engine::contacts::{BallContact, Contacts, Partner, RobotContact};
use crate::math::Vector;

impl RapierSolver {
    /// Writes all contacts with an impulse.
    pub(super) fn report(&self, contacts: &mut Contacts) {
        contacts.clear();
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        contacts.ball.extend(self.narrow_phase.contact_pairs_with(ball).filter_map(|pair| {
            let (normal, impulse) = impulse_of(pair)?;
            let (other, sign) =
                if pair.collider1 == ball { (pair.collider2, -1.0) } else { (pair.collider1, 1.0) };
            let with = partner(self.colliders[other].user_data)?;
            let anchor = pair.manifolds().iter().find_map(|manifold| {
                let contact = manifold.data.solver_contacts.first()?;
                Some(if sign > 0.0 { contact.anchor1 } else { contact.anchor2 })
            });
            let arm = match with {
                // In the frame of the robot since the hook set it.
                Partner::Robot(_) => self.colliders[other].position().rotation * anchor?,
                Partner::Wall(_) => Vector::ZERO,
            };
            Some(BallContact { with, normal: normal * sign, impulse, arm })
        }));
        contacts.robots.extend(self.narrow_phase.contact_pairs().filter_map(|pair| {
            let labels = [pair.collider1, pair.collider2].map(|of| self.colliders[of].user_data);
            let (robot, with, sign) = match labels.map(partner) {
                [Some(Partner::Robot(robot)), Some(with)] => (robot, with, 1.0),
                [Some(with), Some(Partner::Robot(robot))] => (robot, with, -1.0),
                _ => return None,
            };
            let (normal, _) = impulse_of(pair)?;
            let point = self.mean_point(pair)?;
            Some(RobotContact { robot, with, normal: normal * sign, point })
        }));
    }

    /// Mean of a pair's contact points, weighted by impulse, m.
    fn mean_point(&self, pair: &ContactPair) -> Option<Vector> {
        let pose = self.colliders[pair.collider1].position();
        let (sum, weight) = solved_points(pair).fold((Vector::ZERO, 0.0), |(sum, all), point| {
            (
                sum + pose.transform_point(point.local_p1) * point.data.impulse,
                all + point.data.impulse,
            )
        });
        (weight > 0.0).then(|| sum / weight)
    }
}

/// Normal (from the first to the second) and impulse of a pair; `None` without an impulse.
fn impulse_of(pair: &ContactPair) -> Option<(Vector, f32)> {
    let manifolds = pair.manifolds().iter();
    manifolds
        .map(|manifold| {
            let impulse = points_of(manifold).map(|point| point.data.impulse).sum();
            (manifold.data.normal, impulse)
        })
        .find(|(_, impulse): &(Vector, f32)| *impulse > 0.0)
}

/// Contact points of a pair that were solved in this tick: others keep old impulses.
fn solved_points(pair: &ContactPair) -> impl Iterator<Item = &TrackedContact<ContactData>> {
    pair.manifolds().iter().flat_map(points_of)
}

fn points_of(manifold: &ContactManifold) -> impl Iterator<Item = &TrackedContact<ContactData>> {
    manifold.data.solver_contacts.iter().map(|contact| {
        let point = (contact.contact_id[0] & !NEW_CONTACT_BIT) as usize;
        &manifold.points[point]
    })
}

pub(super) const BALL_LABEL: u128 = 0;
/// Labels below are robots, labels from here on are walls.
const FIRST_WALL: u128 = 1000;

/// User data of a collider.
pub(super) fn label(partner: Partner) -> u128 {
    match partner {
        Partner::Robot(index) => 1 + index as u128,
        Partner::Wall(index) => FIRST_WALL + index as u128,
    }
}

/// The robot or wall of a collider's user data; `None` for the ball.
pub(super) fn partner(label: u128) -> Option<Partner> {
    let index = usize::try_from(label).expect("labels are small");
    let first_wall = usize::try_from(FIRST_WALL).expect("small");
    match index {
        0 => None,
        robot if robot < first_wall => Some(Partner::Robot(robot - 1)),
        wall => Some(Partner::Wall(wall - first_wall)),
    }
}

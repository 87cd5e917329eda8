//! Contacts with an impulse in the last tick.

use rapier2d::geometry::NEW_CONTACT_BIT;
use rapier2d::parry::query::TrackedContact;
use rapier2d::prelude::{ContactData, ContactManifold, ContactPair};

use super::{BALL, Engine};
use crate::math::Vector;

/// The other party of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Partner {
    Wall(usize),
    Robot(usize),
}

/// A contact of the ball with an impulse in the last tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BallContact {
    pub(crate) with: Partner,
    /// Unit vector from the partner to the ball.
    pub(crate) normal: Vector,
    /// Impulse along the normal, N s.
    pub(crate) impulse: f32,
}

/// A contact of a robot with a wall or another robot, with an impulse in the last tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RobotContact {
    pub(crate) robot: usize,
    pub(crate) with: Partner,
    /// Unit vector from the robot to its partner.
    pub(crate) normal: Vector,
    /// Mean point of the contact, m.
    pub(crate) point: Vector,
}

impl Engine {
    /// Contacts of the ball with an impulse in the last tick.
    pub(crate) fn ball_contacts(&self) -> impl Iterator<Item = BallContact> {
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.narrow_phase.contact_pairs_with(ball).filter_map(move |pair| {
            let (normal, impulse) = impulse_of(pair)?;
            let (other, sign) =
                if pair.collider1 == ball { (pair.collider2, -1.0) } else { (pair.collider1, 1.0) };
            let with = partner(self.colliders[other].user_data)?;
            Some(BallContact { with, normal: normal * sign, impulse })
        })
    }

    /// Writes the contacts of robots with an impulse in the last tick into `contacts`.
    pub(crate) fn list_robot_contacts(&self, contacts: &mut Vec<RobotContact>) {
        contacts.clear();
        if self.is_contact_free {
            return;
        }
        contacts.extend(self.narrow_phase.contact_pairs().filter_map(|pair| {
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

    /// Number of pairs of bodies, or of a body and a wall, with an impulse in the last tick.
    pub(crate) fn contacts(&self) -> usize {
        self.narrow_phase.contact_pairs().filter(|pair| impulse_of(pair).is_some()).count()
    }
}

/// Normal (from the first to the second) and impulse of a pair; `None` without an impulse.
pub(super) fn impulse_of(pair: &ContactPair) -> Option<(Vector, f32)> {
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

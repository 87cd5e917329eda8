//! Which bodies pressed on which in the last tick.

use rapier2d::geometry::NEW_CONTACT_BIT;
use rapier2d::math::Vector;
use rapier2d::parry::query::TrackedContact;
use rapier2d::prelude::*;

use super::{BALL, Engine};

/// What a body is in contact with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Partner {
    Wall(usize),
    Robot(usize),
}

/// A contact of the ball in which the last tick pressed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    pub(crate) with: Partner,
    /// From the partner outward, a unit vector.
    pub(crate) normal: Vector,
    /// N s, along the normal.
    pub(crate) pressing: f32,
}

/// A contact of a robot with a wall or another robot in which the last tick pressed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Press {
    pub(crate) robot: usize,
    pub(crate) with: Partner,
    /// From the robot to its partner, a unit vector.
    pub(crate) normal: Vector,
    /// Where they press, in the mean, m.
    pub(crate) point: Vector,
}

impl Engine {
    /// What pressed on the ball in the last tick.
    pub(crate) fn ball_contacts(&self) -> impl Iterator<Item = Contact> {
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.narrow_phase.contact_pairs_with(ball).filter_map(move |pair| {
            let (normal, pressing) = pressed(pair)?;
            let (other, sign) =
                if pair.collider1 == ball { (pair.collider2, -1.0) } else { (pair.collider1, 1.0) };
            let with = partner(self.colliders[other].user_data)?;
            Some(Contact { with, normal: normal * sign, pressing })
        })
    }

    /// Contacts of robots that pressed in the last tick, into `presses`.
    pub(crate) fn list_presses(&self, presses: &mut Vec<Press>) {
        presses.clear();
        if self.clear {
            return;
        }
        presses.extend(self.narrow_phase.contact_pairs().filter_map(|pair| {
            let labels = [pair.collider1, pair.collider2].map(|of| self.colliders[of].user_data);
            let (robot, with, sign) = match labels.map(partner) {
                [Some(Partner::Robot(robot)), Some(with)] => (robot, with, 1.0),
                [Some(with), Some(Partner::Robot(robot))] => (robot, with, -1.0),
                _ => return None,
            };
            let (normal, _) = pressed(pair)?;
            Some(Press { robot, with, normal: normal * sign, point: self.middle(pair)? })
        }));
    }

    /// Where a pair presses, in the mean of its points weighted by impulse, m.
    fn middle(&self, pair: &ContactPair) -> Option<Vector> {
        let pose = self.colliders[pair.collider1].position();
        let (sum, weight) = solved_points(pair).fold((Vector::ZERO, 0.0), |(sum, all), point| {
            (
                sum + pose.transform_point(point.local_p1) * point.data.impulse,
                all + point.data.impulse,
            )
        });
        (weight > 0.0).then(|| sum / weight)
    }

    /// Pairs of bodies, or of a body and a wall, that pressed on each other in the last tick.
    pub(crate) fn contacts(&self) -> usize {
        self.narrow_phase.contact_pairs().filter(|pair| pressed(pair).is_some()).count()
    }
}

/// Normal (from the first to the second) and impulse of a pair that pressed.
pub(super) fn pressed(pair: &ContactPair) -> Option<(Vector, f32)> {
    let manifolds = pair.manifolds().iter();
    manifolds
        .map(|manifold| {
            let pressing = points_of(manifold).map(|point| point.data.impulse).sum();
            (manifold.data.normal, pressing)
        })
        .find(|(_, pressing): &(Vector, f32)| *pressing > 0.0)
}

/// Points of a pair that were solved in this tick: others keep old impulses.
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
/// Labels of robots are below, of walls from here on.
const FIRST_WALL: u128 = 1000;

pub(super) fn label(partner: Partner) -> u128 {
    match partner {
        Partner::Robot(index) => 1 + index as u128,
        Partner::Wall(index) => FIRST_WALL + index as u128,
    }
}

/// What a collider's label says it is; `None` for the ball.
pub(super) fn partner(label: u128) -> Option<Partner> {
    let index = usize::try_from(label).expect("labels are small");
    let first_wall = usize::try_from(FIRST_WALL).expect("small");
    match index {
        0 => None,
        robot if robot < first_wall => Some(Partner::Robot(robot - 1)),
        wall => Some(Partner::Wall(wall - first_wall)),
    }
}

//! Pairs that can meet in a tick, prepared for its sub-steps.

use super::SubStep;
use super::body::SolverBody;
use super::boxes::boxes;
use super::constraint::Constraint;
use super::discs::{Disc, discs, meet_ball, outline_and_disc};
use super::impulses::Impulses;
use super::manifold::{Manifold, Window};
use super::rectangle::Rectangle;
use crate::blocks::BALL;
use crate::engine::ball_contact::BallRules;
use crate::engine::contacts::Partner;
use crate::engine::joints::Ball;
use crate::engine::near::{Other, Pair};
use crate::geometry::outline::Outline;
use crate::math::Vector;

/// Speed against each other, m/s, below which the contact points of two bodies that press on each other
/// are found once a tick: they move by less than 1 mm in it.
const STEADY: f32 = 0.2;

/// A pair of bodies, or of a body and a wall; the ball always is the second.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// Identifies the pair from tick to tick.
    pub(super) key: u32,
    pub(super) first: usize,
    pub(super) second: usize,
    /// The robot or wall that the second meets.
    pub(super) with: Partner,
    outlines: [Outline; 2],
    /// Distances of the outlines' farthest points, m.
    radii: [f32; 2],
    friction: f32,
    /// Whether it had a constraint in the last sub-step of this tick.
    pub(super) is_constrained: bool,
    /// Of the last sub-step.
    pub(super) impulses: Impulses,
    /// Sum over the sub-steps of a tick.
    pub(super) total: Total,
}

/// Sum of a pair's impulses over the sub-steps of a tick.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Total {
    /// Normals weighted by impulse, N s.
    pub(super) normal: Vector,
    /// From both bodies' centers to the points, weighted by impulse, N s m.
    pub(super) arms: [Vector; 2],
    /// N s.
    pub(super) impulse: f32,
}

impl Link {
    /// The link of a pair, or `None` if the ball flies over the other. The body of a wall goes to the
    /// end of `bodies`.
    pub(super) fn of(pair: &Pair, rules: &BallRules, bodies: &mut Vec<SolverBody>) -> Option<Self> {
        let one = pair.one;
        let (first, second, outlines, with) = match pair.other {
            Other::Wall(index, place) => {
                let outlines = [place.outline, one.outline];
                (bodies.len(), one.body, outlines, Partner::Wall(index))
            }
            Other::Body(other) => {
                // The first never is the ball.
                let (first, second) = if other.body == BALL { (one, other) } else { (other, one) };
                let outlines = [first.outline, second.outline];
                (first.body, second.body, outlines, Partner::Robot(first.body - 1))
            }
        };
        let is_ball = second == BALL;
        if is_ball && !rules.meets(with) {
            return None;
        }
        if let Other::Wall(_, place) = &pair.other {
            bodies.push(SolverBody::of_wall(place));
        }
        // Friction of the ball is resolved elsewhere.
        let friction = if is_ball { 0.0 } else { with.friction(second - 1, rules.parameters) };
        let radii = outlines.map(|outline| outline.bounding_radius());
        let (impulses, total) = (Impulses::default(), Total::default());
        let (key, is_constrained) = (key(pair), false);
        Some(Self {
            key,
            first,
            second,
            with,
            outlines,
            radii,
            friction,
            is_constrained,
            impulses,
            total,
        })
    }

    /// Whether the constraint of the last sub-step still holds: the two press on each other and hardly
    /// move against each other.
    pub(super) fn is_steady(&self, bodies: &[SolverBody]) -> bool {
        if self.second == BALL || !self.impulses.press() {
            return false;
        }
        let (a, b) = (&bodies[self.first], &bodies[self.second]);
        let rims =
            a.angular_velocity.abs() * self.radii[0] + b.angular_velocity.abs() * self.radii[1];
        rims < STEADY && (b.velocity - a.velocity).length_squared() < STEADY * STEADY
    }

    /// The constraint of the pair in a sub-step, if the two can touch in it.
    pub(super) fn constraint(
        &self,
        links: &[Self],
        bodies: &[SolverBody],
        step: &SubStep,
    ) -> Option<Constraint> {
        let pair = [self.first, self.second];
        let manifold = if self.second == BALL {
            self.meet_ball(links, bodies, step)
        } else {
            self.manifold(pair.map(|body| &bodies[body]), step.window)
        }?;
        Some(Constraint::new(pair, bodies, &manifold, self.friction, &self.impulses))
    }

    /// Contact with the ball; of `links`, those of other boxes with it may have a joint with this one.
    fn meet_ball(&self, links: &[Self], bodies: &[SolverBody], step: &SubStep) -> Option<Manifold> {
        let body = &bodies[BALL];
        let time = if step.squeezed { 0.0 } else { step.window.time };
        let ball = Ball { center: body.position, radius: self.radii[1], time };
        let met = |link: &Self| (&bodies[link.first], link.outlines[0]);
        let others = links.iter().filter(|other| {
            other.second == BALL
                && other.first != self.first
                && matches!(other.outlines[0], Outline::Box { .. })
        });
        meet_ball(met(self), body, ball, others.map(met))
    }

    fn manifold(&self, [a, b]: [&SolverBody; 2], window: Window) -> Option<Manifold> {
        match self.outlines {
            [Outline::Disc { .. }, Outline::Disc { .. }] => {
                let [a, b] = [(a, self.radii[0]), (b, self.radii[1])]
                    .map(|(body, radius)| Disc { body, radius });
                discs(a, b, window)
            }
            [Outline::Box { half: first }, Outline::Box { half: second }] => {
                let [a, b] = [(a, first, self.radii[0]), (b, second, self.radii[1])]
                    .map(|(body, half, radius)| Rectangle { body, half, radius });
                boxes(a, b, window)
            }
            [outline, Outline::Disc { radius }] => {
                outline_and_disc(a, outline, Disc { body: b, radius }, window)
            }
            [Outline::Disc { radius }, outline] => {
                let found = outline_and_disc(b, outline, Disc { body: a, radius }, window);
                found.map(Manifold::reversed)
            }
            // Robots meet robots and walls as discs or boxes.
            _ => None,
        }
    }

    /// Keeps the impulses of a solved constraint, and adds them to the totals.
    pub(super) fn keep(&mut self, constraint: &Constraint) {
        self.impulses = constraint.impulses();
        for point in constraint.points() {
            self.total.normal += constraint.normal * point.impulse;
            for (total, arm) in self.total.arms.iter_mut().zip(point.arms) {
                *total += arm * point.impulse;
            }
            self.total.impulse += point.impulse;
        }
    }
}

/// Identifies a pair from tick to tick.
fn key(pair: &Pair) -> u32 {
    let other = match pair.other {
        Other::Body(body) => body.body,
        Other::Wall(wall, _) => FIRST_WALL + wall,
    };
    #[allow(clippy::cast_possible_truncation)] // a match has few bodies and walls
    let key = (pair.one.body << 8 | other) as u32;
    key
}

/// Whether a body is one of the pair that a key identifies.
pub(super) fn is_of_body(key: u32, body: usize) -> bool {
    let [one, other] = [key >> 8, key & 0xff].map(|number| number as usize);
    one == body || other == body
}

/// Number of the first wall in a key; robots are below.
const FIRST_WALL: usize = 64;

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::engine::near::Solid;
    use crate::geometry::outline::PlacedOutline;
    use crate::math::Rotation;

    const OUTLINE: Outline = Outline::Disc { radius: 0.1 };

    fn pair(one: usize, other: Other) -> Pair {
        Pair { one: Solid { body: one, outline: OUTLINE }, other, margin: 0.0 }
    }

    #[test]
    fn every_pair_has_a_key_of_its_own_that_names_its_bodies() {
        let place =
            PlacedOutline { outline: OUTLINE, position: Vector::ZERO, heading: Rotation::IDENTITY };
        let mut keys = BTreeSet::new();
        let mut pairs = 0;
        for one in 0..23 {
            let bodies = (0..one).map(|body| Other::Body(Solid { body, outline: OUTLINE }));
            let walls = (0..20).map(|wall| Other::Wall(wall, place));
            for other in bodies.chain(walls) {
                let key = key(&pair(one, other));
                assert!(u16::try_from(key).is_ok(), "{key}");
                let named: Vec<_> = (0..23).filter(|body| is_of_body(key, *body)).collect();
                let expected = match other {
                    Other::Body(Solid { body, .. }) => vec![body, one],
                    Other::Wall(..) => vec![one],
                };
                assert_eq!(named, expected);
                keys.insert(key);
                pairs += 1;
            }
        }
        assert_eq!(keys.len(), pairs);
        assert!(!keys.contains(&0), "no key is that of an empty slot");
    }
}

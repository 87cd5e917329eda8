//! Pairs that can meet in a tick, prepared for its sub-steps.

use super::constraint::{Constraint, Impulse};
use super::discs::meet_ball;
use super::manifold::{Manifold, Moving};
use super::meet::meet;
use super::{SolverBody, SubStep};
use crate::engine::ball_contact::BallRules;
use crate::engine::contacts::Partner;
use crate::engine::near::{Other, Pair};
use crate::engine::{BALL, WALL_FRICTION};
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::{Rotation, Vector};

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
    /// Place of the first where it is a wall.
    wall: Option<PlacedOutline>,
    friction: f32,
    /// Impulses of the points of the last sub-step.
    pub(super) kept: [Kept; 2],
    /// Sum over the sub-steps of a tick.
    pub(super) total: Total,
}

/// Impulses of a point, kept for the next sub-step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Kept {
    pub(super) feature: u32,
    pub(super) impulse: Impulse,
}

/// Sum of a pair's impulses over the sub-steps of a tick.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Total {
    /// Normals weighted by impulse, N s.
    pub(super) normal: Vector,
    /// Points weighted by impulse, N s m.
    pub(super) point: Vector,
    /// N s.
    pub(super) impulse: f32,
}

impl Link {
    /// The link of a pair, or `None` if the ball flies over the other. `fixed` is the index of the
    /// body that stands for walls.
    pub(super) fn of(pair: &Pair, fixed: usize, rules: &BallRules) -> Option<Self> {
        let one = pair.one;
        let (other, outline, wall) = match pair.other {
            Other::Body(body) => (body.body, body.outline, None),
            Other::Wall(_, place) => (fixed, place.outline, Some(place)),
        };
        let (first, second, outlines) = if other == BALL {
            (one.body, other, [one.outline, outline])
        } else {
            (other, one.body, [outline, one.outline])
        };
        let with = match pair.other {
            Other::Wall(index, _) => Partner::Wall(index),
            Other::Body(_) => Partner::Robot(first - 1),
        };
        let is_ball = second == BALL;
        if is_ball && !rules.meets(with) {
            return None;
        }
        // Friction of the ball is resolved elsewhere.
        let of = |body: usize| {
            if body == fixed { WALL_FRICTION } else { rules.params.robots[body - 1].model.friction }
        };
        let friction = if is_ball { 0.0 } else { of(first).midpoint(of(second)) };
        let key = key(pair);
        let (kept, total) = (Default::default(), Total::default());
        Some(Self { key, first, second, with, outlines, wall, friction, kept, total })
    }

    /// The constraint of the pair in a sub-step, if the two can touch in it.
    pub(super) fn constraint(
        &self,
        index: usize,
        bodies: &[SolverBody],
        step: &SubStep,
    ) -> Option<Constraint> {
        let manifold = self.manifold(bodies, step)?;
        let start = |feature: u32| {
            let found = self.kept.iter().find(|kept| kept.feature == feature);
            found.map_or(Impulse::default(), |kept| kept.impulse)
        };
        let pair = [self.first, self.second];
        Some(Constraint::new(index, pair, bodies, &manifold, self.friction, step.softness, start))
    }

    fn manifold(&self, bodies: &[SolverBody], step: &SubStep) -> Option<Manifold> {
        let moving = |body: usize, outline: Outline| {
            let SolverBody { position, heading, velocity, spin, .. } = bodies[body];
            let heading = Rotation { re: heading.x, im: heading.y };
            Moving { place: PlacedOutline { outline, position, heading }, velocity, spin }
        };
        let second = moving(self.second, self.outlines[1]);
        let first = match self.wall {
            Some(place) => Moving { place, velocity: Vector::ZERO, spin: 0.0 },
            None => moving(self.first, self.outlines[0]),
        };
        if self.second == BALL {
            meet_ball(&first, &second, step.squeezed, step.time)
        } else {
            meet(&first, &second, step.time, step.reach)
        }
    }

    /// Forgets the impulses of the last sub-step.
    pub(super) fn forget(&mut self) {
        self.kept = Default::default();
    }

    /// Keeps the impulses of a solved constraint, and adds them to the totals.
    pub(super) fn keep(&mut self, constraint: &Constraint) {
        for (kept, point) in self.kept.iter_mut().zip(constraint.points()) {
            let impulse = point.impulse;
            *kept = Kept { feature: point.feature, impulse };
            self.total.normal += constraint.normal * impulse.normal;
            self.total.point += point.position * impulse.normal;
            self.total.impulse += impulse.normal;
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

/// Number of the first wall in a key; robots are below.
const FIRST_WALL: usize = 64;

//! The contact solver of this crate, made for a dozen bodies.
//!
//! Each sub-step is a small tick: contacts are found anew on the paths of that sub-step, solved by
//! sequential impulses with soft constraints, and relaxed so that the push out of an overlap does not
//! stay in the velocities. Impulses start from those of the last sub-step.
//!
//! Sources: E. Catto, "Solver2D" (2024), for soft contacts and relaxation; M. Macklin et al., "Small
//! Steps in Physics Simulation" (2019), for sub-steps in place of iterations.

mod manifold;

use serde::{Deserialize, Serialize};

use super::ball_contact::{Approached, BallRules, Touch};
use super::bodies::Bodies;
use super::contacts::{BallContact, Contacts, Partner, RobotContact};
use super::near::{Other, Pair, Solid};
use super::{BALL, WALL_FRICTION};
use crate::geometry::motion::{Motion, rotated};
use crate::math::Vector;
use manifold::{Manifold, Moving, meet};

/// Stiffness of contacts, Hz, and damping ratio: between bodies, and between a body and a wall.
const BODY_CONTACT: [f32; 2] = [200.0, 2.0];
const WALL_CONTACT: [f32; 2] = [400.0, 2.0];

/// Maximum speed at which overlapping bodies are pushed apart, m/s.
const MAX_PUSH_SPEED: f32 = 1.0;

/// Depth that is not corrected, m: contacts at rest stay in contact.
const ALLOWED_DEPTH: f32 = 2.5e-5;

/// Passes over all contacts in a sub-step, usually and while a ball is jammed.
const PASSES: usize = 1;
const PASSES_JAMMED: usize = 4;

/// State of the solver between ticks.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct CompactSolver {
    /// Impulses of the last sub-step, in the order of their keys.
    impulses: Vec<StoredImpulse>,
}

/// Impulses of a contact point, N s.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct StoredImpulse {
    key: u32,
    normal: f32,
    tangent: f32,
}

/// Working memory of the solver, one per thread; its contents are of no use between ticks.
#[derive(Default)]
pub(super) struct CompactScratch {
    constraints: Vec<Constraint>,
    totals: Vec<PairTotal>,
}

/// Sum of a pair's impulses over the sub-steps of a tick.
#[derive(Debug, Clone, Copy, Default)]
struct PairTotal {
    /// Normals weighted by impulse, N s.
    impulse: Vector,
    /// Points weighted by impulse, N s m.
    point: Vector,
    /// N s.
    weight: f32,
}

/// Response of a soft constraint.
#[derive(Debug, Clone, Copy)]
struct Softness {
    /// Speed of correction per depth, 1/s.
    bias_rate: f32,
    mass_scale: f32,
    impulse_scale: f32,
}

impl Softness {
    /// A damped spring in implicit integration with a step of `time`.
    fn of([hertz, damping]: [f32; 2], time: f32) -> Self {
        let omega = std::f32::consts::TAU * hertz.min(0.25 / time);
        let a = 2.0 * damping + time * omega;
        let b = time * omega * a;
        let c = 1.0 / (1.0 + b);
        Self { bias_rate: omega / a, mass_scale: b * c, impulse_scale: c }
    }
}

/// A contact point between two bodies, or of a body (`second`) with a wall.
#[derive(Debug, Clone, Copy)]
struct Constraint {
    key: u32,
    pair: usize,
    first: Option<usize>,
    second: usize,
    /// Unit vector from the first to the second.
    normal: Vector,
    /// From the centres to the point, m.
    arms: [Vector; 2],
    point: Vector,
    /// m.
    separation: f32,
    /// kg.
    normal_mass: f32,
    tangent_mass: f32,
    friction: f32,
    softness: Softness,
    /// N s.
    normal_impulse: f32,
    tangent_impulse: f32,
}

/// Velocities and inverse inertias that the solver works on.
struct Solution<'a> {
    bodies: &'a mut Bodies,
    ball_inverse_mass: f32,
}

impl Solution<'_> {
    fn inverse(&self, body: usize) -> (f32, f32) {
        let inverse = &self.bodies.inverses[body];
        if body == BALL { (self.ball_inverse_mass, 0.0) } else { (inverse.mass, inverse.inertia) }
    }

    fn velocity_at(&self, body: usize, arm: Vector) -> Vector {
        let motion = &self.bodies.motions[body];
        motion.velocity + arm.perp() * motion.spin
    }

    /// Velocity of the second body against the first at a contact.
    fn relative(&self, constraint: &Constraint) -> Vector {
        let [arm_first, arm_second] = constraint.arms;
        let first = constraint.first.map_or(Vector::ZERO, |body| self.velocity_at(body, arm_first));
        self.velocity_at(constraint.second, arm_second) - first
    }

    fn apply(&mut self, constraint: &Constraint, impulse: Vector) {
        let [arm_first, arm_second] = constraint.arms;
        if let Some(first) = constraint.first {
            self.push(first, -impulse, arm_first);
        }
        self.push(constraint.second, impulse, arm_second);
    }

    fn push(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let (mass, inertia) = self.inverse(body);
        let motion = &mut self.bodies.motions[body];
        motion.velocity += impulse * mass;
        motion.spin += arm.perp_dot(impulse) * inertia;
    }

    /// Mass that an impulse along `direction` meets at a contact, kg.
    fn effective_mass(&self, first: Option<usize>, second: usize, arms: [Vector; 2], direction: Vector) -> f32 {
        let part = |body: usize, arm: Vector| {
            let (mass, inertia) = self.inverse(body);
            let turn = arm.perp_dot(direction);
            mass + turn * turn * inertia
        };
        let inverse = first.map_or(0.0, |body| part(body, arms[0])) + part(second, arms[1]);
        1.0 / inverse
    }

    /// One pass over the constraints: normal impulses, then friction. `bias` pushes overlapping bodies
    /// apart; without it only velocities are corrected.
    fn solve(&mut self, constraints: &mut [Constraint], time: f32, bias: bool) {
        for constraint in constraints {
            let relative = self.relative(constraint);
            let speed = relative.dot(constraint.normal);
            let (mut push, mut mass_scale, mut impulse_scale) = (0.0, 1.0, 0.0);
            if constraint.separation > 0.0 {
                push = constraint.separation / time;
            } else if bias {
                let Softness { bias_rate, .. } = constraint.softness;
                let depth = (constraint.separation + ALLOWED_DEPTH).min(0.0);
                push = (bias_rate * depth).max(-MAX_PUSH_SPEED);
                mass_scale = constraint.softness.mass_scale;
                impulse_scale = constraint.softness.impulse_scale;
            }
            let wanted = -constraint.normal_mass * mass_scale * (speed + push)
                - impulse_scale * constraint.normal_impulse;
            let total = (constraint.normal_impulse + wanted).max(0.0);
            let change = total - constraint.normal_impulse;
            constraint.normal_impulse = total;
            self.apply(constraint, constraint.normal * change);
            if constraint.friction > 0.0 {
                let tangent = constraint.normal.perp();
                let slip = self.relative(constraint).dot(tangent);
                let limit = constraint.friction * constraint.normal_impulse;
                let total = constraint.tangent_impulse - constraint.tangent_mass * slip;
                let total = total.clamp(-limit, limit);
                let change = total - constraint.tangent_impulse;
                constraint.tangent_impulse = total;
                self.apply(constraint, tangent * change);
            }
        }
    }
}

impl CompactSolver {
    /// Advances all bodies by `rules.time`, in sub-steps.
    pub(super) fn solve(
        &mut self,
        bodies: &mut Bodies,
        near: &[Pair],
        scratch: &mut CompactScratch,
        rules: &BallRules,
        sub_steps: usize,
        contacts: &mut Contacts,
    ) {
        let time = rules.time / sub_steps as f32;
        let jammed = rules.squeezed.is_some_and(|squeezed| squeezed.jammed);
        let passes = if jammed { PASSES_JAMMED } else { PASSES };
        scratch.totals.clear();
        scratch.totals.resize(near.len(), PairTotal::default());
        let softness = [Softness::of(BODY_CONTACT, time), Softness::of(WALL_CONTACT, time)];
        let ball_inverse_mass = 1.0 / bodies.ball_mass;
        for _ in 0..sub_steps {
            accelerate(bodies, time);
            let mut solution = Solution { bodies, ball_inverse_mass };
            scratch.constraints.clear();
            for (index, pair) in near.iter().enumerate() {
                self.find(&solution, index, pair, rules, time, softness, &mut scratch.constraints);
            }
            for constraint in &scratch.constraints {
                let tangent = constraint.normal.perp() * constraint.tangent_impulse;
                let impulse = constraint.normal * constraint.normal_impulse + tangent;
                solution.apply(constraint, impulse);
            }
            for _ in 0..passes {
                solution.solve(&mut scratch.constraints, time, true);
            }
            for constraint in &mut scratch.constraints {
                constraint.separation += solution.relative(constraint).dot(constraint.normal) * time;
            }
            for motion in &mut solution.bodies.motions {
                motion.position += motion.velocity * time;
                motion.heading = rotated(motion.heading, motion.spin * time);
            }
            solution.solve(&mut scratch.constraints, time, false);
            self.store(&scratch.constraints, &mut scratch.totals);
        }
        report(near, &scratch.totals, contacts);
    }

    /// Adds the constraints of a pair.
    #[expect(clippy::too_many_arguments, reason = "one call, of the loop above")]
    fn find(
        &self,
        solution: &Solution,
        index: usize,
        pair: &Pair,
        rules: &BallRules,
        time: f32,
        softness: [Softness; 2],
        constraints: &mut Vec<Constraint>,
    ) {
        let motions = &solution.bodies.motions;
        let one = moving(&pair.one, motions);
        let (other, wall) = match &pair.other {
            Other::Body(body) => (moving(body, motions), None),
            Other::Wall(wall, place) => {
                (Moving { place: *place, velocity: Vector::ZERO, spin: 0.0 }, Some(*wall))
            }
        };
        let other_body = if let Other::Body(body) = &pair.other { Some(body.body) } else { None };
        // A ball stands last: the others push it.
        let ball_is_one = pair.one.body == BALL;
        let ball_is_other = other_body == Some(BALL);
        let (first, second, manifold) = if ball_is_one || ball_is_other {
            let (ball, met, partner) = if ball_is_one {
                (&one, &other, wall.map(Partner::Wall))
            } else {
                (&other, &one, pair.one.partner())
            };
            if !partner.is_some_and(|partner| rules.meets(partner)) {
                return;
            }
            let first = if ball_is_one { None } else { Some(pair.one.body) };
            (first, BALL, ball_contact(ball, met, rules, time))
        } else {
            (other_body, pair.one.body, meet(&other, &one, time))
        };
        let Some(manifold) = manifold else { return };
        let friction = self.friction(first, second, rules);
        let softness = softness[usize::from(first.is_none())];
        for point in manifold.points() {
            let arms = [first.unwrap_or(second), second]
                .map(|body| point.position - motions[body].position);
            let key = (index_key(pair) << 4) | point.feature;
            let normal_mass = solution.effective_mass(first, second, arms, manifold.normal);
            let tangent_mass = if friction > 0.0 {
                solution.effective_mass(first, second, arms, manifold.normal.perp())
            } else {
                0.0
            };
            let (normal_impulse, tangent_impulse) = self.stored(key);
            constraints.push(Constraint {
                key,
                pair: index,
                first,
                second,
                normal: manifold.normal,
                arms,
                point: point.position,
                separation: point.separation,
                normal_mass,
                tangent_mass,
                friction,
                softness,
                normal_impulse,
                tangent_impulse,
            });
        }
    }

    /// Coefficient of friction of a contact; that of the ball is resolved elsewhere.
    fn friction(&self, first: Option<usize>, second: usize, rules: &BallRules) -> f32 {
        if second == BALL {
            return 0.0;
        }
        let of = |body: usize| rules.params.robots[body - 1].model.friction;
        of(second).midpoint(first.map_or(WALL_FRICTION, of))
    }

    fn stored(&self, key: u32) -> (f32, f32) {
        let found = self.impulses.iter().find(|stored| stored.key == key);
        found.map_or((0.0, 0.0), |stored| (stored.normal, stored.tangent))
    }

    /// Keeps the impulses for the next sub-step, and adds them to the totals.
    fn store(&mut self, constraints: &[Constraint], totals: &mut [PairTotal]) {
        self.impulses.clear();
        for constraint in constraints.iter().filter(|found| found.normal_impulse > 0.0) {
            let weight = constraint.normal_impulse;
            self.impulses.push(StoredImpulse {
                key: constraint.key,
                normal: weight,
                tangent: constraint.tangent_impulse,
            });
            let total = &mut totals[constraint.pair];
            total.impulse += constraint.normal * weight;
            total.point += constraint.point * weight;
            total.weight += weight;
        }
    }
}

fn accelerate(bodies: &mut Bodies, time: f32) {
    let Bodies { motions, forces, inverses, .. } = bodies;
    for ((motion, force), inverse) in motions.iter_mut().zip(forces).zip(inverses) {
        motion.velocity += force.force * (inverse.mass * time);
        motion.spin += force.torque * (inverse.inertia * time);
    }
}

fn moving(solid: &Solid, motions: &[Motion]) -> Moving {
    let motion = &motions[solid.body];
    Moving { place: solid.placed(motions), velocity: motion.velocity, spin: motion.spin }
}

/// Contact of the ball with a robot or wall; the normal points to the ball.
fn ball_contact(ball: &Moving, met: &Moving, rules: &BallRules, time: f32) -> Option<Manifold> {
    let (center, radius) = (ball.place.position, rules.params.ball.radius);
    let touch = if rules.squeezed.is_some() {
        Touch::of(&met.place.nearest(center), center, radius)
    } else {
        let velocity = ball.velocity - met.velocity;
        Approached { place: met.place, velocity, spin: met.spin }.touch(center, radius, time)?
    };
    Some(Manifold::of_point(touch.normal, center - touch.normal * radius, touch.distance))
}

/// Identifies a pair from tick to tick.
fn index_key(pair: &Pair) -> u32 {
    let other = match pair.other {
        Other::Body(body) => body.body as u32,
        Other::Wall(wall, _) => 64 + wall as u32,
    };
    (pair.one.body as u32) << 8 | other
}

/// Writes the contacts with an impulse in the tick.
fn report(near: &[Pair], totals: &[PairTotal], contacts: &mut Contacts) {
    contacts.clear();
    for (pair, total) in near.iter().zip(totals).filter(|(_, total)| total.weight > 0.0) {
        let length = total.impulse.length();
        if length <= 0.0 {
            continue;
        }
        let normal = total.impulse / length;
        let wall = match pair.other {
            Other::Wall(wall, _) => Some(wall),
            Other::Body(_) => None,
        };
        match (pair.one.body, pair.other) {
            (BALL, Other::Wall(wall, _)) => {
                let with = Partner::Wall(wall);
                contacts.ball.push(BallContact { with, normal, impulse: total.weight });
            }
            (one, Other::Body(Solid { body: BALL, .. })) => {
                let with = Partner::Robot(one - 1);
                contacts.ball.push(BallContact { with, normal, impulse: total.weight });
            }
            (one, other) => {
                let with = match (wall, other) {
                    (None, Other::Body(body)) => Partner::Robot(body.body - 1),
                    _ => Partner::Wall(wall.unwrap_or(0)),
                };
                // The normal points from the other to this robot.
                let point = total.point / total.weight;
                contacts.robots.push(RobotContact { robot: one - 1, with, normal: -normal, point });
            }
        }
    }
}

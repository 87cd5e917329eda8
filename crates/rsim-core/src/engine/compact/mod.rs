//! The contact solver of this crate, made for a dozen bodies.
//!
//! Each sub-step is a small tick: contacts are found anew on the paths of that sub-step, solved by
//! sequential impulses with soft constraints, and relaxed, so that the push out of an overlap does not
//! stay in the velocities. Impulses start from those of the last sub-step.
//!
//! Sources: E. Catto, "Solver2D" (2024), for soft contacts and relaxation; M. Macklin et al., "Small
//! Steps in Physics Simulation" (2019), for sub-steps in place of iterations.

mod boxes;
mod constraint;
mod discs;
mod link;
mod manifold;
mod meet;
mod report;
mod warm_start;

use super::SubSteps;
use super::ball_contact::BallRules;
use super::bodies::Bodies;
use super::contacts::Contacts;
use super::near::Pair;
use crate::geometry::motion::rotated;
use crate::math::Vector;
use constraint::{Constraint, Softness};
use link::Link;
use report::report;
pub(super) use warm_start::CompactSolver;

/// Passes over all contacts in a sub-step, usually and while a ball is jammed.
const PASSES: usize = 1;
const PASSES_JAMMED: usize = 2;

/// Working memory of the solver, one per thread; its contents are of no use between ticks.
#[derive(Default)]
pub(super) struct CompactScratch {
    bodies: Vec<SolverBody>,
    links: Vec<Link>,
    constraints: Vec<Constraint>,
}

/// A body in the solver. After the last body stands one that never moves, for all walls.
#[derive(Debug, Clone, Copy)]
struct SolverBody {
    position: Vector,
    /// Cosine and sine of the heading.
    heading: Vector,
    velocity: Vector,
    spin: f32,
    /// 1/kg and 1/(kg m²).
    inverse_mass: f32,
    inverse_inertia: f32,
}

impl SolverBody {
    const FIXED: Self = Self {
        position: Vector::ZERO,
        heading: Vector::X,
        velocity: Vector::ZERO,
        spin: 0.0,
        inverse_mass: 0.0,
        inverse_inertia: 0.0,
    };
}

impl CompactSolver {
    /// Advances all bodies by `rules.time`, in sub-steps, and returns whether any two came near each
    /// other.
    pub(super) fn solve(
        &mut self,
        bodies: &mut Bodies,
        near: NearBodies,
        scratch: &mut CompactScratch,
        rules: &BallRules,
        SubSteps { time, count }: SubSteps,
        contacts: &mut Contacts,
    ) -> bool {
        scratch.read(bodies);
        self.link(near.pairs, bodies.motions.len(), rules, time, &mut scratch.links);
        let jammed = rules.squeezed.is_some_and(|squeezed| squeezed.jammed);
        let passes = if jammed { PASSES_JAMMED } else { PASSES };
        let step = SubStep {
            time,
            reach: 2.0 * near.fastest * time,
            softness: Softness::new(time),
            squeezed: rules.squeezed.is_some(),
        };
        let mut meets = false;
        for _ in 0..count {
            scratch.accelerate(bodies, time);
            scratch.advance(&step, passes);
            meets |= !scratch.constraints.is_empty();
        }
        scratch.write(bodies);
        self.store(&scratch.links, bodies.ball_mass, time);
        report(&scratch.links, contacts);
        meets
    }
}

/// Bodies that can meet in a tick.
#[derive(Clone, Copy)]
pub(super) struct NearBodies<'a> {
    pub(super) pairs: &'a [Pair],
    /// Speed that a push can give a robot at rest, m/s.
    pub(super) fastest: f32,
}

/// Settings of one sub-step.
struct SubStep {
    /// s.
    time: f32,
    /// Gap up to which bodies have a contact though their paths do not meet, m: others may push them
    /// together within the sub-step.
    reach: f32,
    softness: Softness,
    /// Whether the ball is squeezed.
    squeezed: bool,
}

impl CompactScratch {
    fn read(&mut self, bodies: &Bodies) {
        self.bodies.clear();
        self.bodies.extend(bodies.motions.iter().zip(&bodies.inverses).map(|(motion, inverse)| {
            SolverBody {
                position: motion.position,
                heading: motion.heading,
                velocity: motion.velocity,
                spin: motion.spin,
                inverse_mass: inverse.mass,
                inverse_inertia: inverse.inertia,
            }
        }));
        self.bodies[super::BALL].inverse_mass = 1.0 / bodies.ball_mass;
        self.bodies.push(SolverBody::FIXED);
    }

    fn write(&self, bodies: &mut Bodies) {
        for (motion, body) in bodies.motions.iter_mut().zip(&self.bodies) {
            (motion.position, motion.heading) = (body.position, body.heading);
            (motion.velocity, motion.spin) = (body.velocity, body.spin);
        }
    }

    fn accelerate(&mut self, bodies: &Bodies, time: f32) {
        let all = self.bodies.iter_mut().zip(&bodies.forces).zip(&bodies.inverses);
        for ((body, force), inverse) in all {
            body.velocity += force.force * inverse.mass * time;
            body.spin += force.torque * inverse.inertia * time;
        }
    }

    /// Advances all bodies by a sub-step, with velocities that include its accelerations.
    fn advance(&mut self, step: &SubStep, passes: usize) {
        let Self { bodies, links, constraints } = self;
        let inverse_time = 1.0 / step.time;
        constraints.clear();
        for (index, link) in links.iter().enumerate() {
            constraints.extend(link.constraint(index, bodies, step));
        }
        for constraint in constraints.iter() {
            constraint.warm_start(bodies);
        }
        for _ in 0..passes {
            for constraint in constraints.iter_mut() {
                constraint.solve(bodies, inverse_time, true);
            }
        }
        for constraint in constraints.iter_mut() {
            constraint.close(bodies, step.time);
        }
        for body in bodies.iter_mut() {
            body.position += body.velocity * step.time;
            body.heading = rotated(body.heading, body.spin * step.time);
        }
        for constraint in constraints.iter_mut() {
            constraint.solve(bodies, inverse_time, false);
        }
        links.iter_mut().for_each(Link::forget);
        for constraint in constraints.iter() {
            links[constraint.link].keep(constraint);
        }
    }
}

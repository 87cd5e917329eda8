//! The contact solver of this crate, made for a dozen bodies.
//!
//! Each sub-step is a small tick: contacts are found anew on the paths of that sub-step, solved by
//! sequential impulses with soft constraints, and relaxed, so that the push out of an overlap does not
//! stay in the velocities. Impulses start from those of the last sub-step. Where robots that can meet move slowly,
//! two sub-steps are solved as one.
//!
//! The result has the same bits on every platform: the solver adds, multiplies, divides, takes square
//! roots and compares, always in the order of the bodies.
//!
//! Sources: E. Catto, "Solver 2D" (2024), for soft contacts and relaxation; M. Macklin et al., "Small
//! Steps in Physics Simulation" (2019), for sub-steps in place of iterations.

mod body;
mod boxes;
mod constraint;
mod discs;
mod impulses;
mod link;
mod manifold;
mod pass;
mod rectangle;
mod report;
mod sliding;
mod sub_step;
mod two_points;
mod warm_start;

use super::ball_contact::BallRules;
use super::contacts::Contacts;
use super::near::Pair;
use crate::blocks::{BALL, set_bits};
use crate::bodies::{Acceleration, Bodies, SubSteps, WarmStart};
use crate::body_parameters::BodyParameters;
pub(super) use body::SolverBody;
pub(super) use boxes::boxes;
use constraint::Constraint;
use impulses::Impulses;
use link::Link;
pub(super) use manifold::{Manifold, Window};
pub(super) use rectangle::Rectangle;
use report::report;
use sub_step::SubStep;
pub(super) use warm_start::CompactSolver;

/// Minimum number of passes over all contacts in a sub-step, usually and while a ball is jammed: with
/// one, a robot that presses a ball against a wall is thrown back at .28 of its speed, with two at
/// less than .25.
const MIN_PASSES: usize = 1;
const MIN_PASSES_JAMMED: usize = 2;

/// Maximum number of passes.
const MAX_PASSES: usize = 8;

/// Change of speed in a pass, m/s, below which it is the last: an impact takes several passes to reach
/// the end of a row of robots, and pushing robots need one.
const SETTLED: f32 = 0.1;

/// Working memory of the solver, one per thread; its contents are of no use between ticks.
#[derive(Default)]
pub(super) struct CompactScratch {
    /// All bodies by index, then walls. Only those that can meet others are in use.
    bodies: Vec<SolverBody>,
    met: Vec<Met>,
    warm_starts: Vec<WarmStart>,
    links: Vec<Link>,
    /// A place for the constraint of each link.
    constraints: Vec<Constraint>,
    /// Links that have a constraint in the sub-step.
    constrained: Vec<usize>,
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
        sub_steps: SubSteps,
        contacts: &mut Contacts,
    ) -> bool {
        scratch.read(bodies, rules.parameters, near.pairs);
        let step = SubStep::of(sub_steps, &scratch.bodies, near, rules.squeezed.is_some());
        self.link(bodies, near.pairs, rules, step.time(), scratch);
        let jammed = rules.squeezed.is_some_and(|squeezed| squeezed.jammed);
        let min_passes = if jammed { MIN_PASSES_JAMMED } else { MIN_PASSES };
        if scratch.constraints.len() < scratch.links.len() {
            scratch.constraints.resize(scratch.links.len(), Constraint::default());
        }
        let mut meets = false;
        for _ in 0..step.count {
            scratch.advance(&step, min_passes);
            meets |= !scratch.constrained.is_empty();
        }
        bodies.move_freely(sub_steps);
        scratch.write(bodies);
        self.store(bodies, &scratch.links, step.time());
        report(&scratch.links, &scratch.bodies, contacts);
        meets
    }
}

/// A body that can meet others in the tick.
#[derive(Debug, Clone, Copy)]
struct Met {
    body: usize,
    acceleration: Acceleration,
}

/// Bodies that can meet in a tick.
#[derive(Clone, Copy)]
pub(super) struct NearBodies<'a> {
    pub(super) pairs: &'a [Pair],
    /// Speed that a push can give a robot at rest, m/s.
    pub(super) fastest: f32,
}

impl CompactScratch {
    /// Reads the bodies of `pairs`.
    fn read(&mut self, bodies: &Bodies, parameters: &BodyParameters, pairs: &[Pair]) {
        let met = pairs.iter().fold(0_u64, |met, pair| met | pair.bodies());
        self.bodies.clear();
        self.bodies.resize(bodies.len(), SolverBody::default());
        self.met.clear();
        for body in set_bits(met) {
            self.bodies[body] = SolverBody::of(&bodies.motion(body), parameters.inverse(body));
            self.met.push(Met { body, acceleration: bodies.acceleration(body) });
        }
        self.bodies[BALL].inverse_mass = 1.0 / bodies.ball_mass;
    }

    fn write(&self, bodies: &mut Bodies) {
        for Met { body, .. } in &self.met {
            bodies.set_motion(*body, &self.bodies[*body].motion());
        }
    }

    /// Advances the bodies that can meet others by a sub-step.
    fn advance(&mut self, step: &SubStep, min_passes: usize) {
        let Self { bodies, met, links, constraints, constrained, .. } = self;
        let time = step.time();
        for Met { body, acceleration } in met.iter() {
            bodies[*body].accelerate(*acceleration, time, step.lag);
        }
        constrained.clear();
        for index in 0..links.len() {
            let link = &links[index];
            let is_steady = link.is_constrained && link.is_steady(bodies);
            let found = if is_steady { None } else { link.constraint(links, bodies, step) };
            let is_constrained = is_steady || found.is_some();
            if let Some(found) = found {
                constraints[index] = found;
            }
            if is_constrained {
                constrained.push(index);
            }
            links[index].is_constrained = is_constrained;
        }
        for index in constrained.iter() {
            constraints[*index].note_reach(bodies);
            constraints[*index].warm_start(bodies);
        }
        for pass in 1..=MAX_PASSES {
            let mut change = 0.0_f32;
            for index in constrained.iter() {
                let constraint = &mut constraints[*index];
                let is_ball = constraint.second == BALL;
                let push = if is_ball { &step.pushing_ball } else { &step.pushing };
                change = change.max(constraint.solve(bodies, push));
            }
            if pass >= min_passes && change < SETTLED {
                break;
            }
        }
        for index in constrained.iter() {
            constraints[*index].close(bodies, time);
        }
        for Met { body, acceleration } in met.iter() {
            bodies[*body].advance(*acceleration, time);
        }
        for index in constrained.iter() {
            constraints[*index].solve(bodies, &step.relaxing);
        }
        for link in links.iter_mut() {
            link.impulses = Impulses::default();
        }
        for index in constrained.iter() {
            links[*index].keep(&constraints[*index]);
        }
    }
}

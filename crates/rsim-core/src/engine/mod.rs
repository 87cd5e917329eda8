//! Contact engine of one match: moves all bodies by a tick and keeps them out of each other.
//!
//! This file is the interface. The pairs that can meet ([`near`]), ticks without contacts and the rules
//! for contacts of the ball ([`ball_contact`]) are common to both solvers. A solver takes the bodies,
//! advances them by a tick in sub-steps without bounce, and reports the contacts that had an impulse;
//! bounces follow from the report.

mod ball_contact;
mod compact;
mod contact_free;
mod contacts;
mod joints;
mod near;
mod rapier;
mod shapes;

use serde::{Deserialize, Serialize};

use crate::bodies::{Bodies, FastestRobot, SubSteps, Undisturbed};
use crate::body_parameters::BodyParameters;
use crate::geometry::arena::Wall;
use crate::geometry::free_space::FreeSpace;
use crate::models::config::{EngineKind, SimConfig};
use compact::{CompactScratch, CompactSolver, NearBodies};
use contact_free::{ContactFreeBuffers, try_contact_free};
use near::{NearPairs, Search};
use rapier::{RapierScratch, RapierSolver};

pub(crate) use ball_contact::{BallPhase, BallRules, SqueezedBall};
pub(crate) use contacts::{BallContact, Contacts, Partner, RobotContact};
pub(crate) use shapes::Shape;

/// Sub-steps of the solver in a tick, of which the compact solver merges some.
/// `cargo bench -p rsim-bench --bench solver` compares numbers.
const SUB_STEPS: usize = 4;

/// Friction of a wall against robots, averaged with the robot's own: that of robot against robot. No
/// value is published for a robot that slides along a wall.
const WALL_FRICTION: f32 = 0.2;

/// Solver of one match, and its settings.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Engine {
    solver: Solver,
    /// Number of contacts in the last tick, or in the last part of it.
    contacts: usize,
    sub_steps: usize,
    /// Length of a tick, s.
    tick: f32,
    /// Whether ticks without contacts go without the solver.
    contact_free_enabled: bool,
    /// Number of ticks without contacts.
    contact_free_ticks: u32,
    /// Whether the solver's last tick had no impulses.
    is_contact_free: bool,
}

#[derive(Clone, Serialize, Deserialize)]
enum Solver {
    Rapier(Box<RapierSolver>),
    Compact(CompactSolver),
}

/// Working memory of the engine, one per thread; its contents are of no use between steps.
pub(crate) struct Scratch {
    rapier: RapierScratch,
    compact: CompactScratch,
    near: NearPairs,
    contact_free: ContactFreeBuffers,
    /// Contacts of the last tick, or of the last part of it.
    pub(crate) contacts: Contacts,
    /// Motion that robots would have after that part without contacts, if the solver ran in it.
    pub(crate) undisturbed: Vec<Undisturbed>,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            rapier: RapierScratch::new(),
            compact: CompactScratch::default(),
            near: NearPairs::default(),
            contact_free: ContactFreeBuffers::default(),
            contacts: Contacts::default(),
            undisturbed: Vec::new(),
        }
    }
}

/// Error of a state that is no longer finite.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    pub(crate) fn new(config: &SimConfig, parameters: &BodyParameters, walls: &[Wall]) -> Self {
        Self {
            solver: match config.engine {
                EngineKind::Rapier => {
                    Solver::Rapier(Box::new(RapierSolver::new(config, parameters, walls)))
                }
                EngineKind::Compact => Solver::Compact(CompactSolver::default()),
            },
            contacts: 0,
            sub_steps: SUB_STEPS,
            tick: config.tick,
            contact_free_enabled: true,
            contact_free_ticks: 0,
            is_contact_free: false,
        }
    }

    /// Gives the solver other parameters of the bodies.
    pub(crate) fn set_parameters(&mut self, parameters: &BodyParameters) {
        if let Solver::Rapier(solver) = &mut self.solver {
            solver.set_parameters(parameters);
        }
    }

    /// Marks a body as placed: its pose does not follow from its motion in the last tick.
    pub(crate) fn note_placed(&mut self, body: usize) {
        if let Solver::Rapier(solver) = &mut self.solver {
            solver.note_moved(1 << body);
        }
    }

    /// Forgets the impulses between a body and others, which the next tick would start from.
    pub(crate) fn forget_impulses(&self, bodies: &mut Bodies, body: usize) {
        if let Solver::Compact(solver) = &self.solver {
            solver.forget_body(bodies, body);
        }
    }

    /// Advances all bodies by a tick, or by the part of it that `rules` names, and writes its contacts
    /// into `scratch`. `fastest` is that of the robots of `bodies`.
    pub(crate) fn step(
        &mut self,
        bodies: &mut Bodies,
        scratch: &mut Scratch,
        rules: &BallRules,
        free_space: &FreeSpace,
        fastest: FastestRobot,
    ) -> Result<(), NonFinite> {
        let may_be_free = self.contact_free_enabled
            && self.is_contact_free
            && rules.squeezed.is_none()
            && !bodies.ball_was_jammed(rules.parameters);
        bodies.ball_mass =
            rules.squeezed.map_or(rules.parameters.ball.mass, |squeezed| squeezed.mass);
        let sub_steps = self.sub_steps(rules.time);
        let Scratch { rapier, compact, near, contact_free, contacts, undisturbed } = scratch;
        let is_free = match &mut self.solver {
            Solver::Rapier(solver) => {
                let is_free = may_be_free && {
                    near.find(bodies, rules, free_space, &Search::before_rapier(rules, sub_steps));
                    try_contact_free(bodies, near, contact_free, sub_steps)
                };
                if is_free {
                    solver.note_moved(bodies.all());
                } else {
                    bodies.list_undisturbed(rules.time, undisturbed);
                    solver.solve(bodies, rapier, rules, sub_steps.count, contacts)?;
                }
                is_free
            }
            Solver::Compact(solver) => {
                let search = Search::before_compact(fastest, rules);
                near.find(bodies, rules, free_space, &search);
                if near.pairs.is_empty() && self.contact_free_enabled {
                    bodies.move_freely(sub_steps);
                    solver.forget();
                    true
                } else {
                    bodies.list_undisturbed(rules.time, undisturbed);
                    let near =
                        NearBodies { pairs: &near.pairs, fastest: search.speed.unwrap_or(0.0) };
                    !solver.solve(bodies, near, compact, rules, sub_steps, contacts)
                }
            }
        };
        if is_free {
            self.contact_free_ticks = self.contact_free_ticks.wrapping_add(1);
            contacts.clear();
        }
        self.contacts = contacts.len();
        self.is_contact_free = self.contacts == 0;
        Ok(())
    }

    /// Sub-steps of a tick, or of a part of it of length `time` (s). The compact solver finds contacts
    /// anew in each sub-step, so that a part of a tick needs no shorter ones.
    fn sub_steps(&self, time: f32) -> SubSteps {
        if time >= self.tick {
            return SubSteps { time: time / self.sub_steps as f32, count: self.sub_steps };
        }
        let parts = (self.tick / time).round();
        let count = match self.solver {
            Solver::Rapier(_) => self.sub_steps as f32,
            Solver::Compact(_) => (self.sub_steps as f32 / parts).ceil(),
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small number
        SubSteps { time: time / count, count: count as usize }
    }

    /// Number of pairs of bodies, or of a body and a wall, with an impulse in the last tick.
    pub(crate) fn contacts(&self) -> usize {
        self.contacts
    }

    /// Sets whether ticks without contacts go without the solver.
    pub(crate) fn enable_contact_free_ticks(&mut self, enabled: bool) {
        self.contact_free_enabled = enabled;
    }

    /// Sets the number of sub-steps of a tick.
    pub(crate) fn set_sub_steps(&mut self, sub_steps: usize) {
        self.sub_steps = sub_steps;
    }

    /// Number of ticks without contacts since the match began.
    pub(crate) fn contact_free_ticks(&self) -> u32 {
        self.contact_free_ticks
    }

    /// Number of impulses that the compact solver starts the next tick from.
    #[cfg(test)]
    pub(crate) fn warm_starts(&self) -> usize {
        if let Solver::Compact(solver) = &self.solver { solver.stored } else { 0 }
    }
}

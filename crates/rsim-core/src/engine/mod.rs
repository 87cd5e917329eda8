//! Contact engine of one match: moves all bodies by a tick and keeps them out of each other.
//!
//! This file is the interface. Bodies ([`bodies`]), the pairs that can meet ([`near`]), ticks without
//! contacts and the rules for contacts of the ball ([`ball_contact`]) are common to both solvers. A
//! solver takes the bodies, advances them by a tick in sub-steps without bounce, and reports the
//! contacts that had an impulse; bounces follow from the report.

mod ball_contact;
mod bodies;
mod compact;
mod contact_free;
mod contacts;
mod near;
mod rapier;
mod shapes;

use serde::{Deserialize, Serialize};

use crate::blocks::{BALL, set_bits};
use crate::body_params::BodyParams;
use crate::drive::BlockAcceleration;
use crate::geometry::arena::Wall;
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;
use crate::models::config::{EngineKind, SimConfig};
use bodies::Bodies;
use compact::{CompactScratch, CompactSolver, NearBodies};
use contact_free::{ContactFreeBuffers, try_contact_free};
use contacts::Contacts;
use near::{NearPairs, Search};
use rapier::{RapierScratch, RapierSolver};

pub(crate) use ball_contact::{BallPhase, BallRules, SqueezedBall};
pub(crate) use contacts::{BallContact, Partner, RobotContact};
pub(crate) use shapes::Shape;

/// Sub-steps of the solver in a tick. `cargo bench -p rsim-bench --bench solver` compares numbers.
const SUB_STEPS: usize = 4;

/// Friction of a wall against robots, averaged with the robot's own: that of robot against robot. No
/// value is published for a robot that slides along a wall.
const WALL_FRICTION: f32 = 0.2;

/// Bodies of one match and their solver.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Engine {
    bodies: Bodies,
    solver: Solver,
    /// Contacts of the last tick, or of the last part of it.
    contacts: Contacts,
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
    /// Contacts of robots in the last solved part of a tick.
    pub(crate) robot_contacts: Vec<RobotContact>,
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
            robot_contacts: Vec::new(),
            undisturbed: Vec::new(),
        }
    }
}

/// Motion of a robot without contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Undisturbed {
    /// m/s.
    pub(crate) velocity: Vector,
    /// rad/s.
    pub(crate) spin: f32,
}

/// Sub-steps of a tick.
#[derive(Debug, Clone, Copy)]
struct SubSteps {
    /// Length of each, s.
    time: f32,
    count: usize,
}

/// Error of a state that is no longer finite.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    pub(crate) fn new(config: &SimConfig, params: &BodyParams, walls: &[Wall]) -> Self {
        Self {
            bodies: Bodies::new(params),
            solver: match config.engine {
                EngineKind::Rapier => {
                    Solver::Rapier(Box::new(RapierSolver::new(config, params, walls)))
                }
                EngineKind::Compact => Solver::Compact(CompactSolver::default()),
            },
            contacts: Contacts::default(),
            sub_steps: SUB_STEPS,
            tick: config.tick,
            contact_free_enabled: true,
            contact_free_ticks: 0,
            is_contact_free: false,
        }
    }

    /// Gives the bodies other parameters.
    pub(crate) fn set_params(&mut self, params: &BodyParams) {
        self.bodies.set_params(params);
        if let Solver::Rapier(solver) = &mut self.solver {
            solver.set_params(params);
        }
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        self.bodies.motions.get(body)
    }

    /// Motions of all bodies, by block.
    pub(crate) fn motion_blocks(&self) -> &[MotionBlock] {
        self.bodies.motions.blocks()
    }

    /// Sets the motion of a body. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        self.bodies.motions.set(body, motion);
        self.bodies.moved[body] = true;
    }

    /// Sets position (m) and velocity (m/s) of the ball.
    pub(crate) fn set_ball(&mut self, position: Vector, velocity: Vector) {
        let ball = Motion { position, velocity, ..self.bodies.motions.get(BALL) };
        self.bodies.motions.set(BALL, &ball);
        self.bodies.moved[BALL] = true;
    }

    /// Sets the velocity of a body, m/s.
    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        self.bodies.motions.set_velocity(body, velocity);
    }

    /// Applies an impulse (N s) to a body, at `arm` (m) from its centre of mass.
    pub(crate) fn apply_impulse(&mut self, body: usize, impulse: Vector, arm: Vector) {
        self.bodies.apply_impulse(body, impulse, arm);
    }

    /// Sets the accelerations of the bodies of a block during the next tick.
    pub(crate) fn set_acceleration(&mut self, block: usize, acceleration: BlockAcceleration) {
        self.bodies.accelerations[block] = acceleration;
    }

    /// Acceleration of a body during the next tick, m/s².
    pub(crate) fn acceleration(&self, body: usize) -> Vector {
        self.bodies.acceleration(body).linear
    }

    /// Bound of the speeds of robots within `time` (s) without contacts, m/s.
    pub(crate) fn fastest_robot(&self, time: f32) -> f32 {
        self.bodies.fastest_robot(time)
    }

    /// Indices of the robots whose surrounding circle is nearer than `gap` (m) to that of the ball.
    pub(crate) fn robots_near_ball(&self, gap: f32) -> impl Iterator<Item = usize> {
        set_bits(self.bodies.robots_near_ball(gap))
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(crate) fn ball_was_jammed(&self) -> bool {
        self.bodies.ball_was_jammed()
    }

    /// Advances all bodies by a tick, or by the part of it that `rules` names.
    pub(crate) fn step(
        &mut self,
        scratch: &mut Scratch,
        rules: &BallRules,
        free_space: &FreeSpace,
    ) -> Result<(), NonFinite> {
        let may_be_free = self.contact_free_enabled
            && self.is_contact_free
            && rules.squeezed.is_none()
            && !self.bodies.ball_was_jammed();
        self.bodies.ball_mass =
            rules.squeezed.map_or(rules.params.ball.mass, |squeezed| squeezed.mass);
        let sub_steps = self.sub_steps(rules.time);
        let Self { bodies, solver, contacts, .. } = self;
        let Scratch { rapier, compact, near, contact_free, undisturbed, .. } = scratch;
        let is_free = match solver {
            Solver::Rapier(solver) => {
                let is_free = may_be_free && {
                    near.find(bodies, rules, free_space, &Search::before_rapier(rules, sub_steps));
                    try_contact_free(bodies, near, contact_free, sub_steps)
                };
                if !is_free {
                    bodies.list_undisturbed(rules.time, undisturbed);
                    solver.solve(bodies, rapier, rules, sub_steps.count, contacts)?;
                }
                is_free
            }
            Solver::Compact(solver) => {
                let search = Search::before_compact(bodies, rules);
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
            self.contacts.clear();
        }
        self.is_contact_free = self.contacts.len() == 0;
        Ok(())
    }

    /// Sub-steps of a tick, or of a part of it of length `time` (s). The compact solver finds contacts
    /// anew in each sub-step, so that a part of a tick needs no shorter ones.
    fn sub_steps(&self, time: f32) -> SubSteps {
        let parts = (self.tick / time).round();
        let count = match self.solver {
            Solver::Rapier(_) => self.sub_steps as f32,
            Solver::Compact(_) => (self.sub_steps as f32 / parts).ceil(),
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small number
        SubSteps { time: time / count, count: count as usize }
    }

    /// Contacts of the ball with an impulse in the last tick.
    pub(crate) fn ball_contacts(&self) -> impl Iterator<Item = BallContact> {
        self.contacts.ball.iter().copied()
    }

    /// Writes the contacts of robots with an impulse in the last tick into `contacts`.
    pub(crate) fn list_robot_contacts(&self, contacts: &mut Vec<RobotContact>) {
        contacts.clone_from(&self.contacts.robots);
    }

    /// Number of pairs of bodies, or of a body and a wall, with an impulse in the last tick.
    pub(crate) fn contacts(&self) -> usize {
        self.contacts.len()
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
}

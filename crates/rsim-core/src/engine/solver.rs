//! Steps of the engine: without contacts by free motion, otherwise by the solver.

use rapier2d::dynamics::{CCDSolver, ImpulseJointSet, MultibodyJointSet};
use rapier2d::pipeline::PhysicsPipeline;
use rapier2d::prelude::SoftBodySet;

use super::build::{SOLVER_PASSES, SOLVER_PASSES_JAMMED};
use super::contact_free::ContactFreeBuffers;
use super::contacts::{RobotContact, impulse_of};
use super::{BALL, BallHooks, BallPhase, Engine, Undisturbed};
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion::Motion;
use crate::math::{Pose, Vector};

/// Working memory of the engine, one per thread; its contents are of no use between steps.
pub(crate) struct Scratch {
    pipeline: PhysicsPipeline,
    ccd: CCDSolver,
    contact_free: ContactFreeBuffers,
    /// Contacts of robots in the last solved part of a tick.
    pub(crate) robot_contacts: Vec<RobotContact>,
    /// Motion that robots would have after that part without contacts.
    pub(crate) undisturbed: Vec<Undisturbed>,
    // A match has no joints and no soft bodies; the pipeline takes them as arguments.
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            pipeline: PhysicsPipeline::new(),
            ccd: CCDSolver::new(),
            contact_free: ContactFreeBuffers::default(),
            robot_contacts: Vec::new(),
            undisturbed: Vec::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
        }
    }
}

/// Error of a state that is no longer finite.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    /// Advances all bodies by a tick, or by the part of it that `ball` names.
    pub(crate) fn step(
        &mut self,
        scratch: &mut Scratch,
        ball: &BallHooks,
        free_space: &FreeSpace,
    ) -> Result<(), NonFinite> {
        self.parameters.dt = ball.time;
        let may_be_contact_free = self.contact_free_enabled
            && self.is_contact_free
            && ball.squeezed.is_none()
            && !self.ball_was_jammed();
        if may_be_contact_free
            && self.try_contact_free(
                &mut scratch.contact_free,
                ball.params,
                ball.phase != BallPhase::Floor,
                free_space,
            )
        {
            self.contact_free_ticks = self.contact_free_ticks.wrapping_add(1);
            return Ok(());
        }
        self.set_ball_mass(ball);
        let jammed = ball.squeezed.is_some_and(|squeezed| squeezed.jammed);
        self.parameters.num_internal_pgs_iterations =
            if jammed { SOLVER_PASSES_JAMMED } else { SOLVER_PASSES };
        self.write_to_solver();
        let solved = self.solve(scratch, ball);
        self.parameters.warmstart_coefficient = 1.0;
        self.read_from_solver();
        solved
    }

    fn solve(&mut self, scratch: &mut Scratch, ball: &BallHooks) -> Result<(), NonFinite> {
        scratch.pipeline.step(
            Vector::ZERO,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut scratch.joints,
            &mut scratch.multibodies,
            &mut scratch.soft_bodies,
            &mut scratch.ccd,
            ball,
            &(),
        );
        if scratch.pipeline.quarantine().bodies().is_empty() { Ok(()) } else { Err(NonFinite) }
    }

    fn write_to_solver(&mut self) {
        for (index, handle) in self.handles.iter().enumerate() {
            let (body, motion) = (&mut self.bodies[*handle], &self.motions[index]);
            // The ball always: only then does the solver predict along its new velocity.
            if std::mem::take(&mut self.moved[index]) || index == BALL {
                body.set_position(Pose::from_parts(motion.position, motion.rotation()), true);
            }
            body.set_linvel(motion.velocity, true);
            body.set_angvel(motion.spin, true);
            let force = &self.forces[index];
            body.reset_forces(false);
            body.reset_torques(false);
            body.add_force(force.force, true);
            body.add_torque(force.torque, true);
        }
    }

    fn read_from_solver(&mut self) {
        for (motion, handle) in self.motions.iter_mut().zip(&self.handles) {
            let body = &self.bodies[*handle];
            let rotation = body.rotation();
            *motion = Motion {
                position: body.translation(),
                heading: Vector::new(rotation.re, rotation.im),
                velocity: body.linvel(),
                spin: body.angvel(),
            };
        }
        self.is_contact_free =
            self.narrow_phase.contact_pairs().all(|pair| impulse_of(pair).is_none());
    }

    /// Gives the ball its mass in the solver, larger while it is jammed. [`Engine::apply_impulse`]
    /// always uses the true mass.
    fn set_ball_mass(&mut self, ball: &BallHooks) {
        let mass = ball.squeezed.map_or(ball.params.ball.mass, |squeezed| squeezed.mass);
        if (self.ball_mass - mass).abs() < f32::EPSILON * mass {
            return;
        }
        // Impulses on a heavy ball must not start the solution for a light one.
        self.parameters.warmstart_coefficient = if mass < self.ball_mass { 0.0 } else { 1.0 };
        self.ball_mass = mass;
        self.set_solver_mass(BALL, mass, 1.0);
    }
}

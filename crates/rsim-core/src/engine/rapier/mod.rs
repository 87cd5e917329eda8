//! The reference solver: rapier2d.

mod build;
mod hooks;
mod report;

use rapier2d::dynamics::{
    CCDSolver, ImpulseJointSet, IntegrationParameters, IslandManager, MassProperties,
    MultibodyJointSet, RigidBodyHandle, RigidBodySet,
};
use rapier2d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase, SharedShape};
use rapier2d::pipeline::PhysicsPipeline;
use rapier2d::prelude::SoftBodySet;
use serde::{Deserialize, Serialize};

use super::NonFinite;
use super::ball_contact::BallRules;
use super::contacts::Contacts;
use crate::blocks::{BALL, robot};
use crate::bodies::Bodies;
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::math::{Pose, Vector};
use build::{LENGTH_UNIT, MIN_PREDICTION, PREDICTION_FACTOR, SOLVER_PASSES, SOLVER_PASSES_JAMMED};

/// rapier's copy of the bodies, its contacts and its settings.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct RapierSolver {
    integration: IntegrationParameters,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    handles: Vec<RigidBodyHandle>,
    /// Bodies whose poses changed since the last tick here, one bit each.
    moved: u64,
    /// Mass of the ball that rapier has, kg.
    ball_mass: f32,
}

/// Working memory of rapier, one per thread; its contents are of no use between steps.
pub(super) struct RapierScratch {
    pipeline: PhysicsPipeline,
    ccd: CCDSolver,
    // A match has no joints and no soft bodies; the pipeline takes them as arguments.
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
}

impl RapierScratch {
    pub(super) fn new() -> Self {
        Self {
            pipeline: PhysicsPipeline::new(),
            ccd: CCDSolver::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
        }
    }
}

impl RapierSolver {
    /// Gives the bodies other parameters: masses, and the prediction distance that depends on speeds.
    pub(super) fn set_parameters(&mut self, parameters: &BodyParameters) {
        // The ball does not rotate in the plane: its spin has three axes and is kept elsewhere.
        self.set_mass(BALL, parameters.ball.mass, 1.0);
        self.ball_mass = parameters.ball.mass;
        for (index, body) in parameters.robots.iter().enumerate() {
            self.set_mass(robot(index), body.model.mass, body.model.inertia());
        }
        let speeds = parameters.robots.iter().map(|body| body.model.top_speed());
        let distance = speeds.fold(0.0, f32::max) * self.integration.dt;
        let prediction = (PREDICTION_FACTOR * distance).max(MIN_PREDICTION);
        self.integration.normalized_prediction_distance = prediction / LENGTH_UNIT;
        // The ball's collider is larger by the distance that a robot drives in a tick: for a body with
        // soft continuous detection the engine ignores the motion of all others. The hook of the ball
        // computes true distances.
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.colliders[ball].set_shape(SharedShape::ball(parameters.ball.radius + distance));
    }

    fn set_mass(&mut self, body: usize, mass: f32, inertia: f32) {
        let properties = MassProperties::new(Vector::ZERO, mass, inertia);
        let body = &mut self.bodies[self.handles[body]];
        self.colliders[body.colliders()[0]].set_mass_properties(properties);
        // At once: the solver itself would update the body in its next step, after the first kick.
        body.recompute_mass_properties_from_colliders(&self.colliders);
    }

    /// Gives the ball its mass in the solver, larger while it is jammed.
    fn set_ball_mass(&mut self, mass: f32) {
        if (self.ball_mass - mass).abs() < f32::EPSILON * mass {
            return;
        }
        // Impulses on a heavy ball must not start the solution for a light one.
        self.integration.warmstart_coefficient = if mass < self.ball_mass { 0.0 } else { 1.0 };
        self.ball_mass = mass;
        self.set_mass(BALL, mass, 1.0);
    }

    /// Advances all bodies by `rules.time`, in sub-steps.
    pub(super) fn solve(
        &mut self,
        bodies: &mut Bodies,
        scratch: &mut RapierScratch,
        rules: &BallRules,
        sub_steps: usize,
        contacts: &mut Contacts,
    ) -> Result<(), NonFinite> {
        self.integration.dt = rules.time;
        self.integration.num_solver_iterations = sub_steps;
        self.set_ball_mass(bodies.ball_mass);
        let jammed = rules.squeezed.is_some_and(|squeezed| squeezed.jammed);
        self.integration.num_internal_pgs_iterations =
            if jammed { SOLVER_PASSES_JAMMED } else { SOLVER_PASSES };
        self.read_bodies(bodies, rules.parameters);
        let solved = self.step(scratch, rules);
        self.integration.warmstart_coefficient = 1.0;
        self.write_bodies(bodies);
        self.report(contacts);
        solved
    }

    fn step(&mut self, scratch: &mut RapierScratch, rules: &BallRules) -> Result<(), NonFinite> {
        scratch.pipeline.step(
            Vector::ZERO,
            &self.integration,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut scratch.joints,
            &mut scratch.multibodies,
            &mut scratch.soft_bodies,
            &mut scratch.ccd,
            rules,
            &(),
        );
        if scratch.pipeline.quarantine().bodies().is_empty() { Ok(()) } else { Err(NonFinite) }
    }

    /// Takes note that the poses of bodies changed, one bit each.
    pub(super) fn note_moved(&mut self, bodies: u64) {
        self.moved |= bodies;
    }

    fn read_bodies(&mut self, bodies: &Bodies, parameters: &BodyParameters) {
        let moved = std::mem::take(&mut self.moved);
        for (index, handle) in self.handles.iter().enumerate() {
            let (body, motion) = (&mut self.bodies[*handle], bodies.motion(index));
            // The ball always: only then does the solver predict along its new velocity.
            if moved >> index & 1 == 1 || index == BALL {
                body.set_position(Pose::from_parts(motion.position, motion.rotation()), true);
            }
            body.set_linvel(motion.velocity, true);
            body.set_angvel(motion.angular_velocity, true);
            body.reset_forces(false);
            body.reset_torques(false);
            if index != BALL {
                let (gain, inverse) = (bodies.acceleration(index), parameters.inverse(index));
                body.add_force(gain.linear / inverse.mass, true);
                body.add_torque(gain.angular / inverse.inertia, true);
            }
        }
    }

    fn write_bodies(&self, bodies: &mut Bodies) {
        for (index, handle) in self.handles.iter().enumerate() {
            let body = &self.bodies[*handle];
            let rotation = body.rotation();
            let motion = Motion {
                position: body.translation(),
                heading: Vector::new(rotation.re, rotation.im),
                velocity: body.linvel(),
                angular_velocity: body.angvel(),
            };
            bodies.set_motion(index, &motion);
        }
    }
}

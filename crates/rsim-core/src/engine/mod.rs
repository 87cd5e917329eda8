//! Contact engine of one match: bodies, walls, and rapier2d, which solves their contacts. No module
//! outside this folder depends on the solver; `math.rs` has the vector types that all share.

mod ball_hooks;
mod build;
mod contact_free;
mod contacts;
mod shapes;
mod solver;

use rapier2d::dynamics::{
    IntegrationParameters, IslandManager, MassProperties, RigidBodyHandle, RigidBodySet,
};
use rapier2d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase, SharedShape};
use serde::{Deserialize, Serialize};

use crate::body_params::BodyParams;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use build::{LENGTH_UNIT, MIN_PREDICTION, PREDICTION_FACTOR};

pub(crate) use ball_hooks::{BallHooks, BallPhase, SqueezedBall};
pub(crate) use contacts::{BallContact, Partner, RobotContact};
pub(crate) use shapes::Shape;
pub(crate) use solver::{NonFinite, Scratch};

/// Index of the ball among the bodies.
pub(crate) const BALL: usize = 0;

/// Index of robot `index` among the bodies.
pub(crate) const fn robot(index: usize) -> usize {
    index + 1
}

/// Bodies of one match.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Engine {
    parameters: IntegrationParameters,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    handles: Vec<RigidBodyHandle>,
    /// State of the bodies, valid between ticks; the solver's own copies may lag behind.
    motions: Vec<Motion>,
    forces: Vec<AppliedForce>,
    inverses: Vec<InverseInertia>,
    /// Mass of the ball in the solver, kg.
    ball_mass: f32,
    /// Whether a body's pose differs from the solver's copy.
    moved: Vec<bool>,
    /// Whether the solver's last tick had no impulses.
    is_contact_free: bool,
    /// Whether ticks without contacts go without the solver.
    contact_free_enabled: bool,
    /// Number of ticks that went without the solver.
    contact_free_ticks: u32,
}

/// Force (N) and torque (N m) on a body during the next tick.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct AppliedForce {
    force: Vector,
    torque: f32,
}

/// Inverse mass (1/kg) and inverse moment of inertia (1/(kg m²)) of a body.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct InverseInertia {
    mass: f32,
    inertia: f32,
}

/// Motion of a robot without contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Undisturbed {
    /// m/s.
    pub(crate) velocity: Vector,
    /// rad/s.
    pub(crate) spin: f32,
}

impl Engine {
    /// Gives the bodies other parameters: masses, and the prediction distance that depends on speeds.
    pub(crate) fn set_params(&mut self, params: &BodyParams) {
        // The ball does not rotate in the plane: its spin has three axes and is kept elsewhere.
        self.set_mass(BALL, params.ball.mass, 1.0);
        self.inverses[BALL].inertia = 0.0;
        self.ball_mass = params.ball.mass;
        for (index, body) in params.robots.iter().enumerate() {
            self.set_mass(robot(index), body.model.mass, body.model.inertia());
        }
        let speeds = params.robots.iter().map(|body| body.model.top_speed());
        let distance = speeds.fold(0.0, f32::max) * self.parameters.dt;
        let prediction = (PREDICTION_FACTOR * distance).max(MIN_PREDICTION);
        self.parameters.normalized_prediction_distance = prediction / LENGTH_UNIT;
        // The ball's collider is larger by the distance that a robot drives in a tick: for a body with
        // soft continuous detection the engine ignores the motion of all others. The hook of the ball
        // computes true distances.
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.colliders[ball].set_shape(SharedShape::ball(params.ball.radius + distance));
    }

    fn set_mass(&mut self, body: usize, mass: f32, inertia: f32) {
        self.inverses[body] = InverseInertia { mass: 1.0 / mass, inertia: 1.0 / inertia };
        self.set_solver_mass(body, mass, inertia);
    }

    fn set_solver_mass(&mut self, body: usize, mass: f32, inertia: f32) {
        let properties = MassProperties::new(Vector::ZERO, mass, inertia);
        let body = &mut self.bodies[self.handles[body]];
        self.colliders[body.colliders()[0]].set_mass_properties(properties);
        // At once: the solver itself would update the body in its next step, after the first kick.
        body.recompute_mass_properties_from_colliders(&self.colliders);
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        self.motions[body]
    }

    /// Sets the motion of a body. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        self.motions[body] = *motion;
        self.moved[body] = true;
    }

    /// Sets position (m) and velocity (m/s) of the ball.
    pub(crate) fn set_ball(&mut self, position: Vector, velocity: Vector) {
        let ball = &mut self.motions[BALL];
        (ball.position, ball.velocity) = (position, velocity);
        self.moved[BALL] = true;
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(crate) fn ball_was_jammed(&self) -> bool {
        self.ball_mass * self.inverses[BALL].mass > 1.0 + f32::EPSILON
    }

    /// Writes the motion of robots after `time` without contacts into `undisturbed`.
    pub(crate) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        undisturbed.clear();
        undisturbed.extend((robot(0)..self.motions.len()).map(|body| {
            let (motion, force) = (&self.motions[body], &self.forces[body]);
            let inverse = &self.inverses[body];
            let velocity = motion.velocity + force.force * (inverse.mass * time);
            Undisturbed { velocity, spin: motion.spin + force.torque * (inverse.inertia * time) }
        }));
    }

    /// Acceleration of a body by the applied force during the next tick, m/s².
    pub(crate) fn acceleration(&self, body: usize) -> Vector {
        self.forces[body].force * self.inverses[body].mass
    }

    /// Sets the velocity of a body, m/s.
    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        self.motions[body].velocity = velocity;
    }

    /// Applies an impulse (N s) to a body, at `arm` (m) from its centre of mass.
    pub(crate) fn apply_impulse(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let (motion, inverse) = (&mut self.motions[body], &self.inverses[body]);
        motion.velocity += impulse * inverse.mass;
        motion.spin += arm.perp_dot(impulse) * inverse.inertia;
    }

    /// Sets force (N) and torque (N m) on a body during the next tick.
    pub(crate) fn set_force(&mut self, body: usize, force: Vector, torque: f32) {
        self.forces[body] = AppliedForce { force, torque };
    }

    /// Sets whether ticks without contacts go without the solver.
    pub(crate) fn enable_contact_free_ticks(&mut self, enabled: bool) {
        self.contact_free_enabled = enabled;
    }

    /// Sets the number of sub-steps of a tick.
    pub(crate) fn set_sub_steps(&mut self, sub_steps: usize) {
        self.parameters.num_solver_iterations = sub_steps;
    }

    /// Number of ticks without the solver since the match began.
    pub(crate) fn contact_free_ticks(&self) -> u32 {
        self.contact_free_ticks
    }
}

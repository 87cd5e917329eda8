//! The contact engine behind one match: bodies, walls, and rapier2d that solves what they do to
//! each other. Nothing outside this folder knows which engine it is.

mod ball_hooks;
mod build;
mod pressing;
mod quiet;

use rapier2d::math::{Pose, Vector};
use rapier2d::prelude::*;
use serde::{Deserialize, Serialize};

use build::{LENGTH_UNIT, PASSES, PASSES_JAMMED, SEEN_AHEAD, SEEN_LEAST};

use crate::physique::Physique;

pub(crate) use ball_hooks::{BallHooks, Level, rotation};
use pressing::{BALL_LABEL, label, partner, pressed};
pub(crate) use pressing::{Contact, Partner, Press};
pub(crate) use quiet::Room;

/// The body that is the ball.
pub(crate) const BALL: usize = 0;

/// The body that is robot `index`.
pub(crate) const fn robot(index: usize) -> usize {
    index + 1
}

/// Where a body is and how it moves in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Motion {
    pub(crate) position: Vector,
    /// Cosine and sine of the heading.
    pub(crate) heading: Vector,
    pub(crate) velocity: Vector,
    /// rad/s, counter-clockwise.
    pub(crate) spin: f32,
}

impl Motion {
    pub(crate) fn is_finite(&self) -> bool {
        self.position.is_finite()
            && self.heading.is_finite()
            && self.velocity.is_finite()
            && self.spin.is_finite()
    }
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
    /// Where the bodies are and how they move: what counts between ticks. The solver's own copies
    /// may lag behind.
    motions: Vec<Motion>,
    pushes: Vec<Push>,
    inverses: Vec<Inverse>,
    /// What the solver takes the ball for, kg.
    ball_mass: f32,
    /// Which bodies are elsewhere than the solver has them.
    moved: Vec<bool>,
    /// Whether nothing pressed on anything in the solver's last tick.
    clear: bool,
    /// Whether ticks in which nothing touches go without the solver.
    skips: bool,
    /// Ticks that went without it.
    skipped: u32,
}

/// Force (N) and torque (N m) on a body during the next tick.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Push {
    force: Vector,
    torque: f32,
}

/// 1/kg and 1/(kg m²) of a body.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct Inverse {
    mass: f32,
    inertia: f32,
}

/// What the engine works with during a step: one per thread. What is in it
/// means nothing between steps.
pub(crate) struct Scratch {
    pipeline: PhysicsPipeline,
    ccd: CCDSolver,
    trial: quiet::Trial,
    /// Contacts of robots in what was solved last.
    pub(crate) presses: Vec<Press>,
    /// How robots would move after it if nobody touched them.
    pub(crate) undisturbed: Vec<Undisturbed>,
    // A match has no joints and no soft bodies; the pipeline wants to see that for itself.
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            pipeline: PhysicsPipeline::new(),
            ccd: CCDSolver::new(),
            trial: quiet::Trial::default(),
            presses: Vec::new(),
            undisturbed: Vec::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
        }
    }
}

/// How a robot would move if nobody touched it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Undisturbed {
    pub(crate) velocity: Vector,
    /// rad/s.
    pub(crate) spin: f32,
}

/// A body's state left the finite numbers.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    /// Takes the bodies for those of another physique: their masses, and how far they get in a tick.
    pub(crate) fn fit(&mut self, physique: &Physique) {
        // The ball does not turn in the plane: its spin has three axes and is kept elsewhere.
        self.set_mass(BALL, physique.ball.mass, 1.0);
        self.inverses[BALL].inertia = 0.0;
        self.ball_mass = physique.ball.mass;
        for (index, body) in physique.robots.iter().enumerate() {
            self.set_mass(robot(index), body.model.mass, body.model.inertia());
        }
        let speeds = physique.robots.iter().map(|body| body.model.top_speed());
        let way = speeds.fold(0.0, f32::max) * self.parameters.dt;
        let ahead = (SEEN_AHEAD * way).max(SEEN_LEAST);
        self.parameters.normalized_prediction_distance = ahead / LENGTH_UNIT;
        // Larger by the way of a robot in a tick: beside a body that looks ahead along its own way the
        // engine counts nobody else's. The hook of the ball knows how far everything really is.
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.colliders[ball].set_shape(SharedShape::ball(physique.ball.radius + way));
    }

    fn set_mass(&mut self, body: usize, mass: f32, inertia: f32) {
        self.inverses[body] = Inverse { mass: 1.0 / mass, inertia: 1.0 / inertia };
        let properties = MassProperties::new(Vector::ZERO, mass, inertia);
        let body = &mut self.bodies[self.handles[body]];
        self.colliders[body.colliders()[0]].set_mass_properties(properties);
        // At once: the solver itself would see it in its next step, after the first kick.
        body.recompute_mass_properties_from_colliders(&self.colliders);
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        self.motions[body]
    }

    /// Puts a body somewhere. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        self.motions[body] = *motion;
        self.moved[body] = true;
    }

    /// Puts the ball somewhere, with a velocity.
    pub(crate) fn set_ball(&mut self, position: Vector, velocity: Vector) {
        let ball = &mut self.motions[BALL];
        (ball.position, ball.velocity) = (position, velocity);
        self.moved[BALL] = true;
    }

    /// Whether the ball was caught in the solver's last tick.
    pub(crate) fn was_caught(&self) -> bool {
        self.ball_mass * self.inverses[BALL].mass > 1.0 + f32::EPSILON
    }

    /// How robots move after `time` if nobody touches them.
    pub(crate) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        undisturbed.clear();
        undisturbed.extend((robot(0)..self.motions.len()).map(|body| {
            let (motion, push) = (&self.motions[body], &self.pushes[body]);
            let inverse = &self.inverses[body];
            let velocity = motion.velocity + push.force * (inverse.mass * time);
            Undisturbed { velocity, spin: motion.spin + push.torque * (inverse.inertia * time) }
        }));
    }

    /// Force (N) on a body over its mass, during the next tick.
    pub(crate) fn acceleration(&self, body: usize) -> Vector {
        self.pushes[body].force * self.inverses[body].mass
    }

    /// Has the solver take the ball for a caught one, or for what it is. [`Engine::hit`] never takes it
    /// for a caught one.
    fn catch_ball(&mut self, ball: &BallHooks) {
        let mass = ball.squeeze.map_or(ball.physique.ball.mass, |squeeze| squeeze.mass);
        if (self.ball_mass - mass).abs() < f32::EPSILON * mass {
            return;
        }
        // What pressed on a heavy ball must not start the solution for a light one.
        self.parameters.warmstart_coefficient = if mass < self.ball_mass { 0.0 } else { 1.0 };
        self.ball_mass = mass;
        let properties = MassProperties::new(Vector::ZERO, mass, 1.0);
        let body = &mut self.bodies[self.handles[BALL]];
        self.colliders[body.colliders()[0]].set_mass_properties(properties);
        body.recompute_mass_properties_from_colliders(&self.colliders);
    }

    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        self.motions[body].velocity = velocity;
    }

    /// An impulse (N s) on a body, at `arm` from its centre of mass.
    pub(crate) fn hit(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let (motion, inverse) = (&mut self.motions[body], &self.inverses[body]);
        motion.velocity += impulse * inverse.mass;
        motion.spin += arm.perp_dot(impulse) * inverse.inertia;
    }

    /// Force (N) and torque (N m) on a body during the next tick.
    pub(crate) fn push(&mut self, body: usize, force: Vector, torque: f32) {
        self.pushes[body] = Push { force, torque };
    }

    /// Whether ticks in which nothing touches go without the solver.
    pub(crate) fn set_skips(&mut self, skips: bool) {
        self.skips = skips;
    }

    /// Solves each tick in so many sub-steps.
    pub(crate) fn set_sub_steps(&mut self, sub_steps: usize) {
        self.parameters.num_solver_iterations = sub_steps;
    }

    /// Ticks that went without the solver since the match began.
    pub(crate) fn skipped(&self) -> u32 {
        self.skipped
    }

    /// One tick.
    pub(crate) fn step(
        &mut self,
        scratch: &mut Scratch,
        ball: &BallHooks,
        room: &Room,
    ) -> Result<(), NonFinite> {
        self.parameters.dt = ball.time;
        let quiet = self.skips && self.clear && ball.squeeze.is_none() && !self.was_caught();
        if quiet
            && self.try_coasting(
                &mut scratch.trial,
                ball.physique,
                ball.level != Level::Floor,
                room,
            )
        {
            self.skipped = self.skipped.wrapping_add(1);
            return Ok(());
        }
        self.catch_ball(ball);
        let jammed = ball.squeeze.is_some_and(|squeeze| squeeze.jammed);
        self.parameters.num_internal_pgs_iterations = if jammed { PASSES_JAMMED } else { PASSES };
        self.tell_solver();
        let solved = self.solve(scratch, ball);
        self.parameters.warmstart_coefficient = 1.0;
        self.ask_solver();
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

    fn tell_solver(&mut self) {
        for (index, handle) in self.handles.iter().enumerate() {
            let (body, motion) = (&mut self.bodies[*handle], &self.motions[index]);
            // The ball always: only then does the solver look ahead along its new velocity.
            if std::mem::take(&mut self.moved[index]) || index == BALL {
                let heading = rotation(motion.heading);
                body.set_position(Pose::from_parts(motion.position, heading), true);
            }
            body.set_linvel(motion.velocity, true);
            body.set_angvel(motion.spin, true);
            let push = &self.pushes[index];
            body.reset_forces(false);
            body.reset_torques(false);
            body.add_force(push.force, true);
            body.add_torque(push.torque, true);
        }
    }

    fn ask_solver(&mut self) {
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
        self.clear = self.narrow_phase.contact_pairs().all(|pair| pressed(pair).is_none());
    }
}

/// A heading turned by an angle of a fraction of a radian, as the solver turns bodies.
fn turned(heading: Vector, angle: f32) -> Vector {
    Vector::new(heading.x - angle * heading.y, heading.y + angle * heading.x).normalize()
}

//! The contact engine behind one match: bodies, walls, and rapier2d that solves what they do to
//! each other. Nothing outside this folder knows which engine it is.

mod ball_hooks;
mod build;

use rapier2d::math::{Pose, Rotation, Vector};
use rapier2d::prelude::*;
use serde::{Deserialize, Serialize};

use crate::physique::Physique;

pub(crate) use ball_hooks::{BallHooks, rotation};

/// The body that is the ball.
pub(crate) const BALL: usize = 0;

/// The body that is robot `index`.
pub(crate) const fn robot(index: usize) -> usize {
    index + 1
}

/// Where a body is and how it moves in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
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

/// What a body is in contact with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Partner {
    Wall(usize),
    Robot(usize),
}

/// A contact in which the last tick pressed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    pub(crate) with: Partner,
    /// From the partner outward, a unit vector.
    pub(crate) normal: Vector,
    /// N s, along the normal.
    pub(crate) pressing: f32,
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
}

/// What the engine works with during a step: one per thread, empty between steps.
pub(crate) struct Scratch {
    pipeline: PhysicsPipeline,
    ccd: CCDSolver,
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
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
        }
    }
}

/// A body's state left the finite numbers.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    /// Gives the bodies the masses of another physique.
    pub(crate) fn set_masses(&mut self, physique: &Physique) {
        self.set_mass(BALL, MassProperties::new(Vector::ZERO, physique.ball.mass, 1.0));
        for (index, body) in physique.robots.iter().enumerate() {
            let model = &body.model;
            let properties = MassProperties::new(Vector::ZERO, model.mass, model.inertia());
            self.set_mass(robot(index), properties);
        }
    }

    fn set_mass(&mut self, body: usize, properties: MassProperties) {
        let body = &mut self.bodies[self.handles[body]];
        self.colliders[body.colliders()[0]].set_mass_properties(properties);
        // At once: the engine itself would see it in its next step, after the first kick.
        body.recompute_mass_properties_from_colliders(&self.colliders);
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        let body = &self.bodies[self.handles[body]];
        let rotation = body.rotation();
        Motion {
            position: body.translation(),
            heading: Vector::new(rotation.re, rotation.im),
            velocity: body.linvel(),
            spin: body.angvel(),
        }
    }

    /// Puts a body somewhere. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        let body = &mut self.bodies[self.handles[body]];
        let rotation = Rotation { re: motion.heading.x, im: motion.heading.y };
        body.set_position(Pose::from_parts(motion.position, rotation), true);
        body.set_linvel(motion.velocity, true);
        body.set_angvel(motion.spin, true);
    }

    /// Puts the ball somewhere, with a velocity.
    pub(crate) fn set_ball(&mut self, position: Vector, velocity: Vector) {
        let body = &mut self.bodies[self.handles[BALL]];
        body.set_translation(position, true);
        body.set_linvel(velocity, true);
    }

    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        self.bodies[self.handles[body]].set_linvel(velocity, true);
    }

    /// An impulse (N s) on a body, at `arm` from its centre of mass.
    pub(crate) fn hit(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let body = &mut self.bodies[self.handles[body]];
        body.apply_impulse(impulse, true);
        body.apply_torque_impulse(arm.perp_dot(impulse), true);
    }

    /// Force (N) and torque (N m) on a body during the next tick.
    pub(crate) fn push(&mut self, body: usize, force: Vector, torque: f32) {
        let body = &mut self.bodies[self.handles[body]];
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, true);
        body.add_torque(torque, true);
    }

    /// One tick.
    pub(crate) fn step(
        &mut self,
        scratch: &mut Scratch,
        ball: &BallHooks,
    ) -> Result<(), NonFinite> {
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

    /// What pressed on the ball in the last tick.
    pub(crate) fn ball_contacts(&self) -> impl Iterator<Item = Contact> {
        let ball = self.bodies[self.handles[BALL]].colliders()[0];
        self.narrow_phase.contact_pairs_with(ball).filter_map(move |pair| {
            let (normal, pressing) = pressed(pair)?;
            let (other, sign) =
                if pair.collider1 == ball { (pair.collider2, -1.0) } else { (pair.collider1, 1.0) };
            let with = partner(self.colliders[other].user_data)?;
            Some(Contact { with, normal: normal * sign, pressing })
        })
    }

    /// Pairs of robots that pressed on each other in the last tick, with the normal from the first to
    /// the second.
    pub(crate) fn robot_contacts(&self) -> impl Iterator<Item = ([usize; 2], Vector)> {
        self.narrow_phase.contact_pairs().filter_map(|pair| {
            let labels = [pair.collider1, pair.collider2].map(|of| self.colliders[of].user_data);
            let [Some(Partner::Robot(first)), Some(Partner::Robot(second))] = labels.map(partner)
            else {
                return None;
            };
            pressed(pair).map(|(normal, _)| ([first, second], normal))
        })
    }

    /// Pairs of bodies or walls that touch.
    pub(crate) fn contacts(&self) -> usize {
        self.narrow_phase.contact_pairs().filter(|pair| pair.has_any_active_contact()).count()
    }
}

/// Normal (from the first to the second) and impulse of a pair that pressed.
fn pressed(pair: &ContactPair) -> Option<(Vector, f32)> {
    let manifolds = pair.manifolds().iter();
    manifolds
        .map(|manifold| {
            (manifold.data.normal, manifold.points.iter().map(|p| p.data.impulse).sum())
        })
        .find(|(_, pressing): &(Vector, f32)| *pressing > 0.0)
}

const BALL_LABEL: u128 = 0;
/// Labels of robots are below, of walls from here on.
const FIRST_WALL: u128 = 1000;

fn label(partner: Partner) -> u128 {
    match partner {
        Partner::Robot(index) => 1 + index as u128,
        Partner::Wall(index) => FIRST_WALL + index as u128,
    }
}

/// What a collider's label says it is; `None` for the ball.
pub(crate) fn partner(label: u128) -> Option<Partner> {
    let index = usize::try_from(label).expect("labels are small");
    let first_wall = usize::try_from(FIRST_WALL).expect("small");
    match index {
        0 => None,
        robot if robot < first_wall => Some(Partner::Robot(robot - 1)),
        wall => Some(Partner::Wall(wall - first_wall)),
    }
}

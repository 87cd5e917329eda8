//! Bodies of one match, as both contact solvers move them.

use serde::{Deserialize, Serialize};

use super::{BALL, SubSteps, Undisturbed, robot};
use crate::body_params::BodyParams;
use crate::geometry::motion::{Motion, rotated};
use crate::math::Vector;

/// State and inertia of all bodies; the first is the ball.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Bodies {
    pub(super) motions: Vec<Motion>,
    pub(super) forces: Vec<AppliedForce>,
    pub(super) inverses: Vec<InverseInertia>,
    /// Mass of the ball in the solver, kg; larger than its own while it is jammed.
    pub(super) ball_mass: f32,
    /// Whether a pose was changed since the solver's last tick.
    pub(super) moved: Vec<bool>,
}

/// Force (N) and torque (N m) on a body during the next tick.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct AppliedForce {
    pub(super) force: Vector,
    pub(super) torque: f32,
}

/// Inverse mass (1/kg) and inverse moment of inertia (1/(kg m²)) of a body.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct InverseInertia {
    pub(super) mass: f32,
    pub(super) inertia: f32,
}

impl Bodies {
    pub(super) fn new(params: &BodyParams) -> Self {
        let count = robot(params.robots.len());
        let mut bodies = Self {
            motions: vec![Motion::at_rest(Vector::ZERO, Vector::X); count],
            forces: vec![AppliedForce::default(); count],
            inverses: vec![InverseInertia::default(); count],
            ball_mass: params.ball.mass,
            moved: vec![false; count],
        };
        bodies.set_params(params);
        bodies
    }

    pub(super) fn set_params(&mut self, params: &BodyParams) {
        // The ball does not rotate in the plane: its spin has three axes and is kept elsewhere.
        self.inverses[BALL] = InverseInertia { mass: 1.0 / params.ball.mass, inertia: 0.0 };
        self.ball_mass = params.ball.mass;
        for (index, body) in params.robots.iter().enumerate() {
            self.inverses[robot(index)] =
                InverseInertia { mass: body.inverse_mass, inertia: body.inverse_inertia };
        }
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(super) fn ball_was_jammed(&self) -> bool {
        self.ball_mass * self.inverses[BALL].mass > 1.0 + f32::EPSILON
    }

    /// Bound of the speeds of robots within `time` (s) without contacts, m/s.
    pub(super) fn fastest_robot(&self, time: f32) -> f32 {
        let all = self.motions.iter().zip(&self.forces).zip(&self.inverses).skip(robot(0));
        let [speed, gain] = all.fold([0.0_f32; 2], |[speed, gain], ((motion, force), inverse)| {
            let acceleration = force.force * inverse.mass;
            [speed.max(motion.velocity.length_squared()), gain.max(acceleration.length_squared())]
        });
        speed.sqrt() + gain.sqrt() * time
    }

    /// Writes the motion of robots after `time` without contacts into `undisturbed`.
    pub(super) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        undisturbed.clear();
        undisturbed.extend((robot(0)..self.motions.len()).map(|body| {
            let (motion, force) = (&self.motions[body], &self.forces[body]);
            let inverse = &self.inverses[body];
            let velocity = motion.velocity + force.force * (inverse.mass * time);
            Undisturbed { velocity, spin: motion.spin + force.torque * (inverse.inertia * time) }
        }));
    }

    /// Applies an impulse (N s) to a body, at `arm` (m) from its centre of mass.
    pub(super) fn apply_impulse(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let (motion, inverse) = (&mut self.motions[body], &self.inverses[body]);
        motion.velocity += impulse * inverse.mass;
        motion.spin += arm.perp_dot(impulse) * inverse.inertia;
    }

    /// Moves all bodies by sub-steps without contacts.
    pub(super) fn move_freely(&mut self, sub_steps: SubSteps) {
        let Self { motions, forces, inverses, .. } = self;
        move_freely(motions, forces, inverses, sub_steps);
    }
}

/// Moves bodies by sub-steps without contacts.
pub(super) fn move_freely(
    motions: &mut [Motion],
    forces: &[AppliedForce],
    inverses: &[InverseInertia],
    SubSteps { time, count }: SubSteps,
) {
    for ((motion, force), inverse) in motions.iter_mut().zip(forces).zip(inverses) {
        let velocity_change = force.force * inverse.mass * time;
        let spin_change = force.torque * inverse.inertia * time;
        for _ in 0..count {
            motion.velocity += velocity_change;
            motion.spin += spin_change;
            motion.position += motion.velocity * time;
            motion.heading = rotated(motion.heading, motion.spin * time);
        }
    }
}

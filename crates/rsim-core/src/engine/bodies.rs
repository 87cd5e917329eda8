//! Bodies of one match, as both contact solvers move them.

use serde::{Deserialize, Serialize};

use super::{SubSteps, Undisturbed};
use crate::blocks::{BALL, LANES, Lanes, VectorLanes, larger, mask_of, place_of, robot};
use crate::body_params::BodyParams;
use crate::drive::BlockAcceleration;
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;

/// State and inertia of all bodies; the first is the ball.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Bodies {
    pub(super) motions: Motions,
    /// Accelerations during the next tick, by block.
    pub(super) accelerations: Vec<BlockAcceleration>,
    inertia: Vec<BlockInertia>,
    /// Mass of the ball in the solver, kg; larger than its own while it is jammed.
    pub(super) ball_mass: f32,
    /// Whether a pose was changed since the solver's last tick.
    pub(super) moved: Vec<bool>,
}

/// Motions of all bodies, by block.
#[derive(Clone, Default, Serialize, Deserialize)]
pub(super) struct Motions {
    blocks: Vec<MotionBlock>,
    count: usize,
}

/// Inertia and size of the bodies of a block.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
struct BlockInertia {
    /// 1/kg.
    inverse_mass: Lanes,
    /// 1/(kg m²).
    inverse_inertia: Lanes,
    /// Radii of circles around the bodies, m.
    bounding_radius: Lanes,
}

/// Inverse mass (1/kg) and inverse moment of inertia (1/(kg m²)) of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct InverseInertia {
    pub(super) mass: f32,
    pub(super) inertia: f32,
}

/// Acceleration of a body: m/s² and rad/s².
#[derive(Debug, Clone, Copy)]
pub(super) struct Acceleration {
    pub(super) linear: Vector,
    pub(super) angular: f32,
}

impl Motions {
    /// Motions of `count` bodies at rest in the origin.
    fn new(count: usize) -> Self {
        Self { blocks: vec![MotionBlock::AT_REST; count.div_ceil(LANES)], count }
    }

    /// Takes the motions of `others` without an allocation, if there is space for them.
    pub(super) fn copy_from(&mut self, others: &Self) {
        self.blocks.clone_from(&others.blocks);
        self.count = others.count;
    }

    /// Number of bodies.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    pub(super) fn blocks(&self) -> &[MotionBlock] {
        &self.blocks
    }

    pub(super) fn get(&self, body: usize) -> Motion {
        let (block, lane) = place_of(body);
        self.blocks[block].get(lane)
    }

    pub(super) fn set(&mut self, body: usize, motion: &Motion) {
        let (block, lane) = place_of(body);
        self.blocks[block].set(lane, motion);
    }

    /// Sets the velocity of a body, m/s.
    pub(super) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        let (block, lane) = place_of(body);
        self.blocks[block].velocity.set(lane, velocity);
    }

    /// Moves all bodies by sub-steps without contacts.
    pub(super) fn advance(&mut self, accelerations: &[BlockAcceleration], steps: SubSteps) {
        let time = Lanes::splat(steps.time);
        for (block, BlockAcceleration { linear, angular }) in
            self.blocks.iter_mut().zip(accelerations)
        {
            block.advance(*linear * time, *angular * time, steps.time, steps.count);
        }
    }
}

impl Bodies {
    pub(super) fn new(params: &BodyParams) -> Self {
        let count = robot(params.robots.len());
        let motions = Motions::new(count);
        let blocks = motions.blocks.len();
        let mut bodies = Self {
            motions,
            accelerations: vec![BlockAcceleration::NONE; blocks],
            inertia: vec![BlockInertia::default(); blocks],
            ball_mass: params.ball.mass,
            moved: vec![false; count],
        };
        bodies.set_params(params);
        bodies
    }

    pub(super) fn set_params(&mut self, params: &BodyParams) {
        self.ball_mass = params.ball.mass;
        // The ball does not rotate in the plane: its spin has three axes and is kept elsewhere.
        let ball = InverseInertia { mass: 1.0 / params.ball.mass, inertia: 0.0 };
        self.set_inertia(BALL, ball, params.ball.radius);
        for (index, body) in params.robots.iter().enumerate() {
            let inverse = InverseInertia { mass: body.inverse_mass, inertia: body.inverse_inertia };
            self.set_inertia(robot(index), inverse, body.bounding_radius);
        }
    }

    fn set_inertia(&mut self, body: usize, inverse: InverseInertia, bounding_radius: f32) {
        let (block, lane) = place_of(body);
        let BlockInertia { inverse_mass, inverse_inertia, bounding_radius: radius } =
            &mut self.inertia[block];
        inverse_mass.as_mut_array()[lane] = inverse.mass;
        inverse_inertia.as_mut_array()[lane] = inverse.inertia;
        radius.as_mut_array()[lane] = bounding_radius;
    }

    pub(super) fn inverse(&self, body: usize) -> InverseInertia {
        let (block, lane) = place_of(body);
        let block = &self.inertia[block];
        InverseInertia {
            mass: block.inverse_mass.as_array()[lane],
            inertia: block.inverse_inertia.as_array()[lane],
        }
    }

    /// Radii of circles around the bodies of a block, m.
    pub(super) fn bounding_radii(&self, block: usize) -> Lanes {
        self.inertia[block].bounding_radius
    }

    /// Acceleration of a body during the next tick.
    pub(super) fn acceleration(&self, body: usize) -> Acceleration {
        let (block, lane) = place_of(body);
        let BlockAcceleration { linear, angular } = &self.accelerations[block];
        Acceleration { linear: linear.get(lane), angular: angular.as_array()[lane] }
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(super) fn ball_was_jammed(&self) -> bool {
        self.ball_mass * self.inverse(BALL).mass > 1.0 + f32::EPSILON
    }

    /// Bound of the speeds of robots within `time` (s) without contacts, m/s.
    pub(super) fn fastest_robot(&self, time: f32) -> f32 {
        let (mut speed, mut gain) = (Lanes::ZERO, Lanes::ZERO);
        for (index, (motion, acceleration)) in
            self.motions.blocks.iter().zip(&self.accelerations).enumerate()
        {
            let speeds = motion.velocity.length_squared();
            let speeds = if index == 0 { without_ball(speeds) } else { speeds };
            speed = larger(speed, speeds);
            gain = larger(gain, acceleration.linear.length_squared());
        }
        let most = |squares: Lanes| squares.as_array().iter().fold(0.0, |a: f32, b| a.max(*b));
        most(speed).sqrt() + most(gain).sqrt() * time
    }

    /// Robots whose surrounding circle is nearer than `gap` (m) to that of the ball, one bit each.
    pub(super) fn robots_near_ball(&self, gap: f32) -> u64 {
        let ball = VectorLanes::splat(self.motions.get(BALL).position);
        let gap = Lanes::splat(gap + self.inertia[0].bounding_radius.as_array()[0]);
        let mut near = 0;
        for (index, motion) in self.motions.blocks.iter().enumerate() {
            let reach = self.inertia[index].bounding_radius + gap;
            let bits = (motion.position - ball).length_squared().simd_lt(reach * reach);
            near |= u64::from(bits.to_bitmask()) << (index * LANES);
        }
        // From bodies to robots.
        (near & self.all()) >> robot(0)
    }

    /// All bodies, one bit each.
    pub(super) fn all(&self) -> u64 {
        u64::MAX >> (64 - self.motions.count)
    }

    /// Writes the motion of robots after `time` without contacts into `undisturbed`.
    pub(super) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        undisturbed.clear();
        undisturbed.extend((robot(0)..self.motions.len()).map(|body| {
            let (motion, gain) = (self.motions.get(body), self.acceleration(body));
            Undisturbed {
                velocity: motion.velocity + gain.linear * time,
                spin: motion.spin + gain.angular * time,
            }
        }));
    }

    /// Applies an impulse (N s) to a body, at `arm` (m) from its centre of mass.
    pub(super) fn apply_impulse(&mut self, body: usize, impulse: Vector, arm: Vector) {
        let inverse = self.inverse(body);
        let (block, lane) = place_of(body);
        let block = &mut self.motions.blocks[block];
        let velocity = block.velocity.get(lane) + impulse * inverse.mass;
        block.velocity.set(lane, velocity);
        block.spin.as_mut_array()[lane] += arm.perp_dot(impulse) * inverse.inertia;
    }

    /// Moves all bodies by sub-steps without contacts.
    pub(super) fn move_freely(&mut self, steps: SubSteps) {
        self.motions.advance(&self.accelerations, steps);
    }
}

/// The numbers of the first block with 0 for the ball.
fn without_ball(numbers: Lanes) -> Lanes {
    mask_of(|lane| lane != BALL) & numbers
}

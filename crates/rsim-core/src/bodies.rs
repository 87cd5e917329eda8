//! Bodies of one match: their motions, and all numbers that robots keep from tick to tick.
//!
//! Numbers of a body are in the block of four that its index names, next to those of its neighbors. A
//! block is plain data of fixed size, so the blocks of a match are copied at once.

mod robots;
mod warm_starts;

use serde::{Deserialize, Serialize};

use crate::blocks::{BALL, LANES, Lanes, VectorLanes, blocks_of, larger, mask_of, place_of, robot};
use crate::body_parameters::BodyParameters;
use crate::drive::{BlockAcceleration, DriveState};
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;

/// Maximum number of warm starts by block. Bodies in the plane have fewer than three contacts each
/// on average, since lines between the centers of those that touch do not cross, and only bodies around
/// a crowd touch walls. Crowds of 23 bodies have up to 56 of 96.
pub(crate) const WARM_STARTS: usize = 4 * LANES;

/// State of four bodies.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct BodyBlock {
    pub(crate) motion: MotionBlock,
    /// During the next tick.
    pub(crate) acceleration: BlockAcceleration,
    pub(crate) drive: DriveState,
    /// Time until kickers are charged, s.
    pub(crate) recharging: Lanes,
    /// Speeds of dribblers by their maximum, 0 to 1.
    dribbling: Lanes,
    /// Closing speeds of the hardest contacts with other robots since the control step began, m/s.
    collision_speed: Lanes,
    /// This block's part of the list of all warm starts.
    warm_starts: [WarmStart; WARM_STARTS],
}

impl BodyBlock {
    /// Bodies at rest in the origin.
    const AT_REST: Self = Self {
        motion: MotionBlock::AT_REST,
        acceleration: BlockAcceleration::NONE,
        drive: DriveState::AT_REST,
        recharging: Lanes::ZERO,
        dribbling: Lanes::ZERO,
        collision_speed: Lanes::ZERO,
        warm_starts: [WarmStart::NONE; WARM_STARTS],
    };
}

/// Impulses of two bodies that press on each other, which the contact solver starts the next tick from.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct WarmStart {
    /// Identifies the pair.
    pub(crate) key: u16,
    /// Identify the contact points.
    pub(crate) features: [u8; 2],
    /// Impulses along the normal at the contact points, N s.
    pub(crate) normals: [f32; 2],
    /// Impulse along the surface, N s.
    pub(crate) tangent: f32,
}

impl WarmStart {
    const NONE: Self = Self { key: 0, features: [0; 2], normals: [0.0; 2], tangent: 0.0 };
}

/// State of all bodies; the first is the ball. `B` is the memory of the blocks, which in a match
/// follow the other fields.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Bodies<B: ?Sized = [BodyBlock]> {
    count: usize,
    /// Mass of the ball in the solver, kg; larger than its own while it is jammed.
    pub(crate) ball_mass: f32,
    pub(crate) blocks: B,
}

/// Acceleration of a body: m/s² and rad/s².
#[derive(Debug, Clone, Copy)]
pub(crate) struct Acceleration {
    pub(crate) linear: Vector,
    pub(crate) angular: f32,
}

/// Motion of the bodies of a block after a tick, or a part of it, without contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Undisturbed {
    motion: Change,
    /// Part of it that the wheels gave in that time.
    gain: Change,
}

/// Velocities of the bodies of a block, or changes of them.
#[derive(Debug, Clone, Copy)]
struct Change {
    /// m/s.
    velocity: VectorLanes,
    /// rad/s.
    angular_velocity: Lanes,
}

impl Change {
    fn get(&self, lane: usize) -> (Vector, f32) {
        (self.velocity.get(lane), self.angular_velocity.as_array()[lane])
    }
}

impl Undisturbed {
    /// Velocity (m/s) and angular velocity (rad/s) that a robot would have.
    pub(crate) fn motion(blocks: &[Self], index: usize) -> (Vector, f32) {
        let (block, lane) = place_of(robot(index));
        blocks[block].motion.get(lane)
    }

    /// Part of both that the robot's own wheels gave it.
    pub(crate) fn gain(blocks: &[Self], index: usize) -> (Vector, f32) {
        let (block, lane) = place_of(robot(index));
        blocks[block].gain.get(lane)
    }
}

/// The maximum of the robots' speeds, m/s, and that of their accelerations, m/s².
#[derive(Debug, Clone, Copy)]
pub(crate) struct FastestRobot {
    speed: f32,
    acceleration: f32,
}

impl FastestRobot {
    /// Bound of the speeds of robots within `time` (s) without contacts, m/s.
    pub(crate) fn within(self, time: f32) -> f32 {
        self.speed + self.acceleration * time
    }
}

/// Sub-steps of a tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubSteps {
    /// Length of each, s.
    pub(crate) time: f32,
    pub(crate) count: usize,
}

impl Bodies<Vec<BodyBlock>> {
    /// Bodies at rest in the origin.
    pub(crate) fn new(parameters: &BodyParameters) -> Self {
        let robots = parameters.robots.len();
        Self {
            count: robot(robots),
            ball_mass: parameters.ball.mass,
            blocks: vec![BodyBlock::AT_REST; blocks_of(robots)],
        }
    }
}

impl<B> Bodies<B> {
    /// The same bodies with their blocks in other memory.
    pub(crate) fn map_blocks<C>(self, map: impl FnOnce(B) -> C) -> Bodies<C> {
        Bodies { count: self.count, ball_mass: self.ball_mass, blocks: map(self.blocks) }
    }
}

impl Bodies {
    /// A copy with its blocks in a list.
    pub(crate) fn to_vec(&self) -> Bodies<Vec<BodyBlock>> {
        let Self { count, ball_mass, blocks } = self;
        Bodies { count: *count, ball_mass: *ball_mass, blocks: blocks.to_vec() }
    }

    /// Takes the state of the bodies of another match with as many.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let Self { count, ball_mass, blocks } = other;
        (self.count, self.ball_mass) = (*count, *ball_mass);
        self.blocks.copy_from_slice(blocks);
    }

    /// Number of bodies.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// All bodies, one bit each.
    pub(crate) fn all(&self) -> u64 {
        u64::MAX >> (64 - self.count)
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        let (block, lane) = place_of(body);
        self.blocks[block].motion.get(lane)
    }

    /// Sets the motion of a body. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        let (block, lane) = place_of(body);
        self.blocks[block].motion.set(lane, motion);
    }

    /// Sets position (m) and velocity (m/s) of the ball.
    pub(crate) fn set_ball(&mut self, position: Vector, velocity: Vector) {
        let (block, lane) = place_of(BALL);
        let motion = &mut self.blocks[block].motion;
        motion.position.set(lane, position);
        motion.velocity.set(lane, velocity);
    }

    /// Sets the velocity of a body, m/s.
    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        let (block, lane) = place_of(body);
        self.blocks[block].motion.velocity.set(lane, velocity);
    }

    /// Applies an impulse (N s) to a body, at `arm` (m) from its center of mass.
    pub(crate) fn apply_impulse(
        &mut self,
        parameters: &BodyParameters,
        body: usize,
        impulse: Vector,
        arm: Vector,
    ) {
        let inverse = parameters.inverse(body);
        let (block, lane) = place_of(body);
        let motion = &mut self.blocks[block].motion;
        let velocity = motion.velocity.get(lane) + impulse * inverse.mass;
        motion.velocity.set(lane, velocity);
        motion.angular_velocity.as_mut_array()[lane] += arm.perp_dot(impulse) * inverse.inertia;
    }

    /// Acceleration of a body during the next tick.
    pub(crate) fn acceleration(&self, body: usize) -> Acceleration {
        let (block, lane) = place_of(body);
        let BlockAcceleration { linear, angular } = &self.blocks[block].acceleration;
        Acceleration { linear: linear.get(lane), angular: angular.as_array()[lane] }
    }

    /// Moves all bodies by sub-steps without contacts.
    pub(crate) fn move_freely(&mut self, steps: SubSteps) {
        for block in &mut self.blocks {
            advance(&mut block.motion, &block.acceleration, steps);
        }
    }

    /// Writes the motion of all bodies after `time` (s) without contacts into `undisturbed`, by block.
    pub(crate) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        let time = Lanes::splat(time);
        undisturbed.clear();
        undisturbed.extend(self.blocks.iter().map(|BodyBlock { motion, acceleration, .. }| {
            let gain = Change {
                velocity: acceleration.linear * time,
                angular_velocity: acceleration.angular * time,
            };
            let motion = Change {
                velocity: motion.velocity + gain.velocity,
                angular_velocity: motion.angular_velocity + gain.angular_velocity,
            };
            Undisturbed { motion, gain }
        }));
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(crate) fn ball_was_jammed(&self, parameters: &BodyParameters) -> bool {
        self.ball_mass * parameters.inverse(BALL).mass > 1.0 + f32::EPSILON
    }

    /// The maximum of the robots' speeds, and that of their accelerations.
    pub(crate) fn fastest_robot(&self) -> FastestRobot {
        let (mut speed, mut gain) = (Lanes::ZERO, Lanes::ZERO);
        for (index, BodyBlock { motion, acceleration, .. }) in self.blocks.iter().enumerate() {
            let speeds = motion.velocity.length_squared();
            let speeds = if index == 0 { without_ball(speeds) } else { speeds };
            speed = larger(speed, speeds);
            gain = larger(gain, acceleration.linear.length_squared());
        }
        let most = |squares: Lanes| {
            let squares = squares.to_array().into_iter();
            squares.fold(0.0, |most, square| if square > most { square } else { most })
        };
        FastestRobot { speed: most(speed).sqrt(), acceleration: most(gain).sqrt() }
    }

    /// Robots whose surrounding circle is nearer than `gap` (m) to that of the ball, one bit each.
    pub(crate) fn robots_near_ball(&self, parameters: &BodyParameters, gap: f32) -> u64 {
        let ball = VectorLanes::splat(self.motion(BALL).position);
        let gap = Lanes::splat(gap + parameters.ball.radius);
        let mut near = 0;
        let blocks = self.blocks.iter().zip(&parameters.inertia);
        for (index, (BodyBlock { motion, .. }, inertia)) in blocks.enumerate() {
            let reach = inertia.bounding_radius + gap;
            let bits = (motion.position - ball).length_squared().simd_lt(reach * reach);
            near |= u64::from(bits.to_bitmask()) << (index * LANES);
        }
        // From bodies to robots.
        (near & self.all()) >> robot(0)
    }
}

/// Moves the bodies of a block by sub-steps without contacts.
pub(crate) fn advance(motion: &mut MotionBlock, gain: &BlockAcceleration, steps: SubSteps) {
    let time = Lanes::splat(steps.time);
    motion.advance(gain.linear * time, gain.angular * time, steps.time, steps.count);
}

/// The numbers of the first block with 0 for the ball.
fn without_ball(numbers: Lanes) -> Lanes {
    mask_of(|lane| lane != BALL) & numbers
}

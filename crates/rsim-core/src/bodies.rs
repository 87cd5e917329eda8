//! Bodies of one match: their motions, and all numbers that robots keep from tick to tick.
//!
//! Numbers of a body are in the block of four that its index names, next to those of its neighbors. A
//! block is plain data of fixed size, so the blocks of a match are copied at once.

use serde::{Deserialize, Serialize};

use crate::blocks::{
    BALL, LANES, Lanes, VectorLanes, blocks_of, larger, mask_of, place_of, robot, set_bits,
};
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

/// Motion of a robot without contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Undisturbed {
    /// m/s.
    pub(crate) velocity: Vector,
    /// rad/s.
    pub(crate) angular_velocity: f32,
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

    /// Gives a robot a charged kicker, and wheels and a dribbler that have done nothing yet.
    pub(crate) fn reset_robot(&mut self, index: usize) {
        let (block, lane) = place_of(robot(index));
        let block = &mut self.blocks[block];
        block.acceleration.clear(lane);
        block.drive.clear(lane);
        for number in [&mut block.recharging, &mut block.dribbling, &mut block.collision_speed] {
            number.as_mut_array()[lane] = 0.0;
        }
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

    /// Writes the motion of robots after `time` without contacts into `undisturbed`.
    pub(crate) fn list_undisturbed(&self, time: f32, undisturbed: &mut Vec<Undisturbed>) {
        undisturbed.clear();
        undisturbed.extend((robot(0)..self.len()).map(|body| {
            let (motion, gain) = (self.motion(body), self.acceleration(body));
            Undisturbed {
                velocity: motion.velocity + gain.linear * time,
                angular_velocity: motion.angular_velocity + gain.angular * time,
            }
        }));
    }

    /// Whether the ball was jammed in the solver's last tick.
    pub(crate) fn ball_was_jammed(&self, parameters: &BodyParameters) -> bool {
        self.ball_mass * parameters.inverse(BALL).mass > 1.0 + f32::EPSILON
    }

    /// Bound of the speeds of robots within `time` (s) without contacts, m/s.
    pub(crate) fn fastest_robot(&self, time: f32) -> f32 {
        let (mut speed, mut gain) = (Lanes::ZERO, Lanes::ZERO);
        for (index, BodyBlock { motion, acceleration, .. }) in self.blocks.iter().enumerate() {
            let speeds = motion.velocity.length_squared();
            let speeds = if index == 0 { without_ball(speeds) } else { speeds };
            speed = larger(speed, speeds);
            gain = larger(gain, acceleration.linear.length_squared());
        }
        let most = |squares: Lanes| squares.as_array().iter().fold(0.0, |a: f32, b| a.max(*b));
        most(speed).sqrt() + most(gain).sqrt() * time
    }

    /// Indices of the robots whose surrounding circle is nearer than `gap` (m) to that of the ball.
    pub(crate) fn robots_near_ball(
        &self,
        parameters: &BodyParameters,
        gap: f32,
    ) -> impl Iterator<Item = usize> {
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
        set_bits((near & self.all()) >> robot(0))
    }

    /// Time until the kicker of a robot is charged, s.
    pub(crate) fn recharging(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].recharging.as_array()[lane]
    }

    pub(crate) fn set_recharging(&mut self, index: usize, time: f32) {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].recharging.as_mut_array()[lane] = time;
    }

    /// Speed of a robot's dribbler by its maximum, 0 to 1.
    pub(crate) fn dribbling(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].dribbling.as_array()[lane]
    }

    pub(crate) fn set_dribbling(&mut self, index: usize, speed: f32) {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].dribbling.as_mut_array()[lane] = speed;
    }

    /// Closing speed of a robot's hardest contact with another robot since the control step began, m/s.
    pub(crate) fn collision_speed(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].collision_speed.as_array()[lane]
    }

    /// Records that a robot touched another one at a closing speed, m/s.
    pub(crate) fn add_collision(&mut self, index: usize, closing: f32) {
        let (block, lane) = place_of(robot(index));
        let speed = &mut self.blocks[block].collision_speed.as_mut_array()[lane];
        *speed = speed.max(closing);
    }

    /// Clears the collision speeds for a new control step.
    pub(crate) fn clear_collisions(&mut self) {
        for block in &mut self.blocks {
            block.collision_speed = Lanes::ZERO;
        }
    }

    /// Writes the first `count` warm starts into `all`.
    pub(crate) fn list_warm_starts(&self, count: usize, all: &mut Vec<WarmStart>) {
        all.clear();
        for block in &self.blocks[..count.div_ceil(WARM_STARTS)] {
            let left = (count - all.len()).min(WARM_STARTS);
            all.extend_from_slice(&block.warm_starts[..left]);
        }
    }

    /// Drops those of the first `count` warm starts whose keys fulfill a condition.
    pub(crate) fn drop_warm_starts(&mut self, count: usize, dropped: impl Fn(u16) -> bool) {
        let stored = self.blocks.iter_mut().flat_map(|block| &mut block.warm_starts);
        for warm_start in stored.take(count).filter(|stored| dropped(stored.key)) {
            *warm_start = WarmStart::NONE;
        }
    }

    /// Stores warm starts, and returns their number. Those beyond the capacity are dropped: their pairs
    /// start from no impulse.
    pub(crate) fn store_warm_starts(&mut self, all: impl Iterator<Item = WarmStart>) -> usize {
        let mut count = 0;
        let slots = self.blocks.iter_mut().flat_map(|block| &mut block.warm_starts);
        for (slot, warm_start) in slots.zip(all) {
            *slot = warm_start;
            count += 1;
        }
        count
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::config::SimConfig;
    use crate::state::State;

    fn warm_starts(count: u16) -> impl Iterator<Item = WarmStart> {
        (1..=count).map(|key| WarmStart { key, ..WarmStart::NONE })
    }

    #[test]
    fn warm_starts_fill_the_blocks_in_order_and_those_beyond_are_dropped() {
        let config = SimConfig::vss(3, 3);
        let mut state = State::new(&config, &BodyParameters::of(&config), &[]).boxed();
        let bodies = &mut state.bodies;
        for (given, kept) in [(0, 0), (1, 1), (16, 16), (17, 17), (32, 32), (40, 32)] {
            let count = bodies.store_warm_starts(warm_starts(given));
            assert_eq!(count, kept);
            let mut listed = Vec::new();
            bodies.list_warm_starts(count, &mut listed);
            assert!(listed.iter().map(|one| one.key).eq(1..=given.min(32)), "{given}");
        }
    }
}

//! The bodies of a match at the instants of exposures, which may be within ticks.
//!
//! A tick only records them; cameras look at what was recorded when the step ends. The physics of a step and the
//! senses of some worlds then run one after the other, each from a processor's cache for instructions, which does not
//! hold both.

use crate::blocks::{LANES, Lanes, VectorLanes, place_of, robot};
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::geometry::motion_block::MotionBlock;
use crate::math::{Vec3, Vector};
use crate::senses::detections::Velocities;
use crate::state::State;

/// The bodies at the instants of all exposures of a step of a world.
#[derive(Debug, Default)]
pub(crate) struct Film {
    exposures: Vec<Exposure>,
    /// Motions of the bodies by block, those of an exposure after those of the one before.
    motions: Vec<MotionBlock>,
}

/// Identity of an exposure: its cameras, and its place in time.
#[derive(Debug, Clone, Copy)]
pub(super) struct ExposureId {
    /// Time since the senses began, s.
    pub(super) time: f64,
    /// Number of earlier exposures of the same cameras.
    pub(super) number: u64,
    /// Key of the cameras' random numbers, which differs between teams with cameras of their own.
    pub(super) key: u64,
}

/// Record of an exposure beside the motions.
#[derive(Debug, Clone, Copy)]
struct Exposure {
    id: ExposureId,
    /// Height of the ball's lowest point (m), its vertical velocity (m/s) and its spin (rad/s).
    height: f32,
    v_z: f32,
    spin: Vec3,
    /// Robots on the field, a bit each.
    robots: u64,
}

impl Film {
    /// Records the state `age` (s) ago.
    pub(super) fn expose(&mut self, id: ExposureId, age: f32, state: &State) {
        let ball = &state.ball;
        self.exposures.push(Exposure {
            id,
            height: (ball.z - ball.v_z * age).max(0.0),
            v_z: ball.v_z,
            spin: ball.spin,
            robots: state.bodies.all() >> robot(0) & !state.absent,
        });
        let lanes = Lanes::splat(age);
        let before = |now: &MotionBlock| MotionBlock {
            position: now.position - now.velocity * lanes,
            heading: now.heading - now.heading.perp() * (now.angular_velocity * lanes),
            ..*now
        };
        self.motions.extend(state.bodies.blocks.iter().map(|block| before(&block.motion)));
    }

    /// The bodies at each exposure of the cameras with this key.
    pub(super) fn of<'a>(
        &'a self,
        key: u64,
        parameters: &'a BodyParameters,
    ) -> impl Iterator<Item = Exposed<'a>> {
        let each = self.exposures.iter().zip(self.motions.chunks_exact(parameters.inertia.len()));
        let own = each.filter(move |(exposure, _)| exposure.id.key == key);
        own.map(move |(exposure, motions)| Exposed { exposure, motions, parameters })
    }

    /// Forgets all exposures.
    pub(crate) fn clear(&mut self) {
        self.exposures.clear();
        self.motions.clear();
    }
}

/// The bodies at the instant of an exposure.
#[derive(Clone, Copy)]
pub(super) struct Exposed<'a> {
    exposure: &'a Exposure,
    motions: &'a [MotionBlock],
    pub(super) parameters: &'a BodyParameters,
}

impl Exposed<'_> {
    /// Its cameras, and its place in time.
    pub(super) fn id(&self) -> ExposureId {
        self.exposure.id
    }

    /// A body's motion.
    pub(super) fn motion(&self, body: usize) -> Motion {
        let (block, lane) = place_of(body);
        self.motions[block].get(lane)
    }

    /// The motions of the bodies, by block.
    pub(super) fn motions(&self) -> &[MotionBlock] {
        self.motions
    }

    /// Velocities of the bodies of a block.
    pub(super) fn velocities(&self, block: usize) -> Velocities {
        let MotionBlock { velocity, angular_velocity, .. } = self.motions[block];
        Velocities { linear: velocity, angular: angular_velocity }
    }

    /// Height of the ball's lowest point, m.
    pub(super) fn height(&self) -> f32 {
        self.exposure.height
    }

    /// Vertical velocity of the ball (m/s) and its spin (rad/s).
    pub(super) fn ball_motion(&self) -> (f32, Vec3) {
        (self.exposure.v_z, self.exposure.spin)
    }

    /// Robots on the field, a bit each.
    pub(super) fn robots_on_field(&self) -> u64 {
        self.exposure.robots
    }

    /// Robots on the field whose circles are within `reach` (m) of a point, a bit each.
    pub(super) fn robots_near(&self, point: Vector, reach: f32) -> u64 {
        let sizes = &self.parameters.inertia;
        let blocks = self.motions.iter().zip(sizes).enumerate();
        let bodies = blocks.fold(0, |bits, (block, (motion, sizes))| {
            let reach = sizes.bounding_radius + Lanes::splat(reach);
            let distance = (motion.position - VectorLanes::splat(point)).length_squared();
            bits | u64::from(distance.simd_le(reach * reach).to_bitmask()) << (block * LANES)
        });
        bodies >> robot(0) & self.robots_on_field()
    }
}

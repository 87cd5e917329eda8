//! The bodies of a match at the instant of an exposure, which may be within a tick.

use crate::blocks::{LANES, Lanes, VectorLanes, robot};
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::senses::Watched;
use crate::senses::detections::Velocities;

/// The bodies at the instant of an exposure.
#[derive(Clone, Copy)]
pub(super) struct Exposed<'a> {
    pub(super) watched: Watched<'a>,
    /// Time since the exposure, s.
    pub(super) age: f32,
}

impl Exposed<'_> {
    /// A body's motion at the exposure.
    pub(super) fn motion(&self, body: usize) -> Motion {
        let now = self.watched.state.bodies.motion(body);
        let heading = now.heading - now.heading.perp() * (now.angular_velocity * self.age);
        Motion { position: now.position - now.velocity * self.age, heading, ..now }
    }

    /// Positions of the bodies of a block at the exposure.
    pub(super) fn positions(&self, block: usize) -> VectorLanes {
        let now = &self.watched.state.bodies.blocks[block].motion;
        now.position - now.velocity * Lanes::splat(self.age)
    }

    /// Headings of the bodies of a block at the exposure.
    pub(super) fn headings(&self, block: usize) -> VectorLanes {
        let now = &self.watched.state.bodies.blocks[block].motion;
        now.heading - now.heading.perp() * (now.angular_velocity * Lanes::splat(self.age))
    }

    /// Velocities of the bodies of a block.
    pub(super) fn velocities(&self, block: usize) -> Velocities {
        let now = &self.watched.state.bodies.blocks[block].motion;
        Velocities { linear: now.velocity, angular: now.angular_velocity }
    }

    /// Number of blocks.
    pub(super) fn blocks(&self) -> usize {
        self.watched.state.bodies.blocks.len()
    }

    /// Height of the ball's lowest point, m.
    pub(super) fn height(&self) -> f32 {
        let ball = &self.watched.state.ball;
        (ball.z - ball.v_z * self.age).max(0.0)
    }

    /// Robots on the field, a bit each.
    pub(super) fn robots_on_field(&self) -> u64 {
        let state = self.watched.state;
        state.bodies.all() >> robot(0) & !state.absent
    }

    /// Robots on the field whose circles are within `reach` (m) of a point, a bit each.
    pub(super) fn robots_near(&self, point: Vector, reach: f32) -> u64 {
        let sizes = &self.watched.parameters.inertia;
        let bodies = (0..self.blocks()).fold(0, |bits, block| {
            let reach = sizes[block].bounding_radius + Lanes::splat(reach);
            let distance = (self.positions(block) - VectorLanes::splat(point)).length_squared();
            bits | u64::from(distance.simd_le(reach * reach).to_bitmask()) << (block * LANES)
        });
        bodies >> robot(0) & self.robots_on_field()
    }
}

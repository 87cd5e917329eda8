//! Positions and motions of the bodies of a block.

use serde::{Deserialize, Serialize};

use crate::blocks::{Lanes, VectorLanes};
use crate::geometry::motion::Motion;

/// Position and velocity of the bodies of a block, by columns.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct MotionBlock {
    /// m.
    pub(crate) position: VectorLanes,
    /// Cosine and sine of the headings.
    pub(crate) heading: VectorLanes,
    /// m/s.
    pub(crate) velocity: VectorLanes,
    /// Angular velocities, rad/s, counterclockwise.
    pub(crate) angular_velocity: Lanes,
}

impl MotionBlock {
    /// A block of bodies at rest in the origin.
    pub(crate) const AT_REST: Self = Self {
        position: VectorLanes::ZERO,
        heading: VectorLanes { x: Lanes::ONE, y: Lanes::ZERO },
        velocity: VectorLanes::ZERO,
        angular_velocity: Lanes::ZERO,
    };

    /// Motion of the body in `lane`.
    pub(crate) fn get(&self, lane: usize) -> Motion {
        Motion {
            position: self.position.get(lane),
            heading: self.heading.get(lane),
            velocity: self.velocity.get(lane),
            angular_velocity: self.angular_velocity.as_array()[lane],
        }
    }

    /// Sets the motion of the body in `lane`.
    pub(crate) fn set(&mut self, lane: usize, motion: &Motion) {
        self.position.set(lane, motion.position);
        self.heading.set(lane, motion.heading);
        self.velocity.set(lane, motion.velocity);
        self.angular_velocity.as_mut_array()[lane] = motion.angular_velocity;
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let Self { position, heading, velocity, angular_velocity } = *self;
        let vectors = [position, heading, velocity].into_iter();
        let numbers = vectors.flat_map(|vector| [vector.x, vector.y]).chain([angular_velocity]);
        // A number times 0 is 0 only if it is finite.
        let zero = numbers.fold(Lanes::ZERO, |sum, number| sum + number * Lanes::ZERO);
        zero.simd_eq(Lanes::ZERO).all()
    }

    /// Moves the bodies by `count` steps of `time` (s), each with the given changes of velocity (m/s) and
    /// angular velocity (rad/s).
    pub(crate) fn advance(
        &mut self,
        velocity_change: VectorLanes,
        angular_change: Lanes,
        time: f32,
        count: usize,
    ) {
        let time = Lanes::splat(time);
        let mut heading = self.heading;
        for _ in 0..count {
            self.velocity += velocity_change;
            self.angular_velocity += angular_change;
            self.position += self.velocity * time;
            // To first order, as `rotated`; the product of all rotations is normalized once.
            heading += heading.perp() * (self.angular_velocity * time);
        }
        self.heading = heading * (Lanes::ONE / heading.length_squared().sqrt());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::LANES;
    use crate::geometry::motion::rotated;
    use crate::math::Vector;

    #[test]
    fn a_block_is_finite_if_every_number_of_it_is() {
        assert!(MotionBlock::AT_REST.is_finite());
        for lane in 0..LANES {
            for number in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
                let numbers: [fn(&mut MotionBlock) -> &mut Lanes; 7] = [
                    |block| &mut block.position.x,
                    |block| &mut block.position.y,
                    |block| &mut block.heading.x,
                    |block| &mut block.heading.y,
                    |block| &mut block.velocity.x,
                    |block| &mut block.velocity.y,
                    |block| &mut block.angular_velocity,
                ];
                for of in numbers {
                    let mut block = MotionBlock::AT_REST;
                    of(&mut block).as_mut_array()[lane] = number;
                    assert!(!block.is_finite());
                }
            }
        }
    }

    #[test]
    fn a_body_of_a_block_moves_as_it_would_alone() {
        let motion = Motion {
            position: Vector::new(0.3, -0.2),
            heading: Vector::from_angle(2.0),
            velocity: Vector::new(1.5, 0.4),
            angular_velocity: 30.0,
        };
        let mut block = MotionBlock::AT_REST;
        block.set(2, &motion);
        assert_eq!(block.get(2), motion);
        let (gain, turn) = (Vector::new(0.01, -0.02), 0.3);
        block.advance(VectorLanes::splat(gain), Lanes::splat(turn), 1.25e-3, 4);
        let mut alone = motion;
        for _ in 0..4 {
            alone.velocity += gain;
            alone.angular_velocity += turn;
            alone.position += alone.velocity * 1.25e-3;
            alone.heading = rotated(alone.heading, alone.angular_velocity * 1.25e-3);
        }
        let moved = block.get(2);
        assert!((moved.position - alone.position).length() < 1e-7);
        assert!((moved.heading - alone.heading).length() < 1e-6);
        assert_eq!(
            (moved.velocity, moved.angular_velocity),
            (alone.velocity, alone.angular_velocity)
        );
    }
}

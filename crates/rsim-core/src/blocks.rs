//! Bodies of a match in blocks of four: passes over all bodies compute four at once.
//!
//! Every operation here gives the same bits on every platform: it adds, multiplies, divides, takes
//! square roots or compares. The library's `min` and `max` differ in their signs of zero, and so does
//! a fused multiplication, so this module has its own.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};
use wide::f32x4;

use crate::math::Vector;

/// Index of the ball among the bodies.
pub(crate) const BALL: usize = 0;

/// Index of robot `index` among the bodies.
pub(crate) const fn robot(index: usize) -> usize {
    index + 1
}

/// Number of bodies in a block.
pub(crate) const LANES: usize = 4;

/// A number of each body of a block. As a mask, all bits of a lane are set or none.
pub(crate) type Lanes = f32x4;

/// Number of blocks of a match.
pub(crate) const fn blocks_of(robots: usize) -> usize {
    robot(robots).div_ceil(LANES)
}

/// Block and lane of a body.
pub(crate) const fn place_of(body: usize) -> (usize, usize) {
    (body / LANES, body % LANES)
}

/// Index of the robot in a lane of a block.
pub(crate) const fn robot_at(block: usize, lane: usize) -> usize {
    block * LANES + lane - robot(0)
}

/// Those of `robots`, one bit each, that are in a block, one bit a lane.
pub(crate) fn lanes_of_robots(robots: u64, block: usize) -> u8 {
    #[expect(clippy::cast_possible_truncation, reason = "four bits")]
    let lanes = (robots << robot(0) >> (block * LANES)) as u8;
    lanes & ((1 << LANES) - 1)
}

/// Positions of the bits that are set, from the lowest on.
pub(crate) fn set_bits(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = bits.trailing_zeros();
        bits &= bits.checked_sub(1)?;
        Some(lowest as usize)
    })
}

/// The bits at these positions.
pub(crate) fn bits_of(positions: impl Iterator<Item = usize>) -> u64 {
    positions.fold(0, |bits, position| bits | 1 << position)
}

/// The numbers of a block, by lane.
pub(crate) fn lanes_of(number: impl FnMut(usize) -> f32) -> Lanes {
    Lanes::from(std::array::from_fn::<f32, LANES, _>(number))
}

/// The mask of the lanes for which a condition holds.
pub(crate) fn mask_of(mut holds: impl FnMut(usize) -> bool) -> Lanes {
    lanes_of(|lane| if holds(lane) { f32::from_bits(u32::MAX) } else { 0.0 })
}

/// The mask of the lanes whose bits are set. Further bits are ignored.
pub(crate) fn mask_of_bits(bits: u64) -> Lanes {
    #[expect(clippy::cast_possible_truncation, reason = "four bits")]
    let lanes = bits as usize % MASKS.len();
    MASKS[lanes]
}

/// The masks of all sets of lanes.
static MASKS: [Lanes; 1 << LANES] = {
    let mut masks = [Lanes::ZERO; 1 << LANES];
    let mut bits = 0;
    while bits < masks.len() {
        let mut mask = [0.0; LANES];
        let mut lane = 0;
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                mask[lane] = f32::from_bits(u32::MAX);
            }
            lane += 1;
        }
        masks[bits] = Lanes::new(mask);
        bits += 1;
    }
    masks
};

/// The larger of two numbers, in each lane.
pub(crate) fn larger(one: Lanes, other: Lanes) -> Lanes {
    one.simd_gt(other).bitselect(one, other)
}

/// The smaller of two numbers, in each lane.
pub(crate) fn smaller(one: Lanes, other: Lanes) -> Lanes {
    one.simd_lt(other).bitselect(one, other)
}

/// A number within ±`limit`, in each lane.
pub(crate) fn limited(number: Lanes, limit: Lanes) -> Lanes {
    smaller(larger(number, -limit), limit)
}

/// 1 - x / d (1 - x / e (1 - ...)) with the `divisors` d, e, ...: what the series of sine and cosine are made of.
pub(crate) fn alternating_series<const N: usize>(x: Lanes, divisors: [f32; N]) -> Lanes {
    divisors
        .iter()
        .rev()
        .fold(Lanes::ONE, |next, divisor| Lanes::ONE - x * Lanes::splat(1.0 / divisor) * next)
}

/// A vector of each body of a block.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct VectorLanes {
    pub(crate) x: Lanes,
    pub(crate) y: Lanes,
}

impl VectorLanes {
    pub(crate) const ZERO: Self = Self { x: Lanes::ZERO, y: Lanes::ZERO };

    pub(crate) fn splat(vector: Vector) -> Self {
        Self { x: Lanes::splat(vector.x), y: Lanes::splat(vector.y) }
    }

    /// The vector of one lane.
    pub(crate) fn get(&self, lane: usize) -> Vector {
        Vector::new(self.x.as_array()[lane], self.y.as_array()[lane])
    }

    /// Sets the vector of one lane.
    pub(crate) fn set(&mut self, lane: usize, vector: Vector) {
        self.x.as_mut_array()[lane] = vector.x;
        self.y.as_mut_array()[lane] = vector.y;
    }

    pub(crate) fn dot(self, other: Self) -> Lanes {
        self.x * other.x + self.y * other.y
    }

    pub(crate) fn length_squared(self) -> Lanes {
        self.dot(self)
    }

    /// The vector rotated by a right angle, counterclockwise.
    pub(crate) fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// The vectors in the frames of `heading`, each a cosine and a sine.
    pub(crate) fn seen_from(self, heading: Self) -> Self {
        let x = self.x * heading.x + self.y * heading.y;
        Self { x, y: self.y * heading.x - self.x * heading.y }
    }

    /// The vectors rotated by `heading`, each a cosine and a sine.
    pub(crate) fn rotated_by(self, heading: Self) -> Self {
        let x = self.x * heading.x - self.y * heading.y;
        Self { x, y: self.x * heading.y + self.y * heading.x }
    }

    /// The vectors of at most length `limit`, without a change of direction.
    pub(crate) fn of_length_at_most(self, limit: Lanes) -> Self {
        let squared = self.length_squared();
        let is_longer = squared.simd_gt(limit * limit);
        if !is_longer.any() {
            return self;
        }
        self * is_longer.bitselect(limit / squared.sqrt(), Lanes::ONE)
    }

    /// `self` in the lanes of `mask`, `other` in the others.
    pub(crate) fn where_else(self, mask: Lanes, other: Self) -> Self {
        Self { x: mask.bitselect(self.x, other.x), y: mask.bitselect(self.y, other.y) }
    }
}

impl Add for VectorLanes {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl AddAssign for VectorLanes {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for VectorLanes {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for VectorLanes {
    type Output = Self;

    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl Mul<Lanes> for VectorLanes {
    type Output = Self;

    fn mul(self, factor: Lanes) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vectors() -> VectorLanes {
        VectorLanes { x: Lanes::from([3.0, 0.0, -1.0, 0.6]), y: Lanes::from([4.0, 0.0, 2.0, 0.8]) }
    }

    #[test]
    fn a_length_is_limited_and_a_shorter_one_keeps_its_bits() {
        let limited = vectors().of_length_at_most(Lanes::splat(1.5));
        for lane in 0..LANES {
            let (whole, short) = (vectors().get(lane), limited.get(lane));
            let expected = whole.clamp_length_max(1.5);
            assert!((short - expected).length() < 1e-6, "{short} {expected}");
            assert!(whole.length() > 1.5 || whole == short);
        }
    }

    #[test]
    fn rotations_of_all_lanes_are_those_of_each_vector() {
        let heading = VectorLanes::splat(Vector::from_angle(0.7));
        for lane in 0..LANES {
            let own = vectors().seen_from(heading).get(lane);
            let expected = Vector::from_angle(-0.7).rotate(vectors().get(lane));
            assert!((own - expected).length() < 1e-6, "{own} {expected}");
            let back = vectors().seen_from(heading).rotated_by(heading).get(lane);
            assert!((back - vectors().get(lane)).length() < 1e-6, "{back}");
        }
    }

    #[test]
    fn comparisons_choose_by_lane_with_equal_bits_everywhere() {
        let (one, other) =
            (Lanes::from([1.0, -2.0, 0.0, -0.0]), Lanes::from([2.0, -3.0, -0.0, 0.0]));
        let bits = |lanes: Lanes| lanes.to_array().map(f32::to_bits);
        let expected = Lanes::from([2.0, -2.0, -0.0, 0.0]);
        assert_eq!(bits(larger(one, other)), bits(expected), "of equal numbers the second");
        let expected = Lanes::from([1.0, -1.5, 0.0, -0.0]);
        assert_eq!(bits(limited(one, Lanes::splat(1.5))), bits(expected));
    }

    #[test]
    fn set_bits_are_listed_in_order() {
        assert_eq!(set_bits(0b1001_0010).collect::<Vec<_>>(), [1, 4, 7]);
        assert_eq!(set_bits(1 << 63).collect::<Vec<_>>(), [63]);
        assert_eq!(set_bits(0).count(), 0);
        assert_eq!(bits_of(set_bits(0b1001_0010)), 0b1001_0010);
    }

    #[test]
    fn every_body_has_its_own_lane() {
        assert_eq!(
            [place_of(BALL), place_of(robot(2)), place_of(robot(3))],
            [(0, 0), (0, 3), (1, 0)]
        );
        assert_eq!([1, 3, 4, 22].map(blocks_of), [1, 1, 2, 6]);
        for index in 0..22 {
            let (block, lane) = place_of(robot(index));
            assert_eq!(robot_at(block, lane), index);
            assert_eq!(lanes_of_robots(1 << index, block), 1 << lane);
        }
    }
}

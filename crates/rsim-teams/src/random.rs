//! Random numbers by counting: a number depends on seed, counter and robot, and on nothing else.

/// Random numbers of a team in a match.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Random {
    seed: u32,
    counter: u32,
}

impl Random {
    /// Numbers of a seed at a count.
    pub(crate) const fn new(seed: u32, counter: u32) -> Self {
        Self { seed, counter }
    }

    /// The seed.
    pub(crate) const fn seed(self) -> u32 {
        self.seed
    }

    /// Number from -1 to 1, equally likely everywhere, for a robot and a purpose.
    #[allow(clippy::cast_precision_loss)] // the upper 24 bits are exact
    pub(crate) fn uniform(self, robot: usize, purpose: u32) -> f32 {
        #[allow(clippy::cast_possible_truncation)] // fewer than 2^32 robots
        let robot = robot as u32;
        let counter = mixed(self.counter ^ mixed(robot << 8 | purpose));
        let bits = mixed(self.seed ^ counter) >> 8;
        bits as f32 / 8_388_608.0 - 1.0
    }

    /// Number with mean 0 and standard deviation 1, at most 3: the sum of nine equally likely ones.
    pub(crate) fn normal(self, robot: usize, purpose: u32) -> f32 {
        let sum: f32 = (0..9).map(|nth| self.uniform(robot, purpose << 4 | nth)).sum();
        sum / 3_f32.sqrt()
    }
}

/// Mixes all bits into all bits, one to one (Murmur's finalizer with constants of C. Wellons' search).
const fn mixed(mut bits: u32) -> u32 {
    bits = bits.wrapping_add(0x9e37_79b9);
    bits = (bits ^ bits >> 16).wrapping_mul(0x21f0_aaad);
    bits = (bits ^ bits >> 15).wrapping_mul(0x735a_2d97);
    bits ^ bits >> 15
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_moments_that_they_claim() {
        let draws: Vec<f32> = (0..4000).map(|n| Random::new(7, n).normal(3, 1)).collect();
        let mean = draws.iter().sum::<f32>() / 4000.0;
        let variance = draws.iter().map(|draw| draw * draw).sum::<f32>() / 4000.0;
        assert!(mean.abs() < 0.05 && (variance - 1.0).abs() < 0.08, "{mean} {variance}");
    }

    #[test]
    fn numbers_differ_by_seed_counter_robot_and_purpose() {
        let base = Random::new(1, 2).uniform(3, 4);
        assert_eq!(base.to_bits(), Random::new(1, 2).uniform(3, 4).to_bits());
        for other in [
            Random::new(2, 2).uniform(3, 4),
            Random::new(1, 3).uniform(3, 4),
            Random::new(1, 2).uniform(4, 4),
            Random::new(1, 2).uniform(3, 5),
        ] {
            assert!((base - other).abs() > 1e-6);
        }
    }
}

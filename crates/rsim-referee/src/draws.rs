//! Random numbers of a match, whose state is a column of its row.

use crate::vector::Vector;

const BITS: u32 = 24;
const MASK: u32 = (1 << BITS) - 1;

/// State of the random numbers: a whole number below 2^24, so that a column holds it exactly. Matches with
/// other states draw other numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Draws(u32);

impl Draws {
    /// Numbers that a seed gives, by its lowest 24 bits.
    pub const fn new(seed: u32) -> Self {
        Self(seed & MASK)
    }

    /// The state.
    pub(crate) const fn state(self) -> u32 {
        self.0
    }

    /// A vector whose components are uniform from `-limit` to `limit`. A limit of 0 draws nothing.
    pub(crate) fn within(&mut self, limit: f32) -> Vector {
        if limit == 0.0 {
            return Vector::default();
        }
        let x = self.signed_unit();
        Vector::new(x, self.signed_unit()) * limit
    }

    /// A number from -1 to 1.
    #[allow(clippy::cast_precision_loss)] // below 2^24
    fn signed_unit(&mut self) -> f32 {
        // A linear congruential generator, whose period is 2^24, and the finalizer of MurmurHash3 on its state,
        // whose low bits are poor.
        self.0 = self.0.wrapping_mul(1_140_671_485).wrapping_add(12_820_163) & MASK;
        let mut word = self.0;
        word = (word ^ (word >> 16)).wrapping_mul(0x85eb_ca6b);
        word = (word ^ (word >> 13)).wrapping_mul(0xc2b2_ae35);
        word ^= word >> 16;
        (word >> (32 - BITS)) as f32 / (1 << (BITS - 1)) as f32 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_uniform_and_independent() {
        let (mut stream, count) = (Draws::new(7), 20_000);
        let drawn: Vec<Vector> = (0..count).map(|_| stream.within(2.0)).collect();
        let mean = |value: fn(&Vector) -> f32| {
            drawn.iter().map(|drawn| f64::from(value(drawn))).sum::<f64>() / f64::from(count)
        };
        assert!(drawn.iter().all(|drawn| drawn.x.abs() <= 2.0 && drawn.y.abs() <= 2.0));
        assert!(mean(|drawn| drawn.x).abs() < 0.03 && mean(|drawn| drawn.y).abs() < 0.03);
        assert!((mean(|drawn| drawn.x * drawn.x) - 4.0 / 3.0).abs() < 0.04);
        assert!((mean(|drawn| drawn.y * drawn.y) - 4.0 / 3.0).abs() < 0.04);
        assert!(mean(|drawn| drawn.x * drawn.y).abs() < 0.04);
    }

    #[test]
    fn equal_seeds_draw_equal_numbers_and_others_do_not() {
        let first = |seed| Draws::new(seed).within(1.0);
        assert_eq!(first(3), first(3));
        assert_eq!(first(3), first(3 + (1 << BITS)));
        assert_ne!(first(3), first(4));
    }

    #[test]
    fn without_a_limit_nothing_is_drawn() {
        let mut draws = Draws::new(9);
        assert_eq!(draws.within(0.0), Vector::default());
        assert_eq!(draws, Draws::new(9));
    }
}

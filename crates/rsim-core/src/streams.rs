//! Random number streams, one a world, which the caller keeps: `SplitMix64` (Steele, Lea and Flood, OOPSLA
//! 2014), a counter with a fixed stride and a mixing function of its state.

/// Stride of the counters: the odd number next to 2^64 by the golden ratio.
pub(crate) const STRIDE: u64 = 0x9E37_79B9_7F4A_7C15;

/// Step of a number with 24 bits, which f32 holds exactly.
const UNIT: f32 = 1.0 / 16_777_216.0;

/// Mixes a word, so that every bit depends on every bit of the input.
pub(crate) fn mixed(word: u64) -> u64 {
    let word = (word ^ (word >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    word ^ (word >> 31)
}

/// The next `count` words of each stream, one after the other; streams do not advance.
pub fn words(states: &[u64], count: usize) -> impl Iterator<Item = u64> {
    states.iter().flat_map(move |state| {
        let mut counter = *state;
        (0..count).map(move |_| {
            counter = counter.wrapping_add(STRIDE);
            mixed(counter)
        })
    })
}

/// The number of the first 24 bits of a word, from 0 to below 1.
pub fn unit(word: u64) -> f32 {
    whole(word >> 40) * UNIT
}

/// Two numbers of a word from which the Box-Muller transform makes two normal ones: the first above 0 and up to
/// 1, the second from 0 to below 1.
pub fn units(word: u64) -> [f32; 2] {
    [(whole(word >> 40) + 1.0) * UNIT, whole(word >> 8 & 0xFF_FFFF) * UNIT]
}

/// Two numbers of the standard normal distribution of a word, by the transform of Box and Muller (Annals of Mathematical
/// Statistics 29(2), 1958).
pub fn normals(word: u64) -> [f32; 2] {
    let [radius, angle] = units(word);
    let radius = libm::sqrtf(-2.0 * libm::logf(radius));
    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * angle);
    [radius * cos, radius * sin]
}

#[expect(clippy::cast_precision_loss, reason = "24 bits fit exactly")]
fn whole(bits: u64) -> f32 {
    bits as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_splitmix64() {
        // First outputs for the seed 0, as published with Vigna's reference code.
        let expected = [0xE220_A839_7B1D_CDAF, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F];
        assert!(words(&[0], 3).eq(expected));
    }

    #[test]
    fn each_stream_has_its_own_words() {
        let alone = |state: u64| words(&[state], 4).collect::<Vec<_>>();
        let together: Vec<_> = words(&[5, 5, 9], 4).collect();
        assert_eq!(together, [alone(5), alone(5), alone(9)].concat());
        assert_ne!(alone(5), alone(9));
    }

    #[test]
    fn numbers_of_a_word_lie_in_their_ranges() {
        assert_eq!((unit(0), units(0)), (0.0, [UNIT, 0.0]));
        let below = 1.0 - UNIT;
        assert_eq!((unit(u64::MAX), units(u64::MAX)), (below, [1.0, below]));
    }
}

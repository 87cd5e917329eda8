//! Random numbers of senses: counter-based, so that no order of calls matters.

use std::sync::LazyLock;

use crate::blocks::{Lanes, set_bits};
use crate::math::Vector;
use crate::streams::{STRIDE, mixed, unit};

/// Purpose of random numbers. The numbers of two purposes are independent.
#[derive(Debug, Clone, Copy)]
pub(super) enum Purpose {
    /// Errors that last for an episode.
    Episode = 1,
    /// A frame of the cameras.
    Frame = 2,
    /// A report of the robots' own sensors.
    Report = 3,
    /// A command on its way.
    Command = 4,
    /// A restart of the trackers.
    Look = 5,
}

/// The random numbers of one event: those of `SplitMix64` (Steele, Lea and Flood, OOPSLA 2014) from a start
/// that the match's key, the purpose and the event's number determine.
pub(super) struct Draws {
    word: u64,
    layers: &'static Layers,
}

impl Draws {
    /// The numbers of event `number` of a purpose, in the match with this key.
    pub(super) fn of(key: u64, purpose: Purpose, number: u64) -> Self {
        let event = mixed(number.wrapping_mul(STRIDE) ^ ((purpose as u64) << 56));
        Self { word: mixed(key.wrapping_add(STRIDE) ^ event), layers: &LAYERS }
    }

    fn next(&mut self) -> u64 {
        self.word = self.word.wrapping_add(STRIDE);
        mixed(self.word)
    }

    /// A number from 0 to below 1, with 24 bits.
    pub(super) fn uniform(&mut self) -> f32 {
        unit(self.next())
    }

    /// Whether something of this probability happens. Nothing is drawn for 0.
    pub(super) fn happens(&mut self, probability: f32) -> bool {
        probability > 0.0 && self.uniform() < probability
    }

    /// The things of `count` that happen with this probability each, one bit a thing. Nothing is drawn for 0.
    ///
    /// One number tells which one is the next: powers of the probability that a thing does not happen part
    /// the interval from 0 to 1. What happens seldom costs one number for all things.
    pub(super) fn which(&mut self, probability: f32, count: usize) -> u64 {
        if probability <= 0.0 {
            return 0;
        }
        let (mut happen, mut number, mut power) = (0, self.uniform(), 1.0);
        // By Bernoulli's inequality no power is smaller, but for rounding.
        #[expect(clippy::cast_precision_loss, reason = "at most 64")]
        if number < 1.0 - probability * count as f32 - 1e-5 {
            return 0;
        }
        for index in 0..count {
            power *= 1.0 - probability;
            if number >= power {
                happen |= 1 << index;
                (number, power) = (self.uniform(), 1.0);
            }
        }
        happen
    }

    /// A number from -1 to 1.
    pub(super) fn deviation(&mut self) -> f32 {
        2.0 * self.uniform() - 1.0
    }

    /// A number of a normal distribution with this standard deviation. Nothing is drawn for 0.
    pub(super) fn normal(&mut self, deviation: f32) -> f32 {
        if deviation > 0.0 { deviation * self.standard_normal() } else { 0.0 }
    }

    /// Two numbers of a normal distribution with this standard deviation, from one word. Nothing is drawn
    /// for 0.
    pub(super) fn normals(&mut self, deviation: f32) -> Vector {
        if deviation <= 0.0 {
            return Vector::ZERO;
        }
        let word = self.next();
        #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
        let lower = word as u32;
        deviation * Vector::new(self.shaped(upper(word)), self.shaped(lower))
    }

    /// Numbers of a normal distribution with this standard deviation for the bodies of a block. Nothing is drawn
    /// for 0.
    pub(super) fn normal_lanes(&mut self, deviation: f32) -> Lanes {
        if deviation <= 0.0 {
            return Lanes::ZERO;
        }
        let [first, second] = [self.next(), self.next()];
        #[expect(clippy::cast_possible_truncation, reason = "the lower halves")]
        let bits = [upper(first), first as u32, upper(second), second as u32];
        let layers = bits.map(|bits| (bits & 127) as usize);
        let x = Lanes::from(bits.map(position)) * Lanes::from(layers.map(|at| self.layers.x[at]));
        let inner = Lanes::from(layers.map(|layer| self.layers.x[layer + 1]));
        let beyond = !(x.simd_lt(inner) & (-x).simd_lt(inner));
        let mut numbers = x.to_array();
        for lane in set_bits(beyond.to_bitmask().into()) {
            numbers[lane] = self.outside(layers[lane], numbers[lane]);
        }
        Lanes::splat(deviation) * Lanes::from(numbers)
    }

    /// A number of the standard normal distribution.
    fn standard_normal(&mut self) -> f32 {
        let bits = upper(self.next());
        self.shaped(bits)
    }

    /// A number of the standard normal distribution from random bits, by the ziggurat method (Marsaglia and
    /// Tsang, Journal of Statistical Software 5(8), 2000) with a layer and a position from one word.
    #[inline]
    fn shaped(&mut self, bits: u32) -> f32 {
        let layer = (bits & 127) as usize;
        let x = position(bits) * self.layers.x[layer];
        if x.abs() < self.layers.x[layer + 1] { x } else { self.outside(layer, x) }
    }

    /// The number for a position outside the part of a layer that is below the density everywhere.
    #[cold]
    fn outside(&mut self, mut layer: usize, mut x: f32) -> f32 {
        let layers = self.layers;
        loop {
            if layer == 0 {
                return self.tail(x < 0.0);
            }
            let between = layers.density[layer + 1] - layers.density[layer];
            if layers.density[layer] + between * self.uniform() < density(x) {
                return x;
            }
            let bits = upper(self.next());
            layer = (bits & 127) as usize;
            x = position(bits) * layers.x[layer];
            if x.abs() < layers.x[layer + 1] {
                return x;
            }
        }
    }

    /// A number beyond the last layer, as Marsaglia's method for tails has it.
    fn tail(&mut self, negative: bool) -> f32 {
        loop {
            let x = -libm::logf(1.0 - self.uniform()) / LAST;
            let y = -libm::logf(1.0 - self.uniform());
            if 2.0 * y >= x * x {
                return if negative { -(LAST + x) } else { LAST + x };
            }
        }
    }
}

/// The upper half of a word.
fn upper(word: u64) -> u32 {
    (word >> 32) as u32
}

/// A position in a layer from -1 to below 1, by the bits that do not tell the layer.
fn position(bits: u32) -> f32 {
    #[expect(clippy::cast_precision_loss, reason = "24 bits fit exactly")]
    let number = (bits >> 8) as f32;
    number * (1.0 / 8_388_608.0) - 1.0
}

/// Start of the tail, and area of a layer, of 128 layers.
const LAST: f32 = 3.442_619_8;
const AREA: f32 = 9.912_563e-3;

/// Right ends of the layers under the density, from the lowest one, and the density there.
struct Layers {
    x: [f32; 129],
    density: [f32; 129],
}

static LAYERS: LazyLock<Layers> = LazyLock::new(|| {
    let mut x = [0.0; 129];
    x[0] = AREA / density(LAST);
    x[1] = LAST;
    for layer in 2..128 {
        let above = AREA / x[layer - 1] + density(x[layer - 1]);
        x[layer] = libm::sqrtf(-2.0 * libm::logf(above));
    }
    Layers { x, density: x.map(density) }
});

/// The normal density without its factor: 1 at 0.
fn density(x: f32) -> f32 {
    libm::expf(-0.5 * x * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_the_moments_and_tails_of_the_distribution() {
        let mut draws = Draws::of(1, Purpose::Frame, 0);
        let count = 400_000;
        let mut numbers: Vec<f64> = (0..count / 2).map(|_| draws.normal(1.0).into()).collect();
        numbers.extend((0..count / 8).flat_map(|_| draws.normals(1.0).to_array().map(f64::from)));
        numbers.extend(
            (0..count / 16).flat_map(|_| draws.normal_lanes(1.0).to_array().map(f64::from)),
        );
        let mean_of =
            |f: &dyn Fn(f64) -> f64| numbers.iter().map(|&x| f(x)).sum::<f64>() / f64::from(count);
        assert!(mean_of(&|x| x).abs() < 0.005);
        assert!((mean_of(&|x| x * x) - 1.0).abs() < 0.01);
        assert!((mean_of(&|x| x.powi(4)) - 3.0).abs() < 0.08);
        for (beyond, expected) in [(1.0, 0.3173), (2.0, 0.0455), (3.0, 0.0027), (3.5, 0.000_465)] {
            let part = mean_of(&|x| f64::from(u8::from(x.abs() > beyond)));
            let deviation = (expected / f64::from(count)).sqrt();
            assert!((part - expected).abs() < 5.0 * deviation, "beyond {beyond}: {part}");
        }
    }

    #[test]
    fn both_numbers_of_a_word_are_independent() {
        let mut draws = Draws::of(4, Purpose::Frame, 0);
        let count = 200_000_u32;
        let pairs: Vec<Vector> = (0..count).map(|_| draws.normals(2.0)).collect();
        let product = pairs.iter().map(|pair| f64::from(pair.x * pair.y)).sum::<f64>();
        assert!((product / f64::from(count)).abs() < 4.0 * 5.0 / f64::from(count).sqrt());
        let both = pairs.iter().filter(|pair| pair.abs().min_element() > 2.0).count();
        let expected = 0.3173 * 0.3173 * f64::from(count);
        let both = f64::from(u32::try_from(both).expect("few"));
        assert!((both - expected).abs() < 5.0 * expected.sqrt(), "{both} of {expected}");
        assert_eq!(draws.normals(0.0), Vector::ZERO);
    }

    #[test]
    fn each_thing_happens_with_its_probability_and_independently_of_others() {
        let mut draws = Draws::of(5, Purpose::Report, 0);
        let count = 100_000_u32;
        for probability in [0.001, 0.05, 0.5] {
            let all: Vec<u64> = (0..count).map(|_| draws.which(probability, 6)).collect();
            let share = |mask: u64| {
                let hits = all.iter().filter(|&&which| which & mask == mask).count();
                f64::from(u32::try_from(hits).expect("few")) / f64::from(count)
            };
            let masks: [u64; 6] = [0b1, 0b10, 0b10_0000, 0b11, 0b10_0001, 0b1_0010];
            for mask in masks {
                let expected = f64::from(probability).powi(mask.count_ones().cast_signed());
                let deviation = (expected / f64::from(count)).sqrt();
                let got = share(mask);
                assert!((got - expected).abs() < 5.0 * deviation + 2e-5, "{mask:b}: {got}");
            }
            assert!(all.iter().all(|which| which >> 6 == 0));
        }
        assert_eq!((draws.which(0.0, 6), draws.which(1.0, 6)), (0, 0b11_1111));
    }

    #[test]
    fn events_keys_and_purposes_have_numbers_of_their_own() {
        let first = |key, purpose, number| Draws::of(key, purpose, number).next();
        let all = [
            first(1, Purpose::Frame, 0),
            first(1, Purpose::Frame, 1),
            first(2, Purpose::Frame, 0),
            first(1, Purpose::Report, 0),
            first(0, Purpose::Frame, 0),
        ];
        for (index, one) in all.iter().enumerate() {
            assert!(!all[..index].contains(one));
        }
        assert_eq!(first(1, Purpose::Frame, 1), all[1]);
    }
}

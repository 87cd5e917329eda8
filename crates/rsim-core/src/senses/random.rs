//! Random numbers of senses: counter-based, so that no order of calls matters.

use wide::bytemuck::cast;
use wide::{i32x4, u32x4};

use crate::blocks::{Lanes, VectorLanes, alternating_series};
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
    /// Numbers of the standard normal distribution that were drawn with others.
    spare: Option<Lanes>,
}

impl Draws {
    /// The numbers of event `number` of a purpose, in the match with this key.
    pub(super) fn of(key: u64, purpose: Purpose, number: u64) -> Self {
        let event = mixed(number.wrapping_mul(STRIDE) ^ ((purpose as u64) << 56));
        Self { word: mixed(key.wrapping_add(STRIDE) ^ event), spare: None }
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

    /// Those of `things`, one bit each, that happen with this probability each. Nothing is drawn for 0, or for no
    /// things.
    pub(super) fn which_of(&mut self, probability: f32, things: u64) -> u64 {
        let count = u64::BITS - things.leading_zeros();
        if count == 0 { 0 } else { self.which(probability, count as usize) & things }
    }

    /// A number from -1 to 1.
    pub(super) fn deviation(&mut self) -> f32 {
        2.0 * self.uniform() - 1.0
    }

    /// A number of a normal distribution with this standard deviation. Nothing is drawn for 0.
    pub(super) fn normal(&mut self, deviation: f32) -> f32 {
        self.normals(deviation).x
    }

    /// Two numbers of a normal distribution with this standard deviation. Nothing is drawn for 0.
    pub(super) fn normals(&mut self, deviation: f32) -> Vector {
        if deviation <= 0.0 {
            return Vector::ZERO;
        }
        let word = self.next();
        deviation * standard_normals([word; 2]).get(0)
    }

    /// Vectors whose coordinates are of normal distributions with these standard deviations, for the bodies of a block.
    /// Nothing is drawn if all are 0.
    pub(super) fn normal_vectors(&mut self, deviations: Lanes) -> VectorLanes {
        if deviations == Lanes::ZERO {
            return VectorLanes::ZERO;
        }
        self.standard_vectors() * deviations
    }

    /// Numbers of a normal distribution with this standard deviation for the bodies of a block. Nothing is drawn
    /// for 0.
    pub(super) fn normal_lanes(&mut self, deviation: f32) -> Lanes {
        if deviation <= 0.0 {
            return Lanes::ZERO;
        }
        let standard = self.spare.take().unwrap_or_else(|| {
            let VectorLanes { x, y } = self.standard_vectors();
            self.spare = Some(y);
            x
        });
        Lanes::splat(deviation) * standard
    }

    fn standard_vectors(&mut self) -> VectorLanes {
        standard_normals([self.next(), self.next()])
    }
}

/// Vectors whose coordinates are of the standard normal distribution, by the transform of Box and Muller (Annals of
/// Mathematical Statistics 29(2), 1958): a length and a direction from 16 bits each. Both are by series, with errors of
/// some hundred-thousandths. No length is above 4.86, as one in 130,000 would be.
fn standard_normals(words: [u64; 2]) -> VectorLanes {
    let whole = |shift: u32| {
        #[expect(clippy::cast_possible_truncation, reason = "16 bits")]
        let lowest = |word: u64| i32::from(word as u16);
        let [one, other] = words.map(|word| word >> shift);
        i32x4::from([one, one >> 32, other, other >> 32].map(lowest)).round_float()
    };
    // Between 0 and 1.
    let uniform = (whole(0) + Lanes::HALF) * Lanes::splat(1.0 / 65_536.0);
    let length = (Lanes::splat(-2.0) * logarithm(uniform)).sqrt();
    // From minus to plus a right angle; twice that is the direction.
    let half_turn =
        (whole(16) - Lanes::splat(32_768.0)) * Lanes::splat(std::f32::consts::PI / 65_536.0);
    let square = half_turn * half_turn;
    let sin = half_turn * alternating_series(square, [6.0, 20.0, 42.0, 72.0]);
    let cos = alternating_series(square, [2.0, 12.0, 30.0, 56.0]);
    let double = sin + sin;
    VectorLanes { x: Lanes::ONE - double * sin, y: double * cos } * length
}

/// Bits of 1.
const ONE: u32 = 1.0_f32.to_bits();

/// Logarithms of numbers above 0, up to 1, to 1.3e-5: those of 2 by their exponents, and a series of
/// the hyperbolic tangent's inverse for the rest.
fn logarithm(numbers: Lanes) -> Lanes {
    let bits: u32x4 = cast(numbers);
    let exponents: i32x4 = cast(bits >> 23);
    let rest: Lanes = cast(bits & u32x4::splat((1 << 23) - 1) | u32x4::splat(ONE));
    let tanh = (rest - Lanes::ONE) / (rest + Lanes::ONE);
    let square = tanh * tanh;
    let [third, fifth, seventh] = [1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0].map(Lanes::splat);
    let series = tanh * (Lanes::ONE + square * (third + square * (fifth + square * seventh)));
    (exponents - i32x4::splat(127)).round_float() * Lanes::LN_2 + series + series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::LANES;

    #[test]
    fn normal_numbers_have_the_moments_and_tails_of_the_distribution() {
        let mut draws = Draws::of(1, Purpose::Frame, 0);
        let count = 400_000;
        let mut numbers: Vec<f64> = (0..count / 4).map(|_| draws.normal(1.0).into()).collect();
        numbers.extend((0..count / 8).flat_map(|_| draws.normals(1.0).to_array().map(f64::from)));
        numbers.extend(
            (0..count / 16).flat_map(|_| draws.normal_lanes(1.0).to_array().map(f64::from)),
        );
        numbers.extend((0..count / 32).flat_map(|_| {
            let VectorLanes { x, y } = draws.normal_vectors(Lanes::ONE);
            [x.to_array(), y.to_array()].concat().into_iter().map(f64::from)
        }));
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
    fn numbers_of_a_block_are_independent() {
        let mut draws = Draws::of(6, Purpose::Frame, 0);
        let count = 50_000_u16;
        let mut products = [[0.0; LANES]; 4];
        for _ in 0..count {
            let vectors = draws.normal_vectors(Lanes::ONE);
            // The second is what the first left over.
            let [one, other] = [(); 2].map(|()| draws.normal_lanes(1.0));
            let next = vectors.x.to_array().map(|x| x * vectors.x.as_array()[0]);
            let all = [vectors.x * vectors.y, one * other, one * vectors.x, Lanes::from(next)];
            for (sums, product) in products.iter_mut().zip(all) {
                for (sum, product) in sums.iter_mut().zip(product.to_array()) {
                    *sum += f64::from(product) / f64::from(count);
                }
            }
        }
        let bound = 5.0 / f64::from(count).sqrt();
        assert!((products[3][0] - 1.0).abs() < 2.0 * bound, "{products:?}");
        products[3][0] = 0.0;
        assert!(products.as_flattened().iter().all(|mean| mean.abs() < bound), "{products:?}");
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

//! Random numbers of senses: counter-based, so that no order of calls matters.

use wide::bytemuck::cast;
use wide::{i32x4, u32x4, u64x2};

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
    /// Delays of frames, and of commands, that differ little from one to the next.
    FrameDelay = 6,
    CommandDelay = 7,
}

/// The random numbers of one event: those of `SplitMix64` (Steele, Lea and Flood, OOPSLA 2014) from a start
/// that the match's key, the purpose and the event's number determine.
pub(super) struct Draws {
    word: u64,
    /// Numbers of the standard normal distribution that were drawn with others.
    spare: Option<PoseNoise>,
}

/// Noise of the places and headings of four bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoseNoise {
    pub(super) place: VectorLanes,
    pub(super) turn: Lanes,
}

impl Draws {
    /// The numbers of event `number` of a purpose, in the match with this key.
    pub(super) fn of(key: u64, purpose: Purpose, number: u64) -> Self {
        let event = mixed(number.wrapping_mul(STRIDE) ^ ((purpose as u64) << 56));
        Self { word: mixed(key.wrapping_add(STRIDE) ^ event), spare: None }
    }

    /// A word of random bits.
    pub(super) fn next(&mut self) -> u64 {
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
        let [vectors] = standard_normals([[word; 2]]);
        deviation * vectors.get(0)
    }

    /// Normal numbers for the bodies of a block: of places with standard deviations for each, and of turns with one for
    /// all. Nothing is drawn if all are 0.
    pub(super) fn poses(&mut self, places: Lanes, turn: f32) -> PoseNoise {
        if places == Lanes::ZERO && turn == 0.0 {
            return PoseNoise { place: VectorLanes::ZERO, turn: Lanes::ZERO };
        }
        let standard = self.spare.take().unwrap_or_else(|| self.two_poses());
        PoseNoise { place: standard.place * places, turn: standard.turn * Lanes::splat(turn) }
    }

    /// Numbers of the standard normal distribution for a block. Those for one more are spare.
    fn two_poses(&mut self) -> PoseNoise {
        let words = std::array::from_fn(|_| [self.next(), self.next()]);
        let [place, turns, other] = standard_normals(words);
        self.spare = Some(PoseNoise { place: other, turn: turns.y });
        PoseNoise { place, turn: turns.x }
    }

    /// Numbers of a normal distribution with this standard deviation for the bodies of a block. Nothing is drawn
    /// for 0.
    pub(super) fn normal_lanes(&mut self, deviation: f32) -> Lanes {
        self.poses(Lanes::ZERO, deviation).turn
    }
}

/// Vectors whose coordinates are of the standard normal distribution, by the transform of Box and Muller (Annals of
/// Mathematical Statistics 29(2), 1958): a length and a direction from 16 bits each. Both are by series, with errors of
/// some hundred-thousandths. No length is above 4.86, as one in 130,000 would be.
///
/// Each step of the transform is done for all vectors: one alone waits for its step before.
fn standard_normals<const N: usize>(words: [[u64; 2]; N]) -> [VectorLanes; N] {
    let whole = |bits: u32x4| cast::<_, i32x4>(bits).round_float();
    let halves: [u32x4; N] = words.map(|words| cast(u64x2::from(words)));
    // Between 0 and 1.
    let uniform = halves.map(|halves| {
        (whole(halves & u32x4::splat(0xffff)) + Lanes::HALF) * Lanes::splat(1.0 / 65_536.0)
    });
    let squares = logarithms(uniform).map(|logarithm| logarithm * Lanes::splat(-2.0));
    let lengths = squares.map(Lanes::sqrt);
    // From minus to plus a right angle; twice that is the direction.
    let half_turns = halves.map(|halves| {
        (whole(halves >> 16) - Lanes::splat(32_768.0))
            * Lanes::splat(std::f32::consts::PI / 65_536.0)
    });
    let directions = half_turns.map(|half_turn| {
        let square = half_turn * half_turn;
        let sin = half_turn * alternating_series(square, [6.0, 20.0, 42.0, 72.0]);
        let cos = alternating_series(square, [2.0, 12.0, 30.0, 56.0]);
        let double = sin + sin;
        VectorLanes { x: Lanes::ONE - double * sin, y: double * cos }
    });
    std::array::from_fn(|nth| directions[nth] * lengths[nth])
}

/// Bits of 1.
const ONE: u32 = 1.0_f32.to_bits();

/// Logarithms of numbers above 0, up to 1, to 1.1e-5: those of 2 by their exponents, and for the rest from 1 to 2 a
/// polynomial that is exact at both ends, so that no logarithm is above 0. Of all with its degree it has the least
/// maximum error.
fn logarithms<const N: usize>(numbers: [Lanes; N]) -> [Lanes; N] {
    let bits: [u32x4; N] = numbers.map(cast);
    let beyond = bits.map(|bits| {
        let rest: Lanes = cast(bits & u32x4::splat((1 << 23) - 1) | u32x4::splat(ONE));
        rest - Lanes::ONE
    });
    let [a, b, c, d] = [0.306_313_5, -0.185_194_6, 0.102_881_4, -0.031_294_89].map(Lanes::splat);
    let rests = beyond.map(|x| {
        let between = (a + b * x) + x * x * (c + d * x);
        x * (Lanes::LN_2 + (Lanes::ONE - x) * between)
    });
    std::array::from_fn(|nth| {
        let exponents: i32x4 = cast(bits[nth] >> 23);
        (exponents - i32x4::splat(127)).round_float() * Lanes::LN_2 + rests[nth]
    })
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
            let VectorLanes { x, y } = draws.poses(Lanes::ONE, 1.0).place;
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
        let mut products = [[0.0; LANES]; 7];
        for _ in 0..count {
            // The second is what the first left over.
            let [one, other] = [(); 2].map(|()| draws.poses(Lanes::ONE, 1.0));
            let VectorLanes { x, y } = one.place;
            let next = x.to_array().map(|next| next * x.as_array()[0]);
            let all = [
                x * y,
                x * one.turn,
                x * other.place.x,
                y * other.turn,
                one.turn * other.turn,
                other.place.y * other.turn,
                Lanes::from(next),
            ];
            for (sums, product) in products.iter_mut().zip(all) {
                for (sum, product) in sums.iter_mut().zip(product.to_array()) {
                    *sum += f64::from(product) / f64::from(count);
                }
            }
        }
        let bound = 5.0 / f64::from(count).sqrt();
        assert!((products[6][0] - 1.0_f64).abs() < 2.0 * bound, "{products:?}");
        products[6][0] = 0.0;
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

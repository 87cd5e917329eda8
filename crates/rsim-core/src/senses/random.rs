//! Random numbers of senses: counter-based, so that no order of calls matters.

use std::sync::LazyLock;

use crate::streams::{STRIDE, mixed};

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
pub(super) struct Draws(u64);

impl Draws {
    /// The numbers of event `number` of a purpose, in the match with this key.
    pub(super) fn of(key: u64, purpose: Purpose, number: u64) -> Self {
        let event = mixed(number.wrapping_mul(STRIDE) ^ ((purpose as u64) << 56));
        Self(mixed(key.wrapping_add(STRIDE) ^ event))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STRIDE);
        mixed(self.0)
    }

    /// A number from 0 to below 1, with 24 bits.
    pub(super) fn uniform(&mut self) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "24 bits fit exactly")]
        let number = (self.next() >> 40) as f32;
        number * (1.0 / 16_777_216.0)
    }

    /// Whether something of this probability happens. Nothing is drawn for 0.
    pub(super) fn happens(&mut self, probability: f32) -> bool {
        probability > 0.0 && self.uniform() < probability
    }

    /// A number from -1 to 1.
    pub(super) fn deviation(&mut self) -> f32 {
        2.0 * self.uniform() - 1.0
    }

    /// A number of a normal distribution with this standard deviation. Nothing is drawn for 0.
    pub(super) fn normal(&mut self, deviation: f32) -> f32 {
        if deviation > 0.0 { deviation * self.standard_normal() } else { 0.0 }
    }

    /// A number of the standard normal distribution, by the ziggurat method (Marsaglia and Tsang, Journal
    /// of Statistical Software 5(8), 2000) with a layer and a position from one word.
    fn standard_normal(&mut self) -> f32 {
        let layers = &*LAYERS;
        loop {
            let word = self.next();
            let layer = (word & 127) as usize;
            #[expect(clippy::cast_precision_loss, reason = "24 bits fit exactly")]
            let position = (word >> 40) as f32 * (1.0 / 8_388_608.0) - 1.0;
            let x = position * layers.x[layer];
            if x.abs() < layers.x[layer + 1] {
                return x;
            }
            if layer == 0 {
                return self.tail(x < 0.0);
            }
            let between = layers.density[layer + 1] - layers.density[layer];
            if layers.density[layer] + between * self.uniform() < density(x) {
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
        let numbers: Vec<f64> = (0..count).map(|_| f64::from(draws.normal(1.0))).collect();
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

//! Deviations of delays.

use crate::senses::random::{Draws, Purpose};

/// Part of the period by which two delays in a row differ at most, if deviations are not independent.
const PART: f32 = 2.0 / 3.0;

/// Deviations of the delays of things that set out one after the other, and arrive in this order.
///
/// They are uniform and independent as long as nothing can overtake what set out before. Greater ones go from one
/// random number to the next over several things: otherwise many would have to wait for those before them, and the mean
/// delay would be longer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jitter {
    /// Maximum deviation, s.
    most: f32,
    /// Number of things from one random number to the next.
    over: u64,
}

impl Jitter {
    /// Deviations of up to `most` from a `delay`, s, but not by more than it, of what sets out each `period`, s.
    pub(super) fn of(most: f32, delay: f32, period: f32) -> Self {
        let most = most.min(delay);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
        let over = (2.0 * most / (PART * period)).ceil() as u64;
        Self { most, over: if 2.0 * most <= period { 1 } else { over } }
    }

    /// The deviation of thing `nth`, s. `draws` has its random numbers; those of `purpose` are for several.
    pub(super) fn of_nth(self, nth: u64, key: u64, purpose: Purpose, draws: &mut Draws) -> f32 {
        if self.most <= 0.0 {
            return 0.0;
        }
        if self.over == 1 {
            return draws.deviation() * self.most;
        }
        let of = |knot: u64| Draws::of(key, purpose, knot).deviation();
        let (knot, rest) = (nth / self.over, nth % self.over);
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        let part = rest as f32 / self.over as f32;
        (of(knot) * (1.0 - part) + of(knot + 1) * part) * self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_keep_their_mean_and_their_order() {
        let count = 60_000_u32;
        for (most, delay, period) in
            [(0.01, 0.05, 0.025), (0.05, 0.05, 0.025), (0.1, 0.1, 0.025), (0.03, 0.01, 0.005)]
        {
            let jitter = Jitter::of(most, delay, period);
            let all: Vec<f32> = (0..u64::from(count))
                .map(|nth| {
                    let mut draws = Draws::of(3, Purpose::Command, nth);
                    jitter.of_nth(nth, 3, Purpose::CommandDelay, &mut draws)
                })
                .collect();
            assert!(all.iter().all(|deviation| deviation.abs() <= most.min(delay)));
            assert!(all.windows(2).all(|pair| pair[1] - pair[0] >= -period));
            let mean = all.iter().map(|x| f64::from(*x)).sum::<f64>() / f64::from(count);
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let knots = f64::from(count) / jitter.over as f64;
            let bound = 3.0 * f64::from(most.min(delay)) / knots.sqrt();
            assert!(mean.abs() < bound, "{most} {delay} {period}: {mean}");
            let widest = all.iter().fold(0.0_f32, |widest, deviation| widest.max(deviation.abs()));
            assert!(widest > 0.8 * most.min(delay), "{widest}");
        }
        let mut draws = Draws::of(0, Purpose::Frame, 0);
        let none = Jitter::of(0.0, 0.1, 0.025).of_nth(0, 0, Purpose::FrameDelay, &mut draws);
        assert!(none == 0.0, "{none}");
    }
}

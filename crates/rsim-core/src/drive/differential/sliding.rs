//! Two tires that both slide: their friction acts against a slip that depends on it.

use super::{Friction, Slip, Wheels};
use crate::blocks::{Lanes, larger};

/// Factor by which an estimate reduces the speed of a slip at most, so that it stays positive.
const MAX_REDUCTION: f32 = 0.02;

/// Slip below which a tire rolls, m/s.
const MIN_SLIP: f32 = 1e-6;

/// Slip of two tires that slide, at the end of a tick, and what it depends on.
struct SlidingEnd {
    /// Along the wheels: left, right, m/s.
    along: [Lanes; 2],
    /// Along the axle, m/s.
    across: Lanes,
    /// Inverse speeds of the slips, s/m: left, right.
    per_speed: [Lanes; 2],
    /// Change of the slip at a wheel, left or right, by friction of 1 m/s along it, and at the other one.
    own: [Lanes; 2],
    other: Lanes,
    /// Change of the slip along the axle by full friction of a tire, m/s.
    lateral: Lanes,
}

impl Wheels {
    /// Friction of tires that both slide, against their slip at the end of the tick: along the wheel and
    /// along the axle each by its own grip.
    ///
    /// One step of Newton's method from the first estimate leaves an error of some thousandths of the
    /// friction, and of some hundredths where a tire comes to rest in the tick.
    pub(super) fn sliding(&self, slip: &Slip) -> Friction {
        let speeds = self.refined(slip, self.estimate(slip));
        let SlidingEnd { along, across, .. } = self.sliding_end(slip, speeds);
        let each = [0, 1].map(|wheel| {
            // Not beyond the grip, should the speed not be exact.
            let per_slip = Lanes::ONE / larger(speeds[wheel], magnitude(along[wheel], across));
            let along = -self.longitudinal * along[wheel] * per_slip;
            let across = -self.lateral * across * per_slip;
            let turns = along.abs().simd_le(self.motor);
            let (held, aside) = self.stalled(along, Lanes::splat(-0.5) * slip.across);
            [turns.bitselect(along, held), turns.bitselect(across, aside)]
        });
        let [left, right] = each;
        Friction { along: [left[0], right[0]], across: left[1] + right[1] }
    }

    /// Estimate of the speeds of the slips at the end of the tick: exact for tires that slip alike, along
    /// their wheels or along the axle.
    fn estimate(&self, slip: &Slip) -> [Lanes; 2] {
        slip.along.map(|along| {
            let speed = magnitude(along, slip.across);
            let aside = slip.across / speed;
            let grip = self.longitudinal + aside * aside * (self.lateral - self.longitudinal);
            larger(speed - (grip + grip), speed * Lanes::splat(MAX_REDUCTION))
        })
    }

    /// Slip at the end of a tick in which friction is that of tires that slide at `speeds`, m/s: for given
    /// speeds, friction is linear in the components of the slip.
    fn sliding_end(&self, slip: &Slip, speeds: [Lanes; 2]) -> SlidingEnd {
        let per_speed = speeds.map(|speed| Lanes::ONE / speed);
        let [left, right] = per_speed.map(|per_speed| per_speed * self.longitudinal);
        let both = self.own_and_other;
        let inverse = Lanes::ONE / (Lanes::ONE + self.own * (left + right) + both * (left * right));
        let [first, second] = slip.along;
        let lateral = Lanes::ONE / (Lanes::ONE + self.lateral * (per_speed[0] + per_speed[1]));
        SlidingEnd {
            along: [
                (first + right * (self.own * first - self.other * second)) * inverse,
                (second + left * (self.own * second - self.other * first)) * inverse,
            ],
            across: slip.across * lateral,
            per_speed,
            own: [right, left].map(|other| (self.own + both * other) * inverse),
            other: self.other * inverse,
            lateral: self.lateral * lateral,
        }
    }

    /// Better speeds of tires that slide: a step of Newton's method, for speeds that are those of the slip
    /// that follows from them.
    fn refined(&self, slip: &Slip, speeds: [Lanes; 2]) -> [Lanes; 2] {
        let end = self.sliding_end(slip, speeds);
        let [left, right] = end.along.map(|along| magnitude(along, end.across));
        let missing = [left - speeds[0], right - speeds[1]];
        let aside = end.across * end.across * end.lateral;
        // Derivative of the ratio of speed to slip at `row` by the speed at `column`, times the slip.
        let scale = [speeds[0] / (left * left), speeds[1] / (right * right)];
        let rate = |row: usize, column: usize| {
            let gain = if row == column { end.own[column] } else { end.other };
            let along = self.longitudinal * gain * end.along[row] * end.along[column];
            scale[row] * end.per_speed[column] * end.per_speed[column] * (along + aside)
        };
        let diagonal = [Lanes::ONE - rate(0, 0), Lanes::ONE - rate(1, 1)];
        let coupling = [-rate(0, 1), -rate(1, 0)];
        let inverse = Lanes::ONE / (diagonal[0] * diagonal[1] - coupling[0] * coupling[1]);
        let change = [
            (missing[0] * diagonal[1] - missing[1] * coupling[0]) * inverse,
            (missing[1] * diagonal[0] - missing[0] * coupling[1]) * inverse,
        ];
        [0, 1].map(|wheel| {
            let least = speeds[wheel] * Lanes::splat(MAX_REDUCTION);
            larger(larger(speeds[wheel] + change[wheel], least), Lanes::splat(MIN_SLIP))
        })
    }
}

/// Magnitude of a slip, m/s; never 0.
fn magnitude(along: Lanes, across: Lanes) -> Lanes {
    larger((along * along + across * across).sqrt(), Lanes::splat(MIN_SLIP))
}

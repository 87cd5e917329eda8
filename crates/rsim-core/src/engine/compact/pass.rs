//! Passes over contacts: soft where bodies overlap, to push them apart, or rigid.

/// Maximum speed at which overlapping bodies are pushed apart, m/s.
const MAX_PUSH_SPEED: f32 = 1.0;

/// Depth that is not corrected, m: contacts at rest stay in contact.
const ALLOWED_DEPTH: f32 = 5e-6;

/// Stiffness of contacts, Hz, by their damped spring. Robots that press come to rest: with 170 Hz, a row of
/// eight that presses against a wall keeps moving at 0.02 m/s in sub-steps of 2.5 ms, since one pass does not
/// carry a push to its end.
const STIFFNESS: f32 = 140.0;

/// Stiffness beyond a depth, m, at which robots that press do not lie: the largest that a sub-step of 2.5 ms
/// resolves, by [`MAX_STIFFNESS`]. Without it robots in the crowd of `tests/crowd.rs` come to 1.09 mm, with it to
/// less than 1 mm.
const DEEP: f32 = 2e-4;
const DEEP_STIFFNESS: f32 = 400.0;

/// Maximum stiffness by the rate of sub-steps: those of 2.5 ms have all of [`DEEP_STIFFNESS`].
const MAX_STIFFNESS: f32 = 1.0;

/// Damping ratio: a push out of an overlap does not overshoot.
const DAMPING: f32 = 2.0;

/// A pass over all constraints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    /// Speed at which overlapping bodies are pushed apart by their depth, 1/s.
    bias_rate: f32,
    /// The same for deep overlaps, and the speed to subtract there, m/s.
    deep_rate: f32,
    deep_offset: f32,
    /// Response of an overlapping point to a unit impulse by that of a rigid point, and its inverse.
    stretch: f32,
    mass_scale: f32,
    /// Inverse of the sub-step, 1/s.
    inverse_time: f32,
}

/// A point's equation: its closing speed with the push, and the response of a soft point.
pub(super) struct Row {
    /// m/s.
    pub(super) speed: f32,
    /// Response to a unit impulse by that of a rigid point, and its inverse.
    pub(super) stretch: f32,
    pub(super) mass_scale: f32,
}

impl Pass {
    /// A pass that pushes overlapping bodies apart, in a sub-step of `time` (s): by a damped spring in
    /// implicit integration.
    pub(super) fn pushing(time: f32) -> Self {
        Self::springs(STIFFNESS, time)
    }

    /// The same for contacts of the ball, which no row of robots presses: with 200 Hz, a push
    /// through a squeezed ball was 2% weaker.
    pub(super) fn pushing_ball(time: f32) -> Self {
        Self::springs(DEEP_STIFFNESS, time)
    }

    fn springs(stiffness: f32, time: f32) -> Self {
        let most = MAX_STIFFNESS / time;
        let [omega, deep_omega] =
            [stiffness, DEEP_STIFFNESS].map(|hertz| std::f32::consts::TAU * hertz.min(most));
        let [a, deep_a] = [omega, deep_omega].map(|omega| 2.0 * DAMPING + time * omega);
        let (bias_rate, deep_rate) = (omega / a, deep_omega / deep_a);
        let stretch = 1.0 + 1.0 / (time * omega * a);
        Self {
            bias_rate,
            deep_rate,
            deep_offset: (deep_rate - bias_rate) * DEEP,
            stretch,
            mass_scale: 1.0 / stretch,
            inverse_time: 1.0 / time,
        }
    }

    /// A pass that only corrects velocities, in a sub-step of `time` (s).
    pub(super) fn relaxing(time: f32) -> Self {
        Self {
            bias_rate: 0.0,
            deep_rate: 0.0,
            deep_offset: 0.0,
            stretch: 1.0,
            mass_scale: 1.0,
            inverse_time: 1.0 / time,
        }
    }

    /// Equation of a point that closes at `speed` (m/s) over `separation` (m).
    pub(super) fn row(&self, speed: f32, separation: f32) -> Row {
        if separation > 0.0 {
            let speed = speed + separation * self.inverse_time;
            return Row { speed, stretch: 1.0, mass_scale: 1.0 };
        }
        let depth = (separation + ALLOWED_DEPTH).min(0.0);
        let push = if depth > -DEEP {
            self.bias_rate * depth
        } else {
            (self.deep_rate * depth + self.deep_offset).max(-MAX_PUSH_SPEED)
        };
        Row { speed: speed + push, stretch: self.stretch, mass_scale: self.mass_scale }
    }
}

//! Passes over contacts: soft where bodies overlap, to push them apart, or rigid.

/// Maximum speed at which overlapping bodies are pushed apart, m/s.
const MAX_PUSH_SPEED: f32 = 1.0;

/// Depth that is not corrected, m: contacts at rest stay in contact.
const ALLOWED_DEPTH: f32 = 5e-6;

/// Stiffness of contacts, Hz: the largest that a sub-step of 1.25 ms resolves, by
/// [`MAX_STIFFNESS`]. Half of it doubles the depths of crowds.
const STIFFNESS: f32 = 400.0;

/// Depth, m, up to which contacts have a share of that stiffness. Robots that press come to rest at such
/// depths: with the whole stiffness a row of eight that presses against a wall keeps moving at 0.03 m/s, since
/// one pass does not carry a push to its end; with two thirds it still does.
const SHALLOW: f32 = 2e-4;
const SHALLOW_SHARE: f32 = 0.5;

/// Maximum stiffness by the rate of sub-steps.
const MAX_STIFFNESS: f32 = 0.5;

/// Damping ratio: a push out of an overlap does not overshoot.
const DAMPING: f32 = 2.0;

/// A pass over all constraints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    shallow: Softness,
    deep: Softness,
    /// Inverse of the sub-step, 1/s.
    inverse_time: f32,
}

/// Softness of overlapping points.
#[derive(Debug, Clone, Copy)]
struct Softness {
    /// Speed at which overlapping bodies are pushed apart by their depth, 1/s.
    bias_rate: f32,
    /// Response to a unit impulse by that of a rigid point, and its inverse.
    stretch: f32,
    mass_scale: f32,
}

/// A point's equation: its closing speed with the push, and the response of a soft point.
pub(super) struct Row {
    /// m/s.
    pub(super) speed: f32,
    /// Response to a unit impulse by that of a rigid point, and its inverse.
    pub(super) stretch: f32,
    pub(super) mass_scale: f32,
}

impl Softness {
    /// Points that only have their velocities corrected.
    const RIGID: Self = Self { bias_rate: 0.0, stretch: 1.0, mass_scale: 1.0 };

    /// A damped spring of `stiffness` (Hz) in implicit integration, for a sub-step of `time` (s).
    fn of(stiffness: f32, time: f32) -> Self {
        let omega = std::f32::consts::TAU * stiffness;
        let a = 2.0 * DAMPING + time * omega;
        let stretch = 1.0 + 1.0 / (time * omega * a);
        Self { bias_rate: omega / a, stretch, mass_scale: 1.0 / stretch }
    }
}

impl Pass {
    /// A pass that pushes overlapping bodies apart, in a sub-step of `time` (s).
    pub(super) fn pushing(time: f32) -> Self {
        let stiffness = STIFFNESS.min(MAX_STIFFNESS / time);
        Self {
            shallow: Softness::of(SHALLOW_SHARE * stiffness, time),
            deep: Softness::of(stiffness, time),
            inverse_time: 1.0 / time,
        }
    }

    /// A pass that only corrects velocities, in a sub-step of `time` (s).
    pub(super) fn relaxing(time: f32) -> Self {
        Self { shallow: Softness::RIGID, deep: Softness::RIGID, inverse_time: 1.0 / time }
    }

    /// Equation of a point that closes at `speed` (m/s) over `separation` (m).
    pub(super) fn row(&self, speed: f32, separation: f32) -> Row {
        if separation > 0.0 {
            let speed = speed + separation * self.inverse_time;
            return Row { speed, stretch: 1.0, mass_scale: 1.0 };
        }
        let depth = (separation + ALLOWED_DEPTH).min(0.0);
        let softness = if depth > -SHALLOW { &self.shallow } else { &self.deep };
        let push = (softness.bias_rate * depth).max(-MAX_PUSH_SPEED);
        let Softness { stretch, mass_scale, .. } = *softness;
        Row { speed: speed + push, stretch, mass_scale }
    }
}

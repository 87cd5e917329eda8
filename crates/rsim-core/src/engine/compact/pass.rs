//! Passes over contacts: soft where bodies overlap, to push them apart, or rigid.

/// Maximum speed at which overlapping bodies are pushed apart, m/s.
const MAX_PUSH_SPEED: f32 = 1.0;

/// Depth that is not corrected, m: contacts at rest stay in contact.
const ALLOWED_DEPTH: f32 = 5e-6;

/// Stiffness of contacts, Hz: the largest that a sub-step of 1.25 ms resolves, by
/// [`MAX_STIFFNESS`]. Half of it doubles the depths of crowds.
const STIFFNESS: f32 = 400.0;

/// Maximum stiffness by the rate of sub-steps.
const MAX_STIFFNESS: f32 = 0.5;

/// Damping ratio: a push out of an overlap does not overshoot.
const DAMPING: f32 = 2.0;

/// A pass over all constraints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    soft: [f32; 3],
    /// Speed at which overlapping bodies are pushed apart by their depth, 1/s.
    bias_rate: f32,
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
        let omega = std::f32::consts::TAU * STIFFNESS.min(MAX_STIFFNESS / time);
        let a = 2.0 * DAMPING + time * omega;
        let stretch = 1.0 + 1.0 / (time * omega * a);
        let (bias_rate, mass_scale) = (omega / a, 1.0 / stretch);
        let omega2 = omega * SHARE;
        let a2 = 2.0 * DAMPING + time * omega2;
        let stretch2 = 1.0 + 1.0 / (time * omega2 * a2);
        Self { soft: [omega2 / a2, stretch2, 1.0 / stretch2], bias_rate, stretch, mass_scale, inverse_time: 1.0 / time }
    }

    /// A pass that only corrects velocities, in a sub-step of `time` (s).
    pub(super) fn relaxing(time: f32) -> Self {
        Self { soft: [0.0, 1.0, 1.0], bias_rate: 0.0, stretch: 1.0, mass_scale: 1.0, inverse_time: 1.0 / time }
    }

    /// Equation of a point that closes at `speed` (m/s) over `separation` (m).
    pub(super) fn row(&self, speed: f32, separation: f32) -> Row {
        if separation > 0.0 {
            let speed = speed + separation * self.inverse_time;
            return Row { speed, stretch: 1.0, mass_scale: 1.0 };
        }
        let depth = (separation + ALLOWED_DEPTH).min(0.0);
        if depth > -SHALLOW {
            let [rate, stretch, mass_scale] = self.soft;
            return Row { speed: speed + rate * depth, stretch, mass_scale };
        }
        let push = (self.bias_rate * depth).max(-MAX_PUSH_SPEED);
        Row { speed: speed + push, stretch: self.stretch, mass_scale: self.mass_scale }
    }
}

const SHALLOW: f32 = 2e-4;
const SHARE: f32 = 0.5;

//! Two wheels on one axle: Coulomb friction of each tyre against its slip.

use serde::{Deserialize, Serialize};

use super::{BodyState, DriveLimits, WheelImpulse};
use crate::math::Vector;
use crate::models::robot::DifferentialDrive;

/// Iterations for the speeds at which two tyres slip. Each shrinks the error by the ratio of a tick's
/// friction to the slip, so that two suffice for tyres that slide; the others serve the change from
/// sliding to rolling.
const REFINEMENTS: usize = 4;

/// Limits of one tick.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    /// m.
    half_track: f32,
    /// m.
    wheel_radius: f32,
    /// rad/s.
    max_wheel_speed: f32,
    /// Maximum impulse of a motor at the rim of its wheel, N s.
    motor_impulse: f32,
    /// Maximum impulse of a tyre that slips along its wheel only, N s.
    longitudinal_impulse: f32,
    /// Maximum impulse of a tyre that slips along the axle only, N s.
    lateral_impulse: f32,
}

/// Slip of the two tyres over the floor, m/s: the velocity of their contact patches.
#[derive(Debug, Clone, Copy)]
struct Slip {
    /// Along the wheels, minus the rim speeds: left, right.
    along: [f32; 2],
    /// Along the axle, the same for both tyres.
    across: f32,
}

/// Friction of the floor on the tyres in a tick, N s.
#[derive(Debug, Clone, Copy)]
struct Friction {
    /// Along the wheels: left, right.
    along: [f32; 2],
    /// Along the axle: left, right.
    across: [f32; 2],
}

impl Wheels {
    pub(super) fn of(drive: &DifferentialDrive, mass: f32, tick: f32) -> Self {
        Self {
            half_track: drive.track_width / 2.0,
            wheel_radius: drive.wheel_radius,
            max_wheel_speed: drive.max_wheel_speed,
            motor_impulse: drive.motor_torque / drive.wheel_radius * tick,
            longitudinal_impulse: drive.longitudinal_grip * mass / 2.0 * tick,
            lateral_impulse: drive.lateral_grip * mass / 2.0 * tick,
        }
    }

    /// Impulse of the wheels that follow the speeds `[left, right, ..]`, rad/s, in a tick.
    ///
    /// Rims turn as commanded; friction acts on each tyre against its slip at the end of the tick.
    pub(super) fn impulse(
        &self,
        limits: &DriveLimits,
        command: &[f32],
        body: &BodyState,
    ) -> WheelImpulse {
        let rims = [command[0], command[1]].map(|speed| {
            self.wheel_radius * speed.clamp(-self.max_wheel_speed, self.max_wheel_speed)
        });
        let slip = self.slip(body.velocity, body.spin, rims);
        let rolling = self.rolling(limits, &slip);
        let friction = if self.is_possible(&rolling) {
            // Tyres that roll also compensate the load of the last tick. Those that slide give their
            // maximum whatever the load.
            let loaded = self.loaded(limits, body, &slip);
            let rolling = self.rolling(limits, &loaded);
            if self.is_possible(&rolling) { rolling } else { self.sliding(limits, &loaded) }
        } else {
            self.sliding(limits, &slip)
        };
        let [left, right] = friction.along;
        WheelImpulse {
            impulse: Vector::new(left + right, friction.across[0] + friction.across[1]),
            angular_impulse: (right - left) * self.half_track,
            change: Vector::ZERO,
        }
    }

    fn slip(&self, velocity: Vector, spin: f32, rims: [f32; 2]) -> Slip {
        let turning = spin * self.half_track;
        let along = [velocity.x - turning - rims[0], velocity.x + turning - rims[1]];
        Slip { along, across: velocity.y }
    }

    /// The slip with another load like that of the last tick.
    fn loaded(&self, limits: &DriveLimits, body: &BodyState, slip: &Slip) -> Slip {
        let pushed = body.load / limits.mass;
        let spin = body.angular_load / limits.inertia;
        let added = self.slip(pushed, spin, [0.0; 2]);
        let along = [slip.along[0] + added.along[0], slip.along[1] + added.along[1]];
        Slip { along, across: slip.across + added.across }
    }

    /// Inverse effective mass along a wheel, 1/kg: speed of the robot at that wheel and at the other one
    /// by a unit impulse.
    fn inverse_effective_mass(&self, limits: &DriveLimits) -> [f32; 2] {
        let straight = 1.0 / limits.mass;
        let turning = self.half_track * self.half_track / limits.inertia;
        [straight + turning, straight - turning]
    }

    /// Friction that stops all slip within the tick.
    fn rolling(&self, limits: &DriveLimits, slip: &Slip) -> Friction {
        let [left, right] = slip.along;
        let both = -limits.mass * (left + right) / 4.0;
        let apart = limits.inertia * (left - right) / (4.0 * self.half_track * self.half_track);
        let across = -limits.mass * slip.across / 2.0;
        Friction { along: [both - apart, both + apart], across: [across; 2] }
    }

    /// Whether motors and tyres can transmit this friction: that of a tyre lies within an ellipse.
    fn is_possible(&self, friction: &Friction) -> bool {
        let wheels = friction.along.iter().zip(friction.across);
        wheels.into_iter().all(|(along, across)| {
            let (along_share, across_share) =
                (along / self.longitudinal_impulse, across / self.lateral_impulse);
            along.abs() <= self.motor_impulse
                && along_share * along_share + across_share * across_share <= 1.0
        })
    }

    /// Friction of tyres that slide, against their slip at the end of the tick: along the wheel and
    /// along the axle each by its own grip.
    ///
    /// For given magnitudes of the slips, friction is linear in their components. The iteration
    /// approaches the magnitudes from above, so friction never reverses a slip, and a tyre that starts to
    /// roll within the tick gets only the friction that stops it.
    fn sliding(&self, limits: &DriveLimits, slip: &Slip) -> Friction {
        let [own, other] = self
            .inverse_effective_mass(limits)
            .map(|inverse_mass| inverse_mass * self.longitudinal_impulse);
        let aside = self.lateral_impulse / limits.mass;
        let mut end = *slip;
        let mut per_slip = [0.0; 2];
        for _ in 0..REFINEMENTS {
            per_slip = end.along.map(|along| 1.0 / magnitude(along, end.across));
            let [left, right] = per_slip;
            let diagonal = [1.0 + own * left, 1.0 + own * right];
            let coupling = [other * left, other * right];
            let determinant = diagonal[0] * diagonal[1] - coupling[0] * coupling[1];
            end = Slip {
                along: [
                    (slip.along[0] * diagonal[1] - slip.along[1] * coupling[1]) / determinant,
                    (slip.along[1] * diagonal[0] - slip.along[0] * coupling[0]) / determinant,
                ],
                across: slip.across / (1.0 + aside * (left + right)),
            };
        }
        let mut friction = Friction { along: [0.0; 2], across: [0.0; 2] };
        for (wheel, per_slip) in per_slip.into_iter().enumerate() {
            let along = -self.longitudinal_impulse * end.along[wheel] * per_slip;
            let across = -self.lateral_impulse * end.across * per_slip;
            (friction.along[wheel], friction.across[wheel]) = if along.abs() <= self.motor_impulse {
                (along, across)
            } else {
                self.stalled(along, -limits.mass * slip.across / 2.0)
            };
        }
        friction
    }

    /// Friction of a tyre whose motor is weaker than its grip: the rim follows the floor, which leaves the
    /// tyre more friction along the axle.
    fn stalled(&self, along: f32, across: f32) -> (f32, f32) {
        let used = self.motor_impulse / self.longitudinal_impulse;
        let left = self.lateral_impulse * (1.0 - used * used).max(0.0).sqrt();
        (self.motor_impulse.copysign(along), across.clamp(-left, left))
    }
}

/// Magnitude of a slip, m/s; never 0.
fn magnitude(along: f32, across: f32) -> f32 {
    (along * along + across * across).sqrt().max(MIN_SLIP)
}

/// Slip below which a tyre rolls, m/s.
const MIN_SLIP: f32 = 1e-6;

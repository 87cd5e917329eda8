//! Two wheels on one axle: Coulomb friction of each tyre against its slip.

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use super::{Demand, Limits, Pull};
use crate::robot_model::DifferentialDrive;

/// Refinements of the speeds at which two tyres slip. Each shrinks what is missing by the ratio of
/// the friction of a tick to the slip, so that two suffice where tyres slide at all; the others serve
/// the change from sliding to rolling.
const REFINEMENTS: usize = 4;

/// Bounds of one tick.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    half_track: f32,
    wheel_radius: f32,
    max_wheel_speed: f32,
    /// N s, of a motor at the rim of its wheel.
    motor_impulse: f32,
    /// N s, of a tyre that slips along its wheel only.
    forward_impulse: f32,
    /// N s, of a tyre that slips along the axle only.
    side_impulse: f32,
}

/// Slip of the two tyres over the floor, m/s: velocity of the contact patches.
#[derive(Debug, Clone, Copy)]
struct Slip {
    /// Along the wheels, less the speed of the rims: left, right.
    along: [f32; 2],
    /// Along the axle: both tyres are on it.
    across: f32,
}

/// Friction of the floor on the tyres in a tick, N s.
#[derive(Debug, Clone, Copy)]
struct Friction {
    along: [f32; 2],
    across: [f32; 2],
}

impl Wheels {
    pub(super) fn of(drive: &DifferentialDrive, mass: f32, tick: f32) -> Self {
        Self {
            half_track: drive.track / 2.0,
            wheel_radius: drive.wheel_radius,
            max_wheel_speed: drive.max_wheel_speed,
            motor_impulse: drive.motor_torque / drive.wheel_radius * tick,
            forward_impulse: drive.forward_grip * mass / 2.0 * tick,
            side_impulse: drive.side_grip * mass / 2.0 * tick,
        }
    }

    /// Follows `[left, right, ..]` wheel speeds, rad/s.
    ///
    /// Rims turn as commanded; the floor acts on each tyre against its slip at the end of the tick.
    pub(super) fn pull(&self, limits: &Limits, command: &[f32], demand: &Demand) -> Pull {
        let rims = [command[0], command[1]].map(|speed| {
            self.wheel_radius * speed.clamp(-self.max_wheel_speed, self.max_wheel_speed)
        });
        let slip = self.slip(demand.velocity, demand.spin, rims);
        let rolling = self.rolling(limits, &slip);
        let friction = if self.holds(&rolling) {
            // Tyres that roll also hold what presses on the robot. Those that slide give all that
            // they have whatever presses.
            let loaded = self.loaded(limits, demand, &slip);
            let rolling = self.rolling(limits, &loaded);
            if self.holds(&rolling) { rolling } else { self.sliding(limits, &loaded) }
        } else {
            self.sliding(limits, &slip)
        };
        let [left, right] = friction.along;
        Pull {
            impulse: Vector::new(left + right, friction.across[0] + friction.across[1]),
            turn: (right - left) * self.half_track,
            change: Vector::ZERO,
        }
    }

    fn slip(&self, velocity: Vector, spin: f32, rims: [f32; 2]) -> Slip {
        let turning = spin * self.half_track;
        let along = [velocity.x - turning - rims[0], velocity.x + turning - rims[1]];
        Slip { along, across: velocity.y }
    }

    /// The slip that the load of the last tick would lead to.
    fn loaded(&self, limits: &Limits, demand: &Demand, slip: &Slip) -> Slip {
        let pushed = demand.load / limits.mass;
        let spin = demand.turning_load / limits.inertia;
        let more = self.slip(pushed, spin, [0.0; 2]);
        let along = [slip.along[0] + more.along[0], slip.along[1] + more.along[1]];
        Slip { along, across: slip.across + more.across }
    }

    /// Speed that an impulse along a wheel gives to the robot at that wheel, and at the other one,
    /// 1/kg.
    fn yields(&self, limits: &Limits) -> [f32; 2] {
        let straight = 1.0 / limits.mass;
        let turning = self.half_track * self.half_track / limits.inertia;
        [straight + turning, straight - turning]
    }

    /// Friction that stops all slip within the tick.
    fn rolling(&self, limits: &Limits, slip: &Slip) -> Friction {
        let [left, right] = slip.along;
        let both = -limits.mass * (left + right) / 4.0;
        let apart = limits.inertia * (left - right) / (4.0 * self.half_track * self.half_track);
        let across = -limits.mass * slip.across / 2.0;
        Friction { along: [both - apart, both + apart], across: [across; 2] }
    }

    /// Whether motors and tyres can give it: those of a tyre lie within an ellipse.
    fn holds(&self, friction: &Friction) -> bool {
        let wheels = friction.along.iter().zip(friction.across);
        wheels.into_iter().all(|(along, across)| {
            let (along_share, across_share) =
                (along / self.forward_impulse, across / self.side_impulse);
            along.abs() <= self.motor_impulse
                && along_share * along_share + across_share * across_share <= 1.0
        })
    }

    /// Friction of tyres that slide, against their slip at the end of the tick: along the wheel and
    /// along the axle each by its own grip.
    ///
    /// With the magnitudes of the slips given, friction is linear in their components. Magnitudes are
    /// refined from above, so friction never turns a slip around, and a tyre that comes to roll within
    /// the tick gets no more than stops it.
    fn sliding(&self, limits: &Limits, slip: &Slip) -> Friction {
        let [own, other] =
            self.yields(limits).map(|per_impulse| per_impulse * self.forward_impulse);
        let aside = self.side_impulse / limits.mass;
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
            let along = -self.forward_impulse * end.along[wheel] * per_slip;
            let across = -self.side_impulse * end.across * per_slip;
            (friction.along[wheel], friction.across[wheel]) = if along.abs() <= self.motor_impulse {
                (along, across)
            } else {
                self.stalled(along, -limits.mass * slip.across / 2.0)
            };
        }
        friction
    }

    /// A tyre whose motor is weaker than its grip: the rim follows the floor, and the tyre has more
    /// left along the axle.
    fn stalled(&self, along: f32, across: f32) -> (f32, f32) {
        let share = self.motor_impulse / self.forward_impulse;
        let left = self.side_impulse * (1.0 - share * share).max(0.0).sqrt();
        (self.motor_impulse.copysign(along), across.clamp(-left, left))
    }
}

/// Of a slip, m/s; never 0.
fn magnitude(along: f32, across: f32) -> f32 {
    (along * along + across * across).sqrt().max(LEAST_SLIP)
}

/// Below this a tyre rolls, m/s.
const LEAST_SLIP: f32 = 1e-6;

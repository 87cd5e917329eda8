//! Two wheels on one axle: Coulomb friction of each tyre against its slip.

use serde::{Deserialize, Serialize};

use super::{Driven, MAX_COLUMNS, OwnMotion, WheelEffect};
use crate::blocks::{LANES, Lanes, VectorLanes, lanes_of, larger, limited};
use crate::models::robot::DifferentialDrive;

/// Iterations for the speeds at which two tyres slip. Each shrinks the error by the ratio of a tick's
/// friction to the slip, so that two suffice for tyres that slide; the others serve the change from
/// sliding to rolling.
const REFINEMENTS: usize = 4;

/// Slip below which a tyre rolls, m/s.
const MIN_SLIP: f32 = 1e-6;

/// Limits of one tick. A limit of friction is the change of a robot's speed by one tyre.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    /// m.
    half_track: Lanes,
    /// m.
    wheel_radius: Lanes,
    /// rad/s.
    max_wheel_speed: Lanes,
    /// Maximum friction against a motor at its limit, m/s.
    motor: Lanes,
    /// Maximum friction of a tyre that slips along its wheel only, m/s, and its inverse.
    longitudinal: Lanes,
    per_longitudinal: Lanes,
    /// Maximum friction of a tyre that slips along the axle only, m/s, and its inverse.
    lateral: Lanes,
    per_lateral: Lanes,
    /// Change of the turn rate (rad/s) by friction of 1 m/s at one wheel.
    turn: Lanes,
    /// Speed of the robot at a wheel, and at the other one, by full friction along that wheel, m/s.
    own: Lanes,
    other: Lanes,
    /// Friction (m/s) that stops a slip of 1 m/s of one tyre against the other.
    stop_turning: Lanes,
}

/// Slip of the two tyres over the floor, m/s: the velocity of their contact patches.
#[derive(Clone, Copy)]
struct Slip {
    /// Along the wheels, minus the rim speeds: left, right.
    along: [Lanes; 2],
    /// Along the axle, the same for both tyres.
    across: Lanes,
}

/// Friction of the floor on the tyres in a tick, as changes of the robot's speed, m/s.
struct Friction {
    /// Along the wheels: left, right.
    along: [Lanes; 2],
    /// Along the axle: left, right.
    across: [Lanes; 2],
}

impl Wheels {
    pub(super) fn of(robots: &[Driven<DifferentialDrive>; LANES], tick: f32) -> Self {
        let lanes =
            |number: fn(&Driven<DifferentialDrive>) -> f32| lanes_of(|lane| number(&robots[lane]));
        let tick = Lanes::splat(tick);
        let half_track = lanes(|robot| robot.drive.track_width / 2.0);
        let longitudinal = lanes(|robot| robot.drive.longitudinal_grip / 2.0) * tick;
        let lateral = lanes(|robot| robot.drive.lateral_grip / 2.0) * tick;
        let mass_by_inertia = lanes(|robot| robot.mass / robot.inertia);
        let turn = half_track * mass_by_inertia;
        let turning = half_track * turn;
        Self {
            half_track,
            wheel_radius: lanes(|robot| robot.drive.wheel_radius),
            max_wheel_speed: lanes(|robot| robot.drive.max_wheel_speed),
            motor: lanes(|robot| {
                robot.drive.motor_torque / (robot.drive.wheel_radius * robot.mass)
            }) * tick,
            longitudinal,
            per_longitudinal: Lanes::ONE / longitudinal,
            lateral,
            per_lateral: Lanes::ONE / lateral,
            turn,
            own: (Lanes::ONE + turning) * longitudinal,
            other: (Lanes::ONE - turning) * longitudinal,
            stop_turning: Lanes::splat(0.25) / turning,
        }
    }

    /// Effect of the wheels that follow the speeds `[left, right, ..]`, rad/s, in a tick, for the robots
    /// of `mask`.
    ///
    /// Rims turn as commanded; friction acts on each tyre against its slip at the end of the tick.
    pub(super) fn effect(
        &self,
        mask: Lanes,
        command: &[Lanes; MAX_COLUMNS],
        own: &OwnMotion,
    ) -> WheelEffect {
        let rims = [command[0], command[1]]
            .map(|speed| self.wheel_radius * limited(speed, self.max_wheel_speed));
        let slip = self.slip(own.velocity, own.spin, rims);
        let rolls = self.is_possible(&self.rolling(&slip));
        // Tyres that roll also compensate the load of the last tick. Those that slide give their
        // maximum whatever the load.
        let added = self.slip(own.load, own.angular_load, [Lanes::ZERO; 2]);
        let slip = Slip {
            along: [0, 1].map(|wheel| slip.along[wheel] + (rolls & added.along[wheel])),
            across: slip.across + (rolls & added.across),
        };
        let rolling = self.rolling(&slip);
        let rolls = rolls & self.is_possible(&rolling);
        let friction = if (rolls | !mask).all() {
            rolling
        } else {
            rolling.where_else(rolls, &self.sliding(&slip))
        };
        let [left, right] = friction.along;
        let across = friction.across[0] + friction.across[1];
        WheelEffect {
            velocity: VectorLanes { x: left + right, y: across },
            spin: (right - left) * self.turn,
            change: VectorLanes::ZERO,
        }
    }

    fn slip(&self, velocity: VectorLanes, spin: Lanes, rims: [Lanes; 2]) -> Slip {
        let turning = spin * self.half_track;
        let along = [velocity.x - turning - rims[0], velocity.x + turning - rims[1]];
        Slip { along, across: velocity.y }
    }

    /// Friction that stops all slip within the tick.
    fn rolling(&self, slip: &Slip) -> Friction {
        let [left, right] = slip.along;
        let both = Lanes::splat(-0.25) * (left + right);
        let apart = self.stop_turning * (left - right);
        let across = Lanes::splat(-0.5) * slip.across;
        Friction { along: [both - apart, both + apart], across: [across; 2] }
    }

    /// Whether motors and tyres can transmit this friction: that of a tyre lies within an ellipse.
    fn is_possible(&self, friction: &Friction) -> Lanes {
        let [left, right] = [0, 1].map(|wheel| {
            let along = friction.along[wheel] * self.per_longitudinal;
            let across = friction.across[wheel] * self.per_lateral;
            friction.along[wheel].abs().simd_le(self.motor)
                & (along * along + across * across).simd_le(Lanes::ONE)
        });
        left & right
    }

    /// Friction of tyres that slide, against their slip at the end of the tick: along the wheel and
    /// along the axle each by its own grip.
    ///
    /// For given magnitudes of the slips, friction is linear in their components. The iteration
    /// approaches the magnitudes from above, so friction never reverses a slip, and a tyre that starts to
    /// roll within the tick gets only the friction that stops it.
    fn sliding(&self, slip: &Slip) -> Friction {
        let mut end = *slip;
        let mut per_slip = [Lanes::ZERO; 2];
        for _ in 0..REFINEMENTS {
            per_slip = end.along.map(|along| Lanes::ONE / magnitude(along, end.across));
            let [left, right] = per_slip;
            let diagonal = [Lanes::ONE + self.own * left, Lanes::ONE + self.own * right];
            let coupling = [self.other * left, self.other * right];
            let determinant = diagonal[0] * diagonal[1] - coupling[0] * coupling[1];
            let inverse = Lanes::ONE / determinant;
            end = Slip {
                along: [
                    (slip.along[0] * diagonal[1] - slip.along[1] * coupling[1]) * inverse,
                    (slip.along[1] * diagonal[0] - slip.along[0] * coupling[0]) * inverse,
                ],
                across: slip.across / (Lanes::ONE + self.lateral * (left + right)),
            };
        }
        let [left, right] = [0, 1].map(|wheel| {
            let along = -self.longitudinal * end.along[wheel] * per_slip[wheel];
            let across = -self.lateral * end.across * per_slip[wheel];
            let turns = along.abs().simd_le(self.motor);
            let (held, aside) = self.stalled(along, Lanes::splat(-0.5) * slip.across);
            [turns.bitselect(along, held), turns.bitselect(across, aside)]
        });
        Friction { along: [left[0], right[0]], across: [left[1], right[1]] }
    }

    /// Friction of a tyre whose motor is weaker than its grip: the rim follows the floor, which leaves the
    /// tyre more friction along the axle.
    fn stalled(&self, along: Lanes, across: Lanes) -> (Lanes, Lanes) {
        let used = self.motor * self.per_longitudinal;
        let left = self.lateral * larger(Lanes::ONE - used * used, Lanes::ZERO).sqrt();
        (limited(along, self.motor), limited(across, left))
    }
}

impl Friction {
    /// `self` in the lanes of `mask`, `other` in the others.
    fn where_else(&self, mask: Lanes, other: &Self) -> Self {
        let choose = |one: [Lanes; 2], two: [Lanes; 2]| {
            [mask.bitselect(one[0], two[0]), mask.bitselect(one[1], two[1])]
        };
        Self { along: choose(self.along, other.along), across: choose(self.across, other.across) }
    }
}

/// Magnitude of a slip, m/s; never 0.
fn magnitude(along: Lanes, across: Lanes) -> Lanes {
    larger((along * along + across * across).sqrt(), Lanes::splat(MIN_SLIP))
}

//! Two wheels on one axle: Coulomb friction of each tire against its slip.
//!
//! Friction that can stop the slip of a tire within the tick stops it, up to the limit of the tire: a robot
//! that stands holds whatever pushes it less. Only tires that slide all the same are iterated for.

mod sliding;
mod tipping;

pub(super) use tipping::TippingState;

use serde::{Deserialize, Serialize};
use tipping::Tipping;

use super::{Driven, MAX_COLUMNS, OwnMotion, WheelEffect, WheelErrors};
use crate::blocks::{LANES, Lanes, VectorLanes, lanes_of, larger, limited, smaller};
use crate::models::robot::DifferentialDrive;

/// Limits of one tick. A limit of friction is the change of a robot's speed by one tire.
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
    /// Maximum friction along a wheel, by motor and tire, m/s.
    drive: Lanes,
    /// Maximum friction of a tire that slips along its wheel only, m/s, and its inverse.
    longitudinal: Lanes,
    per_longitudinal: Lanes,
    /// Maximum friction of a tire that slips along the axle only, m/s, and its inverse.
    lateral: Lanes,
    per_lateral: Lanes,
    /// Maximum friction along the axle of a tire whose friction along the wheel is `motor`, and `drive`, m/s.
    lateral_at_motor: Lanes,
    lateral_at_drive: Lanes,
    /// Change of the angular velocity (rad/s) by friction of 1 m/s at one wheel.
    turn: Lanes,
    /// Speed of the robot at a wheel, and at the other one, by friction of 1 m/s along that wheel; and the
    /// inverse of the former.
    own: Lanes,
    other: Lanes,
    per_own: Lanes,
    /// Difference of the squares of `own` and `other`.
    own_and_other: Lanes,
    /// Maximum slip of a tire that friction of both tires at their limits stops, m/s.
    max_held: Lanes,
    /// Friction (m/s) that stops a slip of 1 m/s of one tire against the other.
    stop_turning: Lanes,
    /// `None` if no robot tips.
    tipping: Option<Tipping>,
}

/// Slip of the two tires over the floor, m/s: the velocity of their contact patches.
#[derive(Clone, Copy)]
struct Slip {
    /// Along the wheels, minus the rim speeds: left, right.
    along: [Lanes; 2],
    /// Along the axle, the same for both tires.
    across: Lanes,
}

/// Friction of the floor on the tires in a tick, as changes of the robot's speed, m/s.
struct Friction {
    /// Along the wheels: left, right.
    along: [Lanes; 2],
    /// Along the axle, of both tires.
    across: Lanes,
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
        let (own, other) = (Lanes::ONE + turning, Lanes::ONE - turning);
        let motor =
            lanes(|robot| robot.drive.motor_torque / (robot.drive.wheel_radius * robot.mass))
                * tick;
        let drive = smaller(motor, longitudinal);
        let per_longitudinal = Lanes::ONE / longitudinal;
        let lateral_at = |along: Lanes| lateral * part_left(along * per_longitudinal);
        Self {
            half_track,
            wheel_radius: lanes(|robot| robot.drive.wheel_radius),
            max_wheel_speed: lanes(|robot| robot.drive.max_wheel_speed),
            motor,
            drive,
            longitudinal,
            per_longitudinal,
            lateral_at_motor: lateral_at(motor),
            lateral_at_drive: lateral_at(drive),
            lateral,
            per_lateral: Lanes::ONE / lateral,
            turn,
            own,
            other,
            per_own: Lanes::ONE / own,
            own_and_other: own * own - other * other,
            max_held: (own + other.abs()) * drive,
            stop_turning: Lanes::splat(0.25) / turning,
            tipping: Tipping::of(robots),
        }
    }

    /// The commands `[left, right, ..]`, rad/s, as wheels with errors obey them. A robot clips each of its wheels
    /// before the battery slows both.
    pub(super) fn obeyed(
        &self,
        [left, right, others @ ..]: [Lanes; MAX_COLUMNS],
        errors: WheelErrors<'_>,
    ) -> [Lanes; MAX_COLUMNS] {
        let speeds = [left, right].map(|speed| limited(speed, self.max_wheel_speed));
        let [left, right] = errors.turn(speeds, self.wheel_radius, self.max_wheel_speed);
        [left, right, others[0], others[1]]
    }

    /// Speeds of the rims, m/s, by the commands `[left, right, ..]`, rad/s; the third number means nothing.
    pub(super) fn rims(&self, [left, right, ..]: &[Lanes; MAX_COLUMNS]) -> [Lanes; 3] {
        let rim = |speed: Lanes| self.wheel_radius * limited(speed, self.max_wheel_speed);
        [rim(*left), rim(*right), Lanes::ZERO]
    }

    /// Effect of the wheels whose rims have the speeds `[left, right, ..]`, m/s, in a tick, for the robots
    /// of `mask`, whose tipping is in `state`.
    ///
    /// Rims turn as commanded; friction acts on each tire against its slip at the end of the tick.
    pub(super) fn effect(
        &self,
        mask: Lanes,
        [left, right, _]: &[Lanes; 3],
        own: &OwnMotion,
        state: &mut TippingState,
    ) -> WheelEffect {
        let rims = [*left, *right];
        let mut slip = self.slip(own.velocity, own.angular_velocity, rims);
        let mut load = own.load;
        if let Some(tipping) = &self.tipping {
            let skids = tipping.update_skids(state, mask, slip.along, own.velocity.x);
            let rims = rims.map(|rim| skids.bitselect(Lanes::ZERO, rim));
            slip = self.slip(own.velocity, own.angular_velocity, rims);
            load.x += state.drag;
        }
        let (mut holding, mut holds) = self.holding(&slip, mask);
        if load != VectorLanes::ZERO || own.angular_load != Lanes::ZERO {
            // Tires that hold also compensate the load of the last tick. Those that slide give their
            // maximum whatever the load.
            let added = self.slip(load, own.angular_load, [Lanes::ZERO; 2]);
            slip.along = [0, 1].map(|wheel| slip.along[wheel] + (holds & added.along[wheel]));
            slip.across += holds & added.across;
            (holding, holds) = self.holding(&slip, mask);
        }
        let friction = if (holds | !mask).all() {
            holding
        } else {
            holding.where_else(holds, &self.sliding(&slip))
        };
        let [left, right] = friction.along;
        let mut forward = left + right;
        if let Some(tipping) = &self.tipping {
            let velocity = own.velocity.x + own.load.x + forward;
            state.drag = mask & tipping.drag(friction.along, velocity);
            forward += state.drag;
        }
        WheelEffect {
            velocity: VectorLanes { x: forward, y: friction.across },
            angular_velocity: (right - left) * self.turn,
            change: VectorLanes::ZERO,
        }
    }

    fn slip(&self, velocity: VectorLanes, angular_velocity: Lanes, rims: [Lanes; 2]) -> Slip {
        let turning = angular_velocity * self.half_track;
        let along = [velocity.x - turning - rims[0], velocity.x + turning - rims[1]];
        Slip { along, across: velocity.y }
    }

    /// Friction with which at least one tire does not slip at the end of the tick, and whether motors and
    /// tires can transmit it. Then it is the only solution.
    fn holding(&self, slip: &Slip, mask: Lanes) -> (Friction, Lanes) {
        let rolling = self.rolling(slip);
        let rolls = self.is_possible_in_halves(&rolling);
        if (rolls | !mask).all() {
            return (rolling, rolls);
        }
        let near = self.can_be_held(slip);
        if !(near & mask & !rolls).any() {
            return (rolling, rolls);
        }
        let rolls = rolls | (near & self.is_possible(&rolling));
        let (pivoting, pivots) = self.pivoting(slip, &rolling);
        (rolling.where_else(rolls, &pivoting), rolls | (near & pivots))
    }

    /// Whether friction of both tires at their limits would stop the slip of one: a necessary condition of
    /// [`Self::holding`].
    fn can_be_held(&self, slip: &Slip) -> Lanes {
        let [left, right] = slip.along.map(Lanes::abs);
        smaller(left, right).simd_le(self.max_held)
            & slip.across.abs().simd_le(self.lateral + self.lateral)
    }

    /// Friction that stops all slip within the tick.
    fn rolling(&self, slip: &Slip) -> Friction {
        let [left, right] = slip.along;
        let both = Lanes::splat(-0.25) * (left + right);
        let apart = self.stop_turning * (left - right);
        Friction { along: [both - apart, both + apart], across: -slip.across }
    }

    /// Friction that stops the slip of one tire alone, and whether it is possible. Slip along the axle,
    /// which is the same for both tires, stops as well, so that the other tire slips along its wheel only,
    /// at the limit of its motor or of its grip. That is the tire that needs more friction to roll.
    fn pivoting(&self, slip: &Slip, rolling: &Friction) -> (Friction, Lanes) {
        let [left, right] = rolling.along.map(Lanes::abs);
        let left_slips = right.simd_lt(left);
        let swapped = |[left, right]: [Lanes; 2]| {
            [left_slips.bitselect(right, left), left_slips.bitselect(left, right)]
        };
        let [held, slips] = swapped(slip.along);
        // The slip of the other tire while this one is held has the sign that it would have without friction.
        let direction = slips - held * self.other * self.per_own;
        let other = -limited_to_sign(self.drive, direction);
        let along = -(held + self.other * other) * self.per_own;
        let left = slips + self.own * other + self.other * along;
        let possible = along.abs().simd_le(self.drive)
            & slip.across.abs().simd_le(self.lateral_left(along) + self.lateral_at_drive)
            & (left * direction).simd_ge(Lanes::ZERO);
        (Friction { along: swapped([along, other]), across: -slip.across }, possible)
    }

    /// Whether motors and tires can transmit this friction if both tires give half of that along the axle:
    /// the friction of a tire lies within an ellipse. Then it also is [`Self::is_possible`].
    fn is_possible_in_halves(&self, friction: &Friction) -> Lanes {
        let across = Lanes::splat(0.5) * friction.across * self.per_lateral;
        let [left, right] = friction.along.map(|force| {
            let along = force * self.per_longitudinal;
            force.abs().simd_le(self.motor) & (along * along + across * across).simd_le(Lanes::ONE)
        });
        left & right
    }

    /// Whether motors and tires can transmit this friction: each tire gives along the axle what it has left.
    fn is_possible(&self, friction: &Friction) -> Lanes {
        let [left, right] = friction.along;
        left.abs().simd_le(self.drive)
            & right.abs().simd_le(self.drive)
            & friction.across.abs().simd_le(self.lateral_left(left) + self.lateral_left(right))
    }

    /// Maximum friction along the axle of a tire with friction `along` its wheel, m/s.
    fn lateral_left(&self, along: Lanes) -> Lanes {
        self.lateral * part_left(along * self.per_longitudinal)
    }

    /// Friction of a tire whose motor is weaker than its grip: the rim follows the floor, which leaves the
    /// tire more friction along the axle.
    fn stalled(&self, along: Lanes, across: Lanes) -> (Lanes, Lanes) {
        (limited(along, self.motor), limited(across, self.lateral_at_motor))
    }
}

impl Friction {
    /// `self` in the lanes of `mask`, `other` in the others.
    fn where_else(&self, mask: Lanes, other: &Self) -> Self {
        let choose = |one: [Lanes; 2], two: [Lanes; 2]| {
            [mask.bitselect(one[0], two[0]), mask.bitselect(one[1], two[1])]
        };
        Self {
            along: choose(self.along, other.along),
            across: mask.bitselect(self.across, other.across),
        }
    }
}

/// Part of the friction along the axle that a tire has left if it gives the part `used` of that along the
/// wheel.
fn part_left(used: Lanes) -> Lanes {
    larger(Lanes::ONE - used * used, Lanes::ZERO).sqrt()
}

/// `limit` with the sign of `direction`.
fn limited_to_sign(limit: Lanes, direction: Lanes) -> Lanes {
    direction.simd_lt(Lanes::ZERO).bitselect(-limit, limit)
}

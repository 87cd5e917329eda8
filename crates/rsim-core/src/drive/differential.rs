//! Two wheels on one axle.

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use super::{Demand, Limits, Pull};
use crate::robot_model::DifferentialDrive;

/// Bounds of one tick.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    half_track: f32,
    wheel_radius: f32,
    max_wheel_speed: f32,
    /// N s, per wheel: the weaker of motor and tyre.
    wheel_impulse: f32,
    /// N s, per wheel: the tyre along its wheel, with nothing across.
    tyre_impulse: f32,
    /// N s, per wheel: the tyre along the axle, with nothing forward.
    side_impulse: f32,
}

impl Wheels {
    pub(super) fn of(drive: &DifferentialDrive, mass: f32, tick: f32) -> Self {
        let motor_force = drive.motor_torque / drive.wheel_radius;
        let tyre_force = drive.forward_grip * mass / 2.0;
        Self {
            half_track: drive.track / 2.0,
            wheel_radius: drive.wheel_radius,
            max_wheel_speed: drive.max_wheel_speed,
            wheel_impulse: motor_force.min(tyre_force) * tick,
            tyre_impulse: tyre_force * tick,
            side_impulse: drive.side_grip * mass / 2.0 * tick,
        }
    }

    /// Follows `[left, right, ..]` wheel speeds, rad/s.
    pub(super) fn pull(&self, limits: &Limits, command: &[f32], demand: &Demand) -> Pull {
        let [left, right] = [command[0], command[1]].map(|speed| {
            self.wheel_radius * speed.clamp(-self.max_wheel_speed, self.max_wheel_speed)
        });
        let wanted_speed = left.midpoint(right);
        let wanted_spin = (right - left) / (2.0 * self.half_track);

        let along = limits.mass * (wanted_speed - demand.velocity.x) - demand.load.x;
        let across = -limits.mass * demand.velocity.y - demand.load.y;
        let turn = limits.inertia * (wanted_spin - demand.spin) - demand.turning_load;

        let per_wheel = |part: f32| part.clamp(-self.wheel_impulse, self.wheel_impulse);
        let couple = turn / (2.0 * self.half_track);
        let (left, right) = (per_wheel(along / 2.0 - couple), per_wheel(along / 2.0 + couple));
        let side_limit = self.side_left(left) + self.side_left(right);
        Pull {
            impulse: Vector::new(left + right, across.clamp(-side_limit, side_limit)),
            turn: (right - left) * self.half_track,
        }
    }

    /// What a tyre that gives `forward` (N s) along its wheel has left along the axle: together
    /// they stay within an ellipse. So a robot whose wheels spin skids, and can turn away from a
    /// wall that it stands along.
    fn side_left(&self, forward: f32) -> f32 {
        let used = (forward / self.tyre_impulse).clamp(-1.0, 1.0);
        self.side_impulse * (1.0 - used * used).sqrt()
    }
}

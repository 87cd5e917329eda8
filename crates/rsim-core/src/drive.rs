//! How wheels move a robot: by bounded forces, so that robots push, stall, skid and are pushed.

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use crate::RobotModel;
use crate::engine::Motion;

/// What a robot's wheels can do in one tick: bounds on impulses, and the inertia they act on.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    mass: f32,
    inertia: f32,
    half_track: f32,
    wheel_radius: f32,
    max_wheel_speed: f32,
    /// N s, per wheel: the weaker of motor and tyre.
    wheel_impulse: f32,
    /// N s, per wheel: the tyre along its wheel, with nothing across.
    tyre_impulse: f32,
    /// N s, per wheel: the tyre along the axle, with nothing forward.
    side_impulse: f32,
    tick: f32,
}

impl Limits {
    pub(crate) fn of(model: &RobotModel, tick: f32) -> Self {
        let drive = &model.drive;
        let motor_force = drive.motor_torque / drive.wheel_radius;
        let tyre_force = drive.forward_grip * model.mass / 2.0;
        Self {
            mass: model.mass,
            inertia: model.mass * model.size * model.size / 6.0, // a square plate's
            half_track: drive.track / 2.0,
            wheel_radius: drive.wheel_radius,
            max_wheel_speed: drive.max_wheel_speed,
            wheel_impulse: motor_force.min(tyre_force) * tick,
            tyre_impulse: tyre_force * tick,
            side_impulse: drive.side_grip * model.mass / 2.0 * tick,
            tick,
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

/// What a robot's wheels remember from one tick to the next.
///
/// A bounded correction of the velocity alone creeps when the robot is pushed: each tick undoes
/// only what the last one did. So wheels also carry over the load that they felt in the last tick,
/// within the same bounds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Drive {
    /// Impulse that others gave in the last tick, N s.
    load: Vector,
    /// Likewise about the vertical axis, N m s.
    turning_load: f32,
    expected_velocity: Vector,
    expected_spin: f32,
}

impl Drive {
    /// Force (N) and torque (N m) with which the wheels follow `[left, right]` (rad/s) for a tick.
    pub(crate) fn pull(
        &mut self,
        limits: &Limits,
        wheels: [f32; 2],
        motion: &Motion,
    ) -> (Vector, f32) {
        let forward = motion.heading;
        let side = Vector::new(-forward.y, forward.x);
        let [left, right] = wheels.map(|speed| {
            limits.wheel_radius * speed.clamp(-limits.max_wheel_speed, limits.max_wheel_speed)
        });
        let wanted_speed = left.midpoint(right);
        let wanted_spin = (right - left) / (2.0 * limits.half_track);

        let along =
            limits.mass * (wanted_speed - motion.velocity.dot(forward)) - self.load.dot(forward);
        let across = -limits.mass * motion.velocity.dot(side) - self.load.dot(side);
        let turn = limits.inertia * (wanted_spin - motion.spin) - self.turning_load;

        let per_wheel = |share: f32| share.clamp(-limits.wheel_impulse, limits.wheel_impulse);
        let couple = turn / (2.0 * limits.half_track);
        let (left, right) = (per_wheel(along / 2.0 - couple), per_wheel(along / 2.0 + couple));
        let side_limit = limits.side_left(left) + limits.side_left(right);
        let across = across.clamp(-side_limit, side_limit);
        let impulse = forward * (left + right) + side * across;
        let turn = (right - left) * limits.half_track;

        self.expected_velocity = motion.velocity + impulse / limits.mass;
        self.expected_spin = motion.spin + turn / limits.inertia;
        (impulse / limits.tick, turn / limits.tick)
    }

    /// Takes note of what the tick did beyond what the wheels had asked for.
    pub(crate) fn feel(&mut self, limits: &Limits, motion: &Motion) {
        self.load = (motion.velocity - self.expected_velocity) * limits.mass;
        self.turning_load = (motion.spin - self.expected_spin) * limits.inertia;
    }
}

//! Wheels that move a robot by bounded forces, so that robots push, stall, skid and are pushed.

mod differential;
mod omni;

use serde::{Deserialize, Serialize};

use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::robot::{Drive, RobotModel};

/// Limits of a robot's wheels in one tick, and the inertia that they move.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct DriveLimits {
    /// kg.
    mass: f32,
    /// kg m².
    inertia: f32,
    /// s.
    tick: f32,
    wheels: Wheels,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
enum Wheels {
    Differential(differential::Wheels),
    /// Commanded by the body's velocity.
    Omni(omni::Wheels),
    /// Commanded by the wheels' speeds.
    EachOmni(omni::Wheels),
}

impl DriveLimits {
    pub(crate) fn of(model: &RobotModel, tick: f32) -> Self {
        let (mass, inertia) = (model.mass, model.inertia());
        let wheels = match &model.drive {
            Drive::Differential(drive) => {
                Wheels::Differential(differential::Wheels::of(drive, mass, tick))
            }
            Drive::Omni(drive) => Wheels::Omni(omni::Wheels::of(drive, mass, inertia, tick)),
            Drive::OmniWheels(drive) => {
                Wheels::EachOmni(omni::Wheels::of(drive, mass, inertia, tick))
            }
        };
        Self { mass, inertia, tick, wheels }
    }
}

/// Motion and estimated load of a robot in its own frame: x forward, y to its left.
struct BodyState {
    /// m/s.
    velocity: Vector,
    /// rad/s.
    spin: f32,
    /// Impulse by other bodies in the last tick, N s.
    load: Vector,
    /// Angular impulse by other bodies in the last tick, N m s.
    angular_load: f32,
    /// Change of velocity by the wheels in the last tick, without the compensation of loads, m/s.
    last_change: Vector,
}

/// Effect of the wheels in a tick, in the robot's own frame.
struct WheelImpulse {
    /// N s.
    impulse: Vector,
    /// N m s.
    angular_impulse: f32,
    /// Part of the impulse without the compensation of loads, as a change of velocity, m/s.
    change: Vector,
}

/// State of a robot's wheels between ticks.
///
/// A bounded correction of the velocity alone lets a pushed robot creep: each tick corrects only the
/// error of the last one. So wheels also compensate the load of the last tick, within the same bounds.
/// They do so only while the robot is in contact: the load of an impact does not come again.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct DriveState {
    /// Impulse by other bodies in the last tick, N s.
    load: Vector,
    /// Angular impulse by other bodies in the last tick, N m s.
    angular_load: f32,
    /// Change of velocity by the wheels in the last tick, without the compensation of loads, m/s.
    change: Vector,
    /// Velocity after the tick without contacts, m/s.
    expected_velocity: Vector,
    /// Turn rate after the tick without contacts, rad/s.
    expected_spin: f32,
}

impl DriveState {
    /// Force (N) and torque (N m) of the wheels that follow `command` for a tick.
    pub(crate) fn wheel_force(
        &mut self,
        limits: &DriveLimits,
        command: &[f32],
        motion: &Motion,
    ) -> (Vector, f32) {
        let own = |vector: Vector| {
            let (cos, sin) = (motion.heading.x, motion.heading.y);
            Vector::new(vector.x * cos + vector.y * sin, vector.y * cos - vector.x * sin)
        };
        let body = BodyState {
            velocity: own(motion.velocity),
            spin: motion.spin,
            load: own(self.load),
            angular_load: self.angular_load,
            last_change: own(self.change),
        };
        let wheels = match &limits.wheels {
            Wheels::Differential(wheels) => wheels.impulse(limits, command, &body),
            Wheels::Omni(wheels) => {
                wheels.impulse(limits, &wheels.target_of_velocity(command), &body)
            }
            Wheels::EachOmni(wheels) => {
                wheels.impulse(limits, &wheels.target_of_wheel_speeds(command), &body)
            }
        };
        let to_field = |own: Vector| motion.heading * own.x + motion.heading.perp() * own.y;
        let impulse = to_field(wheels.impulse);
        self.change = to_field(wheels.change);
        self.expected_velocity = motion.velocity + impulse / limits.mass;
        self.expected_spin = motion.spin + wheels.angular_impulse / limits.inertia;
        (impulse / limits.tick, wheels.angular_impulse / limits.tick)
    }

    /// Estimates the load of the tick from the difference to the expected motion. A robot that is not
    /// `in_contact` after the tick has none.
    pub(crate) fn estimate_load(
        &mut self,
        limits: &DriveLimits,
        motion: &Motion,
        in_contact: bool,
    ) {
        let factor = if in_contact { 1.0 } else { 0.0 };
        self.load = (motion.velocity - self.expected_velocity) * (limits.mass * factor);
        self.angular_load = (motion.spin - self.expected_spin) * (limits.inertia * factor);
    }
}

//! How wheels move a robot: by bounded forces, so that robots push, stall, skid and are pushed.

mod differential;
mod omni;

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use crate::RobotModel;
use crate::engine::Motion;
use crate::robot_model;

/// Faster than anything is ever told to be, m/s: its square is still finite.
pub(crate) const ABSURD: f32 = 1e9;

/// What a robot's wheels can do in one tick: bounds on impulses, and the inertia they act on.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Limits {
    mass: f32,
    inertia: f32,
    tick: f32,
    wheels: Wheels,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
enum Wheels {
    Differential(differential::Wheels),
    /// Told the body's velocity.
    Omni(omni::Wheels),
    /// Told the wheels' speeds.
    EachOmni(omni::Wheels),
}

impl Limits {
    pub(crate) fn of(model: &RobotModel, tick: f32) -> Self {
        let (mass, inertia) = (model.mass, model.inertia());
        let wheels = match &model.drive {
            robot_model::Drive::Differential(drive) => {
                Wheels::Differential(differential::Wheels::of(drive, mass, tick))
            }
            robot_model::Drive::Omni(drive) => {
                Wheels::Omni(omni::Wheels::of(drive, mass, inertia, tick))
            }
            robot_model::Drive::OmniWheels(drive) => {
                Wheels::EachOmni(omni::Wheels::of(drive, mass, inertia, tick))
            }
        };
        Self { mass, inertia, tick, wheels }
    }
}

/// What wheels are asked for in a tick, in the robot's own frame: x forward, y to its left.
struct Demand {
    /// Velocity of the robot, m/s.
    velocity: Vector,
    /// rad/s.
    spin: f32,
    /// Impulse that others gave it in the last tick, N s.
    load: Vector,
    /// The same about the vertical axis, N m s.
    turning_load: f32,
    /// Change of velocity by the wheels in the last tick, as far as for their command's sake, m/s.
    last_change: Vector,
}

/// What wheels give in a tick, in the robot's own frame: N s and N m s.
struct Pull {
    impulse: Vector,
    turn: f32,
    /// The part of the impulse that is for the command's sake, as a change of velocity, m/s.
    change: Vector,
}

/// What a robot's wheels remember from one tick to the next.
///
/// A bounded correction of the velocity alone creeps when the robot is pushed: each tick undoes
/// only what the last one did. So wheels also carry over the load that they felt in the last tick,
/// within the same bounds. They do so only while the robot leans on something: the load of an impact
/// does not come again.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Drive {
    /// Impulse that others gave in the last tick, N s.
    load: Vector,
    /// Likewise about the vertical axis, N m s.
    turning_load: f32,
    /// Change of velocity by the wheels in the last tick, as far as for their command's sake, m/s.
    change: Vector,
    /// What the robot will do if nobody touches it.
    pub(crate) expected_velocity: Vector,
    pub(crate) expected_spin: f32,
}

impl Drive {
    /// Force (N) and torque (N m) with which the wheels follow `command` for a tick.
    pub(crate) fn pull(
        &mut self,
        limits: &Limits,
        command: &[f32],
        motion: &Motion,
    ) -> (Vector, f32) {
        let own = |vector: Vector| {
            let (cos, sin) = (motion.heading.x, motion.heading.y);
            Vector::new(vector.x * cos + vector.y * sin, vector.y * cos - vector.x * sin)
        };
        let demand = Demand {
            velocity: own(motion.velocity),
            spin: motion.spin,
            load: own(self.load),
            turning_load: self.turning_load,
            last_change: own(self.change),
        };
        let pull = match &limits.wheels {
            Wheels::Differential(wheels) => wheels.pull(limits, command, &demand),
            Wheels::Omni(wheels) => wheels.pull(limits, &wheels.wanted(command), &demand),
            Wheels::EachOmni(wheels) => wheels.pull(limits, &wheels.rolled(command), &demand),
        };
        let turned = |own: Vector| motion.heading * own.x + motion.heading.perp() * own.y;
        let impulse = turned(pull.impulse);
        self.change = turned(pull.change);
        self.expected_velocity = motion.velocity + impulse / limits.mass;
        self.expected_spin = motion.spin + pull.turn / limits.inertia;
        (impulse / limits.tick, pull.turn / limits.tick)
    }

    /// Takes note of what the tick did beyond what the wheels had asked for. `leans` says whether the
    /// robot stays in contact with what pressed on it.
    pub(crate) fn feel(&mut self, limits: &Limits, motion: &Motion, leans: bool) {
        let felt = if leans { 1.0 } else { 0.0 };
        self.load = (motion.velocity - self.expected_velocity) * (limits.mass * felt);
        self.turning_load = (motion.spin - self.expected_spin) * (limits.inertia * felt);
    }
}

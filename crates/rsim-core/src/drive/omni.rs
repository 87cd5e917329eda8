//! Four omnidirectional wheels around a robot.

use serde::{Deserialize, Serialize};

use super::{Driven, MAX_COLUMNS, OwnMotion, WheelEffect, WheelErrors, saturation_factor};
use crate::blocks::{LANES, Lanes, VectorLanes, lanes_of, larger, limited, smaller};
use crate::columns::MAX_COMMAND;
use crate::math::Rotation;
use crate::models::robot::OmniDrive;

/// Limits of one tick, and the kinematics between body velocity and wheel speeds.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    /// Wheel speeds (rad/s) from velocity forward and to the left and angular velocity, one row per wheel.
    from_body: [[Lanes; 3]; 4],
    /// Least-squares inverse of `from_body`, for wheel speeds that do not fit together.
    to_body: [[Lanes; 4]; 3],
    wheel_radius: Lanes,
    max_wheel_speed: Lanes,
    max_speed: Lanes,
    max_angular_velocity: Lanes,
    /// Maximum changes of velocity in one tick, m/s.
    speed_gain: Lanes,
    speed_loss: Lanes,
    /// Maximum changes of the angular velocity in one tick, rad/s.
    angular_gain: Lanes,
    angular_loss: Lanes,
    /// Maximum change of velocity by friction, m/s.
    traction: Lanes,
    /// Maximum change of the angular velocity by friction, rad/s.
    angular_traction: Lanes,
    /// Maximum difference to the last tick's change of velocity, m/s; infinite without a limit.
    jerk: Lanes,
}

impl Wheels {
    pub(super) fn of(robots: &[Driven<OmniDrive>; LANES], tick: f32) -> Self {
        let lanes =
            |number: &dyn Fn(&Driven<OmniDrive>) -> f32| lanes_of(|lane| number(&robots[lane]));
        let from_body = robots.each_ref().map(|robot| from_body(robot.drive));
        let to_body = from_body.each_ref().map(least_squares_inverse);
        Self {
            from_body: std::array::from_fn(|wheel| {
                std::array::from_fn(|part| lanes_of(|lane| from_body[lane][wheel][part]))
            }),
            to_body: std::array::from_fn(|part| {
                std::array::from_fn(|wheel| lanes_of(|lane| to_body[lane][part][wheel]))
            }),
            wheel_radius: lanes(&|robot| robot.drive.wheel_radius),
            max_wheel_speed: lanes(&|robot| robot.drive.max_wheel_speed),
            max_speed: lanes(&|robot| robot.drive.max_speed),
            max_angular_velocity: lanes(&|robot| robot.drive.max_angular_velocity),
            speed_gain: lanes(&|robot| robot.drive.max_acceleration * tick),
            speed_loss: lanes(&|robot| robot.drive.max_deceleration * tick),
            angular_gain: lanes(&|robot| robot.drive.max_angular_acceleration * tick),
            angular_loss: lanes(&|robot| robot.drive.max_angular_deceleration * tick),
            traction: lanes(&|robot| robot.drive.max_traction * tick),
            // The wheels' forces act at their distance; at least what free turning takes.
            angular_traction: lanes(&|Driven { drive, mass, inertia }| {
                let by_wheels = drive.max_traction * drive.wheel_distance * mass / inertia;
                let free = drive.max_angular_acceleration.max(drive.max_angular_deceleration);
                by_wheels.max(free) * tick
            }),
            jerk: lanes(&|robot| {
                let jerk = robot.drive.max_jerk;
                if jerk > 0.0 { jerk * tick * tick } else { f32::INFINITY }
            }),
        }
    }

    /// The commands `[forward, left, angular velocity, ..]` as wheels with errors obey them. The robot limits its own
    /// speeds before those of its wheels.
    pub(super) fn obeyed_velocity(
        &self,
        [x, y, turn, other]: [Lanes; MAX_COLUMNS],
        errors: WheelErrors<'_>,
    ) -> [Lanes; MAX_COLUMNS] {
        let battery = Lanes::splat(errors.battery);
        let [x, y] = [x, y].map(|speed| limited(speed, Lanes::splat(MAX_COMMAND)));
        let velocity = VectorLanes { x, y }.of_length_at_most(battery * self.max_speed);
        let turn = limited(turn, battery * self.max_angular_velocity);
        let speeds = self.wheel_speeds(velocity, turn);
        let speeds = errors.turn(speeds, self.wheel_radius, self.max_wheel_speed);
        let [x, y, turn] = self.body_velocity(&speeds);
        [x, y, turn, other]
    }

    /// The commands of four wheel speeds, rad/s, as wheels with errors obey them.
    pub(super) fn obeyed_wheel_speeds(
        &self,
        speeds: [Lanes; MAX_COLUMNS],
        errors: WheelErrors<'_>,
    ) -> [Lanes; MAX_COLUMNS] {
        errors.turn(speeds, self.wheel_radius, self.max_wheel_speed)
    }

    /// Wheel speeds (rad/s) of velocities forward and to the left (m/s) and angular velocities (rad/s).
    fn wheel_speeds(&self, velocity: VectorLanes, turn: Lanes) -> [Lanes; 4] {
        self.from_body.map(|row| row[0] * velocity.x + row[1] * velocity.y + row[2] * turn)
    }

    /// The velocities and angular velocities that fit the speeds of four wheels best.
    fn body_velocity(&self, speeds: &[Lanes; 4]) -> [Lanes; 3] {
        self.to_body.map(|row| {
            row[0] * speeds[0] + row[1] * speeds[1] + row[2] * speeds[2] + row[3] * speeds[3]
        })
    }

    /// Target of the commands `[forward, left, angular velocity, ..]`: velocity forward and to the left, m/s, and angular
    /// velocity, rad/s.
    pub(super) fn target_of_velocity(&self, command: &[Lanes; MAX_COLUMNS]) -> [Lanes; 3] {
        let limit = Lanes::splat(MAX_COMMAND);
        let [x, y] = [command[0], command[1]].map(|speed| limited(speed, limit));
        self.saturated(VectorLanes { x, y }, command[2])
    }

    /// Target of commands of four wheel speeds, rad/s.
    pub(super) fn target_of_wheel_speeds(&self, command: &[Lanes; MAX_COLUMNS]) -> [Lanes; 3] {
        let factor = saturation_factor(command, self.max_wheel_speed);
        let speeds = command.map(|speed| speed * factor);
        let [x, y, angular_velocity] = self.body_velocity(&speeds);
        self.saturated(VectorLanes { x, y }, angular_velocity)
    }

    /// The target within the maximum speeds, without a change of direction.
    fn saturated(&self, velocity: VectorLanes, angular_velocity: Lanes) -> [Lanes; 3] {
        let velocity = velocity.of_length_at_most(self.max_speed);
        let angular_velocity = limited(angular_velocity, self.max_angular_velocity);
        let speeds = self.wheel_speeds(velocity, angular_velocity);
        let factor = saturation_factor(&speeds, self.max_wheel_speed);
        let VectorLanes { x, y } = velocity * factor;
        [x, y, angular_velocity * factor]
    }

    /// Whether the jerk of some robots is limited.
    pub(super) fn limits_jerk(&self) -> bool {
        self.jerk.simd_lt(Lanes::splat(f32::INFINITY)).any()
    }

    /// Effect in a tick of wheels with a target velocity forward and to the left, m/s, and angular velocity, rad/s.
    pub(super) fn effect(&self, [x, y, turn]: &[Lanes; 3], own: &OwnMotion) -> WheelEffect {
        let error = VectorLanes { x: *x, y: *y } - own.velocity;
        let slower = error.dot(own.velocity).simd_lt(Lanes::ZERO);
        let limit = slower.bitselect(self.speed_loss, self.speed_gain);
        let change = error.of_length_at_most(self.jerk_limited_change(error, limit));
        let change = self.jerk_limited(change, own);
        let angular_error = *turn - own.angular_velocity;
        let slower = (angular_error * own.angular_velocity).simd_lt(Lanes::ZERO);
        let limit = slower.bitselect(self.angular_loss, self.angular_gain);
        let angular_change = limited(angular_error, limit);
        let load = compensated_load(own.load, error, change);
        let compensates = angular_error.abs().simd_le(limit)
            | (angular_change * own.angular_load).simd_lt(Lanes::ZERO);
        let angular_load = compensates & own.angular_load;
        WheelEffect {
            change,
            velocity: (change - load).of_length_at_most(self.traction),
            angular_velocity: limited(angular_change - angular_load, self.angular_traction),
        }
    }

    /// Maximum change of speed (m/s) in a tick, at most `limit`, that can still fall to 0 by the time
    /// the velocity error is gone.
    fn jerk_limited_change(&self, error: VectorLanes, limit: Lanes) -> Lanes {
        let is_limited = self.jerk.simd_lt(Lanes::splat(f32::INFINITY));
        if !is_limited.any() {
            return limit;
        }
        // n ticks whose changes fall by `jerk` each sum up to n (n + 1) / 2 of it.
        let length = error.length_squared().sqrt();
        let ticks = (Lanes::splat(2.0) * length / self.jerk + Lanes::splat(0.25)).sqrt()
            - Lanes::splat(0.5);
        let change = smaller(limit, self.jerk * larger(ticks, Lanes::ZERO));
        is_limited.bitselect(change, limit)
    }

    /// The change of velocity (m/s) nearest to `change` that the jerk limit allows after the last one.
    fn jerk_limited(&self, change: VectorLanes, own: &OwnMotion) -> VectorLanes {
        let is_limited = self.jerk.simd_lt(Lanes::splat(f32::INFINITY));
        if !is_limited.any() {
            return change;
        }
        let allowed = own.last_change + (change - own.last_change).of_length_at_most(self.jerk);
        allowed.where_else(is_limited, change)
    }
}

/// The part of a load that the wheels compensate, m/s. While the velocity error exceeds the change of
/// this tick, the part along the change is left out: wheels do not work against their own command.
fn compensated_load(load: VectorLanes, error: VectorLanes, change: VectorLanes) -> VectorLanes {
    if load == VectorLanes::ZERO {
        return load;
    }
    let squared = change.length_squared();
    let moves = squared.simd_gt(Lanes::splat(f32::MIN_POSITIVE));
    let along = larger(load.dot(change), Lanes::ZERO) / squared;
    let exceeds = !(change.x.simd_eq(error.x) & change.y.simd_eq(error.y));
    load - change * (moves & exceeds & along)
}

/// Kinematics of one robot: from the velocity of its body to the speeds of its wheels.
pub(crate) struct WheelMap {
    from_body: [[f32; 3]; 4],
}

impl WheelMap {
    pub(crate) fn of(drive: &OmniDrive) -> Self {
        Self { from_body: from_body(drive) }
    }

    /// Wheel speeds (rad/s) of a velocity forward and to the left (m/s) and an angular velocity (rad/s).
    pub(crate) fn wheel_speeds(&self, [x, y, turn]: [f32; 3]) -> [f32; 4] {
        self.from_body.map(|row| row[0] * x + row[1] * y + row[2] * turn)
    }
}

/// Wheel speeds (rad/s) from velocity forward and to the left and angular velocity, one row per wheel.
fn from_body(drive: &OmniDrive) -> [[f32; 3]; 4] {
    drive.wheel_angles.map(|degrees| {
        let Rotation { re: cos, im: sin } = Rotation::new(degrees.to_radians());
        [-sin, cos, drive.wheel_distance].map(|part| part / drive.wheel_radius)
    })
}

/// `(A^T A)^-1 A^T` of the four rows of A.
fn least_squares_inverse(rows: &[[f32; 3]; 4]) -> [[f32; 4]; 3] {
    let mut product = [[0.0_f32; 3]; 3];
    for (i, line) in product.iter_mut().enumerate() {
        for (j, entry) in line.iter_mut().enumerate() {
            *entry = rows.iter().map(|row| row[i] * row[j]).sum();
        }
    }
    let minor = |i: usize, j: usize| {
        let at = |di: usize, dj: usize| product[(i + di) % 3][(j + dj) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant: f32 = (0..3).map(|j| product[0][j] * minor(0, j)).sum();
    std::array::from_fn(|i| {
        std::array::from_fn(|wheel| {
            (0..3).map(|j| minor(j, i) / determinant * rows[wheel][j]).sum()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::robot::{Drive, RobotModel};

    fn wheels(model: &RobotModel) -> Wheels {
        let (Drive::Omni(drive) | Drive::OmniWheels(drive)) = &model.drive else {
            panic!("{} has other wheels", model.name)
        };
        let robot = || Driven { drive, mass: model.mass, inertia: model.inertia() };
        Wheels::of(&std::array::from_fn(|_| robot()), 0.005)
    }

    fn command(numbers: [f32; MAX_COLUMNS]) -> [Lanes; MAX_COLUMNS] {
        numbers.map(Lanes::splat)
    }

    /// Velocity forward and to the left, and angular velocity, in one lane.
    fn speeds(target: &[Lanes; 3], lane: usize) -> [f32; 3] {
        target.map(|speed| speed.as_array()[lane])
    }

    #[test]
    fn wheel_speeds_and_body_velocity_are_equivalent() {
        for model in RobotModel::PRESETS.into_iter().filter(|model| model.mouth.is_some()) {
            let wheels = wheels(&model);
            for body in [[1.0, 0.0, 0.0], [0.0, -0.7, 0.0], [0.3, 0.2, 3.0]] {
                let wheel_speeds = wheels.from_body.map(|row| {
                    row[0] * Lanes::splat(body[0])
                        + row[1] * Lanes::splat(body[1])
                        + row[2] * Lanes::splat(body[2])
                });
                let target = wheels.target_of_wheel_speeds(&wheel_speeds);
                for lane in 0..LANES {
                    for (got, expected) in speeds(&target, lane).iter().zip(body) {
                        assert!((got - expected).abs() < 1e-4, "{}: {got} {expected}", model.name);
                    }
                }
            }
        }
    }

    #[test]
    fn a_saturated_wheel_slows_all_and_keeps_the_direction() {
        let wheels = wheels(&RobotModel::SSL_GENERIC);
        let target = wheels.target_of_velocity(&command([3.0, 1.5, 20.0, 0.0]));
        let [forward, left, turn] = speeds(&target, 1);
        assert!(forward.hypot(left) < 3.0, "it is slower: {forward} {left}");
        assert!((left / forward - 0.5).abs() < 1e-5);
        assert!((turn / forward - 20.0 / 3.0).abs() < 1e-4);
    }
}

//! Four omnidirectional wheels around a robot.

use serde::{Deserialize, Serialize};

use super::{BodyState, DriveLimits, WheelImpulse};
use crate::columns::MAX_COMMAND;
use crate::math::{Rotation, Vector};
use crate::models::robot::OmniDrive;

/// Target velocity (m/s) and turn rate (rad/s) of a body, in its own frame.
pub(super) struct TargetVelocity {
    velocity: Vector,
    spin: f32,
}

/// Limits of one tick, and the kinematics between body velocity and wheel speeds.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    /// Wheel speeds (rad/s) from forward, left and turning speed, one row per wheel.
    from_body: [[f32; 3]; 4],
    /// Least-squares inverse of `from_body`, for wheel speeds that do not fit together.
    to_body: [[f32; 4]; 3],
    max_wheel_speed: f32,
    max_speed: f32,
    max_turn_rate: f32,
    /// Maximum changes of velocity in one tick, m/s.
    speed_gain: f32,
    speed_loss: f32,
    /// Maximum changes of the turn rate in one tick, rad/s.
    spin_gain: f32,
    spin_loss: f32,
    /// Maximum impulse, N s.
    traction: f32,
    /// Maximum angular impulse, N m s.
    angular_traction: f32,
    /// Maximum difference to the last tick's change of velocity, m/s; infinite without a limit.
    jerk: f32,
}

impl Wheels {
    pub(super) fn of(drive: &OmniDrive, mass: f32, inertia: f32, tick: f32) -> Self {
        let from_body = drive.wheel_angles.map(|degrees| {
            let Rotation { re: cos, im: sin } = Rotation::new(degrees.to_radians());
            [-sin, cos, drive.wheel_distance].map(|part| part / drive.wheel_radius)
        });
        let traction = drive.max_traction * mass * tick;
        Self {
            from_body,
            to_body: least_squares_inverse(&from_body),
            max_wheel_speed: drive.max_wheel_speed,
            max_speed: drive.max_speed,
            max_turn_rate: drive.max_turn_rate,
            speed_gain: drive.max_acceleration * tick,
            speed_loss: drive.max_deceleration * tick,
            spin_gain: drive.max_angular_acceleration * tick,
            spin_loss: drive.max_angular_deceleration * tick,
            traction,
            jerk: if drive.max_jerk > 0.0 { drive.max_jerk * tick * tick } else { f32::INFINITY },
            // The wheels' forces act at their distance; at least what free turning takes.
            angular_traction: (traction * drive.wheel_distance).max(
                inertia * drive.max_angular_acceleration.max(drive.max_angular_deceleration) * tick,
            ),
        }
    }

    /// Target of the command `[forward, left, turn, ..]`.
    pub(super) fn target_of_velocity(&self, command: &[f32]) -> TargetVelocity {
        let limit = Vector::splat(MAX_COMMAND);
        self.saturated(Vector::new(command[0], command[1]).clamp(-limit, limit), command[2])
    }

    /// Target of a command of four wheel speeds, rad/s.
    pub(super) fn target_of_wheel_speeds(&self, command: &[f32]) -> TargetVelocity {
        let fastest = command[..4].iter().fold(0.0_f32, |most, speed| most.max(speed.abs()));
        let factor = self.saturation_factor(fastest);
        let [forward, left, turn] = self.to_body.map(|row| {
            row.iter().zip(command).map(|(weight, speed)| weight * (speed * factor)).sum::<f32>()
        });
        self.saturated(Vector::new(forward, left), turn)
    }

    /// The target within the maximum speeds, without a change of direction.
    fn saturated(&self, velocity: Vector, spin: f32) -> TargetVelocity {
        let velocity = velocity.clamp_length_max(self.max_speed);
        let spin = spin.clamp(-self.max_turn_rate, self.max_turn_rate);
        let fastest = self.from_body.iter().fold(0.0_f32, |most, row| {
            most.max((row[0] * velocity.x + row[1] * velocity.y + row[2] * spin).abs())
        });
        let factor = self.saturation_factor(fastest);
        TargetVelocity { velocity: velocity * factor, spin: spin * factor }
    }

    /// Factor on all wheel speeds if the fastest would turn at `fastest`, rad/s.
    fn saturation_factor(&self, fastest: f32) -> f32 {
        if fastest > self.max_wheel_speed { self.max_wheel_speed / fastest } else { 1.0 }
    }

    /// Impulse of the wheels in a tick.
    pub(super) fn impulse(
        &self,
        limits: &DriveLimits,
        target: &TargetVelocity,
        body: &BodyState,
    ) -> WheelImpulse {
        let error = target.velocity - body.velocity;
        let slower = error.dot(body.velocity) < 0.0;
        let limit = if slower { self.speed_loss } else { self.speed_gain };
        let change = error.clamp_length_max(self.jerk_limited_change(error, limit));
        let change = self.jerk_limited(change, body);
        let spin_error = target.spin - body.spin;
        let slower = spin_error * body.spin < 0.0;
        let limit = if slower { self.spin_loss } else { self.spin_gain };
        let spin_change = spin_error.clamp(-limit, limit);
        let load = compensated_load(body.load, error, change);
        let compensates = spin_error.abs() <= limit || spin_change * body.angular_load < 0.0;
        let angular_load = if compensates { body.angular_load } else { 0.0 };
        WheelImpulse {
            change,
            impulse: (change * limits.mass - load).clamp_length_max(self.traction),
            angular_impulse: (limits.inertia * spin_change - angular_load)
                .clamp(-self.angular_traction, self.angular_traction),
        }
    }

    /// Maximum change of speed (m/s) in a tick, at most `limit`, that can still fall to 0 by the time
    /// the velocity error is gone.
    fn jerk_limited_change(&self, error: Vector, limit: f32) -> f32 {
        if self.jerk.is_infinite() {
            return limit;
        }
        // n ticks whose changes fall by `jerk` each sum up to n (n + 1) / 2 of it.
        let ticks = (2.0 * error.length() / self.jerk + 0.25).sqrt() - 0.5;
        limit.min(self.jerk * ticks.max(0.0))
    }

    /// The change of velocity (m/s) nearest to `change` that the jerk limit allows after the last one.
    fn jerk_limited(&self, change: Vector, body: &BodyState) -> Vector {
        if self.jerk.is_infinite() {
            return change;
        }
        body.last_change + (change - body.last_change).clamp_length_max(self.jerk)
    }
}

/// The part of a load that the wheels compensate, N s. While the velocity error exceeds the change of
/// this tick, the part along the change is left out: wheels do not work against their own command.
fn compensated_load(load: Vector, error: Vector, change: Vector) -> Vector {
    if change == error {
        return load;
    }
    let direction = change.normalize_or_zero();
    load - direction * load.dot(direction).max(0.0)
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
        let (Drive::Omni(drive) | Drive::OmniWheels(drive)) = model.drive else {
            panic!("{} has other wheels", model.name)
        };
        Wheels::of(&drive, model.mass, model.inertia(), 0.005)
    }

    #[test]
    fn wheel_speeds_and_body_velocity_are_equivalent() {
        for model in RobotModel::PRESETS.into_iter().filter(|model| model.mouth.is_some()) {
            let wheels = wheels(&model);
            for body in [[1.0, 0.0, 0.0], [0.0, -0.7, 0.0], [0.3, 0.2, 3.0]] {
                let speeds = wheels
                    .from_body
                    .map(|row| row.iter().zip(body).map(|(a, b)| a * b).sum::<f32>());
                let TargetVelocity { velocity, spin } = wheels.target_of_wheel_speeds(&speeds);
                let got = [velocity.x, velocity.y, spin];
                for (got, expected) in got.iter().zip(body) {
                    assert!((got - expected).abs() < 1e-4, "{}: {got} {expected}", model.name);
                }
            }
        }
    }

    #[test]
    fn a_saturated_wheel_slows_all_and_keeps_the_direction() {
        let wheels = wheels(&RobotModel::SSL_GENERIC);
        let TargetVelocity { velocity, spin } = wheels.target_of_velocity(&[3.0, 1.5, 20.0]);
        assert!(velocity.length() < 3.0, "it is slower: {velocity}");
        assert!((velocity.y / velocity.x - 0.5).abs() < 1e-5);
        assert!((spin / velocity.x - 20.0 / 3.0).abs() < 1e-4);
    }
}

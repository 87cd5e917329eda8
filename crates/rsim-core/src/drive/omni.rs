//! Four omnidirectional wheels around a robot.

use rapier2d::math::{Rotation, Vector};
use serde::{Deserialize, Serialize};

use super::{ABSURD, Demand, Limits, Pull};
use crate::robot_model::OmniDrive;

/// What a body is to do, in its own frame: velocity (m/s) and turn rate (rad/s).
pub(super) struct Wanted {
    velocity: Vector,
    spin: f32,
}

/// Bounds of one tick, and how the body's motion and the wheels' speeds go together.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Wheels {
    /// Wheel speeds (rad/s) from forward, left and turning speed, a row a wheel.
    from_body: [[f32; 3]; 4],
    /// The least-squares inverse: what the body does when the wheels disagree.
    to_body: [[f32; 4]; 3],
    max_wheel_speed: f32,
    max_speed: f32,
    max_turn_rate: f32,
    /// m/s and rad/s in one tick.
    speed_up: f32,
    brake: f32,
    turn_speed_up: f32,
    turn_brake: f32,
    /// N s and N m s.
    traction: f32,
    turn_traction: f32,
    /// m/s in one tick, more or less than in the last; infinite without a limit.
    jerk: f32,
}

impl Wheels {
    pub(super) fn of(drive: &OmniDrive, mass: f32, inertia: f32, tick: f32) -> Self {
        let from_body = drive.wheel_angles.map(|degrees| {
            let Rotation { re: cos, im: sin } = Rotation::new(degrees.to_radians());
            [-sin, cos, drive.wheel_distance].map(|part| part / drive.wheel_radius)
        });
        let traction = drive.traction * mass * tick;
        Self {
            from_body,
            to_body: least_squares_inverse(&from_body),
            max_wheel_speed: drive.max_wheel_speed,
            max_speed: drive.max_speed,
            max_turn_rate: drive.max_turn_rate,
            speed_up: drive.speed_up * tick,
            brake: drive.brake * tick,
            turn_speed_up: drive.turn_speed_up * tick,
            turn_brake: drive.turn_brake * tick,
            traction,
            jerk: if drive.jerk > 0.0 { drive.jerk * tick * tick } else { f32::INFINITY },
            // The wheels' forces act at their distance; never so weak that it could not turn freely.
            turn_traction: (traction * drive.wheel_distance)
                .max(inertia * drive.turn_speed_up.max(drive.turn_brake) * tick),
        }
    }

    /// What `[forward, left, turn, ..]` asks for.
    pub(super) fn wanted(&self, command: &[f32]) -> Wanted {
        let far = Vector::splat(ABSURD);
        self.within_reach(Vector::new(command[0], command[1]).clamp(-far, far), command[2])
    }

    /// What four wheel speeds ask for, rad/s.
    pub(super) fn rolled(&self, command: &[f32]) -> Wanted {
        let fastest = command[..4].iter().fold(0.0_f32, |most, speed| most.max(speed.abs()));
        let slowed = self.slowed(fastest);
        let [forward, left, turn] = self.to_body.map(|row| {
            row.iter().zip(command).map(|(weight, speed)| weight * (speed * slowed)).sum::<f32>()
        });
        self.within_reach(Vector::new(forward, left), turn)
    }

    /// Keeps to the top speeds, without bending the path.
    fn within_reach(&self, velocity: Vector, spin: f32) -> Wanted {
        let velocity = velocity.clamp_length_max(self.max_speed);
        let spin = spin.clamp(-self.max_turn_rate, self.max_turn_rate);
        let fastest = self.from_body.iter().fold(0.0_f32, |most, row| {
            most.max((row[0] * velocity.x + row[1] * velocity.y + row[2] * spin).abs())
        });
        let slowed = self.slowed(fastest);
        Wanted { velocity: velocity * slowed, spin: spin * slowed }
    }

    /// Factor on all wheels when the fastest would turn like this.
    fn slowed(&self, fastest: f32) -> f32 {
        if fastest > self.max_wheel_speed { self.max_wheel_speed / fastest } else { 1.0 }
    }

    pub(super) fn pull(&self, limits: &Limits, wanted: &Wanted, demand: &Demand) -> Pull {
        let missing = wanted.velocity - demand.velocity;
        let slower = missing.dot(demand.velocity) < 0.0;
        let most = if slower { self.brake } else { self.speed_up };
        let change = self.eased(missing.clamp_length_max(self.arriving(missing, most)), demand);
        let missing_turn = wanted.spin - demand.spin;
        let slower = missing_turn * demand.spin < 0.0;
        let most = if slower { self.turn_brake } else { self.turn_speed_up };
        let turn = missing_turn.clamp(-most, most);
        let load = held_against(demand.load, missing, change);
        let turning_load = if missing_turn.abs() <= most || turn * demand.turning_load < 0.0 {
            demand.turning_load
        } else {
            0.0
        };
        Pull {
            change,
            impulse: (change * limits.mass - load).clamp_length_max(self.traction),
            turn: (limits.inertia * turn - turning_load)
                .clamp(-self.turn_traction, self.turn_traction),
        }
    }
}

impl Wheels {
    /// Change of speed (m/s) in a tick from which the change can still fall to nothing when nothing is
    /// missing any more, at most `most`.
    fn arriving(&self, missing: Vector, most: f32) -> f32 {
        if self.jerk.is_infinite() {
            return most;
        }
        // n ticks that fall by `jerk` each make up for n (n + 1) / 2 of them.
        let ticks = (2.0 * missing.length() / self.jerk + 0.25).sqrt() - 0.5;
        most.min(self.jerk * ticks.max(0.0))
    }

    /// A change of velocity (m/s) as near to `change` as the last one allows.
    fn eased(&self, change: Vector, demand: &Demand) -> Vector {
        if self.jerk.is_infinite() {
            return change;
        }
        demand.last_change + (change - demand.last_change).clamp_length_max(self.jerk)
    }
}

/// The part of a load that wheels make up for. While a robot is far from the velocity that it is
/// told, this leaves out what drives it there: wheels do not work against their own command.
fn held_against(load: Vector, missing: Vector, change: Vector) -> Vector {
    if change == missing {
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
    use crate::RobotModel;
    use crate::robot_model::Drive;

    fn wheels(model: &RobotModel) -> Wheels {
        let (Drive::Omni(drive) | Drive::OmniWheels(drive)) = model.drive else {
            panic!("{} has other wheels", model.name)
        };
        Wheels::of(&drive, model.mass, model.inertia(), 0.005)
    }

    #[test]
    fn wheel_speeds_and_body_speeds_say_the_same() {
        for model in RobotModel::PRESETS.into_iter().filter(|model| model.mouth.is_some()) {
            let wheels = wheels(&model);
            for body in [[1.0, 0.0, 0.0], [0.0, -0.7, 0.0], [0.3, 0.2, 3.0]] {
                let speeds = wheels
                    .from_body
                    .map(|row| row.iter().zip(body).map(|(a, b)| a * b).sum::<f32>());
                let Wanted { velocity, spin } = wheels.rolled(&speeds);
                let got = [velocity.x, velocity.y, spin];
                for (got, expected) in got.iter().zip(body) {
                    assert!((got - expected).abs() < 1e-4, "{}: {got} {expected}", model.name);
                }
            }
        }
    }

    #[test]
    fn a_wheel_that_saturates_slows_all_and_keeps_the_direction() {
        let wheels = wheels(&RobotModel::SSL_GENERIC);
        let Wanted { velocity, spin } = wheels.wanted(&[3.0, 1.5, 20.0]);
        assert!(velocity.length() < 3.0, "it is slowed: {velocity}");
        assert!((velocity.y / velocity.x - 0.5).abs() < 1e-5);
        assert!((spin / velocity.x - 20.0 / 3.0).abs() < 1e-4);
    }
}

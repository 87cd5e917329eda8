//! Commands of the robots in a scene.

use super::uniform;
use crate::columns::{OMNI_COLUMNS, ROBOT_COLUMNS};
use crate::models::robot::{Drive, RobotModel};

/// Source of the commands in a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Driver {
    /// A constant command for each robot; a robot without one stands still.
    Constant(Vec<Vec<f32>>),
    /// A random command for each robot, drawn every ten steps.
    Random,
    /// All robots drive at the ball all the time and form a crowd.
    Chase,
}

impl Driver {
    /// All robots stand still.
    pub const STILL: Self = Self::Constant(Vec::new());

    /// Command of robot `index`. `robot` has its columns of the row, `key` decides random commands.
    pub(super) fn command(
        &self,
        index: usize,
        model: &RobotModel,
        robot: &[f32],
        ball: [f32; 2],
        key: u64,
    ) -> Vec<f32> {
        match self {
            Self::Constant(all) => all.get(index).cloned().unwrap_or_default(),
            Self::Random => random_command(model, key),
            Self::Chase => toward(model, robot, ball),
        }
    }
}

/// Command that drives a robot with heading `degrees` at a velocity in the field's frame, m/s. A
/// differential robot drives with the component along its heading.
pub fn driving(model: &RobotModel, degrees: f32, [v_x, v_y]: [f32; 2]) -> Vec<f32> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (ahead, aside) = (v_x * cos + v_y * sin, v_y * cos - v_x * sin);
    match model.drive {
        Drive::Differential(drive) => vec![ahead / drive.wheel_radius; 2],
        Drive::Omni(_) | Drive::OmniWheels(_) => vec![ahead, aside, 0.0, 0.0, 0.0, 0.0],
    }
}

/// Random command; `key` decides.
fn random_command(model: &RobotModel, key: u64) -> Vec<f32> {
    let draw = |nth: u64| uniform(key.wrapping_add(nth));
    match &model.drive {
        Drive::Differential(drive) => [0, 1].map(|nth| draw(nth) * drive.max_wheel_speed).to_vec(),
        Drive::Omni(drive) | Drive::OmniWheels(drive) => {
            let kicker = [draw(3), draw(4), draw(5)].map(|share| share.max(0.0));
            let kicker = [kicker[0] * 8.0, kicker[1] * 6.0 * kicker[2], kicker[2]];
            let body = [
                draw(0) * drive.max_speed,
                draw(1) * drive.max_speed,
                draw(2) * drive.max_angular_velocity / 2.0,
            ];
            let wheels = [draw(0), draw(1), draw(2), draw(6)].map(|s| s * drive.max_wheel_speed);
            let mut command = match model.drive {
                Drive::OmniWheels(_) => wheels.to_vec(),
                _ => body.to_vec(),
            };
            command.extend(kicker);
            command
        }
    }
}

/// Command that drives a robot to `target`, facing it.
fn toward(model: &RobotModel, robot: &[f32], target: [f32; 2]) -> Vec<f32> {
    let [x, y, cos, sin, ..] = robot else { unreachable!("a robot has {ROBOT_COLUMNS:?}") };
    let (to_x, to_y) = (target[0] - x, target[1] - y);
    let (ahead, aside) = (to_x * cos + to_y * sin, to_y * cos - to_x * sin);
    let bearing = libm::atan2f(aside, ahead); // the same on every platform, as golden hashes need
    match &model.drive {
        Drive::Differential(drive) => {
            let turn = bearing * 0.3;
            [(1.0 - turn) * drive.max_wheel_speed, (1.0 + turn) * drive.max_wheel_speed].to_vec()
        }
        Drive::Omni(drive) | Drive::OmniWheels(drive) => {
            let away = (ahead * ahead + aside * aside).sqrt().max(1e-3);
            let mut command = vec![0.0; OMNI_COLUMNS.len()];
            command[0] = ahead / away * drive.max_speed;
            command[1] = aside / away * drive.max_speed;
            command[2] = 5.0 * bearing;
            command
        }
    }
}

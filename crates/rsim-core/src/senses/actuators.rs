//! Wheels, kickers, dribblers and batteries that do not obey commands exactly.

use serde::{Deserialize, Serialize};

use crate::ball::mouth::Kicker;
use crate::body_parameters::{BodyParameters, RobotParameters};
use crate::geometry::motion::rotated;
use crate::math::Vector;
use crate::models::robot::Drive;
use crate::models::sensing::Sensing;
use crate::senses::random::{Draws, Purpose};

/// Number of wheels of a robot at most.
const WHEELS: usize = 4;

/// Part of the maximum speed that an empty battery leaves.
const EMPTY_BATTERY: f32 = 0.5;

/// Actuators of all robots of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Actuators {
    /// The robots' wheels.
    wheels: Vec<Wheels>,
    /// The robots' kickers.
    kickers: Vec<Kicker>,
    /// Commands as the robots obey them, a row for each.
    commands: Vec<f32>,
}

/// The wheels of a robot: factors on their speeds.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Wheels {
    gains: [f32; WHEELS],
}

impl Wheels {
    fn new(sensing: &Sensing, draws: &mut Draws) -> Self {
        let gain = |_| (1.0 + draws.normal(sensing.wheel_error)).max(0.0);
        Self { gains: std::array::from_fn(gain) }
    }

    /// Turns wheels that stand below `dead_zone` and do not turn faster than `limit`, rad/s. A robot whose
    /// fastest wheel is limited goes the same way more slowly.
    fn turn(&self, speeds: &mut [f32], dead_zone: f32, limit: f32) {
        let fastest = speeds.iter().fold(0.0_f32, |most, speed| most.max(speed.abs()));
        let slower = if fastest > limit { limit / fastest } else { 1.0 };
        for (speed, gain) in speeds.iter_mut().zip(&self.gains) {
            *speed *= if speed.abs() < dead_zone { 0.0 } else { gain * slower };
        }
    }
}

impl Actuators {
    /// The actuators of all robots, with their errors. A command has `columns` numbers.
    pub(super) fn new(robots: usize, columns: usize, sensing: &Sensing, draws: &mut Draws) -> Self {
        Self {
            wheels: (0..robots).map(|_| Wheels::new(sensing, draws)).collect(),
            kickers: vec![Kicker::EXACT; robots],
            commands: vec![0.0; robots * columns],
        }
    }

    /// Takes in the commands that robots have heard, those of control step `number`. `seconds` is the time
    /// that the batteries have worked.
    pub(super) fn obey(
        &mut self,
        heard: &[f32],
        number: u64,
        seconds: f32,
        (sensing, key): (&Sensing, u64),
        parameters: &BodyParameters,
    ) {
        self.commands.copy_from_slice(heard);
        let battery = (1.0 - sensing.battery_sag * seconds).max(EMPTY_BATTERY);
        if battery >= 1.0 && obeys_exactly(sensing) {
            return;
        }
        let mut draws = Draws::of(key, Purpose::Command, !number);
        let kick_failures = draws.which(sensing.kick_failures, self.wheels.len());
        let dribbler_failures = draws.which(sensing.dribbler_failures, self.wheels.len());
        let columns = heard.len() / self.wheels.len().max(1);
        let inexact = sensing.wheel_error > 0.0 || sensing.wheel_dead_zone > 0.0 || battery < 1.0;
        let robots = self.commands.chunks_exact_mut(columns.max(1)).zip(&self.wheels);
        for (index, (command, wheels)) in robots.enumerate() {
            let robot = &parameters.robots[index];
            let model = &robot.model;
            if inexact {
                drive(command, robot, wheels, sensing.wheel_dead_zone, battery);
            }
            if model.mouth.is_some() {
                let [.., kick, chip, dribbler] = &mut command[..model.command_columns().len()]
                else {
                    continue;
                };
                if kick_failures >> index & 1 == 1 {
                    (*kick, *chip) = (0.0, 0.0);
                }
                if dribbler_failures >> index & 1 == 1 {
                    *dribbler = 0.0;
                }
                let noise = draws.normal(sensing.kick_speed_noise);
                let angle = draws.normal(sensing.kick_direction_noise);
                self.kickers[index] = Kicker {
                    gain: battery * (1.0 + noise).max(0.0),
                    direction: rotated(Vector::X, angle),
                };
            }
        }
    }

    /// The commands as the robots obey them, a row for each.
    pub(super) fn commands(&self) -> &[f32] {
        &self.commands
    }

    /// Errors of a robot's kicker.
    pub(super) fn kicker(&self, robot: usize) -> Kicker {
        self.kickers[robot]
    }
}

/// Whether full batteries are all that robots need to obey exactly.
fn obeys_exactly(sensing: &Sensing) -> bool {
    let Sensing { wheel_error, wheel_dead_zone, kick_failures, dribbler_failures, .. } = *sensing;
    let Sensing { kick_speed_noise, kick_direction_noise, .. } = *sensing;
    let wheels = [wheel_error, wheel_dead_zone];
    let kickers = [kick_failures, dribbler_failures, kick_speed_noise, kick_direction_noise];
    wheels.iter().chain(&kickers).all(|number| *number == 0.0)
}

/// Changes the part of a command that the wheels follow: the speed of each wheel is 0 in the dead zone (m/s
/// at the rim), wrong by its factor, and at most what the battery allows.
fn drive(
    command: &mut [f32],
    robot: &RobotParameters,
    wheels: &Wheels,
    dead_zone: f32,
    battery: f32,
) {
    match (&robot.model.drive, &robot.wheel_map) {
        (Drive::Differential(drive), _) => {
            // A robot clips each of its wheels before the battery slows both.
            let most = drive.max_wheel_speed;
            for speed in &mut command[..2] {
                *speed = speed.clamp(-most, most);
            }
            wheels.turn(&mut command[..2], dead_zone / drive.wheel_radius, battery * most);
        }
        (Drive::Omni(drive), Some(map)) => {
            // The robot limits its own speeds before those of its wheels.
            let velocity = Vector::new(command[0], command[1]);
            let velocity = velocity.clamp_length_max(battery * drive.max_speed);
            let limit = battery * drive.max_angular_velocity;
            let turn = command[2].clamp(-limit, limit);
            let mut speeds = map.wheel_speeds([velocity.x, velocity.y, turn]);
            let limit = battery * drive.max_wheel_speed;
            wheels.turn(&mut speeds, dead_zone / drive.wheel_radius, limit);
            command[..3].copy_from_slice(&map.velocity(&speeds));
        }
        (Drive::Omni(drive) | Drive::OmniWheels(drive), _) => {
            let limit = battery * drive.max_wheel_speed;
            wheels.turn(&mut command[..WHEELS], dead_zone / drive.wheel_radius, limit);
        }
    }
}

//! Wheels, kickers, dribblers and batteries that do not obey commands exactly.

use serde::{Deserialize, Serialize};

use crate::ball::mouth::Kicker;
use crate::blocks::{Lanes, blocks_of, larger, set_bits};
use crate::body_parameters::BodyParameters;
use crate::drive::{BlockCommands, BlockWheels, MAX_WHEELS, WheelErrors};
use crate::geometry::motion::rotated;
use crate::math::Vector;
use crate::models::sensing::Sensing;
use crate::senses::fetch::Fetched;
use crate::senses::random::{Draws, Purpose};

/// Part of the maximum speed that an empty battery leaves.
const EMPTY_BATTERY: f32 = 0.5;

/// Actuators of all robots of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Actuators {
    /// Factors on the speeds of the wheels, by block.
    gains: Vec<[Lanes; MAX_WHEELS]>,
    /// The robots' kickers.
    kickers: Vec<Kicker>,
    /// Commands as the robots hear them and kickers and dribblers obey them, a row for each.
    commands: Vec<f32>,
    /// The same for the wheels as they obey them, by block.
    wheels: Vec<BlockCommands>,
}

impl Actuators {
    /// Fetches errors of wheels, and commands by robot.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.gains.iter().flatten().for_each(|gain| fetched.lanes(gain));
        fetched.numbers(&self.commands);
    }

    /// The actuators of all robots, with their errors. A command has `columns` numbers.
    pub(super) fn new(robots: usize, columns: usize, sensing: &Sensing, draws: &mut Draws) -> Self {
        let mut gain = || larger(Lanes::ONE + draws.normal_lanes(sensing.wheel_error), Lanes::ZERO);
        Self {
            gains: (0..blocks_of(robots)).map(|_| std::array::from_fn(|_| gain())).collect(),
            kickers: vec![Kicker::EXACT; robots],
            commands: vec![0.0; robots * columns],
            wheels: vec![BlockCommands::NONE; blocks_of(robots)],
        }
    }

    /// Takes in the commands that robots have heard, those of control step `number`. `seconds` is the time
    /// that the batteries have worked.
    pub(super) fn hear(
        &mut self,
        heard: &[f32],
        number: u64,
        seconds: f32,
        (sensing, key): (&Sensing, u64),
        parameters: &BodyParameters,
    ) {
        self.commands.copy_from_slice(heard);
        let battery = (1.0 - sensing.battery_sag * seconds).max(EMPTY_BATTERY);
        let columns = heard.len() / self.kickers.len().max(1);
        self.turn_wheels(heard, columns, sensing, battery, &parameters.wheels);
        if parameters.mouths == 0 || battery >= 1.0 && kickers_are_exact(sensing) {
            return;
        }
        let mut draws = Draws::of(key, Purpose::Command, !number);
        let [kick_failures, dribbler_failures] = [sensing.kick_failures, sensing.dribbler_failures]
            .map(|probability| draws.which_of(probability, parameters.mouths));
        for index in set_bits(parameters.mouths) {
            let model = &parameters.robots[index].model;
            let own = &mut self.commands[index * columns..][..model.command_columns().len()];
            let [.., kick, chip, dribbler] = own else { continue };
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

    /// The commands that the robots have heard, a row for each; kickers and dribblers that fail have none.
    pub(super) fn commands(&self) -> &[f32] {
        &self.commands
    }

    /// Errors of the robots' kickers.
    pub(super) fn kickers(&self) -> &[Kicker] {
        &self.kickers
    }

    /// Commands of the wheels as they obey them, by block.
    pub(super) fn wheels(&self) -> &[BlockCommands] {
        &self.wheels
    }

    /// Lets wheels hear rows of `columns` numbers.
    fn turn_wheels(
        &mut self,
        heard: &[f32],
        columns: usize,
        sensing: &Sensing,
        battery: f32,
        wheels: &[BlockWheels],
    ) {
        let dead_zone = sensing.wheel_dead_zone;
        let are_exact = sensing.wheel_error == 0.0 && dead_zone == 0.0 && battery >= 1.0;
        let blocks = self.wheels.iter_mut().zip(&self.gains).zip(wheels).enumerate();
        for (block, ((command, gains), wheels)) in blocks {
            *command = BlockCommands::read(heard, columns, block);
            if !are_exact {
                command.obey(wheels, WheelErrors { gains, dead_zone, battery });
            }
        }
    }
}

/// Whether full batteries are all that kickers and dribblers need to obey exactly.
fn kickers_are_exact(sensing: &Sensing) -> bool {
    let Sensing { kick_failures, dribbler_failures, .. } = *sensing;
    let Sensing { kick_speed_noise, kick_direction_noise, .. } = *sensing;
    let all = [kick_failures, dribbler_failures, kick_speed_noise, kick_direction_noise];
    all.iter().all(|number| *number == 0.0)
}

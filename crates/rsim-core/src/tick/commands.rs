//! Commands in the form that a tick reads: those of a control step are read once, with senses once they are heard.

use serde::{Deserialize, Serialize};

use crate::ball::kicker::KickErrors;
use crate::blocks::{Lanes, lanes_of_robots, mask_of_bits, set_bits};
use crate::body_parameters::BodyParameters;
use crate::columns::{OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::drive::{BlockCommands, BlockTargets, BlockWheels, MAX_WHEELS, WheelErrors};
use crate::models::robot::Drive;
use crate::state::State;

/// Commands of all robots for a control step, or, with senses, until others are heard.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct StepCommands {
    /// Targets of the wheels, by block.
    targets: Vec<BlockTargets>,
    /// Robots that are to kick or to dribble.
    pub(super) handling: Vec<HandlingCommand>,
    /// Errors of the kicks.
    pub(super) kick_errors: KickErrors,
}

/// The part of a command for kicker and dribbler.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct HandlingCommand {
    /// Speed of a kick along the floor, m/s.
    pub(super) kick: f32,
    /// Upward speed of a chip, m/s.
    pub(super) chip: f32,
    /// Speed of the dribbler by its maximum, 0 to 1.
    pub(super) dribbler: f32,
    /// Index of the robot.
    pub(super) robot: u8,
}

/// Errors of robots that do not obey commands exactly.
#[derive(Clone, Copy)]
pub(crate) struct CommandErrors<'a> {
    /// Factors on the speeds of the wheels, by block.
    pub(crate) gains: &'a [[Lanes; MAX_WHEELS]],
    /// Speed below which a wheel stands, m/s at the rim.
    pub(crate) dead_zone: f32,
    /// Part of the maximum speeds that the battery leaves.
    pub(crate) battery: f32,
    /// Robots whose kickers fail, and those whose dribblers do, one bit each.
    pub(crate) kick_failures: u64,
    pub(crate) dribbler_failures: u64,
    /// Errors of the kicks.
    pub(crate) kick_errors: KickErrors,
}

impl StepCommands {
    /// Of no robots.
    pub(crate) const NONE: Self =
        Self { targets: Vec::new(), handling: Vec::new(), kick_errors: KickErrors::NONE };

    /// Of no robots, with memory for those with these parameters.
    pub(crate) fn of(parameters: &BodyParameters) -> Self {
        Self {
            targets: Vec::with_capacity(parameters.wheels.len()),
            handling: Vec::with_capacity(parameters.mouths.count_ones() as usize),
            ..Self::NONE
        }
    }

    /// Reads the commands from rows of `columns` numbers, one row per robot, and sets the dribblers of
    /// `state`. Commands of absent robots are ignored.
    pub(crate) fn read(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        commands: &[f32],
        columns: usize,
    ) {
        self.read_wheels(state.absent, parameters, (commands, columns), |_, _, _| ());
        self.read_handling(state, parameters, commands, columns, [0; 2]);
    }

    /// The same for robots that do not obey exactly.
    pub(crate) fn hear(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        commands: &[f32],
        columns: usize,
        errors: CommandErrors<'_>,
    ) {
        let CommandErrors { gains, dead_zone, battery, .. } = errors;
        let obey = |block: usize, wheels: &BlockWheels, command: &mut BlockCommands| {
            if let Some(gains) = gains.get(block) {
                command.obey(wheels, WheelErrors { gains, dead_zone, battery });
            }
        };
        self.read_wheels(state.absent, parameters, (commands, columns), obey);
        let failures = [errors.kick_failures, errors.dribbler_failures];
        self.read_handling(state, parameters, commands, columns, failures);
        self.kick_errors = errors.kick_errors;
    }

    /// Targets of the wheels, by block.
    pub(crate) fn targets(&self) -> &[BlockTargets] {
        &self.targets
    }

    /// Reads the commands of the wheels. Those of `absent` robots, one bit each, stand still.
    fn read_wheels(
        &mut self,
        absent: u64,
        parameters: &BodyParameters,
        (commands, columns): (&[f32], usize),
        obey: impl Fn(usize, &BlockWheels, &mut BlockCommands),
    ) {
        self.targets.clear();
        self.targets.extend(parameters.wheels.iter().enumerate().map(|(block, wheels)| {
            let mut command = BlockCommands::read(commands, columns, block);
            obey(block, wheels, &mut command);
            if absent != 0 {
                command.halt(mask_of_bits(lanes_of_robots(absent, block).into()));
            }
            command.targets(wheels)
        }));
    }

    /// Reads the commands of kickers and dribblers, of which those of `failures` do nothing: robots whose kickers fail,
    /// and those whose dribblers do, one bit each.
    fn read_handling(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        commands: &[f32],
        columns: usize,
        failures: [u64; 2],
    ) {
        self.handling.clear();
        for index in set_bits(parameters.mouths & !state.absent) {
            let row = commands.get(index * columns..(index + 1) * columns).unwrap_or_default();
            let drive = &parameters.robots[index].model.drive;
            let Some(mut command) = HandlingCommand::read(index, drive, row) else { continue };
            command.fail(failures.map(|robots| robots >> index & 1 == 1));
            state.bodies.set_dribbling(index, command.dribbler);
            if command.acts() {
                self.handling.push(command);
            }
        }
    }
}

impl HandlingCommand {
    /// The part of the command in `row` for kicker and dribbler; `None` for a drive without them.
    fn read(robot: usize, drive: &Drive, row: &[f32]) -> Option<Self> {
        // The last three columns of an omnidirectional robot.
        let at = match drive {
            Drive::Differential(_) => return None,
            Drive::Omni(_) => OMNI_COLUMNS.len() - 3,
            Drive::OmniWheels(_) => OMNI_WHEELS_COLUMNS.len() - 3,
        };
        let [kick, chip, dribbler] = [row[at], row[at + 1], row[at + 2]];
        #[expect(clippy::cast_possible_truncation, reason = "at most 63 robots")]
        let robot = robot as u8;
        Some(Self { robot, kick, chip, dribbler: dribbler.clamp(0.0, 1.0) })
    }

    /// Takes out what a kicker or a dribbler that fails does not do.
    fn fail(&mut self, [kicker, dribbler]: [bool; 2]) {
        if kicker {
            (self.kick, self.chip) = (0.0, 0.0);
        }
        if dribbler {
            self.dribbler = 0.0;
        }
    }

    // One comparison of the greatest: a processor foresees the single ones of random commands half of the time.
    pub(super) fn kicks(&self) -> bool {
        self.kick.max(self.chip) > 0.0
    }

    /// Whether it is to kick or to dribble.
    fn acts(&self) -> bool {
        self.kick.max(self.chip).max(self.dribbler) > 0.0
    }
}

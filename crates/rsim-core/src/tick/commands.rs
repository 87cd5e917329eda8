//! Commands of a control step, read once for all of its ticks.

use crate::ball::mouth::Kicker;
use crate::blocks::{lanes_of_robots, mask_of_bits, set_bits};
use crate::body_parameters::BodyParameters;
use crate::columns::{OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::drive::BlockCommands;
use crate::models::robot::Drive;
use crate::state::State;

/// Commands of all robots for a control step.
#[derive(Default)]
pub(crate) struct StepCommands {
    /// Commands of the wheels, by block.
    pub(super) wheels: Vec<BlockCommands>,
    /// Robots that are to kick or to dribble.
    pub(super) handling: Vec<HandlingCommand>,
}

/// The part of a command for kicker and dribbler.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandlingCommand {
    /// Index of the robot.
    pub(super) robot: usize,
    /// Speed of a kick along the floor, m/s.
    pub(super) kick: f32,
    /// Upward speed of a chip, m/s.
    pub(super) chip: f32,
    /// Speed of the dribbler by its maximum, 0 to 1.
    pub(super) dribbler: f32,
    /// Errors of the kicker.
    pub(super) kicker: Kicker,
}

/// Commands as robots hear them that do not obey exactly.
#[derive(Clone, Copy)]
pub(crate) struct Heard<'a> {
    /// A row for each robot.
    pub(crate) rows: &'a [f32],
    /// Commands that the wheels obey, by block.
    pub(crate) wheels: &'a [BlockCommands],
    /// Errors of the kicker of each robot.
    pub(crate) kickers: &'a [Kicker],
}

impl StepCommands {
    /// Reads the commands from rows of `columns` numbers, one row per robot, and sets the dribblers of
    /// `state`. Commands of absent robots are ignored.
    pub(crate) fn read(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        commands: &[f32],
        columns: usize,
    ) {
        let blocks = 0..parameters.wheels.len();
        let wheels = blocks.map(|block| BlockCommands::read(commands, columns, block));
        self.take(state, parameters, commands, columns, wheels);
    }

    /// The same for robots that do not obey exactly.
    pub(crate) fn hear(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        heard: Heard<'_>,
        columns: usize,
    ) {
        self.take(state, parameters, heard.rows, columns, heard.wheels.iter().copied());
        for command in &mut self.handling {
            command.kicker = heard.kickers[command.robot];
        }
    }

    fn take(
        &mut self,
        state: &mut State,
        parameters: &BodyParameters,
        commands: &[f32],
        columns: usize,
        wheels: impl Iterator<Item = BlockCommands>,
    ) {
        self.wheels.clear();
        self.wheels.extend(wheels);
        if state.absent != 0 {
            self.halt(state.absent);
        }
        self.handling.clear();
        for index in set_bits(parameters.mouths & !state.absent) {
            let row = commands.get(index * columns..(index + 1) * columns).unwrap_or_default();
            let drive = &parameters.robots[index].model.drive;
            let Some(command) = HandlingCommand::read(index, drive, row) else { continue };
            state.bodies.set_dribbling(index, command.dribbler);
            if command.kicks() || command.dribbler > 0.0 {
                self.handling.push(command);
            }
        }
    }

    /// Commands the wheels of `robots`, one bit each, to stand still.
    fn halt(&mut self, robots: u64) {
        for (block, commands) in self.wheels.iter_mut().enumerate() {
            commands.halt(mask_of_bits(lanes_of_robots(robots, block).into()));
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
        let dribbler = dribbler.clamp(0.0, 1.0);
        Some(Self { robot, kick, chip, dribbler, kicker: Kicker::EXACT })
    }

    pub(super) fn kicks(&self) -> bool {
        self.kick > 0.0 || self.chip > 0.0
    }
}

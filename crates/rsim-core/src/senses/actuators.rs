//! Wheels, kickers, dribblers and batteries that do not obey commands exactly.

use serde::{Deserialize, Serialize};

use crate::ball::kicker::KickErrors;
use crate::blocks::{Lanes, larger};
use crate::body_parameters::BodyParameters;
use crate::drive::MAX_WHEELS;
use crate::models::sensing::Sensing;
use crate::senses::fetch::Fetched;
use crate::senses::random::{Draws, Purpose};
use crate::state::State;
use crate::tick::{CommandErrors, StepCommands};

/// Part of the maximum speed that an empty battery leaves.
const EMPTY_BATTERY: f32 = 0.5;

/// Actuators of all robots of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Actuators {
    /// Factors on the speeds of the wheels, by block.
    gains: Vec<[Lanes; MAX_WHEELS]>,
    /// Commands as the robots obey them.
    obeyed: StepCommands,
    /// Control step whose commands were heard last.
    number: u64,
    /// Whether robots have been placed since.
    are_stale: bool,
}

/// Commands that the robots of a match have heard.
#[derive(Clone, Copy)]
pub(super) struct Heard<'a> {
    /// Control step whose commands have just come; `None` if none have.
    pub(super) arrived: Option<u64>,
    /// The last ones of each robot, in rows of `columns` numbers.
    pub(super) commands: &'a [f32],
    pub(super) columns: usize,
    /// Time that the batteries have worked, s.
    pub(super) seconds: f32,
}

impl Actuators {
    /// Fetches errors of wheels, and their commands.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.gains.iter().for_each(|gains| fetched.lanes(&gains[0]));
        self.obeyed.targets().iter().for_each(|targets| fetched.lanes(targets.first()));
    }

    /// The actuators of all robots, with their errors.
    pub(super) fn new(parameters: &BodyParameters, sensing: &Sensing, draws: &mut Draws) -> Self {
        let mut gain = || larger(Lanes::ONE + draws.normal_lanes(sensing.wheel_error), Lanes::ZERO);
        let blocks = parameters.wheels.len();
        let gains = (0..blocks).map(|_| std::array::from_fn(|_| gain())).collect();
        Self { gains, obeyed: StepCommands::of(parameters), number: 0, are_stale: true }
    }

    /// Takes note that robots were placed: they have to obey their commands anew.
    pub(super) fn begin(&mut self) {
        self.are_stale = true;
    }

    /// Whether robots have been placed since they heard commands.
    pub(super) fn are_stale(&self) -> bool {
        self.are_stale
    }

    /// Has robots obey the commands that they have heard.
    pub(super) fn hear(
        &mut self,
        heard: Heard<'_>,
        (sensing, key): (&Sensing, u64),
        parameters: &BodyParameters,
        state: &mut State,
    ) {
        self.number = heard.arrived.unwrap_or(self.number);
        self.are_stale = false;
        let battery = (1.0 - sensing.battery_sag * heard.seconds).max(EMPTY_BATTERY);
        let mut errors = CommandErrors {
            gains: &self.gains,
            dead_zone: sensing.wheel_dead_zone,
            battery,
            kick_failures: 0,
            dribbler_failures: 0,
            kick_errors: KickErrors { gain: battery, ..KickErrors::NONE },
        };
        if sensing.wheel_error == 0.0 && errors.dead_zone == 0.0 && battery >= 1.0 {
            errors.gains = &[];
        }
        if parameters.mouths != 0 {
            let mut draws = Draws::of(key, Purpose::Command, !self.number);
            errors.kick_failures = draws.which_of(sensing.kick_failures, parameters.mouths);
            errors.dribbler_failures = draws.which_of(sensing.dribbler_failures, parameters.mouths);
            errors.kick_errors.word = draws.next();
            errors.kick_errors.speed_noise = sensing.kick_speed_noise;
            errors.kick_errors.direction_noise = sensing.kick_direction_noise;
        }
        self.obeyed.hear(state, parameters, heard.commands, heard.columns, errors);
    }

    /// Commands as the robots obey them.
    pub(super) fn obeyed(&self) -> &StepCommands {
        &self.obeyed
    }
}

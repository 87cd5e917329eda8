//! Configuration of a simulator, constant for its life.

use serde::{Deserialize, Serialize};

use crate::columns;
use crate::error::ConfigError;
use crate::models::ball::BallModel;
use crate::models::field::Field;
use crate::models::league::League;
use crate::models::numbers::Range;
use crate::models::robot::RobotModel;
use crate::models::sensing::Sensing;

/// Solver of contacts between bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EngineKind {
    /// rapier2d, the reference.
    Rapier,
    /// The solver of this crate, made for a dozen bodies.
    #[default]
    Compact,
}

impl EngineKind {
    /// All engines.
    pub const ALL: [Self; 2] = [Self::Rapier, Self::Compact];

    /// Name of the engine.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rapier => "rapier",
            Self::Compact => "compact",
        }
    }

    /// The engine with this name.
    ///
    /// # Errors
    /// [`ConfigError::Inconsistent`] for another name.
    pub fn named(name: &str) -> Result<Self, ConfigError> {
        Self::ALL.into_iter().find(|engine| engine.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(|engine| format!("{:?}", engine.name())).join(" or ");
            ConfigError::Inconsistent(format!("engine must be {names}, got {name:?}"))
        })
    }
}

/// Field, models, teams and time steps of a simulator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SimConfig {
    /// The field.
    pub field: Field,
    /// The ball.
    pub ball: BallModel,
    /// Robots of the first team; their models may differ.
    pub blue: Vec<RobotModel>,
    /// Robots of the second team; their models may differ.
    pub yellow: Vec<RobotModel>,
    /// Length of a control step, for which commands hold, s.
    pub time_step: f32,
    /// Length of a physics tick, s. Shorter ticks are more accurate and slower.
    pub tick: f32,
    /// Solver of contacts.
    #[serde(default)]
    pub engine: EngineKind,
    /// Senses of the robots; `None` if they know the true state and obey exactly.
    #[serde(default)]
    pub sensing: Option<Sensing>,
}

impl SimConfig {
    /// Two teams of one robot model, with the paper's 25 ms control step and 5 ms ticks.
    pub fn new(
        field: Field,
        ball: BallModel,
        robot: &RobotModel,
        n_blue: usize,
        n_yellow: usize,
    ) -> Self {
        Self {
            field,
            ball,
            blue: vec![robot.clone(); n_blue],
            yellow: vec![robot.clone(); n_yellow],
            time_step: 0.025,
            tick: 0.005,
            engine: EngineKind::default(),
            sensing: None,
        }
    }

    /// IEEE VSSS on the field for three robots per team, with the league's default models.
    pub fn vss(n_blue: usize, n_yellow: usize) -> Self {
        let league = League::Vss;
        Self::new(Field::VSS_3V3, league.ball(), &league.robot(), n_blue, n_yellow)
    }

    /// SSL on the field of division B, with the league's default models.
    pub fn ssl(n_blue: usize, n_yellow: usize) -> Self {
        let league = League::Ssl;
        Self::new(Field::SSL_B, league.ball(), &league.robot(), n_blue, n_yellow)
    }

    /// Models of all robots, in the order of a row.
    pub fn robots(&self) -> impl Iterator<Item = &RobotModel> {
        self.blue.iter().chain(&self.yellow)
    }

    /// Number of robots of both teams.
    pub fn n_robots(&self) -> usize {
        self.blue.len() + self.yellow.len()
    }

    /// Length of a state row.
    pub fn row_size(&self) -> usize {
        columns::row_size(self.n_robots())
    }

    /// Length of a world's row of parameters.
    pub fn parameters_size(&self) -> usize {
        columns::parameters_size(self.n_robots())
    }

    /// Number of columns of one robot's command, as the robot with the longest command needs. The
    /// other robots read the first columns.
    pub fn command_columns(&self) -> usize {
        self.robots().map(|robot| robot.command_columns().len()).max().unwrap_or(0)
    }

    /// Length of the commands of one world.
    pub fn command_size(&self) -> usize {
        self.n_robots() * self.command_columns()
    }

    /// Number of physics ticks in a control step.
    pub fn ticks_per_step(&self) -> usize {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // validated: 1 to 1000
        let ticks = (self.time_step / self.tick).round() as usize;
        ticks
    }

    /// Name of robot `index` of a row: `blue_0`, ..., `yellow_0`, ...
    pub fn robot_name(&self, index: usize) -> String {
        if index < self.blue.len() {
            format!("blue_{index}")
        } else {
            format!("yellow_{}", index - self.blue.len())
        }
    }

    /// Checks models, time steps and team sizes.
    ///
    /// # Errors
    /// [`ConfigError`] with the name of the first wrong argument.
    pub fn validate(&self) -> Result<(), ConfigError> {
        self.field.validate()?;
        self.ball.validate()?;
        self.robots().try_for_each(RobotModel::validate)?;
        self.sensing.iter().try_for_each(Sensing::validate)?;
        for (name, got) in [("time_step", self.time_step), ("tick", self.tick)] {
            if !Range::Positive.contains(got) {
                return Err(ConfigError::Number {
                    name,
                    expected: Range::Positive.expected(),
                    got,
                });
            }
        }
        if self.tick > MAX_TICK {
            let expected = "at most 0.005 s: longer ticks are not accurate (docs/physics.md)";
            return Err(ConfigError::Number { name: "tick", expected, got: self.tick });
        }
        if self.tick < MIN_TICK {
            let expected = "at least 0.00001 s";
            return Err(ConfigError::Number { name: "tick", expected, got: self.tick });
        }
        let ratio = self.time_step / self.tick;
        if !(0.999..1000.0).contains(&ratio) || (ratio - ratio.round()).abs() > 1e-3 {
            return Err(ConfigError::Inconsistent(format!(
                "time_step must be a whole number of ticks, 1 to 1000, got {} s and {} s",
                self.time_step, self.tick
            )));
        }
        check_team("n_blue", &self.field, self.blue.len())?;
        check_team("n_yellow", &self.field, self.yellow.len())
    }
}

/// Maximum tick, s, with a margin for rounding. In ticks of 12.5 ms, robots that meet at speed
/// overlap by 25 mm, and a ball at 10 m/s sometimes passes through a spinning robot; in ticks of 5 ms
/// neither happens.
const MAX_TICK: f32 = 0.005_000_1;

/// Minimum tick, s. Shorter ones lose the changes of positions to rounding, and a forecast would take for ever.
const MIN_TICK: f32 = 1e-5;

/// Checks the number of robots of a team against the field's limit. `name` is the argument's name.
///
/// # Errors
/// [`ConfigError::TooManyRobots`].
pub fn check_team(name: &'static str, field: &Field, got: usize) -> Result<(), ConfigError> {
    if got <= field.max_robots {
        return Ok(());
    }
    let field_name = field.name.to_string();
    Err(ConfigError::TooManyRobots { name, max: field.max_robots, field: field_name, got })
}

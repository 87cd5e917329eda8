//! What is fixed for the life of a simulator.

use serde::{Deserialize, Serialize};

use crate::{BallModel, ConfigError, Field, RobotModel, columns};

/// Field, models, teams and time steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SimConfig {
    /// Where the match is played.
    pub field: Field,
    /// What is played with.
    pub ball: BallModel,
    /// Robots of the first team. They need not be alike.
    pub blue: Vec<RobotModel>,
    /// Robots of the second team.
    pub yellow: Vec<RobotModel>,
    /// Length of a control step, s. Commands hold for it.
    pub time_step: f32,
    /// Length of a physics tick, s. Shorter is truer and slower.
    pub tick: f32,
}

impl SimConfig {
    /// Teams of so many robots of one model, at the paper's 25 ms control step of 5 ms ticks.
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
        }
    }

    /// IEEE VSSS on the field for three a side.
    pub fn vss(n_blue: usize, n_yellow: usize) -> Self {
        let robot = RobotModel::VSS_440RPM;
        Self::new(Field::VSS_3V3, BallModel::VSS_RSIM, &robot, n_blue, n_yellow)
    }

    /// SSL on the field of division B.
    pub fn ssl(n_blue: usize, n_yellow: usize) -> Self {
        let robot = RobotModel::SSL_GENERIC;
        Self::new(Field::SSL_B, BallModel::SSL_TIGERS, &robot, n_blue, n_yellow)
    }

    /// Models of all robots, in the order of a row.
    pub fn robots(&self) -> impl Iterator<Item = &RobotModel> {
        self.blue.iter().chain(&self.yellow)
    }

    /// Robots of both teams.
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

    /// Columns of one robot's command: as many as the robot with the longest command needs. The
    /// others read theirs from the first.
    pub fn command_columns(&self) -> usize {
        self.robots().map(|robot| robot.command_columns().len()).max().unwrap_or(0)
    }

    /// Length of the commands of one world.
    pub fn command_size(&self) -> usize {
        self.n_robots() * self.command_columns()
    }

    /// Physics ticks in a control step.
    pub fn ticks_per_step(&self) -> usize {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // validated: 1 to 1000
        let ticks = (self.time_step / self.tick).round() as usize;
        ticks
    }

    /// Name of robot `index` of the row: `blue_0`, ..., `yellow_0`, ...
    pub fn robot_name(&self, index: usize) -> String {
        if index < self.blue.len() {
            format!("blue_{index}")
        } else {
            format!("yellow_{}", index - self.blue.len())
        }
    }

    /// Checks that a match can be played with this.
    ///
    /// # Errors
    /// The first thing that is wrong, by name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        self.field.validate()?;
        self.ball.validate()?;
        self.robots().try_for_each(RobotModel::validate)?;
        positive("time_step", self.time_step)?;
        positive("tick", self.tick)?;
        if self.tick > LONGEST_TICK {
            let expected = "at most 0.005 s: longer ticks are not true (docs/physics.md)";
            return Err(refused("tick", expected, self.tick));
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

/// s. In ticks of 12.5 ms robots that meet at speed come 25 mm into each other, and a ball of 10 m/s
/// now and then passes a robot that spins; in ticks of 5 ms they do not.
const LONGEST_TICK: f32 = 0.005_000_1;

/// Checks that a side may have so many robots.
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

/// The entry of `presets` that is called `name`.
pub(crate) fn find_preset<T: Clone>(
    what: &'static str,
    presets: &[T],
    name_of: impl Fn(&T) -> &str,
    name: &str,
) -> Result<T, ConfigError> {
    let found = presets.iter().find(|preset| name_of(preset) == name);
    found.cloned().ok_or_else(|| ConfigError::UnknownPreset {
        what,
        known: presets.iter().map(&name_of).collect::<Vec<_>>().join(", "),
        got: name.to_owned(),
    })
}

/// Checks that a quantity is positive and finite.
pub(crate) fn positive(name: &'static str, got: f32) -> Result<(), ConfigError> {
    let expected = "positive and finite";
    if got > 0.0 && got.is_finite() { Ok(()) } else { Err(refused(name, expected, got)) }
}

/// Checks that a quantity is finite and not negative.
pub(crate) fn not_negative(name: &'static str, got: f32) -> Result<(), ConfigError> {
    let expected = "finite and not negative";
    if got >= 0.0 && got.is_finite() { Ok(()) } else { Err(refused(name, expected, got)) }
}

/// Checks that a quantity is a share of something.
pub(crate) fn share(name: &'static str, got: f32) -> Result<(), ConfigError> {
    if (0.0..=1.0).contains(&got) { Ok(()) } else { Err(refused(name, "between 0 and 1", got)) }
}

fn refused(name: &'static str, expected: &'static str, got: f32) -> ConfigError {
    ConfigError::Number { name, expected, got }
}

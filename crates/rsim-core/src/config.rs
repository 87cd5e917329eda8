//! What is fixed for the life of a simulator.

use serde::{Deserialize, Serialize};

use crate::{BallModel, ConfigError, Field, RobotModel, columns};

/// Field, models, team sizes and time steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SimConfig {
    /// Where the match is played.
    pub field: Field,
    /// What every robot is.
    pub robot: RobotModel,
    /// What is played with.
    pub ball: BallModel,
    /// Robots of the first team.
    pub n_blue: usize,
    /// Robots of the second team.
    pub n_yellow: usize,
    /// Length of a control step, s. Commands hold for it.
    pub time_step: f32,
    /// Length of a physics tick, s. Shorter is truer and slower.
    pub tick: f32,
}

impl SimConfig {
    /// IEEE VSSS, three a side, at the paper's 25 ms control step of 5 ms ticks.
    pub const VSS_3V3: Self = Self {
        field: Field::VSS_3V3,
        robot: RobotModel::VSS_440RPM,
        ball: BallModel::VSS_RSIM,
        n_blue: 3,
        n_yellow: 3,
        time_step: 0.025,
        tick: 0.005,
    };

    /// Robots of both teams.
    pub fn n_robots(&self) -> usize {
        self.n_blue + self.n_yellow
    }

    /// Length of a state row.
    pub fn row_size(&self) -> usize {
        columns::row_size(self.n_robots())
    }

    /// Length of the commands of one world.
    pub fn command_size(&self) -> usize {
        self.n_robots() * columns::DIFFERENTIAL_COLUMNS.len()
    }

    /// Physics ticks in a control step.
    pub fn ticks_per_step(&self) -> usize {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // validated: 1 to 1000
        let ticks = (self.time_step / self.tick).round() as usize;
        ticks
    }

    /// Name of robot `index` of the row: `blue_0`, ..., `yellow_0`, ...
    pub fn robot_name(&self, index: usize) -> String {
        if index < self.n_blue {
            format!("blue_{index}")
        } else {
            format!("yellow_{}", index - self.n_blue)
        }
    }

    /// Checks that a match can be played with this.
    ///
    /// # Errors
    /// The first thing that is wrong, by name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        self.field.validate()?;
        self.robot.validate()?;
        self.ball.validate()?;
        positive("time_step", self.time_step)?;
        positive("tick", self.tick)?;
        let ratio = self.time_step / self.tick;
        if !(0.999..1000.0).contains(&ratio) || (ratio - ratio.round()).abs() > 1e-3 {
            return Err(ConfigError::Inconsistent(format!(
                "time_step must be a whole number of ticks, 1 to 1000, got {} s and {} s",
                self.time_step, self.tick
            )));
        }
        for (name, got) in [("n_blue", self.n_blue), ("n_yellow", self.n_yellow)] {
            if got > self.field.max_robots {
                return Err(ConfigError::TooManyRobots {
                    name,
                    max: self.field.max_robots,
                    field: self.field.name.to_string(),
                    got,
                });
            }
        }
        Ok(())
    }
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
    if got > 0.0 && got.is_finite() { Ok(()) } else { Err(ConfigError::NotPositive { name, got }) }
}

//! The two leagues, with the ball and the robot that their matches use by default.

use crate::error::ConfigError;
use crate::models::ball::BallModel;
use crate::models::field::Field;
use crate::models::robot::RobotModel;

/// A league of robot soccer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum League {
    /// IEEE Very Small Size Soccer.
    Vss,
    /// `RoboCup` Small Size League.
    Ssl,
}

impl League {
    /// The league that has a field of this name.
    ///
    /// The name decides and not the numbers: an SSL field whose goals lost their walls is still one
    /// of SSL. `needed_for` names the argument that is derived from the league in the error message.
    ///
    /// # Errors
    /// [`ConfigError::UnknownLeague`] if no preset has the name.
    pub fn of(field: &Field, needed_for: &'static str) -> Result<Self, ConfigError> {
        let preset = Field::PRESETS.iter().find(|preset| preset.name == field.name);
        match preset.map(|preset| preset.goal_wall_thickness > 0.0) {
            Some(true) => Ok(Self::Ssl),
            Some(false) => Ok(Self::Vss),
            None => {
                let field = field.name.to_string();
                Err(ConfigError::UnknownLeague { needed_for, field })
            }
        }
    }

    /// The default ball.
    pub const fn ball(self) -> BallModel {
        match self {
            Self::Vss => BallModel::VSS_RSIM,
            Self::Ssl => BallModel::SSL_TIGERS,
        }
    }

    /// The default robot.
    pub const fn robot(self) -> RobotModel {
        match self {
            Self::Vss => RobotModel::VSS_440RPM,
            Self::Ssl => RobotModel::SSL_GENERIC,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_preset_has_the_league_of_its_name() {
        for field in Field::PRESETS {
            let expected = if field.name.starts_with("ssl") { League::Ssl } else { League::Vss };
            assert_eq!(League::of(&field, "robot"), Ok(expected), "{}", field.name);
        }
        let own = Field { name: "own".into(), ..Field::SSL_B };
        let error = League::of(&own, "robot").expect_err("unknown").to_string();
        assert!(error.contains("robot must be given") && error.contains("own"), "{error}");
    }
}

//! Knowledge of a scripted side of field, robots and ball, and how well it plays.

use rsim_referee::Lines;
use rsim_referee::sight::Layout;

use crate::error::TeamsError;

/// Most robots of a team.
pub const MAX_ROBOTS: usize = 11;

/// Numbers of a team's robots, as `RobotModel` has them.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotNumbers {
    /// Radius of the body, m.
    pub radius: f32,
    /// Distance of the flat front from the center, m.
    pub front_distance: f32,
    /// Maximum speed, m/s.
    pub max_speed: f32,
    /// Maximum acceleration, m/s².
    pub max_acceleration: f32,
    /// Maximum deceleration, m/s².
    pub max_deceleration: f32,
    /// Maximum angular velocity, rad/s.
    pub max_angular_velocity: f32,
    /// Maximum speed of a kick along the floor, m/s.
    pub max_kick_speed: f32,
    /// Maximum speed of a chip, m/s.
    pub max_chip_speed: f32,
}

/// Numbers of the ball, as `BallModel` has them.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BallNumbers {
    /// Radius, m.
    pub radius: f32,
    /// Deceleration while it slides, m/s².
    pub sliding_deceleration: f32,
    /// Deceleration while it rolls, m/s².
    pub rolling_deceleration: f32,
    /// Share of a kick's speed at which the ball begins to roll.
    pub slide_to_roll_ratio: f32,
}

/// Knowledge of a scripted side.
#[derive(Debug, Clone)]
pub struct TeamConfig {
    /// Lines and walls of the field.
    pub lines: Lines,
    /// Columns of a state row.
    pub layout: Layout,
    /// Duration of a control step, s.
    pub time_step: f32,
    /// The team's robots.
    pub robot: RobotNumbers,
    /// The ball.
    pub ball: BallNumbers,
    /// Skill of the team, 0 to 1.
    pub skill: f32,
}

impl TeamConfig {
    /// Distance from the center of a robot to that of a ball in its mouth, m.
    pub(crate) fn mouth(&self) -> f32 {
        self.robot.front_distance + self.ball.radius
    }

    /// Checks all numbers.
    pub(crate) fn validate(&self) -> Result<(), TeamsError> {
        let (robot, ball) = (&self.robot, &self.ball);
        for (name, got) in [
            ("time_step", self.time_step),
            ("robot.radius", robot.radius),
            ("robot.front_distance", robot.front_distance),
            ("robot.max_speed", robot.max_speed),
            ("robot.max_acceleration", robot.max_acceleration),
            ("robot.max_deceleration", robot.max_deceleration),
            ("robot.max_angular_velocity", robot.max_angular_velocity),
            ("robot.max_kick_speed", robot.max_kick_speed),
            ("robot.max_chip_speed", robot.max_chip_speed),
            ("ball.radius", ball.radius),
            ("ball.sliding_deceleration", ball.sliding_deceleration),
            ("ball.rolling_deceleration", ball.rolling_deceleration),
            ("ball.slide_to_roll_ratio", ball.slide_to_roll_ratio),
        ] {
            if !(got.is_finite() && got > 0.0) {
                return Err(TeamsError::Number { name, expected: "a number above 0", got });
            }
        }
        if !(0.0..=1.0).contains(&self.skill) {
            let (name, expected) = ("skill", "a number from 0 to 1");
            return Err(TeamsError::Number { name, expected, got: self.skill });
        }
        let larger = rsim_referee::Team::BOTH.map(|team| self.layout.team_size(team));
        let got = larger[0].max(larger[1]);
        if got > MAX_ROBOTS {
            return Err(TeamsError::TooManyRobots { expected: MAX_ROBOTS, got });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::config;

    #[test]
    fn wrong_numbers_are_named() {
        assert_eq!(config().validate(), Ok(()));
        let mut wrong = config();
        wrong.skill = 1.5;
        let error = wrong.validate().expect_err("beyond 1").to_string();
        assert!(error.contains("skill") && error.contains("1.5"), "{error}");
        let mut wrong = config();
        wrong.robot.max_speed = f32::NAN;
        let error = wrong.validate().expect_err("not a number").to_string();
        assert!(error.contains("robot.max_speed"), "{error}");
    }
}

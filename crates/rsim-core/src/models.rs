//! Robots and balls as data.

use std::borrow::Cow;
use std::f32::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::ConfigError;
use crate::config::{find_preset, positive};

/// A square robot on two wheels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotModel {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// Side of the square, m.
    pub size: f32,
    /// kg, wheels included. Heavier robots win shoving matches.
    pub mass: f32,
    /// What moves it.
    pub drive: DifferentialDrive,
    /// Speed kept along the normal when two robots collide, 0 to 1.
    pub restitution: f32,
    /// Coulomb friction between two robots.
    pub friction: f32,
}

/// Two driven wheels on one axle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DifferentialDrive {
    /// m.
    pub wheel_radius: f32,
    /// Effective distance between the wheels, m. A longer one turns more slowly.
    pub track: f32,
    /// Free speed of a wheel, rad/s.
    pub max_wheel_speed: f32,
    /// Torque of a motor at its wheel, N m.
    pub motor_torque: f32,
    /// Most acceleration that the tyres transmit along the wheels, m/s².
    pub forward_grip: f32,
    /// Most acceleration that the tyres transmit along the axle, m/s². Beyond it the robot skids.
    pub side_grip: f32,
}

impl RobotModel {
    /// The old simulator's VSSS robot. Body 75 mm, 120 g + 2 x 15 g, wheels 26 mm, 0.0725 N m and
    /// 440 rpm: its source. Track (26.6 rad/s at +-40 rad/s wheels) and forward acceleration
    /// (6.85 m/s²): measured on it. Side grip: its lateral wheel friction of 1.0 times g.
    pub const VSS_440RPM: Self = Self {
        name: Cow::Borrowed("vss_440rpm"),
        size: 0.075,
        mass: 0.15,
        drive: DifferentialDrive {
            wheel_radius: 0.026,
            track: 0.0782,
            max_wheel_speed: 440.0 / 60.0 * TAU,
            motor_torque: 0.0725,
            forward_grip: 6.85,
            side_grip: 9.81,
        },
        restitution: 0.2, // TIGERs' simulator, robot on robot
        friction: 0.2, // as measured by ER-Force for ball on robot; none published for two robots
    };

    /// A robot with Pololu 50:1 micro gear motors, as modelled from CAD by `TraveSim`: 78 mm,
    /// 180 g, wheels 25 mm, 71 mm apart, 0.073 N m, 650 rpm (1.7 m/s); field friction 0.6.
    pub const VSS_650RPM: Self = Self {
        name: Cow::Borrowed("vss_650rpm"),
        size: 0.078,
        mass: 0.18,
        drive: DifferentialDrive {
            wheel_radius: 0.025,
            track: 0.071,
            max_wheel_speed: 650.0 / 60.0 * TAU,
            motor_torque: 0.073,
            forward_grip: 0.6 * 9.81,
            side_grip: 0.6 * 9.81,
        },
        restitution: 0.2,
        friction: 0.2,
    };

    /// Every preset.
    pub const PRESETS: [Self; 2] = [Self::VSS_440RPM, Self::VSS_650RPM];

    /// The preset of that name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] names those there are.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("robot", &Self::PRESETS, |robot| &robot.name, name)
    }

    /// Speed with both wheels at their free speed, m/s.
    pub fn top_speed(&self) -> f32 {
        self.drive.wheel_radius * self.drive.max_wheel_speed
    }

    /// Radius of the circle around the square, m.
    pub fn bounding_radius(&self) -> f32 {
        self.size * std::f32::consts::FRAC_1_SQRT_2
    }

    pub(crate) fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("robot.size", self.size),
            ("robot.mass", self.mass),
            ("robot.drive.wheel_radius", self.drive.wheel_radius),
            ("robot.drive.track", self.drive.track),
            ("robot.drive.max_wheel_speed", self.drive.max_wheel_speed),
            ("robot.drive.motor_torque", self.drive.motor_torque),
            ("robot.drive.forward_grip", self.drive.forward_grip),
            ("robot.drive.side_grip", self.drive.side_grip),
            ("robot.restitution", self.restitution),
            ("robot.friction", self.friction),
        ] {
            positive(name, got)?;
        }
        Ok(())
    }
}

/// A ball that rolls on the floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallModel {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// m.
    pub radius: f32,
    /// kg.
    pub mass: f32,
    /// m/s², against the motion. Higher stops passes sooner; 0 never stops.
    pub rolling_deceleration: f32,
    /// Speed kept along the normal when it hits a robot, 0 to 1.
    pub robot_restitution: f32,
    /// Speed kept along the normal when it hits a wall, 0 to 1.
    pub wall_restitution: f32,
    /// Coulomb friction against a robot.
    pub robot_friction: f32,
    /// Coulomb friction against a wall.
    pub wall_friction: f32,
}

impl BallModel {
    /// A golf ball on a VSSS table. Size and mass: the league's rules (42.7 mm, 46 g). Roll:
    /// measured on the old simulator (0.140 m/s²). Robot: ER-Force's measured 0.60 and 0.2.
    /// Wall: 0.5 measured on the old simulator (2.56 to 1.25 m/s); friction: ER-Force, 0.35.
    pub const VSS_RSIM: Self = Self {
        name: Cow::Borrowed("vss_rsim"),
        radius: 0.042_7 / 2.0,
        mass: 0.046,
        rolling_deceleration: 0.14,
        robot_restitution: 0.6,
        wall_restitution: 0.5,
        robot_friction: 0.2,
        wall_friction: 0.35,
    };

    /// Every preset.
    pub const PRESETS: [Self; 1] = [Self::VSS_RSIM];

    /// The preset of that name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] names those there are.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("ball", &Self::PRESETS, |ball| &ball.name, name)
    }

    pub(crate) fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("ball.radius", self.radius),
            ("ball.mass", self.mass),
            ("ball.robot_restitution", self.robot_restitution),
            ("ball.wall_restitution", self.wall_restitution),
            ("ball.robot_friction", self.robot_friction),
            ("ball.wall_friction", self.wall_friction),
        ] {
            positive(name, got)?;
        }
        let roll = self.rolling_deceleration;
        if !(roll >= 0.0 && roll.is_finite()) {
            return Err(ConfigError::Inconsistent(format!(
                "ball.rolling_deceleration must be finite and not negative, got {roll}"
            )));
        }
        Ok(())
    }
}

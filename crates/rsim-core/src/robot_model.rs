//! Robots as data: what they are. [`crate::robot_presets`] says which there are.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ConfigError;
use crate::columns::{DIFFERENTIAL_COLUMNS, OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::config::{not_negative, positive, share};
use crate::mouth_model::Mouth;

/// A robot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotModel {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// Its outline from above.
    pub body: Body,
    /// m. What flies higher passes over it.
    pub height: f32,
    /// kg, wheels included. Heavier robots win shoving matches.
    pub mass: f32,
    /// What moves it.
    pub drive: Drive,
    /// What it handles the ball with; `None` for a robot that can only push.
    pub mouth: Option<Mouth>,
    /// Closing speed that comes back when two robots collide, 0 to 1.
    pub restitution: f32,
    /// Coulomb friction between two robots.
    pub friction: f32,
}

/// Outline of a robot from above.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// A square.
    Square {
        /// m.
        side: f32,
    },
    /// A disc whose front is cut off.
    Round {
        /// m.
        radius: f32,
        /// From the centre to the flat front, m: where the ball meets the kicker's plate.
        front: f32,
    },
}

/// What moves a robot, and so what its commands are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Drive {
    /// Two wheels on one axle, commanded by wheel speeds.
    Differential(DifferentialDrive),
    /// Four omnidirectional wheels, commanded by the body's velocity.
    Omni(OmniDrive),
    /// The same wheels, each commanded by its speed.
    OmniWheels(OmniDrive),
}

/// Two driven wheels on one axle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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

/// Four omnidirectional wheels around a robot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OmniDrive {
    /// m.
    pub wheel_radius: f32,
    /// From the centre to where a wheel meets the floor, m.
    pub wheel_distance: f32,
    /// Where the wheels sit, degrees from the front, counter-clockwise.
    pub wheel_angles: [f32; 4],
    /// rad/s. When one wheel would have to be faster, all four are slowed by one factor, so that
    /// the path does not bend.
    pub max_wheel_speed: f32,
    /// m/s, in every direction.
    pub max_speed: f32,
    /// rad/s.
    pub max_turn_rate: f32,
    /// m/s², when it gets faster or turns aside.
    pub speed_up: f32,
    /// m/s², when it gets slower.
    pub brake: f32,
    /// rad/s².
    pub turn_speed_up: f32,
    /// rad/s².
    pub turn_brake: f32,
    /// Most acceleration that the wheels transmit, m/s²: what pushing and being pushed is about.
    pub traction: f32,
    /// Most change of its acceleration, m/s³, when it speeds up and slows down along its path; 0 for
    /// no limit.
    pub jerk: f32,
}

impl RobotModel {
    /// Names of what it is told.
    pub fn command_columns(&self) -> &'static [&'static str] {
        match self.drive {
            Drive::Differential(_) => &DIFFERENTIAL_COLUMNS,
            Drive::Omni(_) => &OMNI_COLUMNS,
            Drive::OmniWheels(_) => &OMNI_WHEELS_COLUMNS,
        }
    }

    /// Speed that it can drive at, m/s.
    pub fn top_speed(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => drive.wheel_radius * drive.max_wheel_speed,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => drive.max_speed,
        }
    }

    /// Rate that it can turn on the spot at, rad/s.
    pub fn top_turn_rate(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => 2.0 * self.top_speed() / drive.track,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => {
                let by_wheels = drive.wheel_radius * drive.max_wheel_speed / drive.wheel_distance;
                drive.max_turn_rate.min(by_wheels)
            }
        }
    }

    /// Radius of the circle around the body, m.
    pub fn bounding_radius(&self) -> f32 {
        match self.body {
            Body::Square { side } => side * std::f32::consts::FRAC_1_SQRT_2,
            Body::Round { radius, .. } => radius,
        }
    }

    /// From the centre to the middle of the front, m.
    pub fn front(&self) -> f32 {
        match self.body {
            Body::Square { side } => side / 2.0,
            Body::Round { front, .. } => front,
        }
    }

    /// Moment of inertia about the vertical axis, kg m²: a plate's of that outline.
    pub(crate) fn inertia(&self) -> f32 {
        match self.body {
            Body::Square { side } => self.mass * side * side / 6.0,
            Body::Round { radius, .. } => self.mass * radius * radius / 2.0,
        }
    }

    /// Checks that every number is in its range.
    ///
    /// # Errors
    /// The first that is not, by name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [("robot.height", self.height), ("robot.mass", self.mass)] {
            positive(name, got)?;
        }
        share("robot.restitution", self.restitution)?;
        not_negative("robot.friction", self.friction)?;
        match self.body {
            Body::Square { side } => positive("robot.side", side)?,
            Body::Round { radius, front } => {
                positive("robot.radius", radius)?;
                positive("robot.front", front)?;
                if front > radius {
                    return Err(ConfigError::Inconsistent(format!(
                        "robot.front must not be beyond robot.radius of {radius} m, got {front} m"
                    )));
                }
            }
        }
        match self.drive {
            Drive::Differential(drive) => drive.validate()?,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => drive.validate()?,
        }
        self.mouth.map_or(Ok(()), |mouth| mouth.validate())
    }
}

impl DifferentialDrive {
    fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("robot.wheel_radius", self.wheel_radius),
            ("robot.track", self.track),
            ("robot.max_wheel_speed", self.max_wheel_speed),
            ("robot.motor_torque", self.motor_torque),
            ("robot.forward_grip", self.forward_grip),
            ("robot.side_grip", self.side_grip),
        ] {
            positive(name, got)?;
        }
        Ok(())
    }
}

impl OmniDrive {
    fn validate(&self) -> Result<(), ConfigError> {
        for (name, got) in [
            ("robot.wheel_radius", self.wheel_radius),
            ("robot.wheel_distance", self.wheel_distance),
            ("robot.max_wheel_speed", self.max_wheel_speed),
            ("robot.max_speed", self.max_speed),
            ("robot.max_turn_rate", self.max_turn_rate),
            ("robot.speed_up", self.speed_up),
            ("robot.brake", self.brake),
            ("robot.turn_speed_up", self.turn_speed_up),
            ("robot.turn_brake", self.turn_brake),
            ("robot.traction", self.traction),
        ] {
            positive(name, got)?;
        }
        not_negative("robot.jerk", self.jerk)?;
        let angles = self.wheel_angles;
        let ordered = angles.windows(2).all(|pair| pair[0] + 1.0 < pair[1]);
        if !(ordered && angles[0] >= 0.0 && angles[3] < 360.0) {
            return Err(ConfigError::Inconsistent(format!(
                "robot.wheel_angles must be four places around the robot in rising order, 0 to 360 \
                 degrees, got {angles:?}"
            )));
        }
        Ok(())
    }
}

//! Robots as data. [`crate::models::robot_presets`] has the presets.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::columns::{DIFFERENTIAL_COLUMNS, OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::error::ConfigError;
use crate::models::mouth::Mouth;
use crate::models::numbers::{Number, NumberField, Range, check_all, find, listed, numbers};

numbers! {
    /// A robot.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct RobotModel, "robot";
    fields {
        /// Name of the preset.
        name: Cow<'static, str>,
        /// Outline from above.
        body: Body,
        /// Wheels and their limits.
        drive: Drive,
        /// Break beam, kicker and dribbler; `None` for a robot that can only push the ball.
        mouth: Option<Mouth>,
    }
    numbers {
        /// Height of the body; a ball that flies higher passes over it.
        height: Positive, "m";
        /// Mass with wheels; heavier robots win shoving matches.
        mass: Positive, "kg";
        /// Restitution against robots or walls (0.2), as the mean of both.
        restitution: Fraction, "1";
        /// Coulomb friction against robots or walls (0.2), as the mean of both.
        friction: NotNegative, "1";
    }
}

/// Outline of a robot from above.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Body {
    /// A square.
    Square {
        /// Side of the square, m.
        side_length: f32,
    },
    /// A disc with a flat front.
    Round {
        /// Radius of the disc, m.
        radius: f32,
        /// Distance of the flat front, where the ball meets the kicker's plate, from the center, m.
        front_distance: f32,
    },
}

/// A number in one variant of [`Body`].
macro_rules! body_number {
    ($variant:ident, $number:ident, $doc:literal) => {
        NumberField {
            number: Number {
                name: stringify!($number),
                unit: "m",
                range: Range::Positive,
                qualified: concat!("robot.", stringify!($number)),
                lines: &[$doc],
            },
            get: |body| {
                if let Body::$variant { $number, .. } = body { Some(*$number) } else { None }
            },
            get_mut: |body| {
                if let Body::$variant { $number, .. } = body { Some($number) } else { None }
            },
        }
    };
}

impl Body {
    /// The numbers of both kinds of body.
    const NUMBERS: &'static [NumberField<Self>] = &[
        body_number!(Square, side_length, "Side of a square body."),
        body_number!(Round, radius, "Radius of a round body."),
        body_number!(
            Round,
            front_distance,
            "Distance of a round body's flat front from the center."
        ),
    ];
}

/// Wheels of a robot; their kind decides the columns of its commands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Drive {
    /// Two wheels on one axle, commanded by wheel speeds.
    Differential(DifferentialDrive),
    /// Four omnidirectional wheels, commanded by the body's velocity.
    Omni(OmniDrive),
    /// Four omnidirectional wheels, commanded by wheel speeds.
    OmniWheels(OmniDrive),
}

numbers! {
    /// Two driven wheels on one axle.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct DifferentialDrive, "robot";
    fields {}
    numbers {
        /// Radius of a wheel.
        wheel_radius: Positive, "m";
        /// Maximum speed of a wheel, free of load.
        max_wheel_speed: Positive, "rad/s";
        /// Effective distance between the two wheels.
        track_width: Positive, "m";
        /// Torque of a motor at its wheel.
        motor_torque: Positive, "N m";
        /// Maximum acceleration that the tires transmit along the wheels.
        longitudinal_grip: Positive, "m/s²";
        /// Maximum acceleration that the tires transmit along the axle.
        lateral_grip: Positive, "m/s²";
        /// Friction of a tipping body, divided by that of its tires; 0 for none.
        #[serde(default)]
        tipping_friction: Fraction, "1";
        /// Slip of both braking tires beyond which a robot skids; 0: never.
        #[serde(default)]
        skid_slip: NotNegative, "m/s";
    }
}

numbers! {
    /// Four omnidirectional wheels around a robot.
    ///
    /// If a command asks more of one wheel than `max_wheel_speed`, all four are slowed by one
    /// factor, so that the path does not bend.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct OmniDrive, "robot";
    fields {
        /// Positions of the wheels, degrees from the front, counterclockwise.
        wheel_angles: [f32; 4],
    }
    numbers {
        /// Radius of a wheel.
        wheel_radius: Positive, "m";
        /// Maximum speed of a wheel, free of load.
        max_wheel_speed: Positive, "rad/s";
        /// Distance from the center to the point where a wheel meets the floor.
        wheel_distance: Positive, "m";
        /// Maximum speed in every direction.
        max_speed: Positive, "m/s";
        /// Maximum angular velocity.
        max_angular_velocity: Positive, "rad/s";
        /// Maximum acceleration when the robot gets faster or turns aside.
        max_acceleration: Positive, "m/s²";
        /// Maximum deceleration when the robot gets slower.
        max_deceleration: Positive, "m/s²";
        /// Maximum angular acceleration when the robot turns faster.
        max_angular_acceleration: Positive, "rad/s²";
        /// Maximum angular deceleration when the robot turns more slowly.
        max_angular_deceleration: Positive, "rad/s²";
        /// Maximum acceleration that the wheels transmit, also in pushing.
        max_traction: Positive, "m/s²";
        /// Maximum change of the acceleration along the path; 0 for no limit.
        max_jerk: NotNegative, "m/s³";
    }
}

impl RobotModel {
    /// All numbers that some kind of robot has, each once.
    pub fn numbers() -> Vec<Number> {
        let mut all: Vec<Number> = Vec::new();
        let parts = listed(Self::NUMBERS)
            .chain(listed(Body::NUMBERS))
            .chain(listed(DifferentialDrive::NUMBERS))
            .chain(listed(OmniDrive::NUMBERS))
            .chain(listed(Mouth::NUMBERS));
        for number in parts {
            if all.iter().all(|known| known.name != number.name) {
                all.push(number);
            }
        }
        all
    }

    /// A number by name; `None` if this kind of robot has none of that name.
    pub fn number_mut(&mut self, name: &str) -> Option<&mut f32> {
        if let Some(field) = find(Self::NUMBERS, name) {
            return (field.get_mut)(self);
        }
        if let Some(field) = find(Body::NUMBERS, name) {
            return (field.get_mut)(&mut self.body);
        }
        if let Some(field) = find(Mouth::NUMBERS, name) {
            return (field.get_mut)(self.mouth.as_mut()?);
        }
        match &mut self.drive {
            Drive::Differential(drive) => (find(DifferentialDrive::NUMBERS, name)?.get_mut)(drive),
            Drive::Omni(drive) | Drive::OmniWheels(drive) => {
                (find(OmniDrive::NUMBERS, name)?.get_mut)(drive)
            }
        }
    }

    /// Names of a command's columns.
    pub fn command_columns(&self) -> &'static [&'static str] {
        match self.drive {
            Drive::Differential(_) => &DIFFERENTIAL_COLUMNS,
            Drive::Omni(_) => &OMNI_COLUMNS,
            Drive::OmniWheels(_) => &OMNI_WHEELS_COLUMNS,
        }
    }

    /// Maximum driving speed, m/s.
    pub fn top_speed(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => drive.wheel_radius * drive.max_wheel_speed,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => drive.max_speed,
        }
    }

    /// Maximum angular velocity on the spot, rad/s.
    pub fn top_angular_velocity(&self) -> f32 {
        match self.drive {
            Drive::Differential(drive) => 2.0 * self.top_speed() / drive.track_width,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => {
                let by_wheels = drive.wheel_radius * drive.max_wheel_speed / drive.wheel_distance;
                drive.max_angular_velocity.min(by_wheels)
            }
        }
    }

    /// Radius of the circle around the body, m.
    pub fn bounding_radius(&self) -> f32 {
        match self.body {
            Body::Square { side_length } => side_length * std::f32::consts::FRAC_1_SQRT_2,
            Body::Round { radius, .. } => radius,
        }
    }

    /// Distance from the center to the middle of the front, m.
    pub fn front_distance(&self) -> f32 {
        match self.body {
            Body::Square { side_length } => side_length / 2.0,
            Body::Round { front_distance, .. } => front_distance,
        }
    }

    /// Distance from the center, m, that the center of a ball in the mouth never exceeds by more than the ball's radius;
    /// `None` without a mouth.
    pub(crate) fn mouth_reach(&self) -> Option<f32> {
        let mouth = self.mouth.as_ref()?;
        Some(self.front_distance() + mouth.beam_distance + mouth.mouth_width)
    }

    /// Moment of inertia about the vertical axis, kg m², of a uniform plate with the body's outline.
    pub(crate) fn inertia(&self) -> f32 {
        match self.body {
            Body::Square { side_length } => self.mass * side_length * side_length / 6.0,
            Body::Round { radius, .. } => self.mass * radius * radius / 2.0,
        }
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`ConfigError`] with the name of the first wrong number.
    pub fn validate(&self) -> Result<(), ConfigError> {
        check_all(Self::NUMBERS, self)?;
        check_all(Body::NUMBERS, &self.body)?;
        if let Body::Round { radius, front_distance } = self.body {
            if front_distance > radius {
                return Err(ConfigError::Inconsistent(format!(
                    "robot.front_distance must not be beyond robot.radius of {radius} m, got \
                     {front_distance} m"
                )));
            }
        }
        match self.drive {
            Drive::Differential(drive) => check_all(DifferentialDrive::NUMBERS, &drive)?,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => drive.validate()?,
        }
        self.mouth.map_or(Ok(()), |mouth| check_all(Mouth::NUMBERS, &mouth))
    }
}

impl OmniDrive {
    fn validate(&self) -> Result<(), ConfigError> {
        check_all(Self::NUMBERS, self)?;
        let angles = self.wheel_angles;
        let ordered = angles.windows(2).all(|pair| pair[0] + 1.0 < pair[1]);
        if !(ordered && angles[0] >= 0.0 && angles[3] < 360.0) {
            return Err(ConfigError::Inconsistent(format!(
                "robot.wheel_angles must be four angles in rising order, 0 to 360 degrees and more \
                 than 1 degree apart, got {angles:?}"
            )));
        }
        Ok(())
    }
}

//! Balls as data.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ConfigError;
use crate::config::{find_preset, not_negative, positive, share};

/// A ball on a floor, and against what it hits: numbers of a venue as much as of a ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallModel {
    /// Name of the preset.
    pub name: Cow<'static, str>,
    /// m.
    pub radius: f32,
    /// kg.
    pub mass: f32,
    /// m/s², while its lowest point slips over the floor.
    pub sliding_deceleration: f32,
    /// m/s², while it rolls. Higher stops passes sooner; 0 never stops.
    pub rolling_deceleration: f32,
    /// Speed that is left when a ball kicked without spin has come to roll, as a share of the
    /// kick's. 5/7 for a solid sphere; measured fields sit lower.
    pub rolling_share: f32,
    /// rad/s², of the spin about the vertical axis.
    pub spin_deceleration: f32,
    /// How it hops after a chip.
    pub hop: Hop,
    /// Against robots.
    pub robot: Surface,
    /// Against walls and the sides of goals.
    pub wall: Surface,
    /// Against the backs of goals, which are padded.
    pub goal_back: Surface,
}

/// What a surface does to a ball that hits it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Closing speed that comes back along the normal, 0 to 1.
    pub restitution: f32,
    /// Coulomb friction.
    pub friction: f32,
}

/// What is left of a flying ball's speed when it meets the floor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Hop {
    /// Share of the speed along the floor after the first touch-down.
    pub first: f32,
    /// The same after each later one.
    pub later: f32,
    /// Share of the vertical speed.
    pub up: f32,
}

/// 5 to 15 rad/s² between ball and cloth: billiards.colostate.edu/threads/physics.html. Nobody has
/// published it for a golf ball on carpet.
const SPIN_DECELERATION: f32 = 10.0;

impl BallModel {
    /// The golf ball of the leagues as the TIGERs have tuned it for `RoboCup` and their lab
    /// (Sumatra, `BallParameters.java`): 3.0 and 0.26 m/s², rolling at 2/3, chips keep 0.80, 0.85
    /// and 0.47, a redirect keeps 0.55. Robot friction and walls: ER-Force's simulator.
    pub const SSL_TIGERS: Self = Self {
        name: Cow::Borrowed("ssl_tigers"),
        radius: 0.0215,
        mass: 0.046,
        sliding_deceleration: 3.0,
        rolling_deceleration: 0.26,
        rolling_share: 2.0 / 3.0,
        spin_deceleration: SPIN_DECELERATION,
        hop: Hop { first: 0.80, later: 0.85, up: 0.47 },
        robot: Surface { restitution: 0.55, friction: 0.2 },
        wall: Surface { restitution: 0.3, friction: 0.35 },
        goal_back: Surface { restitution: 0.1, friction: 0.5 },
    };

    /// ER-Force's field configuration (`config/field-properties/field.txt`): 2.79, 0.33, 0.70, and
    /// chips 0.60 along, 0.70 up (no later loss along is given); robots as they measured, 0.60.
    pub const SSL_ERFORCE: Self = Self {
        name: Cow::Borrowed("ssl_erforce"),
        sliding_deceleration: 2.79,
        rolling_deceleration: 0.33,
        rolling_share: 0.70,
        hop: Hop { first: 0.60, later: 1.0, up: 0.70 },
        robot: Surface { restitution: 0.6, friction: 0.2 },
        ..Self::SSL_TIGERS
    };

    /// What `ssl-vision` sends before a venue sets its own (`src/shared/util/field.cpp`).
    pub const SSL_VISION: Self = Self {
        name: Cow::Borrowed("ssl_vision"),
        sliding_deceleration: 3.0,
        rolling_deceleration: 0.40,
        rolling_share: 0.70,
        hop: Hop { first: 0.60, later: 0.95, up: 0.70 },
        ..Self::SSL_ERFORCE
    };

    /// The ball of grSim and of the old simulator's SSL: 10.3 m/s² (measured along an axis) and
    /// 0.70, hops as grSim reports them, bounces of 0.5.
    pub const GRSIM: Self = Self {
        name: Cow::Borrowed("grsim"),
        sliding_deceleration: 10.3,
        rolling_deceleration: 0.70,
        rolling_share: 0.70,
        hop: Hop { first: 0.60, later: 0.96, up: 0.42 },
        wall: Surface { restitution: 0.5, friction: 0.35 },
        goal_back: Surface { restitution: 0.5, friction: 0.35 },
        ..Self::SSL_ERFORCE
    };

    /// A golf ball on a VSSS table. Size and mass: the league's rules (42.7 mm, 46 g). Floor:
    /// measured on the old simulator (9.9 and 0.140 m/s²; 0.69 to 0.70). Robots and friction:
    /// ER-Force's measured 0.60, 0.2 and 0.35. Walls: 0.5 on the old simulator (2.56 to 1.25 m/s).
    pub const VSS_RSIM: Self = Self {
        name: Cow::Borrowed("vss_rsim"),
        radius: 0.042_7 / 2.0,
        sliding_deceleration: 9.9,
        rolling_deceleration: 0.14,
        ..Self::GRSIM
    };

    /// Every preset.
    pub const PRESETS: [Self; 5] =
        [Self::SSL_TIGERS, Self::SSL_ERFORCE, Self::SSL_VISION, Self::GRSIM, Self::VSS_RSIM];

    /// The preset of that name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] names those there are.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("ball", &Self::PRESETS, |ball| &ball.name, name)
    }

    /// Checks that every number is in its range.
    ///
    /// # Errors
    /// The first that is not, by name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        positive("ball.radius", self.radius)?;
        positive("ball.mass", self.mass)?;
        for (name, got) in [
            ("ball.sliding_deceleration", self.sliding_deceleration),
            ("ball.rolling_deceleration", self.rolling_deceleration),
            ("ball.spin_deceleration", self.spin_deceleration),
            ("ball.robot_friction", self.robot.friction),
            ("ball.wall_friction", self.wall.friction),
            ("ball.goal_back_friction", self.goal_back.friction),
        ] {
            not_negative(name, got)?;
        }
        for (name, got) in [
            ("ball.hop_first", self.hop.first),
            ("ball.hop_later", self.hop.later),
            ("ball.hop_up", self.hop.up),
            ("ball.robot_restitution", self.robot.restitution),
            ("ball.wall_restitution", self.wall.restitution),
            ("ball.goal_back_restitution", self.goal_back.restitution),
        ] {
            share(name, got)?;
        }
        if !(0.5..1.0).contains(&self.rolling_share) {
            return Err(ConfigError::Inconsistent(format!(
                "ball.rolling_share must be at least 0.5 and below 1, got {}",
                self.rolling_share
            )));
        }
        Ok(())
    }
}

//! Presets of balls, with the source of every number.

use std::borrow::Cow;

use crate::error::ConfigError;
use crate::models::ball::BallModel;
use crate::models::presets::find_preset;

/// Measured range between ball and cloth: 5 to 15 rad/s²
/// (billiards.colostate.edu/threads/physics.html). No value is published for a golf ball on carpet.
const SPIN_DECELERATION: f32 = 10.0;

impl BallModel {
    /// The golf ball of both leagues as the TIGERs tuned it for `RoboCup` and their lab (Sumatra,
    /// `BallParameters.java`): 3.0 and 0.26 m/s², rolling at 2/3, factors 0.80, 0.85 and 0.47 of a
    /// chip, 0.55 of a redirect. Robot friction and walls: ER-Force's simulator.
    pub const SSL_TIGERS: Self = Self {
        name: Cow::Borrowed("ssl_tigers"),
        radius: 0.0215,
        mass: 0.046,
        sliding_deceleration: 3.0,
        rolling_deceleration: 0.26,
        rolling_drag: 0.0,
        slide_to_roll_ratio: 2.0 / 3.0,
        spin_deceleration: SPIN_DECELERATION,
        first_hop_factor: 0.80,
        later_hop_factor: 0.85,
        vertical_restitution: 0.47,
        robot_restitution: 0.55,
        robot_friction: 0.2,
        wall_restitution: 0.3,
        wall_friction: 0.35,
        goal_back_restitution: 0.1,
        goal_back_friction: 0.5,
    };

    /// ER-Force's field configuration (`config/field-properties/field.txt`): 2.79, 0.33, 0.70, and
    /// chips 0.60 horizontally, 0.70 vertically (it gives no later horizontal loss); against robots
    /// 0.60 as they measured.
    pub const SSL_ERFORCE: Self = Self {
        name: Cow::Borrowed("ssl_erforce"),
        sliding_deceleration: 2.79,
        rolling_deceleration: 0.33,
        slide_to_roll_ratio: 0.70,
        first_hop_factor: 0.60,
        later_hop_factor: 1.0,
        vertical_restitution: 0.70,
        robot_restitution: 0.6,
        ..Self::SSL_TIGERS
    };

    /// Defaults of `ssl-vision` before a venue sets its own (`src/shared/util/field.cpp`).
    pub const SSL_VISION: Self = Self {
        name: Cow::Borrowed("ssl_vision"),
        sliding_deceleration: 3.0,
        rolling_deceleration: 0.40,
        slide_to_roll_ratio: 0.70,
        first_hop_factor: 0.60,
        later_hop_factor: 0.95,
        vertical_restitution: 0.70,
        ..Self::SSL_ERFORCE
    };

    /// The ball of grSim and of the old simulator's SSL: 10.3 m/s² (measured along an axis) and
    /// 0.70, hops as grSim reports them, restitution 0.5.
    pub const GRSIM: Self = Self {
        name: Cow::Borrowed("grsim"),
        sliding_deceleration: 10.3,
        rolling_deceleration: 0.70,
        slide_to_roll_ratio: 0.70,
        first_hop_factor: 0.60,
        later_hop_factor: 0.96,
        vertical_restitution: 0.42,
        wall_restitution: 0.5,
        wall_friction: 0.35,
        goal_back_restitution: 0.5,
        goal_back_friction: 0.35,
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

    /// The golf ball on the carpet of a field of `RoboCup` 2023. Floor: fitted to the tracked kicks of an
    /// SSL robot there (jgocm/kick-analysis) by `tools/fit_kicks.py`. Other numbers: TIGERs.
    pub const SSL_ROBOCUP_2023: Self = Self {
        name: Cow::Borrowed("ssl_robocup_2023"),
        sliding_deceleration: 3.0,
        rolling_deceleration: 0.15,
        rolling_drag: 0.032,
        slide_to_roll_ratio: 0.69,
        ..Self::SSL_TIGERS
    };

    /// The golf ball on the carpet of a laboratory. Floor: fitted to the tracked kicks of the same robot
    /// there, up to 2.2 m/s, by `tools/fit_kicks.py`. Other numbers: TIGERs.
    pub const SSL_LAB_2023: Self = Self {
        name: Cow::Borrowed("ssl_lab_2023"),
        sliding_deceleration: 3.25,
        rolling_deceleration: 0.095,
        rolling_drag: 0.044,
        slide_to_roll_ratio: 0.66,
        ..Self::SSL_TIGERS
    };

    /// The ball of ER-Force's simulator (9814d057) as it rolls there: floor by `rsoccer identify` from a log of
    /// `benches.transfer_logs`. Other numbers: [`Self::SSL_ERFORCE`].
    pub const SSL_ERFORCE_SIMULATOR: Self = Self {
        name: Cow::Borrowed("ssl_erforce_simulator"),
        sliding_deceleration: 3.91,
        rolling_deceleration: 0.35,
        slide_to_roll_ratio: 0.688,
        ..Self::SSL_ERFORCE
    };

    /// All presets.
    pub const PRESETS: [Self; 8] = [
        Self::SSL_TIGERS,
        Self::SSL_ERFORCE,
        Self::SSL_ERFORCE_SIMULATOR,
        Self::SSL_VISION,
        Self::SSL_ROBOCUP_2023,
        Self::SSL_LAB_2023,
        Self::GRSIM,
        Self::VSS_RSIM,
    ];

    /// The preset with this name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`], which lists the known names.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("ball", &Self::PRESETS, |ball| &ball.name, name)
    }
}

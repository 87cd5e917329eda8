//! Which robots there are, with the source of every number.

use std::borrow::Cow;
use std::f32::consts::TAU;

use crate::config::find_preset;
use crate::mouth_model::Mouth;
use crate::robot_model::{Body, DifferentialDrive, Drive, OmniDrive};
use crate::{ConfigError, RobotModel};

/// Radians per second of so many revolutions per minute.
const fn rpm(value: f32) -> f32 {
    value / 60.0 * TAU
}

impl RobotModel {
    /// The old simulator's VSSS robot. Body 75 mm, 120 g + 2 x 15 g, wheels 26 mm, 0.0725 N m and
    /// 440 rpm: its source. Track (26.6 rad/s at +-40 rad/s wheels) and forward acceleration
    /// (6.85 m/s²): measured on it. Side grip: its lateral wheel friction of 1.0 times g.
    pub const VSS_440RPM: Self = Self {
        name: Cow::Borrowed("vss_440rpm"),
        body: Body::Square { side: 0.075 },
        height: 0.075, // the league's cube
        mass: 0.15,
        drive: Drive::Differential(DifferentialDrive {
            wheel_radius: 0.026,
            track: 0.0782,
            max_wheel_speed: rpm(440.0),
            motor_torque: 0.0725,
            forward_grip: 6.85,
            side_grip: 9.81,
        }),
        mouth: None,
        restitution: 0.2, // TIGERs' simulator, robot on robot
        friction: 0.2, // as measured by ER-Force for ball on robot; none published for two robots
    };

    /// A robot with Pololu 50:1 micro gear motors, as modelled from CAD by `TraveSim`: 78 mm, 62 mm
    /// high, 180 g, wheels 25 mm, 71 mm apart, 0.073 N m, 650 rpm (1.7 m/s); field friction 0.6.
    pub const VSS_650RPM: Self = Self {
        name: Cow::Borrowed("vss_650rpm"),
        body: Body::Square { side: 0.078 },
        height: 0.062,
        mass: 0.18,
        drive: Drive::Differential(DifferentialDrive {
            wheel_radius: 0.025,
            track: 0.071,
            max_wheel_speed: rpm(650.0),
            motor_torque: 0.073,
            forward_grip: 0.6 * 9.81,
            side_grip: 0.6 * 9.81,
        }),
        ..Self::VSS_440RPM
    };

    /// An SSL robot to start from: body of the official virtual tournament's fallback, limits that
    /// all its listed teams share, kicks of three of its seven teams.
    pub const SSL_GENERIC: Self =
        ssl("ssl_generic", FALLBACK_BODY, [8.0, 8.0], FALLBACK_MOUTH, Drive::Omni(OMNI));

    /// The same, told wheel speeds.
    pub const SSL_GENERIC_WHEELS: Self = ssl(
        "ssl_generic_wheels",
        FALLBACK_BODY,
        [8.0, 8.0],
        FALLBACK_MOUTH,
        Drive::OmniWheels(OMNI),
    );

    /// The official virtual tournament's fallback for a team that it does not know.
    pub const SSL_UNKNOWN: Self = ssl(
        "ssl_unknown",
        FALLBACK_BODY,
        [6.0, 6.0],
        FALLBACK_MOUTH,
        Drive::Omni(OmniDrive {
            max_speed: 2.0,
            max_turn_rate: 5.0,
            speed_up: 2.0,
            brake: 2.0,
            turn_speed_up: 20.0,
            turn_brake: 20.0,
            ..OMNI
        }),
    );

    /// TIGERs Mannheim. Wheels: their firmware, 2020.
    pub const SSL_TIGERS: Self = ssl(
        "ssl_tigers",
        FALLBACK_BODY,
        [8.0, 8.0],
        FALLBACK_MOUTH,
        Drive::Omni(OmniDrive {
            wheel_radius: 0.032,
            wheel_distance: 0.079,
            wheel_angles: [59.0, 135.0, 225.0, 301.0],
            max_wheel_speed: RIM_SPEED / 0.032,
            ..OMNI
        }),
    );

    /// ER-Force.
    pub const SSL_ERFORCE: Self =
        ssl("ssl_erforce", [0.089, 0.138, 1.5], [8.0, 8.0], [0.067, 0.070], Drive::Omni(OMNI));

    /// `RobôCin`.
    pub const SSL_ROBOCIN: Self =
        ssl("ssl_robocin", [0.088, 0.148, 2.45], [10.0, 8.0], [0.0669, 0.072], Drive::Omni(OMNI));

    /// `RoboTeam` Twente.
    pub const SSL_TWENTE: Self =
        ssl("ssl_twente", [0.090, 0.149, 2.32], [7.5, 7.35], [0.070, 0.070], Drive::Omni(OMNI));

    /// UBC Thunderbots. Wheels: their contact points and radius, 2026.
    pub const SSL_UBC: Self = ssl(
        "ssl_ubc",
        [0.090, 0.150, 2.5],
        [7.0, 7.0],
        [0.070, 0.088],
        Drive::Omni(OmniDrive {
            wheel_radius: 0.030,
            wheel_distance: 0.075,
            wheel_angles: [62.0, 132.0, 228.0, 298.0],
            max_wheel_speed: RIM_SPEED / 0.030,
            ..OMNI
        }),
    );

    /// KIKS.
    pub const SSL_KIKS: Self =
        ssl("ssl_kiks", [0.089, 0.132, 2.6], [8.0, 8.0], [0.070, 0.081], Drive::Omni(OMNI));

    /// `RoboDragons`.
    pub const SSL_ROBODRAGONS: Self =
        ssl("ssl_robodragons", [0.090, 0.125, 2.4], [6.5, 6.5], [0.0715, 0.075], Drive::Omni(OMNI));

    /// Every preset.
    pub const PRESETS: [Self; 12] = [
        Self::VSS_440RPM,
        Self::VSS_650RPM,
        Self::SSL_GENERIC,
        Self::SSL_GENERIC_WHEELS,
        Self::SSL_UNKNOWN,
        Self::SSL_TIGERS,
        Self::SSL_ERFORCE,
        Self::SSL_ROBOCIN,
        Self::SSL_TWENTE,
        Self::SSL_UBC,
        Self::SSL_KIKS,
        Self::SSL_ROBODRAGONS,
    ];

    /// The preset of that name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] names those there are.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("robot", &Self::PRESETS, |robot| &robot.name, name)
    }
}

/// Free speed of a wheel's rim, m/s: the old simulator's robot, 1557 rpm on wheels of 24.75 mm.
const RIM_SPEED: f32 = rpm(1557.0) * 0.024_75;

/// Limits that all teams listed for the official virtual tournament share (`ssl-simulation-setup`,
/// `robot-specs.yaml`), on the wheels of the old simulator and grSim. Traction: `SSL-A-Team`'s wheel
/// on carpet, 0.7 times g.
const OMNI: OmniDrive = OmniDrive {
    wheel_radius: 0.024_75,
    wheel_distance: 0.09,
    wheel_angles: [60.0, 135.0, 225.0, 300.0],
    max_wheel_speed: rpm(1557.0),
    max_speed: 3.7,
    max_turn_rate: 26.2,
    speed_up: 4.7,
    brake: 5.9,
    turn_speed_up: 50.8,
    turn_brake: 51.6,
    traction: 6.9,
    jerk: 0.0,
};

/// Radius (m), height (m) and mass (kg) of the fallback; TIGERs' are the same.
const FALLBACK_BODY: [f32; 3] = [0.090, 0.143, 2.7];

/// Front and width of the fallback's mouth, m.
const FALLBACK_MOUTH: [f32; 2] = [0.0715, 0.065];

/// A robot of the official virtual tournament (`robot-specs.yaml`): radius and height (m) and mass
/// (kg); fastest kick and chip (m/s); shoot radius and dribbler width (m).
const fn ssl(
    name: &'static str,
    [radius, height, mass]: [f32; 3],
    [max_kick, max_chip]: [f32; 2],
    [front, width]: [f32; 2],
    drive: Drive,
) -> RobotModel {
    RobotModel {
        name: Cow::Borrowed(name),
        body: Body::Round { radius, front },
        height,
        mass,
        drive,
        mouth: Some(Mouth {
            width,
            beam_distance: 0.010, // the old simulator: the ball within 10 mm of the plate
            beam_height: 0.0215,  // through the middle of a ball on the floor
            max_kick,
            max_chip,
            recharge: 0.1,    // ER-Force's simulator asks for at least that
            kick_keeps: 0.35, // TIGERs: across the front, in a redirect
            // Ours: with the floor's own hold on a ball with back-spin (3 m/s²) it keeps the ball in
            // up to 5.6 m/s², less than a robot's full brake. TIGERs drive with the ball at up to
            // 1.2 m/s² and 5 rad/s (Sumatra, DragBallSkill and ProtectiveGetBallSkill).
            grip: 0.12,
            bar_force: 0.5,       // TIGERs: least force of their bar on the ball
            bar_speed: 2.0,       // TIGERs: 2 to 5 m/s at the surface
            bar_restitution: 0.2, // ER-Force: ball on dribbler bar
            bar_friction: 1.5,    // likewise
        }),
        restitution: 0.2, // TIGERs' simulator, robot on robot
        friction: 0.2,    // none published for two robots; ER-Force's for ball on robot
    }
}

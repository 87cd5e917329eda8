//! Presets of robots, with the source of every number.

use std::borrow::Cow;
use std::f32::consts::TAU;

use crate::error::ConfigError;
use crate::models::mouth::Mouth;
use crate::models::presets::find_preset;
use crate::models::robot::{Body, DifferentialDrive, Drive, OmniDrive, RobotModel};

/// Revolutions per minute as rad/s.
const fn rpm(value: f32) -> f32 {
    value / 60.0 * TAU
}

impl RobotModel {
    /// The old simulator's VSSS robot. Body 75 mm, 120 g + 2 x 15 g, wheels 26 mm, 0.0725 N m and
    /// 440 rpm: its source. Track width (26.6 rad/s at +-40 rad/s wheels) and forward acceleration
    /// (6.85 m/s²): measured on it. Lateral grip: its lateral wheel friction of 1.0 times g.
    pub const VSS_440RPM: Self = Self {
        name: Cow::Borrowed("vss_440rpm"),
        body: Body::Square { side_length: 0.075 },
        height: 0.075, // the league's cube
        mass: 0.15,
        drive: Drive::Differential(DifferentialDrive {
            wheel_radius: 0.026,
            track_width: 0.0782,
            max_wheel_speed: rpm(440.0),
            motor_torque: 0.0725,
            longitudinal_grip: 6.85,
            lateral_grip: 9.81,
            tipping_friction: 0.0,
            skid_slip: 0.0,
        }),
        mouth: None,
        restitution: 0.2, // TIGERs' simulator, robot on robot
        friction: 0.2, // as measured by ER-Force for ball on robot; none published for two robots
    };

    /// A robot with Pololu 50:1 micro gear motors, as modeled from CAD by `TraveSim`: 78 mm, 62 mm
    /// high, 180 g, wheels 25 mm, 71 mm apart, 0.073 N m, 650 rpm (1.7 m/s); field friction 0.6.
    pub const VSS_650RPM: Self = Self {
        name: Cow::Borrowed("vss_650rpm"),
        body: Body::Square { side_length: 0.078 },
        height: 0.062,
        mass: 0.18,
        drive: Drive::Differential(DifferentialDrive {
            wheel_radius: 0.025,
            track_width: 0.071,
            max_wheel_speed: rpm(650.0),
            motor_torque: 0.073,
            longitudinal_grip: 0.6 * 9.81,
            lateral_grip: 0.6 * 9.81,
            tipping_friction: 0.0,
            skid_slip: 0.0,
        }),
        ..Self::VSS_440RPM
    };

    /// The robot of `FIRASim` (8955749) as it moves there: radius of the wheels, track, top speed, accelerations and
    /// slip of a robot that tips by step responses (`benches.transfer_responses`); mass of body and two wheels and torque
    /// of its `Parsian.ini`. Friction sideways does not depend there on that along the wheels; a grip that is hardly
    /// used up comes near it.
    pub const VSS_FIRASIM: Self = Self {
        name: Cow::Borrowed("vss_firasim"),
        mass: 1.4,
        drive: Drive::Differential(DifferentialDrive {
            wheel_radius: 0.02,
            track_width: 0.08,
            max_wheel_speed: 59.9,
            motor_torque: 0.11,
            longitudinal_grip: 4.03,
            lateral_grip: 40.0,
            tipping_friction: 0.69,
            skid_slip: 0.15,
        }),
        restitution: 0.0, // its contacts of robots have none
        friction: 0.3,    // by glancing pushes there
        ..Self::VSS_440RPM
    };

    /// A generic SSL robot: body of the official virtual tournament's fallback, limits that
    /// all its listed teams share, kicks of three of its seven teams.
    pub const SSL_GENERIC: Self =
        ssl("ssl_generic", FALLBACK_BODY, [8.0, 8.0], FALLBACK_MOUTH, Drive::Omni(OMNI));

    /// [`Self::SSL_GENERIC`], commanded by wheel speeds.
    pub const SSL_GENERIC_WHEELS: Self = ssl(
        "ssl_generic_wheels",
        FALLBACK_BODY,
        [8.0, 8.0],
        FALLBACK_MOUTH,
        Drive::OmniWheels(OMNI),
    );

    /// The official virtual tournament's fallback for an unlisted team.
    pub const SSL_UNKNOWN: Self = ssl(
        "ssl_unknown",
        FALLBACK_BODY,
        [6.0, 6.0],
        FALLBACK_MOUTH,
        Drive::Omni(OmniDrive {
            max_speed: 2.0,
            max_angular_velocity: 5.0,
            max_acceleration: 2.0,
            max_deceleration: 2.0,
            max_angular_acceleration: 20.0,
            max_angular_deceleration: 20.0,
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
        ssl("ssl_erforce", ERFORCE_BODY, [8.0, 8.0], [0.067, 0.070], Drive::Omni(OMNI));

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

    /// The robot of grSim (fe2bd29) as it moves there: limits by `rsoccer identify` from a log of
    /// `benches.transfer_logs`; a ball touches its kicker at 0.102 m.
    pub const SSL_GRSIM: Self = with_mouth(
        "ssl_grsim",
        FALLBACK_BODY,
        0.0805,
        Mouth { kicker_reach: TOUCHING, dribbler_grip: HOLDING, ..mouth([8.0, 8.0], 0.08) },
        Drive::Omni(OmniDrive {
            max_acceleration: 3.6,
            max_deceleration: 3.9,
            max_angular_acceleration: 49.0,
            max_angular_deceleration: 39.0,
            ..OMNI
        }),
    );

    /// The robot of ER-Force's simulator (9814d057) as it moves there without realism: limits by the same, body of
    /// [`Self::SSL_ERFORCE`]; a ball touches its dribbler at 0.0855 m and is reported up to 0.0985 m. The dribbler
    /// does nothing: a robot that drives back by 0.1 m/s leaves the ball where it is.
    pub const SSL_ERFORCE_SIMULATOR: Self = erforce_simulator(
        "ssl_erforce_simulator",
        Mouth { dribbler_grip: 0.0, dribbler_force: 0.0, ..ERFORCE_SIMULATOR_MOUTH },
    );

    /// The same robot under RC2021, the setting of tournaments: its dribbler loses no ball.
    pub const SSL_ERFORCE_SIMULATOR_RC2021: Self = erforce_simulator(
        "ssl_erforce_simulator_rc2021",
        Mouth { dribbler_grip: HOLDING, ..ERFORCE_SIMULATOR_MOUTH },
    );

    /// All presets.
    pub const PRESETS: [Self; 16] = [
        Self::VSS_440RPM,
        Self::VSS_650RPM,
        Self::VSS_FIRASIM,
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
        Self::SSL_GRSIM,
        Self::SSL_ERFORCE_SIMULATOR,
        Self::SSL_ERFORCE_SIMULATOR_RC2021,
    ];

    /// The preset with this name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`], which lists the known names.
    pub fn preset(name: &str) -> Result<Self, ConfigError> {
        find_preset("robot", &Self::PRESETS, |robot| &robot.name, name)
    }
}

/// Reach of kickers that fire at a ball that touches the robot, m: above the gap of bodies in contact, and below 2 mm,
/// at which those of grSim and ER-Force's simulator do not fire (`benches.transfer_logs`).
const TOUCHING: f32 = 0.001;

/// Grip of dribblers that lose no ball at up to 1.5 m/s backward, 1 m/s sideways and 8 rad/s, N.
const HOLDING: f32 = 2.0;

/// The mouth of [`RobotModel::SSL_ERFORCE_SIMULATOR`], but for its dribbler.
const ERFORCE_SIMULATOR_MOUTH: Mouth = Mouth {
    beam_distance: 0.013,
    kicker_reach: TOUCHING,
    dribbler_restitution: 0.05, // balls of 1 to 4 m/s come back with 0.01 to 0.1 of it
    ..mouth([8.0, 8.0], 0.070)
};

const fn erforce_simulator(name: &'static str, mouth: Mouth) -> RobotModel {
    let drive = OmniDrive {
        max_acceleration: 5.8,
        max_deceleration: 7.9,
        max_angular_acceleration: 67.0,
        max_angular_deceleration: 96.0,
        ..OMNI
    };
    with_mouth(name, ERFORCE_BODY, 0.064, mouth, Drive::Omni(drive))
}

/// Radius, height (m) and mass (kg) of ER-Force's robot.
const ERFORCE_BODY: [f32; 3] = [0.089, 0.138, 1.5];

/// Free rim speed of a wheel, m/s: the old simulator's robot, 1557 rpm on wheels of 24.75 mm.
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
    max_angular_velocity: 26.2,
    max_acceleration: 4.7,
    max_deceleration: 5.9,
    max_angular_acceleration: 50.8,
    max_angular_deceleration: 51.6,
    max_traction: 6.9,
    max_jerk: 0.0,
};

/// Radius (m), height (m) and mass (kg) of the fallback; TIGERs' are the same.
const FALLBACK_BODY: [f32; 3] = [0.090, 0.143, 2.7];

/// Front distance and mouth width of the fallback, m.
const FALLBACK_MOUTH: [f32; 2] = [0.0715, 0.065];

/// A robot of the official virtual tournament (`robot-specs.yaml`): radius and height (m) and mass
/// (kg); maximum kick and chip speed (m/s); shoot radius and dribbler width (m).
const fn ssl(
    name: &'static str,
    body: [f32; 3],
    kicks: [f32; 2],
    [front_distance, mouth_width]: [f32; 2],
    drive: Drive,
) -> RobotModel {
    with_mouth(name, body, front_distance, mouth(kicks, mouth_width), drive)
}

/// A round robot with a mouth: radius and height (m) and mass (kg); distance of its front, m.
const fn with_mouth(
    name: &'static str,
    [radius, height, mass]: [f32; 3],
    front_distance: f32,
    mouth: Mouth,
    drive: Drive,
) -> RobotModel {
    RobotModel {
        name: Cow::Borrowed(name),
        body: Body::Round { radius, front_distance },
        height,
        mass,
        drive,
        mouth: Some(mouth),
        restitution: 0.2, // TIGERs' simulator, robot on robot
        friction: 0.2,    // none published for two robots; ER-Force's for ball on robot
    }
}

/// The mouth of such a robot: maximum kick and chip speed (m/s), dribbler width (m).
const fn mouth([max_kick_speed, max_chip_speed]: [f32; 2], mouth_width: f32) -> Mouth {
    Mouth {
        mouth_width,
        beam_distance: 0.010, // the old simulator: the ball within 10 mm of the plate
        beam_height: 0.0215,  // through the middle of a ball on the floor
        max_kick_speed,
        max_chip_speed,
        kicker_recharge_time: 0.1, // minimum of ER-Force's simulator
        kicker_reach: 0.05,        // farther than any beam: a kicker fires at a ball that cuts it
        kick_lateral_factor: 0.35, // TIGERs: across the front, in a redirect
        // Our choice: with the floor's friction on a ball with back-spin (3 m/s²) it holds the
        // ball up to 5.6 m/s², less than a robot's maximum deceleration. TIGERs drive with the ball at up to
        // 1.2 m/s² and 5 rad/s (Sumatra, DragBallSkill and ProtectiveGetBallSkill).
        dribbler_grip: 0.12,
        dribbler_force: 0.5, // TIGERs: minimum force of their bar on the ball
        dribbler_speed: 2.0, // TIGERs: 2 to 5 m/s at the surface
        dribbler_restitution: 0.2, // ER-Force: ball on dribbler bar
        dribbler_friction: 1.5, // ER-Force: ball on dribbler bar
    }
}

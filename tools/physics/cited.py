"""Published numbers of balls, robots and fields: the reference for the presets.

This module copies them from the sources and reads nothing from the simulator, so that a wrong
number in a preset shows.
"""

from dataclasses import dataclass, field, replace
from math import pi

G = 9.81  # m/s²
SOLID_SPHERE = 2 / 5  # moment of inertia of a solid sphere divided by m r²


@dataclass(frozen=True)
class Ball:
    """Published ball model in SI units. Field names are those of `BallModel`."""

    source: str
    radius: float = 0.0215
    mass: float = 0.046
    sliding_deceleration: float = 3.0
    rolling_deceleration: float = 0.26
    rolling_drag: float = 0.0  # 1/s
    slide_to_roll_ratio: float = 2 / 3
    spin_deceleration: float = 10.0
    first_hop_factor: float = 0.80
    later_hop_factor: float = 0.85
    vertical_restitution: float = 0.47
    robot_restitution: float = 0.55
    robot_friction: float = 0.2
    wall_restitution: float = 0.3
    wall_friction: float = 0.35
    goal_back_restitution: float = 0.1
    goal_back_friction: float = 0.5


TIGERS = Ball("TIGERs, Sumatra `BallParameters.java`; walls and friction: ER-Force's simulator")
ERFORCE = replace(
    TIGERS,
    source="ER-Force, field-properties/field.txt, and their measured restitution",
    sliding_deceleration=2.79,
    rolling_deceleration=0.33,
    slide_to_roll_ratio=0.70,
    first_hop_factor=0.60,
    later_hop_factor=1.0,
    vertical_restitution=0.70,
    robot_restitution=0.60,
)
VISION = replace(
    ERFORCE,
    source="ssl-vision, `field.cpp`: default before calibration at a venue",
    sliding_deceleration=3.0,
    rolling_deceleration=0.40,
    later_hop_factor=0.95,
)
KICKS = "fitted to kicks tracked {} (jgocm/kick-analysis); other numbers: TIGERs"
ROBOCUP_2023 = replace(
    TIGERS,
    source=KICKS.format("at RoboCup 2023"),
    sliding_deceleration=3.0,
    rolling_deceleration=0.15,
    rolling_drag=0.032,
    slide_to_roll_ratio=0.69,
)
LAB_2023 = replace(
    TIGERS,
    source=KICKS.format("in a laboratory"),
    sliding_deceleration=3.25,
    rolling_deceleration=0.095,
    rolling_drag=0.044,
    slide_to_roll_ratio=0.66,
)
MIMICKED = "`rsoccer identify` on a log of {}"
ERFORCE_SIMULATOR = replace(
    ERFORCE,
    source=MIMICKED.format("ER-Force's simulator; other numbers: ssl_erforce"),
    sliding_deceleration=3.91,
    rolling_deceleration=0.35,
    slide_to_roll_ratio=0.688,
)
GRSIM = replace(
    ERFORCE,
    source="grSim's report and measurements of rSim's SSL ball (along an axis)",
    sliding_deceleration=10.3,
    rolling_deceleration=0.70,
    later_hop_factor=0.96,
    vertical_restitution=0.42,
    wall_restitution=0.5,
    goal_back_restitution=0.5,
    goal_back_friction=0.35,
)
RSIM_VSS = replace(
    GRSIM,
    source="measured on rSim's VSS ball; size and mass: VSSS rules",
    radius=0.0427 / 2,
    sliding_deceleration=9.9,
    rolling_deceleration=0.14,
)
BALLS = {
    "ssl_tigers": TIGERS,
    "ssl_erforce": ERFORCE,
    "ssl_erforce_simulator": ERFORCE_SIMULATOR,
    "ssl_vision": VISION,
    "ssl_robocup_2023": ROBOCUP_2023,
    "ssl_lab_2023": LAB_2023,
    "grsim": GRSIM,
    "vss_rsim": RSIM_VSS,
}


@dataclass(frozen=True)
class SslRobot:
    """Robot of the official virtual tournament (`robot-specs.yaml`) in SI units."""

    radius: float
    height: float
    mass: float
    max_kick_speed: float
    max_chip_speed: float
    front_distance: float
    mouth_width: float
    max_speed: float = 3.7
    max_angular_velocity: float = 26.2
    max_acceleration: float = 4.7
    max_deceleration: float = 5.9
    max_angular_acceleration: float = 50.8
    max_angular_deceleration: float = 51.6


SSL_ROBOTS = {
    "ssl_generic": SslRobot(0.090, 0.143, 2.7, 8, 8, 0.0715, 0.065),
    "ssl_generic_wheels": SslRobot(0.090, 0.143, 2.7, 8, 8, 0.0715, 0.065),
    "ssl_unknown": SslRobot(0.090, 0.143, 2.7, 6, 6, 0.0715, 0.065, 2, 5, 2, 2, 20, 20),
    "ssl_tigers": SslRobot(0.090, 0.143, 2.7, 8, 8, 0.0715, 0.065),
    "ssl_erforce": SslRobot(0.089, 0.138, 1.5, 8, 8, 0.067, 0.070),
    "ssl_robocin": SslRobot(0.088, 0.148, 2.45, 10, 8, 0.0669, 0.072),
    "ssl_twente": SslRobot(0.090, 0.149, 2.32, 7.5, 7.35, 0.070, 0.070),
    "ssl_ubc": SslRobot(0.090, 0.150, 2.5, 7, 7, 0.070, 0.088),
    "ssl_kiks": SslRobot(0.089, 0.132, 2.6, 8, 8, 0.070, 0.081),
    "ssl_robodragons": SslRobot(0.090, 0.125, 2.4, 6.5, 6.5, 0.0715, 0.075),
}
_ERFORCE_SIMULATOR = SslRobot(
    *(0.089, 0.138, 1.5, 8, 8, 0.064, 0.070), *(3.7, 26.2, 5.8, 7.9, 67, 96)
)
SSL_MIMICS = {
    "ssl_grsim": SslRobot(0.090, 0.143, 2.7, 8, 8, 0.0805, 0.08, 3.7, 26.2, 3.6, 3.9, 49, 39),
    "ssl_erforce_simulator": _ERFORCE_SIMULATOR,
    "ssl_erforce_simulator_rc2021": _ERFORCE_SIMULATOR,
}
"""Robots of other simulators as they move there: their numbers are those of a fit."""
GENERIC = SSL_ROBOTS["ssl_generic"]


@dataclass(frozen=True)
class Number:
    """One number with its unit and source."""

    value: float
    unit: str
    source: str


SPECS = "`robot-specs.yaml`, all listed teams"
SSL_SHARED = {
    "max_speed": Number(3.7, "m/s", SPECS),
    "max_angular_velocity": Number(26.2, "rad/s", SPECS),
    "max_acceleration": Number(4.7, "m/s²", SPECS),
    "max_deceleration": Number(5.9, "m/s²", SPECS),
    "max_angular_acceleration": Number(50.8, "rad/s²", SPECS),
    "max_angular_deceleration": Number(51.6, "rad/s²", SPECS),
    "max_traction": Number(6.9, "m/s²", "SSL-A-Team: wheel on carpet, 0.7 g"),
    "beam_distance": Number(0.010, "m", "rSim: ball within 10 mm of the kicker plate"),
    "beam_height": Number(0.0215, "m", "own choice: height of a resting ball's center"),
    "kicker_recharge_time": Number(0.1, "s", "ER-Force's simulator: minimum"),
    "kicker_reach": Number(0.05, "m", "own choice, beyond the beam: a kicker fires when it is cut"),
    "kick_lateral_factor": Number(
        0.35, "", "TIGERs: share of the tangential speed kept in a redirect"
    ),
    "max_jerk": Number(0.0, "m/s³", "no limit; TIGERs estimate 20 m/s³ for other teams' robots"),
    "dribbler_grip": Number(
        0.12, "N", "own choice, fitted to the limits of TIGERs with the ball: 1.2 m/s² and 5 rad/s"
    ),
    "dribbler_force": Number(0.5, "N", "TIGERs: minimum force of the dribbler bar on the ball"),
    "dribbler_speed": Number(2.0, "m/s", "TIGERs: 2 to 5 m/s surface speed of the bar"),
    "dribbler_restitution": Number(0.2, "", "ER-Force: ball on dribbler bar"),
    "dribbler_friction": Number(1.5, "", "ER-Force: ball on dribbler bar"),
    "restitution": Number(0.2, "", "TIGERs' simulator, robot on robot"),
    "friction": Number(
        0.2, "", "no published value for two robots; ER-Force's value for ball on robot"
    ),
}

# From TIGERs' Sumatra: its jerk estimate for other teams' robots (`botParamsDatabase`) and its
# limits for driving with the ball (DragBallSkill, ProtectiveGetBallSkill).
JERK = 20.0  # m/s³
WITH_BALL = 1.2  # m/s²
TURN_WITH_BALL = 5.0  # rad/s


@dataclass(frozen=True)
class VssRobot:
    """Differential-drive robot in SI units."""

    source: str
    side_length: float
    mass: float
    wheel_radius: float
    track_width: float
    rpm: float
    longitudinal_grip: float  # m/s², along the wheels
    lateral_grip: float  # m/s², along the axle
    height: float
    motor_torque: float
    tipping_friction: float = 0.0  # by the force of the tires, 0 for a robot that does not tip
    skid_slip: float = 0.0  # m/s, 0 for a robot that never skids as it brakes
    restitution: float = 0.2  # of robots and walls, as the mean of both
    friction: float = 0.2


VSS_ROBOTS = {
    "vss_440rpm": VssRobot(
        "rSim's VSS robot: its source; track and forward grip measured; side grip 1.0 g",
        *(0.075, 0.15, 0.026, 0.0782, 440, 6.85, G, 0.075, 0.0725),
    ),
    "vss_650rpm": VssRobot(
        "TraveSim, from CAD; Pololu 50:1 motors; friction coefficient of the field 0.6",
        *(0.078, 0.18, 0.025, 0.071, 650, 0.6 * G, 0.6 * G, 0.062, 0.073),
    ),
}
VSS_MIMICS = {
    "vss_firasim": VssRobot(
        "FIRASim: step responses, glancing pushes; mass and torque of its configuration",
        *(0.075, 1.4, 0.02, 0.08, 59.9 * 30 / pi, 4.03, 40.0, 0.075, 0.11, 0.69, 0.15, 0.0, 0.3),
    ),
}


@dataclass(frozen=True)
class Pitch:
    """Field dimensions by the rules, m."""

    source: str
    numbers: dict[str, float] = field(default_factory=dict)


def _pitch(source: str, *sizes: float, **others: float) -> Pitch:
    names = ("length", "width", "goal_width", "goal_depth", "goal_height")
    return Pitch(source, dict(zip(names, sizes, strict=True)) | others)


# Numbers that all SSL fields and both VSSS fields share, by their rules.
_SSL = {
    "touch_line_margin": 0.3,
    "goal_wall_thickness": 0.02,
    "center_circle_radius": 0.5,
    "line_width": 0.01,
}
_VSS = {
    "corner_leg": 0.07,
    "wall_height": 0.05,
    "penalty_mark_distance": 0.375,
    "line_width": 0.003,
}
FIELDS = {
    "vss_3v3": _pitch("VSSS rules, VSSReferee", 1.5, 1.3, 0.4, 0.1, 0.05, **_VSS),
    "vss_5v5": _pitch("VSSReferee", 2.2, 1.8, 0.4, 0.15, 0.05, **_VSS),
    "ssl_a": _pitch(
        "SSL rules 2026",
        12,
        9,
        1.8,
        0.18,
        0.16,
        goal_line_margin=0.6,
        penalty_mark_distance=8,
        **_SSL,
    ),
    "ssl_b": _pitch(
        "SSL rules 2026",
        9,
        6,
        1.0,
        0.18,
        0.16,
        goal_line_margin=0.3,
        penalty_mark_distance=6,
        **_SSL,
    ),
    "ssl_challenge": _pitch("SSL hardware challenges 2021", 6, 4, 0.7, 0.18, 0.16, **_SSL),
}

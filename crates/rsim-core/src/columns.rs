//! Names of the columns of a state row, of a command and of a world's parameters: written once,
//! here.
//!
//! A state row is the ball's columns, then each robot's, first team first. A row of parameters is
//! laid out likewise.

/// What a row says of the ball.
///
/// Position (m; `z` is the height of its lowest point, 0 on the floor), velocity (m/s), spin
/// (rad/s, about the field's axes), the robot that touched it last (its place in the row, or -1),
/// and what its centre crossed during the control step (a position in [`CROSSINGS`]) and where (m;
/// 0 when nothing was crossed).
pub const BALL_COLUMNS: [&str; 14] = [
    "x",
    "y",
    "z",
    "v_x",
    "v_y",
    "v_z",
    "spin_x",
    "spin_y",
    "spin_z",
    "last_touch",
    "crossed",
    "crossed_x",
    "crossed_y",
    "crossed_z",
];

/// What a row says of a robot.
///
/// Position (m), heading as cosine and sine, velocity (m/s), turn rate (rad/s, counter-clockwise),
/// whether its break beam is cut (1 or 0), and what happened during the control step: whether it
/// touched the ball or a robot of the other team (1 or 0), and the closing speed of its hardest
/// contact with any robot (m/s).
pub const ROBOT_COLUMNS: [&str; 11] = [
    "x",
    "y",
    "cos",
    "sin",
    "v_x",
    "v_y",
    "v_theta",
    "infrared",
    "touched_ball",
    "touched_opponent",
    "collision_speed",
];

/// What a differential robot is told: wheel speeds, rad/s, positive is forward.
pub const DIFFERENTIAL_COLUMNS: [&str; 2] = ["left", "right"];

/// What an omnidirectional robot is told: velocity forward and to its left (m/s), turn rate
/// (rad/s), speed of a kick along its heading and upward (m/s; 0 for none), and the share of its
/// dribbler's speed (0 is off, 1 is full).
pub const OMNI_COLUMNS: [&str; 6] = ["v_x", "v_y", "v_theta", "kick_v_x", "kick_v_z", "dribbler"];

/// The same by wheels: speeds in rad/s in the order of the model's `wheel_angles`; positive turns
/// the robot counter-clockwise.
pub const OMNI_WHEELS_COLUMNS: [&str; 7] =
    ["wheel_0", "wheel_1", "wheel_2", "wheel_3", "kick_v_x", "kick_v_z", "dribbler"];

/// Meanings of the ball's `crossed` column: nothing, the goal mouth at +x or -x, the rest of the
/// goal line there, the touch line at +y (left of +x) or -y.
pub const CROSSINGS: [&str; 7] = [
    "none",
    "goal_right",
    "goal_left",
    "goal_line_right",
    "goal_line_left",
    "touch_line_left",
    "touch_line_right",
];

/// What a world of its own may change of the ball, as factors on the model's numbers.
pub const BALL_PARAMETERS: [&str; 8] = [
    "mass",
    "sliding_deceleration",
    "rolling_deceleration",
    "hop",
    "robot_restitution",
    "robot_friction",
    "wall_restitution",
    "wall_friction",
];

/// What a world of its own may change of each robot, as factors on its model's numbers.
///
/// `acceleration` is of all that it gains and loses speed with; `traction` is what its wheels transmit:
/// in every direction (omnidirectional), or along the axle (differential).
pub const ROBOT_PARAMETERS: [&str; 7] =
    ["mass", "height", "acceleration", "speed", "traction", "kick", "grip"];

/// Maximum speed of a body in a start row, m/s. Kicks reach 14 m/s with the robot's own speed.
pub const MAX_PLACED_SPEED: f32 = 20.0;

/// Bound on commanded velocities before any limit of the robot, m/s: its square is still finite.
pub(crate) const MAX_COMMAND: f32 = 1e9;

/// Meaning of a value of the ball's `crossed` column.
///
/// # Panics
/// When no row has such a value.
pub fn crossing_name(crossed: f32) -> &'static str {
    let codes = (0_u8..).map(f32::from);
    let found = codes.zip(CROSSINGS).find(|(code, _)| (code - crossed).abs() < 0.5);
    found.expect("`crossed` is a position in CROSSINGS").1
}

/// Place of a column among the ball's.
///
/// # Panics
/// When the ball has no such column.
pub fn ball_column(name: &str) -> usize {
    place(&BALL_COLUMNS, name)
}

/// Place of a column among a robot's.
///
/// # Panics
/// When a robot has no such column.
pub fn robot_column(name: &str) -> usize {
    place(&ROBOT_COLUMNS, name)
}

fn place(columns: &[&str], name: &str) -> usize {
    let found = columns.iter().position(|column| *column == name);
    found.unwrap_or_else(|| panic!("{name:?} is none of {columns:?}"))
}

/// Length of the row of a match with `robots` robots.
pub const fn row_size(robots: usize) -> usize {
    BALL_COLUMNS.len() + robots * ROBOT_COLUMNS.len()
}

/// Length of the row of parameters of a match with `robots` robots.
pub const fn parameters_size(robots: usize) -> usize {
    BALL_PARAMETERS.len() + robots * ROBOT_PARAMETERS.len()
}

//! Names of the columns of a state row, of a command and of a world's parameters.
//!
//! A state row has the ball's columns, then each robot's, first team first; so has a row of parameters.

/// Columns of the ball.
///
/// Position (m; `z` is the height of the lowest point, 0 on the floor), velocity (m/s), spin (rad/s,
/// about the field's axes), index of the last robot that touched the ball (or -1), the line that its
/// center crossed during the control step (an index in [`CROSSINGS`]), and the point of the crossing (m;
/// 0 without one). Last, of the last touch by a robot: the time since it (s), the speed of the ball right after it
/// (m/s, in three dimensions), and the maximum of `z` since it (m); 0 where nobody has touched the ball. A tick of
/// contact is a touch, so that the time is 0 while a robot keeps the ball.
pub const BALL_COLUMNS: [&str; 17] = [
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
    "seconds_since_touch",
    "speed_after_touch",
    "height_since_touch",
];

/// Columns of a robot.
///
/// Position (m), heading as cosine and sine, velocity (m/s), angular velocity (rad/s, counterclockwise),
/// whether the ball cuts the break beam (1 or 0), and of the control step: whether the robot touched the
/// ball or an opponent (1 or 0), and the closing speed of its hardest contact with any robot (m/s). Last,
/// whether the robot is absent (1 or 0): not on the field. It then rests behind its own goal, beyond all
/// walls.
///
/// `v_theta` is the name of the column of the angular velocity only, beside `v_x` and `v_y`.
pub const ROBOT_COLUMNS: [&str; 12] = [
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
    "absent",
];

/// Command of a differential robot: wheel speeds, rad/s, positive is forward.
pub const DIFFERENTIAL_COLUMNS: [&str; 2] = ["left", "right"];

/// Command of an omnidirectional robot by its velocity: velocity forward and to the left (m/s), angular
/// velocity (rad/s), speed of a kick along the heading and upward (m/s; 0 for none), dribbler speed (0 is
/// off, 1 is full).
pub const OMNI_COLUMNS: [&str; 6] = ["v_x", "v_y", "v_theta", "kick_v_x", "kick_v_z", "dribbler"];

/// Command of an omnidirectional robot by its wheels: wheel speeds (rad/s) in the order of the model's
/// `wheel_angles`, positive turns the robot counterclockwise; kick and dribbler as in
/// [`OMNI_COLUMNS`].
pub const OMNI_WHEELS_COLUMNS: [&str; 7] =
    ["wheel_0", "wheel_1", "wheel_2", "wheel_3", "kick_v_x", "kick_v_z", "dribbler"];

/// Names of the values of the ball's `crossed` column: nothing, the goal at +x or -x, the rest of the goal
/// line there, the touch line at +y (left of +x) or -y.
pub const CROSSINGS: [&str; 7] = [
    "none",
    "goal_right",
    "goal_left",
    "goal_line_right",
    "goal_line_left",
    "touch_line_left",
    "touch_line_right",
];

/// Factors on the ball's numbers that each world can have of its own.
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

/// Factors on each robot's numbers that each world can have of its own.
///
/// `acceleration` applies to all accelerations and decelerations; `traction` to the force that wheels
/// transmit in every direction (omnidirectional) or along the axle (differential).
pub const ROBOT_PARAMETERS: [&str; 7] =
    ["mass", "height", "acceleration", "speed", "traction", "kick", "grip"];

/// Maximum speed of a body in a start row, m/s, height included. Kicks reach 14 m/s with the robot's own speed.
pub const MAX_PLACED_SPEED: f32 = 20.0;

/// Maximum angular velocity of a robot in a start row, rad/s: at most a radian in the longest tick, for
/// which the solver still rotates bodies accurately. The fastest preset turns at 48 rad/s.
pub const MAX_PLACED_ANGULAR_VELOCITY: f32 = 200.0;

/// Maximum spin of the ball in a start row, rad/s. A golf ball that rolls at [`MAX_PLACED_SPEED`] spins at
/// 940 rad/s.
pub const MAX_PLACED_SPIN: f32 = 1000.0;

/// Maximum height of the ball in a start row, m: what a throw at [`MAX_PLACED_SPEED`] reaches.
pub const MAX_PLACED_HEIGHT: f32 = 20.0;

/// Maximum factor on a number of a model, and the inverse of the minimum of one that must be positive. Beyond
/// it the models' numbers lose their meaning, and the solver its accuracy.
pub const MAX_FACTOR: f32 = 1000.0;

/// Bound on commanded velocities before any limit of the robot, m/s: its square is still finite.
pub(crate) const MAX_COMMAND: f32 = 1e9;

/// Name of a value of the ball's `crossed` column.
///
/// # Panics
/// If the value is no index of [`CROSSINGS`].
pub fn crossing_name(crossed: f32) -> &'static str {
    let codes = (0_u8..).map(f32::from);
    let found = codes.zip(CROSSINGS).find(|(code, _)| (code - crossed).abs() < 0.5);
    found.expect("`crossed` is a position in CROSSINGS").1
}

/// Index of a column among the ball's.
///
/// # Panics
/// If the ball has no such column.
pub fn ball_column(name: &str) -> usize {
    index_of(&BALL_COLUMNS, name)
}

/// Index of a column among a robot's.
///
/// # Panics
/// If a robot has no such column.
pub fn robot_column(name: &str) -> usize {
    index_of(&ROBOT_COLUMNS, name)
}

fn index_of(columns: &[&str], name: &str) -> usize {
    let found = columns.iter().position(|column| *column == name);
    found.unwrap_or_else(|| panic!("{name:?} is none of {columns:?}"))
}

/// Place of `absent` among a robot's columns: the last.
pub(crate) const ABSENT_COLUMN: usize = ROBOT_COLUMNS.len() - 1;

/// Whether the robot with these columns is absent.
pub fn is_absent(robot: &[f32]) -> bool {
    robot[ABSENT_COLUMN] > 0.0
}

/// Length of the state row of a match with `robots` robots.
pub const fn row_size(robots: usize) -> usize {
    BALL_COLUMNS.len() + robots * ROBOT_COLUMNS.len()
}

/// Length of the row of parameters of a match with `robots` robots.
pub const fn parameters_size(robots: usize) -> usize {
    BALL_PARAMETERS.len() + robots * ROBOT_PARAMETERS.len()
}

//! Names of the columns of a state row and of a command: written once, here.
//!
//! A state row is the ball's columns, then each robot's, first team first.

/// What a row says of the ball: position (m), velocity (m/s), and what its centre crossed during
/// the control step (a position in [`CROSSINGS`]) and where (m; 0 when nothing was crossed).
pub const BALL_COLUMNS: [&str; 7] = ["x", "y", "v_x", "v_y", "crossed", "crossed_x", "crossed_y"];

/// What a row says of a robot: position (m), heading as cosine and sine, velocity (m/s), turn rate
/// (rad/s, counter-clockwise).
pub const ROBOT_COLUMNS: [&str; 7] = ["x", "y", "cos", "sin", "v_x", "v_y", "v_theta"];

/// What a differential robot is told: wheel speeds, rad/s, positive is forward.
pub const DIFFERENTIAL_COLUMNS: [&str; 2] = ["left", "right"];

/// Meanings of the ball's `crossed` column: nothing, the goal mouth at +x, the one at -x.
pub const CROSSINGS: [&str; 3] = ["none", "goal_right", "goal_left"];

/// Meaning of a value of the ball's `crossed` column.
///
/// # Panics
/// When no row has such a value.
pub fn crossing_name(crossed: f32) -> &'static str {
    let codes = (0_u8..).map(f32::from);
    let found = codes.zip(CROSSINGS).find(|(code, _)| (code - crossed).abs() < 0.5);
    found.expect("`crossed` is a position in CROSSINGS").1
}

/// Length of the row of a match with `robots` robots.
pub const fn row_size(robots: usize) -> usize {
    BALL_COLUMNS.len() + robots * ROBOT_COLUMNS.len()
}

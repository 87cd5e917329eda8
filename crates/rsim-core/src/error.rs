//! All errors of the crate; the binding maps them to Python exceptions.

use crate::columns::{
    MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED, MAX_PLACED_SPIN,
};

/// An invalid configuration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConfigError {
    /// A name that is not a preset.
    #[error("{what} must be one of {known}, got {got:?}")]
    UnknownPreset {
        /// Name of the argument.
        what: &'static str,
        /// Names of the presets.
        known: String,
        /// The given value.
        got: String,
    },
    /// A number out of its range.
    #[error("{name} must be {expected}, got {got}")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Its range.
        expected: &'static str,
        /// The given value.
        got: f32,
    },
    /// Numbers that do not fit together.
    #[error("{0}")]
    Inconsistent(String),
    /// More robots than the league allows.
    #[error("{name} must be at most {max} on a {field} field, got {got}")]
    TooManyRobots {
        /// Name of the argument with the team's size.
        name: &'static str,
        /// The league's limit.
        max: usize,
        /// The field.
        field: String,
        /// The given value.
        got: usize,
    },
    /// 0 worlds or threads.
    #[error("{name} must be at least 1, got 0")]
    Zero {
        /// Name of the argument.
        name: &'static str,
    },
    /// More worlds than fit into memory.
    #[error("worlds must be at most {max}, got {got}")]
    TooManyWorlds {
        /// The limit.
        max: usize,
        /// The given value.
        got: usize,
    },
    /// A field whose name belongs to no league, so that an argument has no default.
    #[error("{needed_for} must be given for a field of no known league, got field {field:?}")]
    UnknownLeague {
        /// The argument without a default.
        needed_for: &'static str,
        /// Name of the field.
        field: String,
    },
    /// The operating system refused to start threads.
    #[error("could not start {threads} threads: {reason}")]
    Threads {
        /// Requested number of threads.
        threads: usize,
        /// The operating system's message.
        reason: String,
    },
}

/// An invalid start of a match.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlaceError {
    /// Two bodies overlap.
    #[error("{first} and {second} overlap by {depth_mm:.1} mm")]
    Overlap {
        /// Name of one body.
        first: String,
        /// Name of the other body.
        second: String,
        /// Depth of the overlap, mm.
        depth_mm: f32,
    },
    /// A body is outside the field.
    #[error("{who} is outside the field, at ({x:.3}, {y:.3}) m")]
    Outside {
        /// Name of the body.
        who: String,
        /// Position of the body, m.
        x: f32,
        /// Position of the body, m.
        y: f32,
    },
    /// A heading that is no unit vector.
    #[error("the heading of {who} must be a unit vector (cos, sin), got ({cos}, {sin})")]
    Heading {
        /// Name of the robot.
        who: String,
        /// The given value.
        cos: f32,
        /// The given value.
        sin: f32,
    },
    /// A value that is not finite.
    #[error("{column} of {who} must be finite, got {got}")]
    NotFinite {
        /// Name of the body.
        who: String,
        /// Name of the column.
        column: &'static str,
        /// The given value.
        got: f32,
    },
    /// A body faster than [`MAX_PLACED_SPEED`].
    #[error(
        "{who} moves at {speed:?} m/s ({columns}); at most {MAX_PLACED_SPEED} m/s can be placed"
    )]
    TooFast {
        /// Name of the body.
        who: String,
        /// Names of the columns of its velocity.
        columns: &'static str,
        /// Speed of the body, m/s.
        speed: f32,
    },
    /// A column `absent` that is neither 0 nor 1.
    #[error("`absent` of {who} must be 0 or 1, got {got}")]
    Absent {
        /// Name of the robot.
        who: String,
        /// The given value.
        got: f32,
    },
    /// A robot that turns faster than [`MAX_PLACED_ANGULAR_VELOCITY`].
    #[error(
        "{who} turns at {angular_velocity:?} rad/s (v_theta); at most \
         {MAX_PLACED_ANGULAR_VELOCITY} rad/s can be placed"
    )]
    TurnsTooFast {
        /// Name of the robot.
        who: String,
        /// Its angular velocity, rad/s.
        angular_velocity: f32,
    },
    /// A ball that spins faster than [`MAX_PLACED_SPIN`].
    #[error(
        "the ball spins at {spin:?} rad/s (spin_x, spin_y, spin_z); at most {MAX_PLACED_SPIN} rad/s \
         can be placed"
    )]
    SpinsTooFast {
        /// Spin of the ball, rad/s.
        spin: f32,
    },
    /// A ball higher than [`MAX_PLACED_HEIGHT`].
    #[error("the ball must not be higher than {MAX_PLACED_HEIGHT} m, got z = {z:?} m")]
    TooHigh {
        /// Height of the ball's lowest point, m.
        z: f32,
    },
    /// A ball below the floor.
    #[error("the ball must not be below the floor, got z = {z:?} m")]
    Below {
        /// Height of the ball's lowest point, m.
        z: f32,
    },
    /// Factors out of their range.
    #[error("parameters: {0}")]
    Parameters(ConfigError),
    /// A ball or robots for a match whose state became non-finite.
    #[error("its state became non-finite; place that world again")]
    Lost,
    /// An error in one world of many.
    #[error("world {world}: {error}")]
    InWorld {
        /// Index of the world.
        world: usize,
        /// The error.
        error: Box<PlaceError>,
    },
}

impl PlaceError {
    /// The error with the index of its world.
    pub(crate) fn in_world(self, world: usize) -> Self {
        Self::InWorld { world, error: Box::new(self) }
    }
}

/// Worlds with a non-finite state, since this step or an earlier one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the state of worlds {worlds:?} became non-finite; place them again")]
pub struct StepError {
    /// Indices of all such worlds, in order.
    pub worlds: Vec<usize>,
}

impl StepError {
    /// The error of these worlds, given in any order.
    pub(crate) fn in_worlds(mut worlds: Vec<usize>) -> Self {
        worlds.sort_unstable();
        Self { worlds }
    }
}

/// An invalid snapshot.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// Bytes that this crate did not write.
    #[error("these bytes are not a snapshot")]
    Foreign,
    /// A snapshot of a version that stores states in another way.
    #[error("the snapshot is of another version of rsim-core, which stores states in another way")]
    Layout,
    /// A snapshot of another physics version.
    #[error("the snapshot is of physics {found}, this is physics {expected}")]
    Version {
        /// Version in the bytes.
        found: u32,
        /// Version of this crate.
        expected: u32,
    },
    /// Bytes that are cut off or changed.
    #[error("the snapshot is damaged: {0}")]
    Damaged(&'static str),
    /// A snapshot of another configuration.
    #[error("the snapshot is of another configuration or number of worlds")]
    OtherConfig,
}

/// A forecast that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ForecastError {
    /// Commands that were sent before others that are known.
    #[error(
        "times: the commands of world {world} were sent at {got} s, before the last ones at {last} s"
    )]
    OutOfOrder {
        /// Index of the world.
        world: usize,
        /// The given time, s.
        got: f64,
        /// Time of the last commands, s.
        last: f64,
    },
    /// A row that is too old.
    #[error("the row of world {world} is {got} s before its forecast, expected at most {max} s")]
    TooOld {
        /// Index of the world.
        world: usize,
        /// The limit, s.
        max: f64,
        /// The time between them, s.
        got: f64,
    },
    /// A row of a time whose commands are forgotten.
    #[error(
        "seen: the row of world {world} is of {got} s, expected {since} s or later: commands that acted before are forgotten"
    )]
    Forgotten {
        /// Index of the world.
        world: usize,
        /// Time of the row, s.
        got: f64,
        /// Time from which commands are known, s.
        since: f64,
    },
    /// A row that cannot be placed.
    #[error(transparent)]
    Row(#[from] PlaceError),
}

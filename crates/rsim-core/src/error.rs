//! Everything that can be wrong, in one place; the binding maps these to Python exceptions.

use crate::columns::MAX_PLACED_SPEED;

/// A configuration that no match can be played with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConfigError {
    /// A name that is not a preset.
    #[error("{what} must be one of {known}, got {got:?}")]
    UnknownPreset {
        /// Which argument.
        what: &'static str,
        /// The presets there are.
        known: String,
        /// What came.
        got: String,
    },
    /// A quantity that is out of its range.
    #[error("{name} must be {expected}, got {got}")]
    Number {
        /// Which quantity.
        name: &'static str,
        /// Its range.
        expected: &'static str,
        /// What came.
        got: f32,
    },
    /// Two quantities that do not fit together.
    #[error("{0}")]
    Inconsistent(String),
    /// More robots than the league allows.
    #[error("{name} must be at most {max} on a {field} field, got {got}")]
    TooManyRobots {
        /// Which team.
        name: &'static str,
        /// The league's limit.
        max: usize,
        /// The field.
        field: String,
        /// What came.
        got: usize,
    },
    /// A number of worlds or threads that cannot work.
    #[error("{name} must be at least 1, got 0")]
    Zero {
        /// Which number.
        name: &'static str,
    },
    /// More worlds than any memory holds.
    #[error("worlds must be at most {max}, got {got}")]
    TooManyWorlds {
        /// The limit.
        max: usize,
        /// What came.
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
        /// How many were wanted.
        threads: usize,
        /// What the system said.
        reason: String,
    },
}

/// A starting row that no match can start from.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlaceError {
    /// Two bodies share space.
    #[error("{first} and {second} overlap by {depth_mm:.1} mm")]
    Overlap {
        /// One of the two.
        first: String,
        /// The other.
        second: String,
        /// How deep, millimetres.
        depth_mm: f32,
    },
    /// A body is not on the field.
    #[error("{who} is outside the field, at ({x:.3}, {y:.3}) m")]
    Outside {
        /// Which body.
        who: String,
        /// Where, metres.
        x: f32,
        /// Where, metres.
        y: f32,
    },
    /// A heading that is no direction.
    #[error("the heading of {who} must be a unit vector (cos, sin), got ({cos}, {sin})")]
    Heading {
        /// Which robot.
        who: String,
        /// What came.
        cos: f32,
        /// What came.
        sin: f32,
    },
    /// A number that is not finite.
    #[error("{who} has a value that is not finite")]
    NotFinite {
        /// Which body.
        who: String,
    },
    /// A body that is faster than anything in the game, and than what contacts are looked for.
    #[error("{who} moves at {speed:.1} m/s; at most {MAX_PLACED_SPEED} m/s can be placed")]
    TooFast {
        /// Which body.
        who: String,
        /// How fast.
        speed: f32,
    },
    /// A ball below the floor.
    #[error("the ball must not be below the floor, got z = {z} m")]
    Below {
        /// Where, metres.
        z: f32,
    },
    /// Parameters that make no ball or robot.
    #[error("params: {0}")]
    Parameters(ConfigError),
    /// A ball for a match that is no match any more.
    #[error("its state became non-finite; place that world again")]
    Lost,
    /// The same, in one world of many.
    #[error("world {world}: {error}")]
    InWorld {
        /// Index of the world.
        world: usize,
        /// What is wrong there.
        error: Box<PlaceError>,
    },
}

impl PlaceError {
    /// The same, in one world of many.
    pub(crate) fn in_world(self, world: usize) -> Self {
        Self::InWorld { world, error: Box::new(self) }
    }
}

/// Worlds whose state became non-finite while they were stepped, or had become so before.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the state of worlds {worlds:?} became non-finite; place them again")]
pub struct StepError {
    /// Indices of all such worlds, in order.
    pub worlds: Vec<usize>,
}

impl StepError {
    /// Of these worlds, given in any order.
    pub(crate) fn in_worlds(mut worlds: Vec<usize>) -> Self {
        worlds.sort_unstable();
        Self { worlds }
    }
}

/// Bytes that are not a snapshot of this simulator.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// Not written by this crate.
    #[error("these bytes are not a snapshot")]
    Foreign,
    /// Written by another version of the format or the physics.
    #[error("the snapshot is of physics {found}, this is physics {expected}")]
    Version {
        /// Version in the bytes.
        found: u32,
        /// Version of this crate.
        expected: u32,
    },
    /// Cut off or changed.
    #[error("the snapshot is damaged: {0}")]
    Damaged(&'static str),
    /// Of a simulator that was set up differently.
    #[error("the snapshot is of another configuration or number of worlds")]
    OtherConfig,
}

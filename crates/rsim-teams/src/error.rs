//! Errors of input that a scripted side refuses.

use rsim_referee::RefereeError;

/// Input that does not fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TeamsError {
    /// A number outside its range.
    #[error("{name}: expected {expected}, got {got}")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Numbers that it may be.
        expected: &'static str,
        /// Number given.
        got: f32,
    },
    /// A number of the tactics outside its range.
    #[error("tactics: expected {name} from {least} to {most}, got {got}")]
    Tactic {
        /// Name of the number.
        name: &'static str,
        /// Least value.
        least: f32,
        /// Greatest value.
        most: f32,
        /// Number given.
        got: f32,
    },
    /// A team that is too large.
    #[error("layout: expected at most {expected} robots a team, got {got}")]
    TooManyRobots {
        /// Most robots of a team.
        expected: usize,
        /// Robots of the larger team.
        got: usize,
    },
    /// A row of another length.
    #[error("{name}: expected {expected} numbers, got {got}")]
    Size {
        /// Name of the row.
        name: &'static str,
        /// Numbers in it.
        expected: usize,
        /// Numbers given.
        got: usize,
    },
    /// A number in the memory that its column cannot have.
    #[error("memory: expected a value of {name:?}")]
    Memory {
        /// Name of the column, without its ends.
        name: &'static str,
    },
    /// A state row that does not fit the layout.
    #[error(transparent)]
    Row(#[from] RefereeError),
}

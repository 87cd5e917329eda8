//! Errors of input that a referee refuses.

/// Input that does not fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RefereeError {
    /// A row without a column that the rules read.
    #[error("columns: expected one named {name:?}")]
    MissingColumn {
        /// The name.
        name: &'static str,
    },
    /// A number in a row that its column cannot have.
    #[error("row: expected a value of {name:?}")]
    Column {
        /// Name of the column, without its ends.
        name: &'static str,
    },
    /// A row of another length.
    #[error("row: expected {expected} numbers, got {got}")]
    RowSize {
        /// Numbers in a row.
        expected: usize,
        /// Numbers given.
        got: usize,
    },
    /// A number of the configuration that is not finite or negative.
    #[error("{name}: expected a finite number, at least 0, got {got}")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Number given.
        got: f32,
    },
    /// A time of the configuration whose steps a row cannot count.
    #[error("{name}: expected at most {most} s, got {got}")]
    TooLong {
        /// Name of the number.
        name: &'static str,
        /// Longest time, s.
        most: f32,
        /// Time given, s.
        got: f32,
    },
    /// A rule that does not exist.
    #[error("off: expected names of {known}, got {name:?}")]
    UnknownRule {
        /// Name given.
        name: String,
        /// Names of all rules.
        known: String,
    },
}

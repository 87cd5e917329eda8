//! Input that a match refuses.

use rsim_core::{ConfigError, PlaceError, StepError};
use rsim_referee::RefereeError;
use rsim_teams::TeamsError;

/// Input that does not fit, or a state that cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum MatchError {
    /// A number of the physics or of the senses.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// Bodies that cannot be where they are put.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// A state that is not finite any more.
    #[error(transparent)]
    Step(#[from] StepError),
    /// A state of the referee.
    #[error(transparent)]
    Referee(#[from] RefereeError),
    /// A scripted side.
    #[error(transparent)]
    Teams(#[from] TeamsError),
    /// A policy file.
    #[error("policy: {0}")]
    Policy(String),
    /// Anything else: the argument, what was expected, and what came.
    #[error("{name}: expected {expected}, got {got}")]
    Argument {
        /// Name of the argument.
        name: &'static str,
        /// What it may be.
        expected: String,
        /// What it was.
        got: String,
    },
}

impl MatchError {
    /// An argument that is not as expected.
    pub(crate) fn argument(
        name: &'static str,
        expected: impl Into<String>,
        got: &impl ToString,
    ) -> Self {
        Self::Argument { name, expected: expected.into(), got: got.to_string() }
    }
}

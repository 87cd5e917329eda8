//! Restart of play within a match: all bodies in a new state, as a referee puts them.

use crate::error::PlaceError;
use crate::world::placement::Start;
use crate::world::{CheckedStart, World};

impl World {
    /// Puts all bodies into the state of a row, as a referee does within a match. The world keeps its own
    /// parameters. Nothing else of the old state remains: kickers are charged, and touches, crossings,
    /// collisions and the solver's impulses are cleared. A match whose state became non-finite can be
    /// restarted too.
    ///
    /// # Errors
    /// [`PlaceError`] for bodies outside the field or overlapping; then nothing has changed.
    pub fn restart(&mut self, row: &[f32]) -> Result<(), PlaceError> {
        let start = self.check_restart(row)?;
        self.restart_from(start);
        Ok(())
    }

    /// Reads and checks a start of the world with its own parameters.
    pub(super) fn check_restart(&self, row: &[f32]) -> Result<Start, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        self.shared.placement.read(row, self.parameters())
    }

    /// Restarts play from a checked start.
    pub(super) fn restart_from(&mut self, start: Start) {
        let own_parameters = self.state.own_parameters.take();
        self.start(CheckedStart { start, own_parameters });
        self.look_again();
    }
}

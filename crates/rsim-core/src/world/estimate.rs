//! Placement of an estimate: a running match continues from the valid state that is nearest to a row.

use crate::error::PlaceError;
use crate::world::World;
use crate::world::nearest::Nearest;

impl World {
    /// Puts all bodies into the valid state that is nearest to a row from noisy senses, whose bodies may
    /// overlap each other or walls, be outside the field or too fast, or have headings of any length. A
    /// valid row is taken as it is. All else is as in [`World::restart`]: the world keeps its own
    /// parameters, and nothing else of the old state remains. Returns by how much the ball and each robot
    /// were moved, m.
    ///
    /// # Errors
    /// [`PlaceError`] for numbers that are not finite, or `absent` neither 0 nor 1; then nothing has
    /// changed.
    pub fn place_estimate(&mut self, row: &[f32]) -> Result<Vec<f32>, PlaceError> {
        let Nearest { start, moved } = self.nearest(row)?;
        self.restart_from(start);
        Ok(moved)
    }

    /// The valid state that is nearest to a row.
    pub(super) fn nearest(&self, row: &[f32]) -> Result<Nearest, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        self.shared.placement.nearest(row, self.parameters())
    }
}

//! Changes of some worlds at once: new matches, restarts, bodies that are moved.

use super::Batch;
use crate::blocks::robot;
use crate::columns::BALL_COLUMNS;
use crate::error::PlaceError;
use crate::world::World;

/// Number of worlds that the caller's thread places by itself: waking others would take longer.
const PLACED_ALONE: usize = 32;

impl Batch {
    /// Starts new matches in the worlds of the mask. `rows` has one row for each of these worlds, and so
    /// has `parameters` if given (see [`World::place`]). `out` has one row for every world; the rows of
    /// placed worlds are written.
    ///
    /// # Errors
    /// [`PlaceError::InWorld`] for the first world with an invalid start; then no world has changed.
    pub fn place(
        &mut self,
        mask: &[bool],
        rows: &[f32],
        parameters: Option<&[f32]>,
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let (size, count) = (self.config().row_size(), self.config().parameters_size());
        let row = |nth: usize| &rows[nth * size..][..size];
        let own = |nth: usize| parameters.map(|all| &all[nth * count..][..count]);
        self.change(mask, out, |nth, world| world.check(row(nth), own(nth)), World::start_match)
    }

    /// Restarts play in the worlds of the mask: all bodies get a new state, and the worlds keep their own
    /// parameters. `rows` has one row for each of these worlds (see [`World::restart`]). `out` has one row
    /// for every world; the rows of these worlds are written.
    ///
    /// # Errors
    /// [`PlaceError::InWorld`] for the first world with an invalid row; then no world has changed.
    pub fn restart(
        &mut self,
        mask: &[bool],
        rows: &[f32],
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let size = self.config().row_size();
        let row = |nth: usize| &rows[nth * size..][..size];
        self.change(mask, out, |nth, world| world.check_restart(row(nth)), World::restart_from)
    }

    /// Moves the ball in the worlds of the mask; everything else of their matches continues. `balls` has
    /// the ball's columns for each of these worlds (see [`World::reposition_ball`]). `out` has one row for
    /// every world; the rows of these worlds are written.
    ///
    /// # Errors
    /// [`PlaceError::InWorld`] for the first world with an invalid ball; then no world has changed.
    pub fn reposition_balls(
        &mut self,
        mask: &[bool],
        balls: &[f32],
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let size = BALL_COLUMNS.len();
        let ball = |nth: usize| &balls[nth * size..][..size];
        self.change(mask, out, |nth, world| world.check_ball(ball(nth)), World::set_ball)
    }

    /// Moves robots in the worlds of the mask, or takes them off the field; everything else of their
    /// matches continues. `robots` has a flag for each robot of each of these worlds, and `rows` one row
    /// (see [`World::reposition_robots`]). `out` has one row for every world; the rows of these worlds are
    /// written.
    ///
    /// # Errors
    /// [`PlaceError::InWorld`] for the first world with an invalid robot; then no world has changed.
    pub fn reposition_robots(
        &mut self,
        mask: &[bool],
        robots: &[bool],
        rows: &[f32],
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let (size, count) = (self.config().row_size(), self.config().n_robots());
        let row = |nth: usize| &rows[nth * size..][..size];
        let moved = |nth: usize| &robots[nth * count..][..count];
        let check = |nth, world: &World| world.check_robots(moved(nth), row(nth));
        self.change(mask, out, check, World::set_robots)
    }

    /// Restarts play in the worlds of the mask from the valid states that are nearest to `rows`, one row
    /// for each of these worlds (see [`World::place_estimate`]). `out` has one row for every world; the
    /// rows of these worlds are written. `moved` has a number for each body of each of these worlds: by
    /// how much it was moved, m.
    ///
    /// # Errors
    /// [`PlaceError::InWorld`] for the first world with a row that is not finite; then no world has
    /// changed.
    pub fn place_estimates(
        &mut self,
        mask: &[bool],
        rows: &[f32],
        out: &mut [f32],
        moved: &mut [f32],
    ) -> Result<(), PlaceError> {
        let (size, bodies) = (self.config().row_size(), robot(self.config().n_robots()));
        let row = |nth: usize| &rows[nth * size..][..size];
        let all = self.checked(mask, |nth, world| world.nearest(row(nth)))?;
        for (found, moved) in all.iter().zip(moved.chunks_exact_mut(bodies)) {
            moved.copy_from_slice(&found.moved);
        }
        let starts = all.into_iter().map(|found| found.start).collect();
        self.make(mask, out, starts, World::restart_from);
        Ok(())
    }

    /// Changes the worlds of the mask and writes their rows, unless a check refuses the change of a world.
    /// `check` takes the position of a world among those of the mask.
    fn change<C: Send>(
        &mut self,
        mask: &[bool],
        out: &mut [f32],
        check: impl Fn(usize, &World) -> Result<C, PlaceError> + Sync,
        make: impl Fn(&mut World, C) + Sync,
    ) -> Result<(), PlaceError> {
        let changes = self.checked(mask, check)?;
        self.make(mask, out, changes, make);
        Ok(())
    }

    /// The checked changes of the worlds of the mask.
    fn checked<C: Send>(
        &self,
        mask: &[bool],
        check: impl Fn(usize, &World) -> Result<C, PlaceError> + Sync,
    ) -> Result<Vec<C>, PlaceError> {
        let worlds = &self.worlds;
        let chosen: Vec<usize> = (0..mask.len()).filter(|&world| mask[world]).collect();
        let mut checked: Vec<_> = chosen.iter().map(|_| None).collect();
        self.threads.write_rows(&mut checked, 1, PLACED_ALONE, |nth, checked| {
            checked[0] = Some(check(nth, &worlds[chosen[nth]]));
        });
        let each = checked.into_iter().flatten().zip(chosen);
        each.map(|(checked, world)| checked.map_err(|error| error.in_world(world))).collect()
    }

    /// Makes a change of each world of the mask, and writes its row.
    fn make<C: Send>(
        &mut self,
        mask: &[bool],
        out: &mut [f32],
        changes: Vec<C>,
        make: impl Fn(&mut World, C) + Sync,
    ) {
        let size = self.config().row_size();
        let rows = self.worlds.iter_mut().zip(out.chunks_exact_mut(size)).zip(mask);
        let chosen = rows.filter(|(_, chosen)| **chosen).map(|(world_and_row, _)| world_and_row);
        let mut each: Vec<_> = chosen.zip(changes).map(Some).collect();
        self.threads.write_rows(&mut each, 1, PLACED_ALONE, |_, one| {
            if let Some(((world, row), change)) = one[0].take() {
                make(world, change);
                world.write_row(row);
            }
        });
    }
}

//! Many matches of one configuration, stepped from plain slices on several threads.

use std::sync::{Mutex, PoisonError};

use crate::blocks::robot;
use crate::bodies::BodyBlock;
use crate::columns::BALL_COLUMNS;
use crate::error::{ConfigError, PlaceError, SnapshotError, StepError};
use crate::models::config::SimConfig;
use crate::state::State;
use crate::threads::Threads;
use crate::world::World;
use crate::world::snapshot::{self, Header};

/// Many independent matches. World `i` gives the same bits as a single [`World`], whatever the number of
/// worlds and threads.
pub struct Batch {
    worlds: Vec<World>,
    threads: Threads,
}

/// Maximum number of worlds that a thread takes at once; taking them costs next to nothing compared with
/// stepping them.
const MAX_PORTION: usize = 16;

/// Number of worlds that the caller's thread places by itself: waking others would take longer.
const PLACED_ALONE: usize = 32;

/// More worlds than any memory holds.
const MAX_WORLDS: usize = 10_000_000;

impl Batch {
    /// Creates `worlds` matches in their default line-up, stepped on `threads` threads.
    ///
    /// # Errors
    /// As [`SimConfig::validate`]; 0 or too many worlds; 0 threads, or more than can be started.
    pub fn new(config: &SimConfig, worlds: usize, threads: usize) -> Result<Self, ConfigError> {
        Self::on_threads(config, worlds, Threads::new(threads)?)
    }

    /// As [`Batch::new`], on threads that may also do other work.
    ///
    /// # Errors
    /// As [`SimConfig::validate`]; 0 or too many worlds.
    pub fn on_threads(
        config: &SimConfig,
        worlds: usize,
        threads: Threads,
    ) -> Result<Self, ConfigError> {
        if worlds == 0 {
            return Err(ConfigError::Zero { name: "worlds" });
        }
        if worlds > MAX_WORLDS {
            return Err(ConfigError::TooManyWorlds { max: MAX_WORLDS, got: worlds });
        }
        let world = World::new(config)?;
        Ok(Self { worlds: vec![world; worlds], threads })
    }

    /// Configuration of the matches.
    pub fn config(&self) -> &SimConfig {
        self.worlds[0].config()
    }

    /// Number of matches.
    pub fn worlds(&self) -> usize {
        self.worlds.len()
    }

    /// Number of threads that `step` uses.
    pub fn threads(&self) -> usize {
        self.threads.count()
    }

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
        self.change(mask, out, |nth, world| world.check(row(nth), own(nth)), World::start)
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

    /// Advances the active worlds (all if `active` is `None`) by one control step. Rows of inactive worlds
    /// in `out` are unchanged.
    ///
    /// # Errors
    /// [`StepError`] with all worlds whose state is non-finite, now or since an earlier step without a
    /// placement. All other worlds have stepped, and their rows are written.
    ///
    /// # Panics
    /// If the process was forked and the operating system refuses to start threads.
    pub fn step(
        &mut self,
        commands: &[f32],
        out: &mut [f32],
        active: Option<&[bool]>,
    ) -> Result<(), StepError> {
        let (row_size, command_size) = (self.config().row_size(), self.config().command_size());
        debug_assert_eq!(out.len(), self.worlds.len() * row_size);
        if command_size == 0 {
            // Without robots there are no commands to split.
            return self.step_each(|_| &[], out, active);
        }
        self.step_each(|world| &commands[world * command_size..][..command_size], out, active)
    }

    fn step_each<'a>(
        &mut self,
        commands: impl Fn(usize) -> &'a [f32] + Sync,
        out: &mut [f32],
        active: Option<&[bool]>,
    ) -> Result<(), StepError> {
        let size = self.config().row_size();
        let lost = Mutex::new(Vec::new());
        let step = |first: usize, worlds: &mut [World], rows: &mut [f32]| {
            let each = worlds.iter_mut().zip(rows.chunks_exact_mut(size));
            for (index, (world, row)) in (first..).zip(each) {
                if active.is_some_and(|active| !active[index]) {
                    continue;
                }
                match world.step(commands(index)) {
                    Ok(()) => world.write_row(row),
                    Err(_) => lost.lock().unwrap_or_else(PoisonError::into_inner).push(index),
                }
            }
        };
        if self.worlds.len() == 1 {
            // Handing a single world to a thread costs more than stepping it.
            step(0, &mut self.worlds, out);
        } else {
            let portion = self.threads.portion(self.worlds.len(), 1, MAX_PORTION);
            let pairs = self.worlds.chunks_mut(portion).zip(out.chunks_mut(portion * size));
            let portions = (0..).step_by(portion).zip(pairs);
            self.threads.share(portions, |(first, (worlds, rows))| step(first, worlds, rows));
        }
        let lost = lost.into_inner().unwrap_or_else(PoisonError::into_inner);
        if lost.is_empty() { Ok(()) } else { Err(StepError::in_worlds(lost)) }
    }

    /// Writes the rows of all worlds.
    pub fn read(&self, out: &mut [f32]) {
        for (world, row) in self.worlds.iter().zip(out.chunks_exact_mut(self.config().row_size())) {
            world.write_row(row);
        }
    }

    /// The states of all worlds as bytes: everything that their futures depend on.
    pub fn snapshot(&self) -> Vec<u8> {
        let states: Vec<&State> = self.worlds.iter().map(|world| &*world.state).collect();
        snapshot::write(&self.header(), &states)
    }

    /// Restores the states of a snapshot.
    ///
    /// # Errors
    /// [`SnapshotError`] for foreign or damaged bytes, or another configuration; then nothing has changed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let states: Vec<State<Vec<BodyBlock>>> = snapshot::read(&self.header(), bytes)?;
        for (world, state) in self.worlds.iter_mut().zip(states) {
            world.state = state.boxed();
        }
        Ok(())
    }

    fn header(&self) -> Header {
        Header::new(self.config(), self.worlds.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::BALL;
    use crate::math::Vector;
    use crate::scenes;

    #[test]
    fn a_non_finite_state_names_its_world_and_can_be_placed_again() {
        let scene = scenes::ssl_random(scenes::ssl(1, 1));
        for body in [BALL, robot(0), robot(1)] {
            for wrong in [f32::NAN, f32::INFINITY] {
                let (mut batch, mut rows) = scene.batch(3, 1);
                let commands = vec![1.0; 3 * scene.config.command_size()];
                batch.worlds[1].state.bodies.set_velocity(body, Vector::new(wrong, 0.0));
                for _ in 0..2 {
                    // The world is lost until it is placed; the others continue.
                    let before = rows.clone();
                    assert_eq!(
                        batch.step(&commands, &mut rows, None),
                        Err(StepError::in_worlds(vec![1]))
                    );
                    let size = scene.config.row_size();
                    assert_ne!(rows[..size], before[..size]);
                    assert_eq!(rows[size..2 * size], before[size..2 * size]);
                }
                let (mask, lost) = ([false, true, false], batch.snapshot());
                batch.place(&mask, &scene.start, None, &mut rows).expect("valid");
                assert_eq!(batch.step(&commands, &mut rows, None), Ok(()));
                assert!(rows.iter().all(|value| value.is_finite()));
                batch.restore(&lost).expect("its own");
                batch.restart(&mask, &scene.start, &mut rows).expect("valid");
                assert_eq!(batch.step(&commands, &mut rows, None), Ok(()));
                assert!(rows.iter().all(|value| value.is_finite()));
            }
        }
    }

    #[test]
    fn all_lost_worlds_are_named_and_refuse_a_ball() {
        let scene = scenes::random_play();
        for threads in [1, 2] {
            let (mut batch, mut rows) = scene.batch(40, threads);
            let commands = scene.commands(&scene.start, 0, 0).repeat(40);
            for world in [33, 7, 20] {
                let wrong = Vector::new(f32::NAN, 0.0);
                batch.worlds[world].state.bodies.set_velocity(BALL, wrong);
            }
            let error = batch.step(&commands, &mut rows, None).expect_err("lost");
            assert_eq!(error.worlds, [7, 20, 33]);
            assert!(error.to_string().contains("worlds [7, 20, 33]"), "{error}");
            let (mut mask, before) = ([false; 40], rows.clone());
            mask[7] = true;
            let ball = &scene.start[..BALL_COLUMNS.len()];
            let refused = batch.reposition_balls(&mask, ball, &mut rows).expect_err("lost");
            assert_eq!(refused, PlaceError::Lost.in_world(7));
            let (robots, start) = (vec![false; scene.config.n_robots()], &scene.start);
            let refused = batch.reposition_robots(&mask, &robots, start, &mut rows);
            assert_eq!(refused, Err(PlaceError::Lost.in_world(7)));
            assert_eq!(rows, before);
        }
    }
}

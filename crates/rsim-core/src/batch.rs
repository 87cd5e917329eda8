//! Many matches of one configuration, stepped over plain slices and on several threads.

use crate::columns::BALL_COLUMNS;
use crate::pool::Pool;
use crate::snapshot::{self, Header};
use crate::world::State;
use crate::{ConfigError, PlaceError, SimConfig, SnapshotError, StepError, World};

/// Many independent matches. World `i` computes what it would compute alone: neither the number of
/// worlds nor of threads changes a bit of it.
pub struct Batch {
    worlds: Vec<World>,
    /// None where one thread is enough.
    pool: Option<Pool>,
}

/// Worlds that a thread takes at once: enough that taking them costs nothing beside stepping them.
const MOST_AT_ONCE: usize = 16;

/// More than any memory holds.
const MAX_WORLDS: usize = 10_000_000;

impl Batch {
    /// `worlds` matches in their default line-up, to be stepped on `threads` threads.
    ///
    /// # Errors
    /// What [`SimConfig::validate`] finds; no worlds; no threads, or more than can be started.
    pub fn new(config: &SimConfig, worlds: usize, threads: usize) -> Result<Self, ConfigError> {
        for (name, count) in [("worlds", worlds), ("threads", threads)] {
            if count == 0 {
                return Err(ConfigError::Zero { name });
            }
        }
        if worlds > MAX_WORLDS {
            return Err(ConfigError::TooManyWorlds { max: MAX_WORLDS, got: worlds });
        }
        let world = World::new(config)?;
        let pool = if threads > 1 { Some(Pool::new(threads)?) } else { None };
        Ok(Self { worlds: vec![world; worlds], pool })
    }

    /// What the matches are played with.
    pub fn config(&self) -> &SimConfig {
        self.worlds[0].config()
    }

    /// Number of matches.
    pub fn worlds(&self) -> usize {
        self.worlds.len()
    }

    /// Number of threads that `step` uses.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, Pool::threads)
    }

    /// Starts new matches in the worlds of the mask. `rows` has one row for each of them, and so has
    /// `parameters` where it is given (see [`World::place`]); `out` has one for every world; those of
    /// the placed ones are written.
    ///
    /// # Errors
    /// The first world whose row no match can start from; then no world has changed.
    pub fn place(
        &mut self,
        mask: &[bool],
        rows: &[f32],
        parameters: Option<&[f32]>,
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let parameters_size = self.config().parameters_size();
        let size = self.config().row_size();
        let chosen = || (0..mask.len()).filter(|&world| mask[world]);
        debug_assert_eq!(rows.len(), chosen().count() * size);
        let starts = chosen()
            .zip(rows.chunks_exact(size))
            .enumerate()
            .map(|(nth, (world, row))| {
                let own = parameters.map(|all| &all[nth * parameters_size..][..parameters_size]);
                self.worlds[world].check(row, own).map_err(|error| error.in_world(world))
            })
            .collect::<Result<Vec<_>, _>>()?;
        for (world, start) in chosen().zip(starts) {
            self.worlds[world].start(&start);
            self.worlds[world].write_row(&mut out[world * size..][..size]);
        }
        Ok(())
    }

    /// Puts the ball elsewhere in the worlds of the mask; all else of their matches goes on. `balls`
    /// has a ball for each of them (see [`World::reposition_ball`]); `out` has a row for every world;
    /// those of the chosen ones are written.
    ///
    /// # Errors
    /// The first world that the ball cannot go on in from there; then no world has changed.
    pub fn reposition_balls(
        &mut self,
        mask: &[bool],
        balls: &[f32],
        out: &mut [f32],
    ) -> Result<(), PlaceError> {
        let size = self.config().row_size();
        let chosen = || (0..mask.len()).filter(|&world| mask[world]);
        debug_assert_eq!(balls.len(), chosen().count() * BALL_COLUMNS.len());
        let starts = chosen()
            .zip(balls.chunks_exact(BALL_COLUMNS.len()))
            .map(|(world, ball)| {
                self.worlds[world].check_ball(ball).map_err(|error| error.in_world(world))
            })
            .collect::<Result<Vec<_>, _>>()?;
        for (world, start) in chosen().zip(starts) {
            self.worlds[world].put_ball(&start);
            self.worlds[world].write_row(&mut out[world * size..][..size]);
        }
        Ok(())
    }

    /// One control step of the active worlds (all, when `active` is `None`). Rows of the others in
    /// `out` stay as they are.
    ///
    /// # Errors
    /// All worlds that became non-finite, or had been and were not placed since. All others have
    /// stepped, and their rows are written.
    ///
    /// # Panics
    /// When the process was forked and the operating system refuses to start threads anew.
    pub fn step(
        &mut self,
        commands: &[f32],
        out: &mut [f32],
        active: Option<&[bool]>,
    ) -> Result<(), StepError> {
        let (row_size, command_size) = (self.config().row_size(), self.config().command_size());
        debug_assert_eq!(out.len(), self.worlds.len() * row_size);
        if command_size == 0 {
            // No robots: the ball rolls alone, and there are no commands to share out.
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
        let step = |(index, (world, row)): (usize, (&mut World, &mut [f32]))| {
            if active.is_some_and(|active| !active[index]) {
                return Ok(());
            }
            world.step(commands(index)).map_err(|_| index)?;
            world.write_row(row);
            Ok(())
        };
        // One world never touches a pool: sharing out one world costs more than stepping it.
        let lost: Vec<usize> =
            if let Some(pool) = self.pool.as_mut().filter(|_| self.worlds.len() > 1) {
                let portion = (self.worlds.len() / (8 * pool.threads())).clamp(1, MOST_AT_ONCE);
                let pairs = self.worlds.chunks_mut(portion).zip(out.chunks_mut(portion * size));
                let firsts = (0..).step_by(portion);
                let portions = firsts.zip(pairs).map(|(first, (worlds, rows))| {
                    let pairs = worlds.iter_mut().zip(rows.chunks_exact_mut(size));
                    (first..).zip(pairs).map(&step)
                });
                pool.share(portions)
            } else {
                let pairs = self.worlds.iter_mut().zip(out.chunks_exact_mut(size));
                pairs.enumerate().map(step).filter_map(Result::err).collect()
            };
        if lost.is_empty() { Ok(()) } else { Err(StepError::in_worlds(lost)) }
    }

    /// Writes the rows of all worlds.
    pub fn read(&self, out: &mut [f32]) {
        for (world, row) in self.worlds.iter().zip(out.chunks_exact_mut(self.config().row_size())) {
            world.write_row(row);
        }
    }

    /// Everything that the matches' futures depend on.
    pub fn snapshot(&self) -> Vec<u8> {
        let states: Vec<&State> = self.worlds.iter().map(|world| &world.state).collect();
        snapshot::write(&self.header(), &states)
    }

    /// Puts the matches back where they were when the snapshot was taken.
    ///
    /// # Errors
    /// Foreign, damaged or unfitting bytes; then nothing has changed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let states: Vec<State> = snapshot::read(&self.header(), bytes)?;
        for (world, state) in self.worlds.iter_mut().zip(states) {
            world.state = state;
        }
        Ok(())
    }

    fn header(&self) -> Header {
        Header::new(self.config(), self.worlds.len())
    }
}

#[cfg(test)]
mod tests {
    use rapier2d::math::Vector;

    use super::*;
    use crate::engine::{BALL, robot};
    use crate::scenes;

    #[test]
    fn a_state_that_is_not_finite_names_its_world_and_can_be_placed_anew() {
        let scene = scenes::ssl_random(SimConfig::ssl(1, 1));
        for body in [BALL, robot(0), robot(1)] {
            for wrong in [f32::NAN, f32::INFINITY] {
                let (mut batch, mut rows) = scene.batch(3, 1);
                let told = vec![1.0; 3 * scene.config.command_size()];
                batch.worlds[1].state.engine.set_velocity(body, Vector::new(wrong, 0.0));
                for _ in 0..2 {
                    // Lost until it is placed; the others go on.
                    let before = rows.clone();
                    assert_eq!(
                        batch.step(&told, &mut rows, None),
                        Err(StepError::in_worlds(vec![1]))
                    );
                    let size = scene.config.row_size();
                    assert_ne!(rows[..size], before[..size]);
                    assert_eq!(rows[size..2 * size], before[size..2 * size]);
                }
                let mask = [false, true, false];
                batch.place(&mask, &scene.start, None, &mut rows).expect("valid");
                assert_eq!(batch.step(&told, &mut rows, None), Ok(()));
                assert!(rows.iter().all(|value| value.is_finite()));
            }
        }
    }

    #[test]
    fn all_worlds_that_are_lost_are_named_and_take_no_ball() {
        let scene = scenes::random_play();
        for threads in [1, 2] {
            let (mut batch, mut rows) = scene.batch(40, threads);
            let told = scene.commands(&scene.start, 0, 0).repeat(40);
            for world in [33, 7, 20] {
                let wrong = Vector::new(f32::NAN, 0.0);
                batch.worlds[world].state.engine.set_velocity(BALL, wrong);
            }
            let error = batch.step(&told, &mut rows, None).expect_err("lost");
            assert_eq!(error.worlds, [7, 20, 33]);
            assert!(error.to_string().contains("worlds [7, 20, 33]"), "{error}");
            let (mut mask, before) = ([false; 40], rows.clone());
            mask[7] = true;
            let ball = &scene.start[..BALL_COLUMNS.len()];
            let refused = batch.reposition_balls(&mask, ball, &mut rows).expect_err("lost");
            assert_eq!(refused, PlaceError::Lost.in_world(7));
            assert_eq!(rows, before);
        }
    }
}

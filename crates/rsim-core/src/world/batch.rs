//! Many matches of one configuration, stepped from plain slices on several threads.

mod placing;

use std::cell::RefCell;
use std::iter;
use std::sync::{Arc, Mutex, PoisonError};

use crate::bodies::BodyBlock;
use crate::error::{ConfigError, SnapshotError, StepError};
use crate::forecast::Knowledge;
use crate::models::config::SimConfig;
use crate::senses::Senses;
use crate::senses::exposed::Film;
use crate::senses::fetch::Fetched;
use crate::senses::frames::CameraFrame;
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

/// A world in a snapshot.
type Saved = (State<Vec<BodyBlock>>, Option<Box<Senses>>);

/// Maximum number of worlds that a thread takes at once; taking them costs next to nothing compared with
/// stepping them.
const MAX_PORTION: usize = 16;

thread_local! {
    /// Films of the worlds that a thread steps at once.
    static FILMS: RefCell<[Film; MAX_PORTION]> = RefCell::default();
}

/// Number of rows that the caller's thread writes by itself.
const SENSED_ALONE: usize = 64;
/// The same for forecasts, each of which takes longer than a step.
pub(super) const FORECAST_ALONE: usize = 2;

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
        self.step_and_sense(commands, out, None, active)
    }

    /// As [`Batch::step`], and writes the rows that [`Batch::sense`] would write to `sensed`, if given: they cost less
    /// while a world's state is in the processor's cache.
    ///
    /// # Errors
    /// As [`Batch::step`].
    ///
    /// # Panics
    /// As [`Batch::step`].
    pub fn step_and_sense(
        &mut self,
        commands: &[f32],
        out: &mut [f32],
        sensed: Option<&mut [f32]>,
        active: Option<&[bool]>,
    ) -> Result<(), StepError> {
        let (row_size, command_size) = (self.config().row_size(), self.config().command_size());
        debug_assert_eq!(out.len(), self.worlds.len() * row_size);
        if command_size == 0 {
            // Without robots there are no commands to split.
            return self.step_each(|_| &[], out, sensed, active);
        }
        let of_world = |world| &commands[world * command_size..][..command_size];
        self.step_each(of_world, out, sensed, active)
    }

    fn step_each<'a>(
        &mut self,
        commands: impl Fn(usize) -> &'a [f32] + Sync,
        out: &mut [f32],
        sensed: Option<&mut [f32]>,
        active: Option<&[bool]>,
    ) -> Result<(), StepError> {
        let size = self.config().row_size();
        let lost = Mutex::new(Vec::new());
        let step = |first: usize, worlds: &mut [World], rows: &mut [f32], sensed: &mut [f32]| {
            let is_active = |index: usize| active.is_none_or(|active| active[index]);
            let end = first + worlds.len();
            let chosen = || (first..end).filter(|index| is_active(*index));
            let mut fetched = Fetched::default();
            chosen().for_each(|index| worlds[index - first].fetch_senses(&mut fetched));
            drop(fetched);
            // Each part of a step runs for all worlds, with its instructions in the processor's cache.
            for index in chosen() {
                worlds[index - first].begin_step(commands(index));
            }
            FILMS.with_borrow_mut(|films| {
                for index in chosen() {
                    let film = &mut films[index - first];
                    film.clear();
                    worlds[index - first].move_bodies(commands(index), film);
                }
                for index in chosen() {
                    worlds[index - first].end_step(&films[index - first]);
                }
            });
            for index in chosen() {
                let nth = index - first;
                if worlds[nth].is_lost() {
                    lost.lock().unwrap_or_else(PoisonError::into_inner).push(index);
                } else {
                    let row = nth * size..(nth + 1) * size;
                    worlds[nth].write_row(&mut rows[row.clone()]);
                    if let Some(sensed) = sensed.get_mut(row) {
                        worlds[nth].write_sensed_row(sensed);
                    }
                }
            }
        };
        let sensed = sensed.unwrap_or_default();
        if self.worlds.len() == 1 {
            // Handing a single world to a thread costs more than stepping it.
            step(0, &mut self.worlds, out, sensed);
        } else {
            let portion = self.threads.portion(self.worlds.len(), 1, MAX_PORTION);
            let sensed =
                sensed.chunks_mut(portion * size).chain(iter::repeat_with(Default::default));
            let rows = out.chunks_mut(portion * size).zip(sensed);
            let pairs = self.worlds.chunks_mut(portion).zip(rows);
            let portions = (0..).step_by(portion).zip(pairs);
            self.threads.share(portions, |(first, (worlds, (rows, sensed)))| {
                step(first, worlds, rows, sensed);
            });
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

    /// Writes the rows of what the first team's robots in the active worlds (all if `active` is `None`) know:
    /// state rows without senses.
    pub fn sense(&self, out: &mut [f32], active: Option<&[bool]>) {
        self.sense_as(Knowledge::Blue, out, active);
    }

    /// As [`Batch::sense`], for robots that know the commands of other teams: see
    /// [`World::write_row_known_to`].
    pub fn sense_as(&self, knowledge: Knowledge, out: &mut [f32], active: Option<&[bool]>) {
        let size = self.config().row_size();
        let forecast = self.worlds.first().is_some_and(World::forecasts);
        let alone = if forecast { FORECAST_ALONE } else { SENSED_ALONE };
        self.threads.write_rows(out, size, alone, |world, row| {
            if active.is_none_or(|active| active[world]) {
                self.worlds[world].write_row_known_to(knowledge, row);
            }
        });
    }

    /// As [`Batch::sense_as`], for robots that do not forecast.
    pub fn sense_without_forecast(
        &self,
        knowledge: Knowledge,
        out: &mut [f32],
        active: Option<&[bool]>,
    ) {
        self.threads.write_rows(out, self.config().row_size(), SENSED_ALONE, |world, row| {
            if active.is_none_or(|active| active[world]) {
                self.worlds[world].write_row_as_seen(knowledge, row);
            }
        });
    }

    /// The frames of a world's cameras that arrived in its last control step; none without senses.
    ///
    /// # Panics
    /// There is no such world.
    pub fn camera_frames(&self, world: usize) -> Vec<CameraFrame> {
        self.worlds[world].camera_frames()
    }

    /// Begins the senses of the worlds of the mask, which have just been placed. `keys` has one number for
    /// each of these worlds, which makes its errors its own. `numbers` has one row for each, if given: numbers in
    /// place of the configuration's, in the order of [`Sensing::numbers`](crate::Sensing::numbers). Without senses in the configuration
    /// nothing happens.
    ///
    /// # Errors
    /// [`ConfigError`] for the first world with a number out of its range; then no world has changed.
    pub fn begin_senses(
        &mut self,
        mask: &[bool],
        keys: &[u64],
        numbers: Option<&[f32]>,
    ) -> Result<(), ConfigError> {
        let Some(first) = self.worlds.first() else { return Ok(()) };
        let Some(sensing) = first.shared.sensing.clone() else { return Ok(()) };
        let size = sensing.values().len();
        let own = |nth: usize| match numbers {
            Some(numbers) => sensing.with_values(&numbers[nth * size..][..size]).map(Arc::new),
            None => Ok(sensing.clone()),
        };
        let all = (0..keys.len()).map(own).collect::<Result<Vec<_>, _>>()?;
        let chosen = self.worlds.iter_mut().zip(mask).filter(|(_, chosen)| **chosen);
        for (((world, _), key), sensing) in chosen.zip(keys).zip(all) {
            world.set_senses(*key, Some(sensing));
        }
        Ok(())
    }

    /// The states of all worlds as bytes: everything that their futures depend on.
    pub fn snapshot(&self) -> Vec<u8> {
        let states: Vec<(&State, &Option<Box<Senses>>)> =
            self.worlds.iter().map(|world| (&*world.state, &world.senses)).collect();
        snapshot::write(&self.header(), &states)
    }

    /// Restores the states of a snapshot.
    ///
    /// # Errors
    /// [`SnapshotError`] for foreign or damaged bytes, or another configuration; then nothing has changed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let states: Vec<Saved> = snapshot::read(&self.header(), bytes)?;
        for (world, (state, senses)) in self.worlds.iter_mut().zip(states) {
            (world.state, world.senses) = (state.boxed(), senses);
            world.share_sensing();
        }
        Ok(())
    }

    fn header(&self) -> Header {
        Header::new(self.config(), self.worlds.len(), b"")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::{BALL, robot};
    use crate::columns::BALL_COLUMNS;
    use crate::error::PlaceError;
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

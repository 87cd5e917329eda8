//! Forecasts on their own, for robots whose commands and poses pass through a network.

use std::sync::Arc;

use crate::error::{ConfigError, ForecastError, SnapshotError};
use crate::forecast::commands::CommandLog;
use crate::forecast::{Knowledge, MAX_FORECAST};
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::threads::Threads;
use crate::world::batch::FORECAST_ALONE;
use crate::world::forecast::Known;
use crate::world::snapshot::{self, Header};
use crate::world::{Shared, World};

/// Forecasts of many matches: from what is known of a past time, through the commands that are on their way,
/// to the time at which the next commands will act.
///
/// The forecast of a world follows from its row, its times and its commands alone, whatever the number of
/// worlds and threads. Commands act `command_delay` of [`SimConfig::sensing`] after they were sent; 0 without
/// senses. Robots whose commands are unknown keep their velocities.
pub struct Forecaster {
    shared: Arc<Shared>,
    /// Commands of each world.
    commands: Vec<CommandLog>,
    knowledge: Knowledge,
    threads: Threads,
}

impl Forecaster {
    /// Forecasts of `worlds` matches, computed on `threads`.
    ///
    /// # Errors
    /// As [`World::new`]; 0 worlds.
    pub fn new(
        config: &SimConfig,
        worlds: usize,
        knowledge: Knowledge,
        threads: Threads,
    ) -> Result<Self, ConfigError> {
        if worlds == 0 {
            return Err(ConfigError::Zero { name: "worlds" });
        }
        let shared = World::new(config)?.shared;
        Ok(Self { shared, commands: vec![CommandLog::default(); worlds], knowledge, threads })
    }

    /// Configuration of the matches.
    pub fn config(&self) -> &SimConfig {
        &self.shared.setup.config
    }

    /// Number of matches.
    pub fn worlds(&self) -> usize {
        self.commands.len()
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.threads.count()
    }

    /// Robots whose commands are known.
    pub fn knowledge(&self) -> Knowledge {
        self.knowledge
    }

    /// Takes note of commands that were sent in the active worlds (all if `active` is `None`), with one time for
    /// each world, s. The commands of robots that are not known are ignored. Commands that no forecast of this or
    /// a later time needs are forgotten.
    ///
    /// # Errors
    /// [`ForecastError::OutOfOrder`] for a time before that of a world's last commands; then nothing has
    /// changed.
    pub fn send(
        &mut self,
        commands: &[f32],
        times: &[f64],
        active: Option<&[bool]>,
    ) -> Result<(), ForecastError> {
        let is_active = |world: usize| active.is_none_or(|active| active[world]);
        let delay = self.delay();
        for (world, (log, time)) in self.commands.iter().zip(times).enumerate() {
            let last = log.last().filter(|last| is_active(world) && time + delay < *last);
            if let Some(last) = last {
                return Err(ForecastError::OutOfOrder { world, got: *time, last: last - delay });
            }
        }
        let size = self.config().command_size();
        for (world, (log, time)) in self.commands.iter_mut().zip(times).enumerate() {
            if is_active(world) {
                log.forget_before(time + delay - MAX_FORECAST);
                log.add(time + delay, &commands[world * size..][..size]);
            }
        }
        Ok(())
    }

    /// Writes forecasts of rows that were so at the times `seen`, s, for commands that will be sent at the times
    /// `now`, s. Commands that no row of these or later times needs are forgotten.
    ///
    /// # Errors
    /// [`ForecastError`] for the first world with a row that is too old, of a time whose commands are forgotten or
    /// not finite; then nothing has changed.
    pub fn forecast(
        &mut self,
        rows: &[f32],
        seen: &[f64],
        now: &[f64],
        out: &mut [f32],
    ) -> Result<(), ForecastError> {
        let (delay, size) = (self.delay(), self.config().row_size());
        for (world, ((seen, now), log)) in seen.iter().zip(now).zip(&self.commands).enumerate() {
            let got = now + delay - seen;
            if got > MAX_FORECAST {
                return Err(ForecastError::TooOld { world, max: MAX_FORECAST, got });
            }
            if let Some(since) = log.known_since().filter(|since| seen < since) {
                return Err(ForecastError::Forgotten { world, got: *seen, since });
            }
        }
        for (world, row) in rows.chunks_exact(size).enumerate() {
            self.shared.placement.parse(row).map_err(|error| error.in_world(world))?;
        }
        let robots = self.knowledge.robots(self.config());
        let timeout = self.config().sensing.as_ref().and_then(Sensing::timeout);
        self.threads.write_rows(out, size, FORECAST_ALONE, |world, out| {
            let known = Known {
                row: &rows[world * size..][..size],
                seen: seen[world],
                until: now[world] + delay,
                commands: &self.commands[world],
                robots,
                timeout,
            };
            self.shared.forecast(&known, out);
        });
        for (log, seen) in self.commands.iter_mut().zip(seen) {
            log.forget_before(*seen);
        }
        Ok(())
    }

    /// Forgets the commands of the worlds of the mask, whose robots have then been sent none.
    pub fn reset(&mut self, mask: &[bool]) {
        for (log, _) in self.commands.iter_mut().zip(mask).filter(|(_, chosen)| **chosen) {
            log.clear();
        }
    }

    /// The commands of all worlds as bytes.
    pub fn snapshot(&self) -> Vec<u8> {
        snapshot::write(&self.header(), &self.commands)
    }

    /// Restores the commands of a snapshot.
    ///
    /// # Errors
    /// [`SnapshotError`] for foreign or damaged bytes, or another configuration; then nothing has changed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        self.commands = snapshot::read(&self.header(), bytes)?;
        Ok(())
    }

    /// Time from a command to its effect, s.
    fn delay(&self) -> f64 {
        let sensing = self.config().sensing.as_ref();
        sensing.map_or(0.0, |sensing| f64::from(sensing.command_delay))
    }

    fn header(&self) -> Header {
        Header::new(self.config(), self.commands.len(), b"forecaster")
    }
}

//! Threads that share the work of a batch.

use std::sync::{Mutex, PoisonError};

use crate::error::ConfigError;

/// More threads than any machine has; a larger number is a mistake.
const MAX_THREADS: usize = 1024;

/// Helper threads of the caller's thread. Threads do not survive a fork, so a pool belongs to one
/// process.
pub(super) struct Pool {
    process: u32,
    helpers: rayon::ThreadPool,
}

impl Pool {
    /// A pool of `threads` threads, including the caller's.
    pub(super) fn new(threads: usize) -> Result<Self, ConfigError> {
        let failed = |reason| ConfigError::Threads { threads, reason };
        if threads > MAX_THREADS {
            return Err(failed(format!("the maximum is {MAX_THREADS}")));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads - 1).build();
        let helpers = pool.map_err(|error| failed(error.to_string()))?;
        Ok(Self { process: std::process::id(), helpers })
    }

    pub(super) fn threads(&self) -> usize {
        self.helpers.current_num_threads() + 1
    }

    /// Runs all portions on the threads of this process, each of which takes the next portion when it
    /// is free, and returns the errors in any order. The caller's thread works too: it is awake, and
    /// waking another one in its place costs milliseconds.
    pub(super) fn share<P, F>(&mut self, portions: impl Iterator<Item = P> + Send) -> Vec<F>
    where
        P: Iterator<Item = Result<(), F>>,
        F: Send,
    {
        if self.process != std::process::id() {
            let pool = Self::new(self.threads()).expect("as many threads as before should start");
            // The old pool's threads do not exist in this process: dropping it would wait for them.
            std::mem::forget(std::mem::replace(self, pool));
        }
        let (portions, failures) = (Mutex::new(portions), Mutex::new(Vec::new()));
        let work = || {
            // Locked only to take the next portion, some hundred microseconds of work.
            let next = || portions.lock().unwrap_or_else(PoisonError::into_inner).next();
            let failed: Vec<_> =
                std::iter::from_fn(next).flatten().filter_map(Result::err).collect();
            failures.lock().unwrap_or_else(PoisonError::into_inner).extend(failed);
        };
        self.helpers.in_place_scope(|scope| {
            for _ in 0..self.helpers.current_num_threads() {
                scope.spawn(|_| work());
            }
            work();
        });
        failures.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

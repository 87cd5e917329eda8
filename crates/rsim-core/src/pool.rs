//! Work that is shared out over threads.

use std::sync::{Mutex, PoisonError};

use crate::ConfigError;

/// More than any machine has; asking for so many is a slip.
const MAX_THREADS: usize = 1024;

/// The threads that help the caller's. Threads do not survive a fork, so they are of one process.
pub(crate) struct Pool {
    process: u32,
    helpers: rayon::ThreadPool,
}

impl Pool {
    /// So many threads, the caller's among them.
    pub(crate) fn new(threads: usize) -> Result<Self, ConfigError> {
        let failed = |reason| ConfigError::Threads { threads, reason };
        if threads > MAX_THREADS {
            return Err(failed(format!("at most {MAX_THREADS} make sense")));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads - 1).build();
        let helpers = pool.map_err(|error| failed(error.to_string()))?;
        Ok(Self { process: std::process::id(), helpers })
    }

    pub(crate) fn threads(&self) -> usize {
        self.helpers.current_num_threads() + 1
    }

    /// Has the threads of this process do all portions, each taking the next as it gets free. The
    /// caller's works too: it is awake, and to wake another in its place costs milliseconds. What
    /// they have failed at, in any order.
    pub(crate) fn share<P, F>(&mut self, portions: impl Iterator<Item = P> + Send) -> Vec<F>
    where
        P: Iterator<Item = Result<(), F>>,
        F: Send,
    {
        if self.process != std::process::id() {
            let pool = Self::new(self.threads()).expect("as many threads as before should start");
            // The old pool's threads are not in this process: dropping it would wait for them.
            std::mem::forget(std::mem::replace(self, pool));
        }
        let (portions, failures) = (Mutex::new(portions), Mutex::new(Vec::new()));
        let work = || {
            // Held only to take the next portion, some hundred microseconds of work.
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

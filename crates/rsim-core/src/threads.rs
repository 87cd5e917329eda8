//! Threads that share work on rows: physics of worlds, features of their rows.

use std::sync::{Arc, Mutex, PoisonError};

use crate::error::ConfigError;

/// More threads than any machine has; a larger number is a mistake.
const MAX_THREADS: usize = 1024;

/// Portions of work for each thread: a thread that starts late leaves its portions to the others.
const PORTIONS: usize = 8;

/// The caller's thread and its helpers, which share work on rows. Clones share the helpers.
///
/// Results do not depend on the number of threads: each row is written by one thread, from input that
/// no thread changes.
#[derive(Clone)]
pub struct Threads {
    count: usize,
    /// `None` for one thread.
    helpers: Option<Arc<Mutex<Helpers>>>,
}

/// Helper threads of a process. Threads do not survive a fork, so a child process starts its own.
struct Helpers {
    process: u32,
    pool: Arc<rayon::ThreadPool>,
}

impl Helpers {
    fn start(count: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
        Ok(Self { process: std::process::id(), pool: Arc::new(pool) })
    }
}

impl Threads {
    /// Starts `count` threads, of which the caller's is one.
    ///
    /// # Errors
    /// 0 threads, or more than can be started.
    pub fn new(count: usize) -> Result<Self, ConfigError> {
        if count == 0 {
            return Err(ConfigError::Zero { name: "threads" });
        }
        let failed = |reason| ConfigError::Threads { threads: count, reason };
        if count > MAX_THREADS {
            return Err(failed(format!("the maximum is {MAX_THREADS}")));
        }
        if count == 1 {
            return Ok(Self { count, helpers: None });
        }
        let helpers = Helpers::start(count - 1).map_err(|error| failed(error.to_string()))?;
        Ok(Self { count, helpers: Some(Arc::new(Mutex::new(helpers))) })
    }

    /// Number of threads, including the caller's.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of rows in a portion, `min` to `max`, if `rows` rows are shared: `max` for one thread, which leaves
    /// nothing to others.
    pub fn portion(&self, rows: usize, min: usize, max: usize) -> usize {
        if self.count == 1 {
            return max;
        }
        (rows / (PORTIONS * self.count)).clamp(min, max)
    }

    /// Works on all portions. Each thread takes the next portion when it is free. The caller's thread
    /// works too: it is awake, and waking another one in its place costs milliseconds.
    ///
    /// # Panics
    /// If the process was forked and the operating system refuses to start threads.
    pub fn share<P: Send>(
        &self,
        portions: impl Iterator<Item = P> + Send,
        work: impl Fn(P) + Sync,
    ) {
        let Some(pool) = self.pool() else { return portions.for_each(work) };
        let portions = Mutex::new(portions);
        // Locked only to take the next portion.
        let next = || portions.lock().unwrap_or_else(PoisonError::into_inner).next();
        let take_turns = || std::iter::from_fn(next).for_each(&work);
        pool.in_place_scope(|scope| {
            for _ in 0..pool.current_num_threads() {
                scope.spawn(|_| take_turns());
            }
            take_turns();
        });
    }

    /// Writes all rows of `out`, `size` values each: `write` gets the index of a row and the row. Few
    /// rows, up to `alone`, are written by the caller's thread: waking others would take longer.
    pub fn write_rows<T: Send>(
        &self,
        out: &mut [T],
        size: usize,
        alone: usize,
        write: impl Fn(usize, &mut [T]) + Sync,
    ) {
        if out.is_empty() {
            return;
        }
        let rows = out.len() / size;
        let write_all = |first: usize, portion: &mut [T]| {
            for (row, out) in portion.chunks_exact_mut(size).enumerate() {
                write(first + row, out);
            }
        };
        if self.count == 1 || rows <= alone {
            return write_all(0, out);
        }
        let portion = self.portion(rows, 1, alone.max(1));
        let portions = out.chunks_mut(portion * size).enumerate();
        self.share(portions, |(nth, rows)| write_all(nth * portion, rows));
    }

    /// Helper threads of this process; `None` for one thread.
    fn pool(&self) -> Option<Arc<rayon::ThreadPool>> {
        let mut helpers = self.helpers.as_ref()?.lock().unwrap_or_else(PoisonError::into_inner);
        if helpers.process != std::process::id() {
            let own =
                Helpers::start(self.count - 1).expect("as many threads as before should start");
            // The threads of the old pool are not in this process: dropping it would wait for them.
            std::mem::forget(std::mem::replace(&mut *helpers, own));
        }
        Some(Arc::clone(&helpers.pool))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_written_once_whatever_the_number_of_threads() {
        for threads in [1, 2, 5] {
            let threads = Threads::new(threads).expect("few threads");
            for (rows, alone) in [(0, 4), (3, 4), (4, 4), (5, 4), (1000, 16), (7, 0)] {
                let mut out = vec![0; rows * 3];
                threads.write_rows(&mut out, 3, alone, |row, out| {
                    for (column, out) in out.iter_mut().enumerate() {
                        *out += 1 + 3 * row + column;
                    }
                });
                assert!(out.iter().copied().eq(1..=rows * 3), "{rows} rows");
            }
        }
    }

    #[test]
    fn several_callers_use_the_same_threads_at_once() {
        let threads = Threads::new(3).expect("few threads");
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let mut out = vec![0; 500];
                    for _ in 0..20 {
                        threads.write_rows(&mut out, 1, 8, |row, out| out[0] = row);
                        assert!(out.iter().copied().eq(0..500));
                    }
                });
            }
        });
    }
}

//! Shield of VSSS policies, for arrays of rows and actions.

use numpy::{Ix3, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Rows, readable, sizes, values, writeable};
use crate::config::SimConfig;
use crate::threads::{Threads, write_rows};

/// Most worlds whose actions the caller's thread changes alone.
const ALONE: usize = 256;
/// Numbers in an action: the speeds of both wheels.
const WHEELS: usize = 2;

/// Shield that keeps VSSS robots out of goal areas in which the referee allows no more of their team.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct AreaShield {
    shield: rsim_match::AreaShield,
    config: SimConfig,
}

#[pymethods]
impl AreaShield {
    #[new]
    fn new(config: &SimConfig) -> PyResult<Self> {
        let shield = rsim_match::AreaShield::new(&config.0)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Self { shield, config: config.clone() })
    }

    /// Changes the actions of robots that would be one too many in a goal area.
    #[pyo3(signature = (rows, robots, actions, threads = None))]
    fn apply(
        &self,
        py: Python<'_>,
        rows: &Bound<'_, PyAny>,
        robots: Vec<usize>,
        actions: &Bound<'_, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<()> {
        let [n, _] = sizes::<2>("rows", rows)?;
        let row_size = self.config.0.row_size();
        let rows: Rows = readable("rows", rows, &[n, row_size])?;
        let count = self.shield.n_robots();
        if let Some(robot) = robots.iter().find(|robot| **robot >= count) {
            return Err(PyValueError::new_err(format!(
                "robots: expected indices below {count}, got {robot}"
            )));
        }
        let mut actions: PyReadwriteArray<'_, f32, Ix3> =
            writeable("actions", actions, &[n, robots.len(), WHEELS])?;
        let rows = values(&rows);
        let size = robots.len() * WHEELS;
        write_rows(py, threads, actions.as_slice_mut()?, size, ALONE, |world, actions| {
            let row = &rows[world * row_size..][..row_size];
            for (robot, action) in robots.iter().zip(actions.chunks_exact_mut(WHEELS)) {
                self.shield.apply(row, *robot, action);
            }
        });
        Ok(())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (SimConfig,)) {
        (slf.get_type().into_any(), (slf.get().config.clone(),))
    }
}

//! Shields of policies, for arrays of rows and actions.

use numpy::{Ix3, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Rows, readable, sizes, values, writeable};
use crate::config::{SimConfig, of_argument};
use crate::threads::{Threads, write_rows};

/// Most worlds whose actions the caller's thread changes alone.
const ALONE: usize = 256;
/// Numbers in an action of a differential robot: the speeds of both wheels.
const WHEELS: usize = 2;
/// Numbers of the velocity, with which the action of an omnidirectional robot begins.
const VELOCITY: usize = 2;

/// Shield that keeps VSSS robots out of goal areas in which the referee allows no more of their team.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct AreaShield {
    shield: rsim_match::AreaShield,
    config: SimConfig,
}

#[pymethods]
impl AreaShield {
    #[new]
    fn new(#[pyo3(from_py_with = of_argument)] config: SimConfig) -> PyResult<Self> {
        let shield = rsim_match::AreaShield::new(&config.0)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Self { shield, config })
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
        let arrays = Arrays { rows, robots: &robots, actions, size: WHEELS };
        let shield = &self.shield;
        arrays.change(py, &self.config, threads, |row, robot, action| {
            shield.apply(row, robot, action);
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (SimConfig,)) {
        (slf.get_type().into_any(), (slf.get().config.clone(),))
    }
}

/// Shield that brakes SSL robots before opponents, the attacked goal area and the limits of its half.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct AttackShield {
    shield: rsim_match::AttackShield,
    config: SimConfig,
}

#[pymethods]
impl AttackShield {
    #[new]
    fn new(#[pyo3(from_py_with = of_argument)] config: SimConfig) -> PyResult<Self> {
        let shield = rsim_match::AttackShield::new(&config.0)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Self { shield, config })
    }

    /// Changes the actions of robots that could not stop in time.
    #[pyo3(signature = (rows, robots, actions, threads = None))]
    fn apply(
        &self,
        py: Python<'_>,
        rows: &Bound<'_, PyAny>,
        robots: Vec<usize>,
        actions: &Bound<'_, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<()> {
        let [_, _, size] = sizes::<3>("actions", actions)?;
        if size < VELOCITY {
            return Err(PyValueError::new_err(format!(
                "actions: expected at least {VELOCITY} numbers a robot, got {size}"
            )));
        }
        let arrays = Arrays { rows, robots: &robots, actions, size };
        let shield = &self.shield;
        arrays.change(py, &self.config, threads, |row, robot, action| {
            shield.apply(row, robot, action);
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (SimConfig,)) {
        (slf.get_type().into_any(), (slf.get().config.clone(),))
    }
}

/// Arguments of a shield: states, robots in them, and their actions of `size` numbers.
struct Arrays<'a, 'py> {
    rows: &'a Bound<'py, PyAny>,
    robots: &'a [usize],
    actions: &'a Bound<'py, PyAny>,
    size: usize,
}

impl Arrays<'_, '_> {
    /// Checks the arrays, and changes the action of each robot in each world.
    fn change(
        &self,
        py: Python<'_>,
        config: &SimConfig,
        threads: Option<&Threads>,
        change: impl Fn(&[f32], usize, &mut [f32]) + Sync + Send,
    ) -> PyResult<()> {
        let Self { rows, robots, actions, size } = *self;
        let [n, _] = sizes::<2>("rows", rows)?;
        let row_size = config.0.row_size();
        let rows: Rows = readable("rows", rows, &[n, row_size])?;
        let count = config.0.n_robots();
        if let Some(robot) = robots.iter().find(|robot| **robot >= count) {
            return Err(PyValueError::new_err(format!(
                "robots: expected indices below {count}, got {robot}"
            )));
        }
        let mut actions: PyReadwriteArray<'_, f32, Ix3> =
            writeable("actions", actions, &[n, robots.len(), size])?;
        let rows = values(&rows);
        write_rows(
            py,
            threads,
            actions.as_slice_mut()?,
            robots.len() * size,
            ALONE,
            |world, actions| {
                let row = &rows[world * row_size..][..row_size];
                for (robot, action) in robots.iter().zip(actions.chunks_exact_mut(size)) {
                    change(row, *robot, action);
                }
            },
        );
        Ok(())
    }
}

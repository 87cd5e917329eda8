//! Commands from actions, for arrays of actions and rows.

use numpy::{Ix3, PyArray3, PyArrayMethods, PyReadonlyArray};
use pyo3::prelude::*;
use rsim_core::columns::{BALL_COLUMNS, OMNI_COLUMNS, ROBOT_COLUMNS, row_size};
use rsim_core::steering::ACTION_SIZE;

use crate::arrays::{Rows, finite, readable, sizes, values};
use crate::config::count;
use crate::threads::{Threads, write_rows};

/// Most worlds whose commands the caller's thread computes alone.
const ALONE: usize = 256;

/// Commands of omnidirectional robots from actions.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Steering {
    steering: rsim_core::Steering,
    n_blue: usize,
}

#[pymethods]
impl Steering {
    #[new]
    fn new(scales: [f32; ACTION_SIZE], field_frame: bool, n_blue: i64) -> PyResult<Self> {
        finite("scales", &scales)?;
        let n_blue = count("n_blue", n_blue)?;
        Ok(Self { steering: rsim_core::Steering { scales, field_frame }, n_blue })
    }

    #[pyo3(signature = (actions, rows, threads = None))]
    fn commands<'py>(
        &self,
        py: Python<'py>,
        actions: &Bound<'py, PyAny>,
        rows: &Bound<'py, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let [n, robots, _] = sizes("actions", actions)?;
        let actions: PyReadonlyArray<'_, f32, Ix3> =
            readable("actions", actions, &[n, robots, ACTION_SIZE])?;
        let row_size = row_size(robots);
        let rows: Rows = readable("rows", rows, &[n, row_size])?;
        let (actions, rows) = (values(&actions), values(&rows));
        let commands = PyArray3::zeros(py, [n, robots, OMNI_COLUMNS.len()], false);
        {
            let mut out = commands.readwrite();
            let out = out.as_slice_mut()?;
            write_rows(py, threads, out, robots * OMNI_COLUMNS.len(), ALONE, |world, out| {
                let actions = actions[world * robots * ACTION_SIZE..].chunks_exact(ACTION_SIZE);
                let row = &rows[world * row_size..][..row_size];
                let states = row[BALL_COLUMNS.len()..].chunks_exact(ROBOT_COLUMNS.len());
                let each = out.chunks_exact_mut(OMNI_COLUMNS.len()).zip(actions.zip(states));
                for (robot, (out, (action, state))) in each.enumerate() {
                    let rotated = robot >= self.n_blue;
                    self.steering.command(action, [state[2], state[3]], rotated, out);
                }
            });
        }
        Ok(commands)
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, ([f32; ACTION_SIZE], bool, usize)) {
        let Self { steering, n_blue } = slf.get();
        (slf.get_type().into_any(), (steering.scales, steering.field_frame, *n_blue))
    }
}

//! Egocentric features, for arrays of views.

use numpy::{Ix1, Ix3, PyReadonlyArray, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::{readable, sizes, values, writeable};
use crate::bounds::{check_bounds, clip_row};
use crate::config::count;
use crate::models::{Field, RobotModel};
use crate::threads::{Threads, write_rows};
use crate::viewpoint::Viewpoint;

/// Most worlds whose features the caller's thread computes alone.
const ALONE: usize = 32;

/// Egocentric features of robots, scaled for a network.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct EgoFeatures {
    features: rsim_core::EgoFeatures,
    field: Field,
    robot: RobotModel,
    /// Numbers of teammates and opponents.
    others: (usize, usize),
    presence: bool,
}

#[pymethods]
impl EgoFeatures {
    #[new]
    #[pyo3(signature = (field, robot, n_teammates, n_opponents, presence = false))]
    fn new(
        field: Field,
        robot: RobotModel,
        n_teammates: i64,
        n_opponents: i64,
        presence: bool,
    ) -> PyResult<Self> {
        let (teammates, opponents) =
            (count("n_teammates", n_teammates)?, count("n_opponents", n_opponents)?);
        let features =
            rsim_core::EgoFeatures::new(&field.0, &robot.0, teammates, opponents, presence);
        Ok(Self { features, field, robot, others: (teammates, opponents), presence })
    }

    #[getter]
    fn blocks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let blocks = self.features.blocks().into_iter();
        let named = blocks.map(|(name, shape)| Ok((name, PyTuple::new(py, shape)?)));
        PyTuple::new(py, named.collect::<PyResult<Vec<_>>>()?)
    }

    #[pyo3(signature = (viewpoint, rows, actions, out, bounds = None, threads = None, rotated = None))]
    #[expect(clippy::too_many_arguments, reason = "the arguments of Python's method")]
    fn encode(
        &self,
        py: Python<'_>,
        viewpoint: &Viewpoint,
        rows: &Bound<'_, PyAny>,
        actions: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
        bounds: Option<&Bound<'_, PyAny>>,
        threads: Option<&Threads>,
        rotated: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let observers = viewpoint.viewpoint.observers();
        if let Some(observer) = observers.first()
            && observer.slots.len() != self.features.slots()
        {
            let (expected, got) = (self.features.slots(), observer.slots.len());
            return Err(PyValueError::new_err(format!(
                "viewpoint must have {expected} slots, got {got}"
            )));
        }
        let (n, rows) = viewpoint.rows("rows", rows)?;
        let rotated = viewpoint.rotated(n, rotated)?;
        let rotated = rotated.as_ref().map(values);
        let [_, _, action_size] = sizes("actions", actions)?;
        let robots = viewpoint.n_robots();
        let actions: PyReadonlyArray<'_, f32, Ix3> =
            readable("actions", actions, &[n, robots, action_size])?;
        let (size, row_size) = (self.features.size(), viewpoint.row_size());
        let width = size + action_size;
        let [_, _, columns] = sizes("out", out)?;
        let columns = columns.max(width);
        let mut out: PyReadwriteArray<'_, f32, Ix3> =
            writeable("out", out, &[n, observers.len(), columns])?;
        let bounds: Option<PyReadonlyArray<'_, f32, Ix1>> =
            bounds.map(|bounds| readable("bounds", bounds, &[width])).transpose()?;
        let bounds = bounds.as_ref().map(values);
        bounds.as_deref().map_or(Ok(()), check_bounds)?;
        let (rows, actions) = (values(&rows), values(&actions));
        let encode = |world: usize, out: &mut [f32]| {
            let own = world * row_size..(world + 1) * row_size;
            let row = &rows[own.clone()];
            let rotated = rotated.as_ref().map_or(row, |rotated| &rotated[own]);
            let actions = &actions[world * robots * action_size..][..robots * action_size];
            for (observer, out) in observers.iter().zip(out.chunks_exact_mut(columns)) {
                let out = &mut out[..width];
                let (features, action) = out.split_at_mut(size);
                let row = if observer.rotated { rotated } else { row };
                self.features.encode(observer, row, features);
                match observer.robot() {
                    Some(robot) => {
                        action.copy_from_slice(&actions[robot * action_size..][..action_size]);
                    }
                    None => action.fill(0.0),
                }
                if let Some(bounds) = &bounds {
                    clip_row(out, bounds);
                }
            }
        };
        let out = out.as_slice_mut()?;
        write_rows(py, threads, out, observers.len() * columns, ALONE, encode);
        Ok(())
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (Field, RobotModel, usize, usize, bool)) {
        let Self { field, robot, others: (teammates, opponents), presence, .. } = slf.get();
        let arguments = (field.clone(), robot.clone(), *teammates, *opponents, *presence);
        (slf.get_type().into_any(), arguments)
    }
}

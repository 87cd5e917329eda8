//! Terms of rewards, for arrays of views and rows.

use numpy::{Ix1, Ix3, PyArray2, PyArrayMethods, PyReadonlyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_core::shaping;

use crate::arrays::{Rows, readable, sizes, values};
use crate::models::{BallModel, Field, RobotModel};
use crate::threads::{Threads, write_rows};
use crate::viewpoint::Viewpoint;

/// Most terms that the caller's thread computes alone, one for each observer of a world.
const ALONE: usize = 1536;

/// A potential function for reward shaping, in meters.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Potential(rsim_core::Potential);

#[pymethods]
impl Potential {
    #[staticmethod]
    fn ball_to_goal(field: &Field) -> Self {
        Self(rsim_core::Potential::ball_to_goal(&field.0))
    }

    #[staticmethod]
    fn behind_ball(field: &Field, distance: f32) -> PyResult<Self> {
        if distance.is_finite() && distance > 0.0 {
            return Ok(Self(rsim_core::Potential::behind_ball(&field.0, distance)));
        }
        Err(PyValueError::new_err(format!("distance must be above 0 m and finite, got {distance}")))
    }

    #[staticmethod]
    fn at_mouth(robot: &RobotModel, ball: &BallModel) -> PyResult<Self> {
        if robot.0.mouth.is_some() {
            return Ok(Self(rsim_core::Potential::at_mouth(&robot.0, &ball.0)));
        }
        let got = &robot.0.name;
        Err(PyValueError::new_err(format!("robot must have a mouth, got {got}")))
    }

    #[pyo3(signature = (viewpoint, last_rows, rows, threads = None))]
    fn difference<'py>(
        &self,
        py: Python<'py>,
        viewpoint: &Viewpoint,
        last_rows: &Bound<'py, PyAny>,
        rows: &Bound<'py, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (n, rows) = viewpoint.rows("rows", rows)?;
        let size = viewpoint.row_size();
        let last_rows: Rows = readable("last_rows", last_rows, &[n, size])?;
        let (last_rows, rows) = (values(&last_rows), values(&rows));
        let observers = viewpoint.viewpoint.observers();
        let differences = PyArray2::zeros(py, [n, observers.len()], false);
        {
            let mut out = differences.readwrite();
            let out = out.as_slice_mut()?;
            write_rows(py, threads, out, observers.len(), alone(observers.len()), |world, out| {
                let row = world * size..(world + 1) * size;
                let (last_row, row) = (&last_rows[row.clone()], &rows[row]);
                for (out, observer) in out.iter_mut().zip(observers) {
                    *out = self.0.difference(observer, last_row, row);
                }
            });
        }
        Ok(differences)
    }
}

/// Returns whether each observer is its team's nearest robot to the ball.
#[pyfunction]
#[pyo3(signature = (rows, n_blue, observers, threads = None))]
pub(crate) fn nearest_to_ball<'py>(
    py: Python<'py>,
    rows: &Bound<'py, PyAny>,
    n_blue: usize,
    observers: &Bound<'py, PyAny>,
    threads: Option<&Threads>,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let [n, size] = sizes("rows", rows)?;
    let rows: Rows = readable("rows", rows, &[n, size])?;
    let robots = size.saturating_sub(BALL_COLUMNS.len()) / ROBOT_COLUMNS.len();
    let observers = indices(observers, robots)?;
    let rows = values(&rows);
    let nearest = PyArray2::zeros(py, [n, observers.len()], false);
    {
        let mut out = nearest.readwrite();
        let out = out.as_slice_mut()?;
        write_rows(py, threads, out, observers.len(), alone(observers.len()), |world, out| {
            let mut all = vec![false; robots];
            shaping::nearest_to_ball(&rows[world * size..][..size], n_blue, &mut all);
            for (out, observer) in out.iter_mut().zip(&observers) {
                *out = all[*observer];
            }
        });
    }
    Ok(nearest)
}

/// Returns the mean magnitude of each observer's action.
#[pyfunction]
#[pyo3(signature = (actions, observers, threads = None))]
pub(crate) fn mean_action_magnitude<'py>(
    py: Python<'py>,
    actions: &Bound<'py, PyAny>,
    observers: &Bound<'py, PyAny>,
    threads: Option<&Threads>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let [n, robots, size] = sizes("actions", actions)?;
    let actions: PyReadonlyArray<'_, f32, Ix3> = readable("actions", actions, &[n, robots, size])?;
    let observers = indices(observers, robots)?;
    let actions = values(&actions);
    let magnitudes = PyArray2::zeros(py, [n, observers.len()], false);
    if size > 0 {
        let mut out = magnitudes.readwrite();
        let out = out.as_slice_mut()?;
        write_rows(py, threads, out, observers.len(), alone(observers.len()), |world, out| {
            let actions = &actions[world * robots * size..][..robots * size];
            for (out, observer) in out.iter_mut().zip(&observers) {
                *out = shaping::mean_magnitude(&actions[observer * size..][..size]);
            }
        });
    }
    Ok(magnitudes)
}

/// Most worlds whose terms the caller's thread computes alone, for the observers of a world.
fn alone(observers: usize) -> usize {
    ALONE / observers.max(1)
}

/// Indices of observers among the `robots` of a row.
fn indices(observers: &Bound<'_, PyAny>, robots: usize) -> PyResult<Vec<usize>> {
    let given: PyReadonlyArray<'_, isize, Ix1> =
        readable("observers", observers, &sizes::<1>("observers", observers)?)?;
    let index =
        |observer: &isize| usize::try_from(*observer).ok().filter(|observer| *observer < robots);
    let found: Result<_, isize> =
        values(&given).iter().map(|observer| index(observer).ok_or(*observer)).collect();
    found.map_err(|observer| {
        PyValueError::new_err(format!("observers must be robots below {robots}, got {observer}"))
    })
}

//! What rewards are made of, for arrays of views and rows.

use numpy::{Ix1, Ix3, Ix4, PyArray2, PyArrayMethods, PyReadonlyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_core::shaping::{effort, nearest_to_ball};

use crate::arrays::{Rows, readable, sizes, values};
use crate::models::{BallModel, Field, RobotModel};

/// What a robot is to raise, in metres.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Potential(rsim_core::Potential);

#[pymethods]
impl Potential {
    #[staticmethod]
    fn ball_to_goal(field: &Field) -> Self {
        Self(rsim_core::Potential::ball_to_goal(&field.0))
    }

    #[staticmethod]
    fn behind_ball(field: &Field, behind: f32) -> PyResult<Self> {
        if behind.is_finite() && behind > 0.0 {
            return Ok(Self(rsim_core::Potential::behind_ball(&field.0, behind)));
        }
        Err(PyValueError::new_err(format!("behind must be metres above 0, got {behind}")))
    }

    #[staticmethod]
    fn at_mouth(robot: &RobotModel, ball: &BallModel) -> PyResult<Self> {
        if robot.0.mouth.is_some() {
            return Ok(Self(rsim_core::Potential::at_mouth(&robot.0, &ball.0)));
        }
        let got = &robot.0.name;
        Err(PyValueError::new_err(format!("robot must be one with a mouth, got {got}")))
    }

    fn gained<'py>(
        &self,
        py: Python<'py>,
        last_ball: &Bound<'py, PyAny>,
        last_robots: &Bound<'py, PyAny>,
        ball: &Bound<'py, PyAny>,
        robots: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let [n, seers, slots, _] = sizes("robots", robots)?;
        let (a_ball, a_view) = (BALL_COLUMNS.len(), slots.max(1) * ROBOT_COLUMNS.len());
        let shape = [n, seers, slots, ROBOT_COLUMNS.len()];
        let balls = |name, array| readable(name, array, &[n, seers, a_ball]);
        let views = |name, array| readable(name, array, &shape);
        let last_ball: PyReadonlyArray<'_, f32, Ix3> = balls("last_ball", last_ball)?;
        let ball: PyReadonlyArray<'_, f32, Ix3> = balls("ball", ball)?;
        let last_robots: PyReadonlyArray<'_, f32, Ix4> = views("last_robots", last_robots)?;
        let robots: PyReadonlyArray<'_, f32, Ix4> = views("robots", robots)?;
        let (last_ball, last_robots) = (values(&last_ball), values(&last_robots));
        let (ball, robots) = (values(&ball), values(&robots));
        let gained = PyArray2::zeros(py, [n, seers], false);
        {
            let mut out = gained.readwrite();
            let out = out.as_slice_mut()?;
            py.detach(|| {
                let now = ball.chunks_exact(a_ball).zip(robots.chunks_exact(a_view));
                let before = last_ball.chunks_exact(a_ball).zip(last_robots.chunks_exact(a_view));
                for (out, (now, before)) in out.iter_mut().zip(now.zip(before)) {
                    *out = self.0.of(now.0, now.1) - self.0.of(before.0, before.1);
                }
            });
        }
        Ok(gained)
    }
}

/// Whether each seer is its team's nearest to the ball.
#[pyfunction]
pub(crate) fn nearest<'py>(
    py: Python<'py>,
    rows: &Bound<'py, PyAny>,
    n_blue: usize,
    seers: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let [n, size] = sizes("rows", rows)?;
    let rows: Rows = readable("rows", rows, &[n, size])?;
    let robots = size.saturating_sub(BALL_COLUMNS.len()) / ROBOT_COLUMNS.len();
    let seers = places(seers, robots)?;
    let rows = values(&rows);
    let nearest = PyArray2::zeros(py, [n, seers.len()], false);
    if !seers.is_empty() {
        let mut out = nearest.readwrite();
        let mut all = vec![false; robots];
        let each = out.as_slice_mut()?.chunks_exact_mut(seers.len());
        for (out, row) in each.zip(rows.chunks_exact(size)) {
            nearest_to_ball(row, n_blue, &mut all);
            for (out, seer) in out.iter_mut().zip(&seers) {
                *out = all[*seer];
            }
        }
    }
    Ok(nearest)
}

/// Mean magnitude of the actions of each seer.
#[pyfunction]
pub(crate) fn efforts<'py>(
    py: Python<'py>,
    actions: &Bound<'py, PyAny>,
    seers: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let [n, robots, size] = sizes("actions", actions)?;
    let actions: PyReadonlyArray<'_, f32, Ix3> = readable("actions", actions, &[n, robots, size])?;
    let seers = places(seers, robots)?;
    let actions = values(&actions);
    let efforts = PyArray2::zeros(py, [n, seers.len()], false);
    if !seers.is_empty() && size > 0 {
        let mut out = efforts.readwrite();
        let each = out.as_slice_mut()?.chunks_exact_mut(seers.len());
        for (out, actions) in each.zip(actions.chunks_exact(robots * size)) {
            for (out, seer) in out.iter_mut().zip(&seers) {
                *out = effort(&actions[seer * size..][..size]);
            }
        }
    }
    Ok(efforts)
}

/// Robots by their place in a row, which has so many.
fn places(seers: &Bound<'_, PyAny>, robots: usize) -> PyResult<Vec<usize>> {
    let given: PyReadonlyArray<'_, isize, Ix1> =
        readable("seers", seers, &sizes::<1>("seers", seers)?)?;
    let place = |seer: &isize| usize::try_from(*seer).ok().filter(|seer| *seer < robots);
    let found: Result<_, isize> =
        values(&given).iter().map(|seer| place(seer).ok_or(*seer)).collect();
    found.map_err(|seer| {
        PyValueError::new_err(format!("seers must be robots below {robots}, got {seer}"))
    })
}

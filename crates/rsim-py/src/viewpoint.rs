//! Rows as robots see them, for arrays of rows.

use numpy::{Ix3, Ix4, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::Seat;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, row_size};

use crate::arrays::{Rows, readable, sizes, values, writeable};

/// Who looks, and what each has where.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Viewpoint {
    viewpoint: rsim_core::Viewpoint,
    robots: usize,
}

#[pymethods]
impl Viewpoint {
    #[new]
    fn new(robots: usize, slots: Vec<Vec<Option<usize>>>, turned: Vec<bool>) -> PyResult<Self> {
        let wide = slots.first().map_or(0, Vec::len);
        if slots.len() != turned.len() || slots.iter().any(|slots| slots.len() != wide) {
            return Err(PyValueError::new_err(
                "slots must have a row for each of turned, all of one length",
            ));
        }
        if let Some(robot) = slots.iter().flatten().flatten().find(|robot| **robot >= robots) {
            return Err(PyValueError::new_err(format!(
                "slots must hold robots below {robots}, got {robot}"
            )));
        }
        let seats = slots.into_iter().zip(turned);
        let seats = seats.map(|(slots, turned)| Seat { turned, slots }).collect();
        Ok(Self { viewpoint: rsim_core::Viewpoint::new(seats), robots })
    }

    fn fill(
        &self,
        py: Python<'_>,
        rows: &Bound<'_, PyAny>,
        ball: &Bound<'_, PyAny>,
        robots: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let [n, _] = sizes("rows", rows)?;
        let (seers, slots) = (self.viewpoint.seers(), self.viewpoint.slots());
        let size = row_size(self.robots);
        let rows: Rows = readable("rows", rows, &[n, size])?;
        let ball_shape = [n, seers, BALL_COLUMNS.len()];
        let robots_shape = [n, seers, slots, ROBOT_COLUMNS.len()];
        let mut ball: PyReadwriteArray<'_, f32, Ix3> = writeable("ball", ball, &ball_shape)?;
        let mut robots: PyReadwriteArray<'_, f32, Ix4> =
            writeable("robots", robots, &robots_shape)?;
        let (rows, ball, robots) = (values(&rows), ball.as_slice_mut()?, robots.as_slice_mut()?);
        if ball.is_empty() {
            return Ok(());
        }
        py.detach(|| {
            let balls = ball.chunks_exact_mut(seers * BALL_COLUMNS.len());
            let views = robots.chunks_exact_mut(seers * slots * ROBOT_COLUMNS.len());
            for (row, (ball, robots)) in rows.chunks_exact(size).zip(balls.zip(views)) {
                self.viewpoint.fill(row, ball, robots);
            }
        });
        Ok(())
    }
}

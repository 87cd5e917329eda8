//! Views of robots, for arrays of rows.

use numpy::{Ix3, Ix4, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::Observer;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, row_size};

use crate::arrays::{Rows, readable, sizes, values, writeable};

/// The observers of a match, with the robots in the slots of each.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Viewpoint {
    pub(crate) viewpoint: rsim_core::Viewpoint,
    n_robots: usize,
}

#[pymethods]
impl Viewpoint {
    #[new]
    fn new(n_robots: usize, slots: Vec<Vec<Option<usize>>>, rotated: Vec<bool>) -> PyResult<Self> {
        let wide = slots.first().map_or(0, Vec::len);
        if slots.len() != rotated.len() || slots.iter().any(|slots| slots.len() != wide) {
            return Err(PyValueError::new_err(
                "slots must have a row for each of rotated, all of one length",
            ));
        }
        if let Some(robot) = slots.iter().flatten().flatten().find(|robot| **robot >= n_robots) {
            return Err(PyValueError::new_err(format!(
                "slots must hold robots below {n_robots}, got {robot}"
            )));
        }
        let observers = slots.into_iter().zip(rotated);
        let observers = observers.map(|(slots, rotated)| Observer { rotated, slots }).collect();
        Ok(Self { viewpoint: rsim_core::Viewpoint::new(observers), n_robots })
    }

    #[pyo3(signature = (rows, ball, robots, rotated = None))]
    fn fill(
        &self,
        py: Python<'_>,
        rows: &Bound<'_, PyAny>,
        ball: &Bound<'_, PyAny>,
        robots: &Bound<'_, PyAny>,
        rotated: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (n, rows) = self.rows("rows", rows)?;
        let rotated = self.rotated(n, rotated)?;
        let rotated = rotated.as_ref().map(values);
        let (observers, slots) = (self.viewpoint.n_observers(), self.viewpoint.slots());
        let ball_shape = [n, observers, BALL_COLUMNS.len()];
        let robots_shape = [n, observers, slots, ROBOT_COLUMNS.len()];
        let mut ball: PyReadwriteArray<'_, f32, Ix3> = writeable("ball", ball, &ball_shape)?;
        let mut robots: PyReadwriteArray<'_, f32, Ix4> =
            writeable("robots", robots, &robots_shape)?;
        let (rows, ball, robots) = (values(&rows), ball.as_slice_mut()?, robots.as_slice_mut()?);
        if ball.is_empty() {
            return Ok(());
        }
        py.detach(|| {
            let balls = ball.chunks_exact_mut(observers * BALL_COLUMNS.len());
            let size = self.row_size();
            let of_world = observers * slots * ROBOT_COLUMNS.len();
            for (world, ball) in balls.enumerate() {
                let robots = &mut robots[world * of_world..(world + 1) * of_world];
                let own = world * size..(world + 1) * size;
                let row = &rows[own.clone()];
                let rotated = rotated.as_ref().map_or(row, |rotated| &rotated[own]);
                self.viewpoint.fill([row, rotated], ball, robots);
            }
        });
        Ok(())
    }
}

impl Viewpoint {
    /// Checks the rows of the observers on the rotated field, as many as other rows.
    pub(crate) fn rotated<'py>(
        &self,
        n: usize,
        rotated: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Option<Rows<'py>>> {
        rotated.map(|rows| readable("rotated", rows, &[n, self.row_size()])).transpose()
    }

    /// Number of columns of a row.
    pub(crate) fn row_size(&self) -> usize {
        row_size(self.n_robots)
    }

    /// Number of robots in a row.
    pub(crate) fn n_robots(&self) -> usize {
        self.n_robots
    }

    /// Checks rows, and returns them with their number.
    pub(crate) fn rows<'py>(
        &self,
        name: &str,
        rows: &Bound<'py, PyAny>,
    ) -> PyResult<(usize, Rows<'py>)> {
        let [n, _] = sizes(name, rows)?;
        Ok((n, readable(name, rows, &[n, self.row_size()])?))
    }
}

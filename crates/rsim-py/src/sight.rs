//! What robots see, for arrays of views.

use numpy::{
    Ix3, Ix4, PyArray3, PyArrayMethods, PyReadonlyArray, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};

use crate::arrays::{readable, values};
use crate::config::count;
use crate::models::{Field, RobotModel};

/// What robots see, in half lengths of the field and top speeds of a robot.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Sight {
    seen: rsim_core::Sight,
    field: Field,
    robot: RobotModel,
    others: (usize, usize),
}

#[pymethods]
impl Sight {
    #[new]
    fn new(field: Field, robot: RobotModel, n_mates: i64, n_foes: i64) -> PyResult<Self> {
        let (mates, foes) = (count("n_mates", n_mates)?, count("n_foes", n_foes)?);
        let seen = rsim_core::Sight::new(&field.0, &robot.0, mates, foes);
        Ok(Self { seen, field, robot, others: (mates, foes) })
    }

    #[getter]
    fn blocks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let blocks = self.seen.blocks().into_iter();
        let named = blocks.map(|(name, shape)| Ok((name, PyTuple::new(py, shape)?)));
        PyTuple::new(py, named.collect::<PyResult<Vec<_>>>()?)
    }

    fn look<'py>(
        &self,
        py: Python<'py>,
        ball: &Bound<'py, PyAny>,
        robots: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let (n, seers) = match ball.cast::<PyUntypedArray>().map(PyUntypedArrayMethods::shape) {
            Ok(&[n, seers, _]) => (n, seers),
            _ => (0, 0), // refused just below
        };
        let (ball_size, robots_size) =
            (BALL_COLUMNS.len(), self.seen.slots() * ROBOT_COLUMNS.len());
        let ball: PyReadonlyArray<'_, f32, Ix3> = readable("ball", ball, &[n, seers, ball_size])?;
        let shape = [n, seers, self.seen.slots(), ROBOT_COLUMNS.len()];
        let robots: PyReadonlyArray<'_, f32, Ix4> = readable("robots", robots, &shape)?;
        let (ball, robots) = (values(&ball), values(&robots));
        let numbers = PyArray3::zeros(py, [n, seers, self.seen.size()], false);
        {
            let mut out = numbers.readwrite();
            let out = out.as_slice_mut()?;
            py.detach(|| {
                let each = out.chunks_exact_mut(self.seen.size());
                let views = ball.chunks_exact(ball_size).zip(robots.chunks_exact(robots_size));
                each.zip(views)
                    .for_each(|(out, (ball, robots))| self.seen.write(ball, robots, out));
            });
        }
        Ok(numbers)
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (Field, RobotModel, usize, usize)) {
        let Self { field, robot, others: (mates, foes), .. } = slf.get();
        (slf.get_type().into_any(), (field.clone(), robot.clone(), *mates, *foes))
    }
}

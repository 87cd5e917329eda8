//! What robots see, for arrays of views.

use numpy::{Ix3, Ix4, PyArray3, PyArrayMethods, PyReadonlyArray};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};

use crate::arrays::{readable, sizes, values};
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

    #[pyo3(signature = (ball, robots, room = 0))]
    fn look<'py>(
        &self,
        py: Python<'py>,
        ball: &Bound<'py, PyAny>,
        robots: &Bound<'py, PyAny>,
        room: i64,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let [n, seers, _] = sizes("ball", ball)?;
        let room = count("room", room)?;
        let (ball_size, robots_size) =
            (BALL_COLUMNS.len(), self.seen.slots() * ROBOT_COLUMNS.len());
        let ball: PyReadonlyArray<'_, f32, Ix3> = readable("ball", ball, &[n, seers, ball_size])?;
        let shape = [n, seers, self.seen.slots(), ROBOT_COLUMNS.len()];
        let robots: PyReadonlyArray<'_, f32, Ix4> = readable("robots", robots, &shape)?;
        let (ball, robots) = (values(&ball), values(&robots));
        let size = self.seen.size();
        let numbers = PyArray3::zeros(py, [n, seers, size + room], false);
        {
            let mut out = numbers.readwrite();
            let out = out.as_slice_mut()?;
            py.detach(|| {
                let each = out.chunks_exact_mut(size + room);
                let views = ball.chunks_exact(ball_size).zip(robots.chunks_exact(robots_size));
                each.zip(views).for_each(|(out, (ball, robots))| {
                    self.seen.write(ball, robots, &mut out[..size]);
                });
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

//! Egocentric features, for arrays of views.

use numpy::{Ix3, Ix4, PyArray3, PyArrayMethods, PyReadonlyArray};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};

use crate::arrays::{readable, sizes, values};
use crate::config::count;
use crate::models::{Field, RobotModel};

/// Egocentric features of robots, scaled for a network.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct EgoFeatures {
    features: rsim_core::EgoFeatures,
    field: Field,
    robot: RobotModel,
    /// Numbers of teammates and opponents.
    others: (usize, usize),
}

#[pymethods]
impl EgoFeatures {
    #[new]
    fn new(field: Field, robot: RobotModel, n_teammates: i64, n_opponents: i64) -> PyResult<Self> {
        let (teammates, opponents) =
            (count("n_teammates", n_teammates)?, count("n_opponents", n_opponents)?);
        let features = rsim_core::EgoFeatures::new(&field.0, &robot.0, teammates, opponents);
        Ok(Self { features, field, robot, others: (teammates, opponents) })
    }

    #[getter]
    fn blocks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let blocks = self.features.blocks().into_iter();
        let named = blocks.map(|(name, shape)| Ok((name, PyTuple::new(py, shape)?)));
        PyTuple::new(py, named.collect::<PyResult<Vec<_>>>()?)
    }

    #[pyo3(signature = (ball, robots, extra = 0))]
    fn encode<'py>(
        &self,
        py: Python<'py>,
        ball: &Bound<'py, PyAny>,
        robots: &Bound<'py, PyAny>,
        extra: i64,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let [n, observers, _] = sizes("ball", ball)?;
        let extra = count("extra", extra)?;
        let (ball_size, robots_size) =
            (BALL_COLUMNS.len(), self.features.slots() * ROBOT_COLUMNS.len());
        let ball: PyReadonlyArray<'_, f32, Ix3> =
            readable("ball", ball, &[n, observers, ball_size])?;
        let shape = [n, observers, self.features.slots(), ROBOT_COLUMNS.len()];
        let robots: PyReadonlyArray<'_, f32, Ix4> = readable("robots", robots, &shape)?;
        let (ball, robots) = (values(&ball), values(&robots));
        let size = self.features.size();
        let numbers = PyArray3::zeros(py, [n, observers, size + extra], false);
        {
            let mut out = numbers.readwrite();
            let out = out.as_slice_mut()?;
            py.detach(|| {
                let each = out.chunks_exact_mut(size + extra);
                let views = ball.chunks_exact(ball_size).zip(robots.chunks_exact(robots_size));
                each.zip(views).for_each(|(out, (ball, robots))| {
                    self.features.encode(ball, robots, &mut out[..size]);
                });
            });
        }
        Ok(numbers)
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (Field, RobotModel, usize, usize)) {
        let Self { field, robot, others: (teammates, opponents), .. } = slf.get();
        (slf.get_type().into_any(), (field.clone(), robot.clone(), *teammates, *opponents))
    }
}

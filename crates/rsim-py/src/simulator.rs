//! Simulator: many matches in one Python object.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rsim_core::columns::BALL_COLUMNS;
use rsim_core::{Batch, PlaceError};

use crate::arguments::required;
use crate::arrays::{
    Commands, InputRows, Keys, Mask, RobotsMask, Rows, RowsOut, finite, readable, values, writeable,
};
use crate::config::{SimConfig, invalid, of_argument, worlds};
use crate::forecaster::Known;
use crate::threads::ThreadsOrCount;

/// Time of a frame, detected balls and detected robots.
type CameraFrame<'py> = (f64, Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<f32>>);

/// Many independent matches of one configuration.
#[pyclass(module = "rsoccer._core")]
pub(crate) struct Simulator(Batch);

#[pymethods]
impl Simulator {
    #[new]
    #[pyo3(signature = (config, worlds = 1, threads = ThreadsOrCount::Count(1)),
        text_signature = "(config, worlds=1, threads=1)")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = of_argument)] config: SimConfig,
        #[pyo3(from_py_with = worlds)] worlds: usize,
        #[pyo3(from_py_with = ThreadsOrCount::of_argument)] threads: ThreadsOrCount<'_>,
    ) -> PyResult<Self> {
        let threads = threads.started(py)?;
        let batch = py.detach(|| Batch::on_threads(&config.0, worlds, threads));
        Ok(Self(batch.map_err(invalid)?))
    }

    #[getter]
    fn config(&self) -> SimConfig {
        SimConfig(self.0.config().clone())
    }

    #[getter]
    fn worlds(&self) -> usize {
        self.0.worlds()
    }

    #[getter]
    fn threads(&self) -> usize {
        self.0.threads()
    }

    #[pyo3(signature = (worlds, rows, out, parameters = None))]
    fn place(
        &mut self,
        py: Python<'_>,
        worlds: &Bound<'_, PyAny>,
        rows: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
        parameters: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let change = self.change(worlds, ("rows", rows), self.row_size(), out)?;
        let shape = [change.chosen, self.0.config().parameters_size()];
        let parameters = parameters
            .map(|parameters| InputRows::new("parameters", parameters, &shape, out))
            .transpose()?;
        let parameters = parameters.as_ref().map(InputRows::values);
        change.make(py, self, |batch, mask, rows, out| {
            batch.place(mask, rows, parameters.as_deref(), out)
        })
    }

    fn restart(
        &mut self,
        py: Python<'_>,
        worlds: &Bound<'_, PyAny>,
        rows: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let change = self.change(worlds, ("rows", rows), self.row_size(), out)?;
        change.make(py, self, Batch::restart)
    }

    fn reposition_balls(
        &mut self,
        py: Python<'_>,
        worlds: &Bound<'_, PyAny>,
        balls: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let change = self.change(worlds, ("balls", balls), BALL_COLUMNS.len(), out)?;
        change.make(py, self, Batch::reposition_balls)
    }

    fn reposition_robots(
        &mut self,
        py: Python<'_>,
        worlds: &Bound<'_, PyAny>,
        robots: &Bound<'_, PyAny>,
        rows: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let change = self.change(worlds, ("rows", rows), self.row_size(), out)?;
        let shape = [change.chosen, self.0.config().n_robots()];
        let robots: RobotsMask = readable("robots", robots, &shape)?;
        let robots = values(&robots);
        change.make(py, self, |batch, mask, rows, out| {
            batch.reposition_robots(mask, &robots, rows, out)
        })
    }

    fn place_estimates<'py>(
        &mut self,
        py: Python<'py>,
        worlds: &Bound<'py, PyAny>,
        rows: &Bound<'py, PyAny>,
        out: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let change = self.change(worlds, ("rows", rows), self.row_size(), out)?;
        let bodies = 1 + self.0.config().n_robots();
        let mut moved = vec![0.0; change.chosen * bodies];
        change.make(py, self, |batch, mask, rows, out| {
            batch.place_estimates(mask, rows, out, &mut moved)
        })?;
        PyArray1::from_vec(py, moved).reshape([change.chosen, bodies])
    }

    #[pyo3(signature = (commands, out, active = None, sensed = None))]
    fn step(
        &mut self,
        py: Python<'_>,
        commands: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
        active: Option<&Bound<'_, PyAny>>,
        sensed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let robots = self.0.config().n_robots();
        let columns = self.0.config().command_columns();
        let commands: Commands =
            readable("commands", commands, &[self.0.worlds(), robots, columns])?;
        let commands = values(&commands);
        finite("commands", &commands)?;
        let active: Option<Mask> =
            active.map(|mask| readable("active", mask, &[self.0.worlds()])).transpose()?;
        let active = active.as_ref().map(values);
        let mut out = self.rows_out(out)?;
        let out = out.as_slice_mut()?;
        let shape = [self.0.worlds(), self.row_size()];
        let mut sensed: Option<RowsOut> =
            sensed.map(|sensed| writeable("sensed", sensed, &shape)).transpose()?;
        let sensed = sensed.as_mut().map(RowsOut::as_slice_mut).transpose()?;
        py.detach(|| self.0.step_and_sense(&commands, out, sensed, active.as_deref()))
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    fn read(&self, out: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut out = self.rows_out(out)?;
        self.0.read(out.as_slice_mut()?);
        Ok(())
    }

    #[pyo3(signature = (out, active = None, known = Some(Known::default())), text_signature = "($self, out, active=None, known='blue')")]
    fn sense(
        &self,
        py: Python<'_>,
        out: &Bound<'_, PyAny>,
        active: Option<&Bound<'_, PyAny>>,
        known: Option<Known>,
    ) -> PyResult<()> {
        let active: Option<Mask> =
            active.map(|mask| readable("active", mask, &[self.0.worlds()])).transpose()?;
        let active = active.as_ref().map(values);
        let mut out = self.rows_out(out)?;
        let out = out.as_slice_mut()?;
        let Known(knowledge) = known.unwrap_or_default();
        py.detach(|| {
            if known.is_some() {
                self.0.sense_as(knowledge, out, active.as_deref());
            } else {
                self.0.sense_without_forecast(knowledge, out, active.as_deref());
            }
        });
        Ok(())
    }

    #[pyo3(signature = (world = 0))]
    fn camera_frames<'py>(&self, py: Python<'py>, world: i64) -> PyResult<Vec<CameraFrame<'py>>> {
        let worlds = self.0.worlds();
        let Some(world) = usize::try_from(world).ok().filter(|&world| world < worlds) else {
            let last = worlds - 1;
            return Err(PyValueError::new_err(format!("world must be 0 to {last}, got {world}")));
        };
        let frames = self.0.camera_frames(world);
        let to_arrays = |frame: rsim_core::CameraFrame| {
            let balls = PyArray1::from_slice(py, frame.balls.as_flattened());
            let robots = PyArray1::from_slice(py, frame.robots.as_flattened());
            let balls = balls.reshape([frame.balls.len(), 4])?;
            Ok((frame.time, balls, robots.reshape([frame.robots.len(), 6])?))
        };
        frames.into_iter().map(to_arrays).collect()
    }

    #[pyo3(signature = (worlds, keys, numbers = None))]
    fn begin_senses(
        &mut self,
        worlds: &Bound<'_, PyAny>,
        keys: &Bound<'_, PyAny>,
        numbers: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let mask: Mask = readable("worlds", worlds, &[self.0.worlds()])?;
        let mask = values(&mask);
        let chosen = mask.iter().filter(|&&chosen| chosen).count();
        let keys: Keys = readable("keys", keys, &[chosen])?;
        let size = rsim_core::Sensing::numbers().len();
        let numbers: Option<Rows> =
            numbers.map(|rows| readable("numbers", rows, &[chosen, size])).transpose()?;
        let numbers = numbers.as_ref().map(values);
        self.0.begin_senses(&mask, &values(&keys), numbers.as_deref()).map_err(invalid)
    }

    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes = py.detach(|| self.0.snapshot());
        PyBytes::new(py, &bytes)
    }

    fn restore(&mut self, py: Python<'_>, snapshot: &Bound<'_, PyAny>) -> PyResult<()> {
        let snapshot: Bound<'_, PyBytes> = required("snapshot", "bytes", snapshot)?;
        let snapshot = snapshot.as_bytes();
        py.detach(|| self.0.restore(snapshot)).map_err(invalid)
    }

    fn __getnewargs__(&self) -> (SimConfig, usize, usize) {
        (self.config(), self.worlds(), self.threads())
    }

    fn __getstate__<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.snapshot(py)
    }

    fn __setstate__(&mut self, py: Python<'_>, state: &Bound<'_, PyAny>) -> PyResult<()> {
        self.restore(py, state)
    }

    fn __repr__(&self) -> String {
        format!("Simulator({} worlds, {} threads)", self.worlds(), self.threads())
    }
}

impl Simulator {
    fn row_size(&self) -> usize {
        self.0.config().row_size()
    }

    /// Reads the worlds that a method changes, and the numbers of each of them.
    fn change<'a, 'py>(
        &self,
        worlds: &Bound<'py, PyAny>,
        (name, numbers): (&str, &Bound<'py, PyAny>),
        columns: usize,
        out: &'a Bound<'py, PyAny>,
    ) -> PyResult<Change<'a, 'py>> {
        let mask: Mask = readable("worlds", worlds, &[self.0.worlds()])?;
        let chosen = values(&mask).iter().filter(|&&chosen| chosen).count();
        let numbers = InputRows::new(name, numbers, &[chosen, columns], out)?;
        Ok(Change { mask, chosen, numbers, out })
    }

    fn rows_out<'py>(&self, out: &Bound<'py, PyAny>) -> PyResult<RowsOut<'py>> {
        writeable("out", out, &[self.0.worlds(), self.row_size()])
    }
}

/// Input of a method that changes some worlds.
struct Change<'a, 'py> {
    mask: Mask<'py>,
    /// Number of worlds of the mask.
    chosen: usize,
    /// A row for each of them.
    numbers: InputRows<'py>,
    out: &'a Bound<'py, PyAny>,
}

impl Change<'_, '_> {
    /// Makes the change by a method of the batch, which takes mask, numbers and output.
    fn make(
        &self,
        py: Python<'_>,
        simulator: &mut Simulator,
        method: impl FnOnce(&mut Batch, &[bool], &[f32], &mut [f32]) -> Result<(), PlaceError> + Send,
    ) -> PyResult<()> {
        let (mask, numbers) = (values(&self.mask), self.numbers.values());
        // The output is borrowed last: an input that shares its memory was copied before.
        let mut out = simulator.rows_out(self.out)?;
        let out = out.as_slice_mut()?;
        py.detach(|| method(&mut simulator.0, &mask, &numbers, out)).map_err(invalid)
    }
}

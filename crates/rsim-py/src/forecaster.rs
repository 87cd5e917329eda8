//! Forecaster: from what is known of the past to the time at which the next commands act.

use numpy::{Ix1, PyReadonlyArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rsim_core::Knowledge;

use crate::arguments::required;
use crate::arrays::{Commands, InputRows, Mask, RowsOut, finite, readable, values, writeable};
use crate::config::{SimConfig, invalid, of_argument, worlds};
use crate::threads::ThreadsOrCount;

/// Robots whose commands are known, by their team or "all".
#[derive(Default, Clone, Copy)]
pub(crate) struct Known(pub(crate) Knowledge);

impl FromPyObject<'_, '_> for Known {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let expected = "known must be 'blue', 'yellow' or 'all', got";
        let Ok(name) = value.extract::<String>() else {
            return Err(PyTypeError::new_err(format!("{expected} {}", value.repr()?)));
        };
        let found = Knowledge::named(&name).map(Self);
        found.ok_or_else(|| PyValueError::new_err(format!("{expected} {name:?}")))
    }
}

/// Forecasts of many matches.
#[pyclass(module = "rsoccer._core")]
pub(crate) struct Forecaster(rsim_core::Forecaster);

/// Times of all worlds, s.
type Times<'py> = PyReadonlyArray<'py, f64, Ix1>;

#[pymethods]
impl Forecaster {
    #[new]
    #[pyo3(signature = (config, worlds = 1, threads = ThreadsOrCount::Count(1), known = Known(Knowledge::All)),
        text_signature = "(config, worlds=1, threads=1, known='all')")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = of_argument)] config: SimConfig,
        #[pyo3(from_py_with = worlds)] worlds: usize,
        #[pyo3(from_py_with = ThreadsOrCount::of_argument)] threads: ThreadsOrCount<'_>,
        known: Known,
    ) -> PyResult<Self> {
        let threads = threads.started(py)?;
        let made = rsim_core::Forecaster::new(&config.0, worlds, known.0, threads);
        made.map(Self).map_err(invalid)
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

    #[getter]
    fn known(&self) -> &'static str {
        self.0.knowledge().name()
    }

    #[pyo3(signature = (commands, times, active = None))]
    fn send(
        &mut self,
        commands: &Bound<'_, PyAny>,
        times: &Bound<'_, PyAny>,
        active: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let worlds = self.0.worlds();
        let (robots, columns) = (self.0.config().n_robots(), self.0.config().command_columns());
        let commands: Commands = readable("commands", commands, &[worlds, robots, columns])?;
        let commands = values(&commands);
        finite("commands", &commands)?;
        let times = seconds("times", times, worlds)?;
        let active: Option<Mask> =
            active.map(|mask| readable("active", mask, &[worlds])).transpose()?;
        let active = active.as_ref().map(values);
        self.0.send(&commands, &times, active.as_deref()).map_err(invalid)
    }

    fn forecast(
        &mut self,
        py: Python<'_>,
        rows: &Bound<'_, PyAny>,
        seen: &Bound<'_, PyAny>,
        now: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (worlds, size) = (self.0.worlds(), self.0.config().row_size());
        let rows = InputRows::new("rows", rows, &[worlds, size], out)?;
        let (seen, now) = (seconds("seen", seen, worlds)?, seconds("now", now, worlds)?);
        let rows = rows.values();
        let mut out: RowsOut = writeable("out", out, &[worlds, size])?;
        let out = out.as_slice_mut()?;
        py.detach(|| self.0.forecast(&rows, &seen, &now, out)).map_err(invalid)
    }

    fn reset(&mut self, worlds: &Bound<'_, PyAny>) -> PyResult<()> {
        let mask: Mask = readable("worlds", worlds, &[self.0.worlds()])?;
        self.0.reset(&values(&mask));
        Ok(())
    }

    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.0.snapshot())
    }

    fn restore(&mut self, snapshot: &Bound<'_, PyAny>) -> PyResult<()> {
        let snapshot: Bound<'_, PyBytes> = required("snapshot", "bytes", snapshot)?;
        let snapshot = snapshot.as_bytes();
        self.0.restore(snapshot).map_err(invalid)
    }

    fn __getnewargs__(&self) -> (SimConfig, usize, usize, &'static str) {
        (self.config(), self.worlds(), self.threads(), self.known())
    }

    fn __getstate__<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.snapshot(py)
    }

    fn __setstate__(&mut self, state: &Bound<'_, PyAny>) -> PyResult<()> {
        self.restore(state)
    }

    fn __repr__(&self) -> String {
        format!("Forecaster({} worlds, known={:?})", self.worlds(), self.known())
    }
}

/// Checks times of all worlds.
fn seconds(name: &str, times: &Bound<'_, PyAny>, worlds: usize) -> PyResult<Vec<f64>> {
    let times: Times = readable(name, times, &[worlds])?;
    let times = values(&times).into_owned();
    match times.iter().find(|time| !time.is_finite()) {
        None => Ok(times),
        Some(time) => Err(PyValueError::new_err(format!("{name} must be finite, got {time}"))),
    }
}

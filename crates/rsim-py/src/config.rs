//! Configuration of a simulator, as a frozen Python class.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use rsim_core::{EngineKind, League};

use crate::arguments::{Given, argument, given, required};
use crate::models::{BallModel, Field, Model, RobotModel, Sensing, named, shortest};

/// Configuration of a simulator.
#[pyclass(frozen, eq, from_py_object, module = "rsoccer._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct SimConfig(pub(crate) rsim_core::SimConfig);

#[pymethods]
impl SimConfig {
    #[new]
    #[pyo3(signature = (
        field = None, n_blue = None, n_yellow = None, *,
        robot = None, ball = None, time_step = None, tick = None, engine = None, sensing = None
    ), text_signature = "(field='vss_3v3', n_blue=3, n_yellow=3, *, robot=None, ball=None, \
        time_step=0.025, tick=0.005, engine='compact', sensing=None)")]
    #[expect(clippy::too_many_arguments, reason = "the keywords of Python's constructor")]
    fn new(
        #[pyo3(from_py_with = given)] field: Given<'_>,
        #[pyo3(from_py_with = given)] n_blue: Given<'_>,
        #[pyo3(from_py_with = given)] n_yellow: Given<'_>,
        robot: Option<Bound<'_, PyAny>>,
        ball: Option<Bound<'_, PyAny>>,
        #[pyo3(from_py_with = given)] time_step: Given<'_>,
        #[pyo3(from_py_with = given)] tick: Given<'_>,
        #[pyo3(from_py_with = given)] engine: Given<'_>,
        sensing: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let solvers = "'compact' or 'rapier'";
        let engine = argument("engine", solvers, engine, || "compact".to_owned())?;
        let engine = EngineKind::named(&engine).map_err(invalid)?;
        let field = match field {
            Some(field) => named::<Field>("field", &field)?.0,
            None => Field::preset("vss_3v3")?.0,
        };
        let n_blue = count("n_blue", argument("n_blue", "a whole number", n_blue, || 3)?)?;
        let n_yellow = count("n_yellow", argument("n_yellow", "a whole number", n_yellow, || 3)?)?;
        let time_step = argument("time_step", "a number", time_step, || 0.025)?;
        let tick = argument("tick", "a number", tick, || 0.005)?;
        // Checked before the models are copied.
        rsim_core::check_team("n_blue", &field, n_blue).map_err(invalid)?;
        rsim_core::check_team("n_yellow", &field, n_yellow).map_err(invalid)?;
        let ball = match ball {
            Some(ball) => named::<BallModel>("ball", &ball)?.0,
            None => League::of(&field, "ball").map_err(invalid)?.ball(),
        };
        let mut blue = if let Some(robot) = robot {
            robot_models(&robot, n_blue + n_yellow)?
        } else {
            let robot = League::of(&field, "robot").map_err(invalid)?.robot();
            vec![robot; n_blue + n_yellow]
        };
        let yellow = blue.split_off(n_blue);
        let sensing = sensing.map(|sensing| named::<Sensing>("sensing", &sensing)).transpose()?;
        let sensing = sensing.map(|sensing| sensing.0);
        let config =
            rsim_core::SimConfig { field, ball, blue, yellow, time_step, tick, engine, sensing };
        config.validate().map_err(invalid)?;
        Ok(Self(config))
    }

    #[getter]
    fn field(&self) -> Field {
        Field(self.0.field.clone())
    }

    #[getter]
    fn robots<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.robots().map(|model| RobotModel(model.clone())).collect::<Vec<_>>())
    }

    #[getter]
    fn robot(&self) -> PyResult<RobotModel> {
        let mut robots = self.0.robots();
        match robots.next() {
            Some(first) if robots.all(|model| model == first) => Ok(RobotModel(first.clone())),
            Some(_) => Err(PyValueError::new_err(
                "the robots differ: use `robots`, with one model for each",
            )),
            None => Err(PyValueError::new_err("there are no robots")),
        }
    }

    #[getter]
    fn ball(&self) -> BallModel {
        BallModel(self.0.ball.clone())
    }

    #[getter]
    fn n_blue(&self) -> usize {
        self.0.blue.len()
    }

    #[getter]
    fn n_yellow(&self) -> usize {
        self.0.yellow.len()
    }

    #[getter]
    fn n_robots(&self) -> usize {
        self.0.n_robots()
    }

    #[getter]
    fn time_step(&self) -> f64 {
        shortest(self.0.time_step)
    }

    #[getter]
    fn tick(&self) -> f64 {
        shortest(self.0.tick)
    }

    #[getter]
    fn engine(&self) -> &'static str {
        self.0.engine.name()
    }

    #[getter]
    fn sensing(&self) -> Option<Sensing> {
        self.0.sensing.clone().map(Sensing)
    }

    fn with_sensing(&self, sensing: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let sensing = sensing
            .map(|sensing| required::<Sensing>("sensing", "a Sensing or None", sensing))
            .transpose()?;
        let sensing = sensing.map(|sensing| sensing.0);
        let config = rsim_core::SimConfig { sensing, ..self.0.clone() };
        config.validate().map_err(invalid)?;
        Ok(Self(config))
    }

    #[getter]
    fn ticks_per_step(&self) -> usize {
        self.0.ticks_per_step()
    }

    #[getter]
    fn row_size(&self) -> usize {
        self.0.row_size()
    }

    #[getter]
    fn parameters_size(&self) -> usize {
        self.0.parameters_size()
    }

    #[getter]
    fn command_columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let columns = self.0.robots().map(rsim_core::RobotModel::command_columns);
        PyTuple::new(py, columns.max_by_key(|columns| columns.len()).unwrap_or_default())
    }

    fn to_json(&self) -> String {
        serde_json::to_string(&self.0).expect("plain data always encodes")
    }

    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text: String = required("text", "JSON of a SimConfig", text)?;
        let config: rsim_core::SimConfig = serde_json::from_str(&text).map_err(|error| {
            PyValueError::new_err(format!("text is not a configuration: {error}"))
        })?;
        config.validate().map_err(invalid)?;
        Ok(Self(config))
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.to_json().hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        let config = &self.0;
        let robots: Vec<&str> = config.robots().map(|model| &*model.name).collect();
        let robots = match robots.first() {
            Some(first) if robots.iter().all(|name| name == first) => format!("{first:?}"),
            _ => format!("{robots:?}"),
        };
        format!(
            "SimConfig({:?}, {}, {}, robot={robots}, ball={:?}, time_step={}, tick={}, \
             engine={:?})",
            config.field.name,
            config.blue.len(),
            config.yellow.len(),
            config.ball.name,
            config.time_step,
            config.tick,
            config.engine.name()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json(),)))
    }
}

/// The models of all robots, from one for all or a sequence with one for each.
fn robot_models(robot: &Bound<'_, PyAny>, n_robots: usize) -> PyResult<Vec<rsim_core::RobotModel>> {
    let Ok(robots) = robot.extract::<Vec<Bound<'_, PyAny>>>() else {
        return Ok(vec![named::<RobotModel>("robot", robot)?.0; n_robots]);
    };
    if robots.len() != n_robots {
        return Err(PyValueError::new_err(format!(
            "robot must be one model or one for each of {n_robots} robots, got {}",
            robots.len()
        )));
    }
    robots.iter().map(|robot| Ok(named::<RobotModel>("robot", robot)?.0)).collect()
}

/// A `ValueError` with the core's message.
pub(crate) fn invalid(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Converts the argument `config` of a constructor.
pub(crate) fn of_argument(value: &Bound<'_, PyAny>) -> PyResult<SimConfig> {
    required("config", "a SimConfig", value)
}

/// Converts the argument `worlds` of a constructor.
pub(crate) fn worlds(value: &Bound<'_, PyAny>) -> PyResult<usize> {
    count("worlds", required("worlds", "a whole number", value)?)
}

/// A count from Python, which may be negative there.
pub(crate) fn count(name: &str, value: i64) -> PyResult<usize> {
    usize::try_from(value)
        .map_err(|_| PyValueError::new_err(format!("{name} must not be negative, got {value}")))
}

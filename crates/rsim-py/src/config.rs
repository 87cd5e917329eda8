//! Configuration: frozen mirrors of the core's data.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};

/// What is fixed for the life of a simulator.
#[pyclass(frozen, eq, from_py_object, module = "rsoccer._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct SimConfig(pub(crate) rsim_core::SimConfig);

#[pymethods]
impl SimConfig {
    #[new]
    #[pyo3(signature = (
        field = "vss_3v3", n_blue = 3, n_yellow = 3, *,
        robot = "vss_440rpm", ball = "vss_rsim", time_step = 0.025, tick = 0.005
    ))]
    fn new(
        field: &str,
        n_blue: i64,
        n_yellow: i64,
        robot: &str,
        ball: &str,
        time_step: f32,
        tick: f32,
    ) -> PyResult<Self> {
        let config = rsim_core::SimConfig {
            field: rsim_core::Field::preset(field).map_err(invalid)?,
            robot: rsim_core::RobotModel::preset(robot).map_err(invalid)?,
            ball: rsim_core::BallModel::preset(ball).map_err(invalid)?,
            n_blue: count("n_blue", n_blue)?,
            n_yellow: count("n_yellow", n_yellow)?,
            time_step,
            tick,
        };
        config.validate().map_err(invalid)?;
        Ok(Self(config))
    }

    #[getter]
    fn field(&self) -> Field {
        Field(self.0.field.clone())
    }

    #[getter]
    fn robot(&self) -> RobotModel {
        RobotModel(self.0.robot.clone())
    }

    #[getter]
    fn ball(&self) -> BallModel {
        BallModel(self.0.ball.clone())
    }

    #[getter]
    fn n_blue(&self) -> usize {
        self.0.n_blue
    }

    #[getter]
    fn n_yellow(&self) -> usize {
        self.0.n_yellow
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
    fn ticks_per_step(&self) -> usize {
        self.0.ticks_per_step()
    }

    #[getter]
    fn row_size(&self) -> usize {
        self.0.row_size()
    }

    #[getter]
    #[allow(clippy::unused_self)] // there is one kind of drive
    fn command_columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, rsim_core::columns::DIFFERENTIAL_COLUMNS)
    }

    fn to_json(&self) -> String {
        serde_json::to_string(&self.0).expect("plain data always encodes")
    }

    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        let config: rsim_core::SimConfig = serde_json::from_str(text).map_err(|error| {
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
        format!(
            "SimConfig({:?}, {}, {}, robot={:?}, ball={:?}, time_step={}, tick={})",
            config.field.name,
            config.n_blue,
            config.n_yellow,
            config.robot.name,
            config.ball.name,
            config.time_step,
            config.tick
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json(),)))
    }
}

/// A `ValueError` with the core's words.
pub(crate) fn invalid(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// A number of things, which Python may have made negative.
pub(crate) fn count(name: &str, value: i64) -> PyResult<usize> {
    usize::try_from(value)
        .map_err(|_| PyValueError::new_err(format!("{name} must not be negative, got {value}")))
}

/// The double that prints like this float: 0.005 and not 0.004999999888241291.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().expect("a printed float is a float")
}

/// A frozen Python class around a struct of the core, with a getter per number.
macro_rules! mirror {
    ($name:ident, $core:ty, $doc:literal, [$($field:ident),*], [$($method:ident),*], { $($extra:tt)* }) => {
        #[doc = $doc]
        #[pyclass(frozen, eq, module = "rsoccer._core")]
        #[derive(Clone, PartialEq)]
        pub(crate) struct $name($core);

        #[pymethods]
        impl $name {
            #[getter]
            fn name(&self) -> &str {
                &self.0.name
            }

            $(#[getter]
            fn $field(&self) -> f64 {
                shortest(self.0.$field)
            })*

            $(#[getter]
            fn $method(&self) -> f64 {
                shortest(self.0.$method())
            })*

            $($extra)*

            fn __repr__(&self) -> String {
                format!("{:?}", self.0)
            }
        }
    };
}

mirror!(
    Field,
    rsim_core::Field,
    "A walled field, its lines and marks. Metres.",
    [
        length,
        width,
        goal_width,
        goal_depth,
        corner,
        wall_height,
        center_radius,
        goal_area_width,
        goal_area_depth,
        penalty_mark,
        free_ball_x,
        free_ball_y,
        line_width
    ],
    [half_length, half_width],
    {
        #[getter]
        fn max_robots(&self) -> usize {
            self.0.max_robots
        }
    }
);

mirror!(
    RobotModel,
    rsim_core::RobotModel,
    "A robot as data. SI units.",
    [size, mass],
    [top_speed, bounding_radius],
    {
        #[getter]
        fn wheel_radius(&self) -> f64 {
            shortest(self.0.drive.wheel_radius)
        }

        #[getter]
        fn track(&self) -> f64 {
            shortest(self.0.drive.track)
        }

        #[getter]
        fn max_wheel_speed(&self) -> f64 {
            shortest(self.0.drive.max_wheel_speed)
        }

        #[getter]
        #[allow(clippy::unused_self)] // there is one kind of drive
        fn drive(&self) -> &'static str {
            "differential"
        }
    }
);

mirror!(
    BallModel,
    rsim_core::BallModel,
    "A ball as data. SI units.",
    [
        radius,
        mass,
        rolling_deceleration,
        robot_restitution,
        wall_restitution,
        robot_friction,
        wall_friction
    ],
    [],
    {}
);

//! Fields, robots and balls as frozen Python classes, built from a preset and replaced numbers.
//!
//! The numbers come from the core's tables: each becomes a read-only property with its documentation.

use std::hash::{DefaultHasher, Hash, Hasher};

use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyAttributeError, PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyCFunction, PyDict, PyString, PyTuple, PyType};
use rsim_core::{Drive, Number};
use serde_json::Value;

use crate::arguments::{required, text_or_path, unexpected};
use crate::config::invalid;
use crate::json::Unique;

/// End of the names of files that hold a model.
const SUFFIX: &str = ".json";
/// Ways to name a model, in words.
const NAMES: &str = "a preset's name, the path of a .json file";
/// Preset of models whose text has numbers alone, where there is one of this name.
const OFF: &str = "none";

/// A model class with presets and numbers.
pub(crate) trait Model: Sized + Clone + for<'py> FromPyObjectOwned<'py> {
    /// Name of the class in Python.
    const CLASS: &'static str;
    /// Name of its part of a file with several models.
    const PART: &'static str;
    /// Names for two numbers together.
    const OF_BOTH: &'static [(&'static str, [&'static str; 2])] = &[];

    fn preset(name: &str) -> PyResult<Self>;
    fn decoded(text: &str) -> PyResult<Self>;
    fn numbers() -> Vec<Number>;
    fn number_mut(&mut self, name: &str) -> Option<&mut f32>;
    fn name(&self) -> &str;
    fn validate(&self) -> PyResult<()>;

    /// A number by name; an `AttributeError` if this kind of model does not have it.
    fn number(&self, name: &str) -> PyResult<f64> {
        let mut model = self.clone();
        let found = model.number_mut(name).map(|value| shortest(*value));
        found.ok_or_else(|| PyAttributeError::new_err(format!("{} has no {name}", self.name())))
    }

    /// The model with some numbers replaced.
    fn with(mut self, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut given = Vec::new();
        for (key, value) in numbers.into_iter().flatten() {
            let key: String = key.extract()?;
            let number = if is_bool(&value)? { None } else { value.extract().ok() };
            let Some(number) = number else {
                return Err(unexpected(&key, "a number", &value));
            };
            given.push((key, number));
        }
        self.set_all(given)?;
        self.validate()?;
        Ok(self)
    }

    /// Replaces numbers, whatever their order: those with a name of their own after those that two have together.
    fn set_all(&mut self, mut numbers: Vec<(String, f32)>) -> PyResult<()> {
        let is_of_both = |key: &str| Self::OF_BOTH.iter().any(|(both, _)| *both == key);
        numbers.sort_by_key(|(key, _)| !is_of_both(key));
        numbers.iter().try_for_each(|(key, value)| self.set(key, *value))
    }

    /// Replaces a number, or two that have a name together; a `ValueError` if this kind of model does not
    /// have it.
    fn set(&mut self, key: &str, value: f32) -> PyResult<()> {
        if let Some((_, names)) = Self::OF_BOTH.iter().find(|(both, _)| *both == key) {
            return names.iter().try_for_each(|name| self.set(name, value));
        }
        if let Some(place) = self.number_mut(key) {
            *place = value;
            return Ok(());
        }
        let names = Self::numbers().into_iter().map(|number| number.name);
        let valid: Vec<&str> = names.filter(|name| self.number(name).is_ok()).collect();
        let (name, valid) = (self.name(), valid.join(", "));
        Err(PyValueError::new_err(format!("{name} has no {key:?}; its numbers are {valid}")))
    }

    /// The model of a JSON text: of `to_json`, a preset's name with the numbers that differ, or an object
    /// with one of these as its part.
    fn parsed(text: &str) -> PyResult<Self> {
        let numbers = match serde_json::from_str(text) {
            Err(error) if error.is_data() => return Err(Self::undecodable(&error)),
            Ok(Unique(Value::Object(numbers))) => Some(numbers),
            _ => None,
        };
        let Some(mut numbers) = numbers else {
            return Self::decoded(text)?.with(None);
        };
        if let Some(part @ Value::Object(_)) = numbers.get(Self::PART) {
            let within =
                |error| PyValueError::new_err(format!("{}: {}", Self::PART, message(&error)));
            return Self::parsed(&part.to_string()).map_err(within);
        }
        let mut model = match numbers.remove("preset") {
            Some(Value::String(name)) => Self::preset(&name)?,
            Some(other) => {
                let expected = "preset: expected a preset's name";
                return Err(PyValueError::new_err(format!("{expected}, got {other}")));
            }
            None => match Self::preset(OFF) {
                Ok(model) if !numbers.is_empty() && !numbers.contains_key("name") => model,
                _ => return Self::decoded(text)?.with(None),
            },
        };
        let mut given = Vec::new();
        for (key, value) in numbers {
            let Some(number) = value.as_f64() else {
                return Err(PyValueError::new_err(format!(
                    "{key}: expected a number, got {value}"
                )));
            };
            given.push((key, narrowed(number)));
        }
        model.set_all(given)?;
        model.validate()?;
        Ok(model)
    }

    /// The error of a JSON text that holds no such model.
    fn undecodable(error: &serde_json::Error) -> PyErr {
        PyValueError::new_err(format!("text is not a {}: {error}", Self::CLASS))
    }

    /// The model in a file.
    fn read(path: &str) -> PyResult<Self> {
        let text = std::fs::read_to_string(path).map_err(|error| {
            let reason = format!("cannot read {path}: {error}");
            match error.kind() {
                std::io::ErrorKind::NotFound => PyFileNotFoundError::new_err(reason),
                _ => PyValueError::new_err(reason),
            }
        })?;
        let within = |error| PyValueError::new_err(format!("{path}: {}", message(&error)));
        Self::parsed(&text).map_err(within)
    }

    /// A hash of the name and the numbers, equal for equal models.
    fn hashed(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.name().hash(&mut hasher);
        let numbers = Self::numbers();
        let values = numbers.iter().filter_map(|number| self.number(number.name).ok());
        values.for_each(|value| (value + 0.0).to_bits().hash(&mut hasher)); // -0 equals 0
        hasher.finish()
    }
}

/// Message of an error, without its type.
fn message(error: &PyErr) -> String {
    Python::attach(|py| error.value(py).to_string())
}

/// The model that an argument is or names: a model, a preset's name, or a file.
pub(crate) fn named<T: Model>(argument: &str, value: &Bound<'_, PyAny>) -> PyResult<T> {
    match value.extract() {
        Ok(model) => Ok(model),
        Err(_) => found(argument, &format!("{NAMES} or a {}", T::CLASS), value),
    }
}

/// The model that an argument names.
fn found<T: Model>(argument: &str, expected: &str, value: &Bound<'_, PyAny>) -> PyResult<T> {
    match text_or_path(value)? {
        Some(text) => of_text(&text),
        None => Err(unexpected(argument, expected, value)),
    }
}

/// The model that a text names: a preset or a file, and numbers that differ, as in `rc2021, delay=0.1`.
fn of_text<T: Model>(text: &str) -> PyResult<T> {
    if text.ends_with(SUFFIX) {
        return T::read(text);
    }
    if !text.contains('=') {
        return T::preset(text);
    }
    let mut parts = text.split(',').map(str::trim).peekable();
    let name = parts.next_if(|part| !part.contains('='));
    let mut model: T = match name {
        Some(name) => of_text(name)?,
        None => T::preset(OFF).or_else(|_| T::preset(text))?,
    };
    let within = |error: String| PyValueError::new_err(format!("{}: {error}", T::PART));
    let mut given: Vec<(String, f32)> = Vec::new();
    for part in parts {
        let Some((key, number)) = replaced(part) else {
            return Err(within(format!(
                "expected number=value after the name and a comma, as in 'rc2021, delay=0.1', got \
                 {part:?} in {text:?}"
            )));
        };
        if given.iter().any(|(before, _)| before == key) {
            return Err(within(format!(
                "expected each number once, got {key:?} twice in {text:?}"
            )));
        }
        given.push((key.to_owned(), number));
    }
    model.set_all(given).map_err(|error| within(message(&error)))?;
    model.validate()?;
    Ok(model)
}

/// Name and value of a number in a text, as in `delay=0.1`.
fn replaced(part: &str) -> Option<(&str, f32)> {
    let (key, value) = part.split_once('=')?;
    let key = key.trim();
    let number = value.trim().parse().ok()?;
    (!key.contains(char::is_whitespace)).then_some((key, narrowed(number)))
}

/// Whether a value is a bool, which converts to a number: Python's or `NumPy`'s.
fn is_bool(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    let class = value.get_type();
    Ok(value.is_instance_of::<PyBool>()
        || (class.module()? == "numpy" && class.name()?.to_str()?.starts_with("bool")))
}

/// The nearest float.
#[expect(clippy::cast_possible_truncation, reason = "rounding is meant; the range is checked")]
fn narrowed(value: f64) -> f32 {
    value as f32
}

/// The double that prints like this float: 0.005 and not 0.004999999888241291.
pub(crate) fn shortest(value: f32) -> f64 {
    value.to_string().parse().expect("a printed float is a float")
}

/// Adds a read-only property for each number to a model class.
pub(crate) fn add_numbers<T>(py: Python<'_>) -> PyResult<()>
where
    T: Model + pyo3::PyClass + Sync,
{
    let class = py.get_type::<T>();
    let property = py.import("builtins")?.getattr("property")?;
    for number in T::numbers() {
        let getter = PyCFunction::new_closure(
            py,
            None,
            None,
            move |args: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<f64> {
                let model = args.get_item(0)?.cast_into::<T>()?;
                model.borrow().number(number.name)
            },
        )?;
        let none = py.None();
        let doc = PyString::new(py, &number.doc());
        class.setattr(number.name, property.call1((getter, &none, &none, doc))?)?;
    }
    Ok(())
}

/// A frozen Python class around a model of the core.
macro_rules! mirror {
    ($name:ident, $part:literal, $doc:literal, { $($extra:tt)* }) => {
        mirror!($name, $part, $doc, both &[], new {
            #[new]
            #[pyo3(signature = (name, **numbers))]
            fn new(name: &Bound<'_, PyAny>, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
                let expected = "a preset's name or the path of a .json file";
                found::<Self>("name", expected, name)?.with(numbers)
            }
        }, { $($extra)* });
    };
    ($name:ident, $part:literal, $doc:literal, both $both:expr, new { $($new:tt)* }, { $($extra:tt)* }) => {
        #[doc = $doc]
        #[pyclass(frozen, eq, from_py_object, module = "rsoccer._core")]
        #[derive(Clone, PartialEq)]
        pub(crate) struct $name(pub(crate) rsim_core::$name);

        impl Model for $name {
            const CLASS: &'static str = stringify!($name);
            const PART: &'static str = $part;
            const OF_BOTH: &'static [(&'static str, [&'static str; 2])] = $both;

            fn preset(name: &str) -> PyResult<Self> {
                Ok(Self(rsim_core::$name::preset(name).map_err(invalid)?))
            }

            fn decoded(text: &str) -> PyResult<Self> {
                serde_json::from_str(text).map(Self).map_err(|error| Self::undecodable(&error))
            }

            fn numbers() -> Vec<Number> {
                rsim_core::$name::numbers()
            }

            fn number_mut(&mut self, name: &str) -> Option<&mut f32> {
                self.0.number_mut(name)
            }

            fn name(&self) -> &str {
                &self.0.name
            }

            fn validate(&self) -> PyResult<()> {
                self.0.validate().map_err(invalid)
            }
        }

        #[pymethods]
        impl $name {
            $($new)*

            #[classattr]
            #[pyo3(name = "PRESETS")]
            fn presets(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
                PyTuple::new(py, rsim_core::$name::PRESETS.iter().map(|preset| &*preset.name))
            }

            #[getter(name)]
            fn get_name(&self) -> &str {
                &self.0.name
            }

            $($extra)*

            fn to_json(&self) -> String {
                serde_json::to_string(&self.0).expect("plain data always encodes")
            }

            #[classmethod]
            fn from_json(
                _class: &Bound<'_, PyType>,
                text: &Bound<'_, PyAny>,
            ) -> PyResult<Self> {
                let expected = concat!("JSON of a ", stringify!($name));
                Self::parsed(&required::<String>("text", expected, text)?)
            }

            fn __hash__(&self) -> u64 {
                self.hashed()
            }

            fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
                Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json(),)))
            }

            fn __repr__(&self) -> String {
                format!("{:?}", self.0)
            }
        }
    };
}

mirror!(
    Field,
    "field",
    "A field: play area, goals, walls, and the lines and marks on the floor. SI units.",
    {
        #[getter]
        fn half_length(&self) -> f64 {
            shortest(self.0.half_length())
        }

        #[getter]
        fn half_width(&self) -> f64 {
            shortest(self.0.half_width())
        }

        #[getter]
        fn max_x(&self) -> f64 {
            shortest(self.0.max_x())
        }

        #[getter]
        fn max_y(&self) -> f64 {
            shortest(self.0.max_y())
        }

        #[getter]
        fn max_robots(&self) -> usize {
            self.0.max_robots
        }
    }
);

mirror!(
    BallModel,
    "ball",
    "A ball with the floor that it rolls on and the surfaces that it hits. SI units.",
    {}
);

mirror!(RobotModel, "robot", "A robot: body, drive, and mouth if it has one. SI units.", {
    #[getter]
    fn bounding_radius(&self) -> f64 {
        shortest(self.0.bounding_radius())
    }

    #[getter]
    fn top_speed(&self) -> f64 {
        shortest(self.0.top_speed())
    }

    #[getter]
    fn top_angular_velocity(&self) -> f64 {
        shortest(self.0.top_angular_velocity())
    }

    #[getter]
    fn has_mouth(&self) -> bool {
        self.0.mouth.is_some()
    }

    #[getter]
    fn drive(&self) -> &'static str {
        match self.0.drive {
            Drive::Differential(_) => "differential",
            Drive::Omni(_) => "omni",
            Drive::OmniWheels(_) => "omni_wheels",
        }
    }

    #[getter]
    fn wheel_angles(&self) -> PyResult<[f64; 4]> {
        match &self.0.drive {
            Drive::Omni(drive) | Drive::OmniWheels(drive) => Ok(drive.wheel_angles.map(shortest)),
            Drive::Differential(_) => {
                Err(PyAttributeError::new_err(format!("{} has no wheel_angles", self.0.name)))
            }
        }
    }

    #[getter]
    fn command_columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.command_columns())
    }
});

mirror!(
    Sensing,
    "sensing",
    "What lies between the true state and what robots know, and between commands and what they do.",
    both &[
        ("position_noise", ["ball_position_noise", "robot_position_noise"]),
        ("missing", ["missing_balls", "missing_robots"]),
    ],
    new {
        #[new]
        #[pyo3(signature = (name = None, **numbers))]
        fn new(
            name: Option<&Bound<'_, PyAny>>,
            numbers: Option<&Bound<'_, PyDict>>,
        ) -> PyResult<Self> {
            let expected = "a preset's name or the path of a .json file";
            let sensing = match name {
                Some(name) => found::<Self>("name", expected, name)?,
                None => Self(rsim_core::Sensing::OFF),
            };
            sensing.with(numbers)
        }
    },
    {
        #[classmethod]
        #[pyo3(name = "preset")]
        fn of_preset(_class: &Bound<'_, PyType>, name: &Bound<'_, PyAny>) -> PyResult<Self> {
            <Self as Model>::preset(&required::<String>("name", "a preset's name", name)?)
        }

        #[getter]
        fn is_off(&self) -> bool {
            self.0.is_off()
        }
    }
);

//! Arguments from Python: their conversion, with errors that name them.

use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyString;

/// An argument with a default; None if it is left out, not for Python's None.
pub(crate) type Given<'py> = Option<Bound<'py, PyAny>>;

/// An argument as it is, for `argument` to convert.
#[expect(clippy::unnecessary_wraps, reason = "the type that PyO3 expects of a converter")]
pub(crate) fn given<'py>(value: &Bound<'py, PyAny>) -> PyResult<Given<'py>> {
    Ok(Some(value.clone()))
}

/// Converts an argument; a `TypeError` for another type says its name and what was expected.
pub(crate) fn argument<'py, T: FromPyObjectOwned<'py>>(
    name: &str,
    expected: &str,
    value: Given<'py>,
    default: impl FnOnce() -> T,
) -> PyResult<T> {
    value.map_or_else(|| Ok(default()), |value| required(name, expected, &value))
}

/// Converts an argument without a default, as [`argument`] does.
pub(crate) fn required<'py, T: FromPyObjectOwned<'py>>(
    name: &str,
    expected: &str,
    value: &Bound<'py, PyAny>,
) -> PyResult<T> {
    value.extract().map_err(|error: <T as FromPyObject<'_, 'py>>::Error| {
        let error: PyErr = error.into();
        if error.is_instance_of::<PyTypeError>(value.py()) {
            return unexpected(name, expected, value);
        }
        error
    })
}

/// The text of an argument that is text or a path-like object; None for another one.
pub(crate) fn text_or_path(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    if !value.is_instance_of::<PyString>() && !value.hasattr("__fspath__")? {
        return Ok(None);
    }
    let text = value.py().import("os")?.call_method1("fspath", (value,))?;
    Ok(text.extract().ok()) // paths may be bytes
}

/// A `TypeError` for an argument of another type than expected.
pub(crate) fn unexpected(name: &str, expected: &str, value: &Bound<'_, PyAny>) -> PyErr {
    PyTypeError::new_err(format!("{name}: expected {expected}, got {value:?}"))
}

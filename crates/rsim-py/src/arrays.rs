//! Checks of arrays from Python. Every message names the argument, the expected value and the given
//! one.

use std::borrow::Cow;
use std::ops::Range;

use numpy::{
    Element, Ix1, Ix2, Ix3, IxDyn, PyArray, PyArrayDescrMethods, PyArrayMethods, PyReadonlyArray,
    PyReadwriteArray, PyUntypedArray, PyUntypedArrayMethods, ndarray,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Checks element type and shape of an array, and borrows it for reading.
pub(crate) fn readable<'py, T: Element, D: ndarray::Dimension>(
    name: &str,
    value: &Bound<'py, PyAny>,
    shape: &[usize],
) -> PyResult<PyReadonlyArray<'py, T, D>> {
    Ok(checked(name, value, shape)?.try_readonly()?)
}

/// Checks element type, shape, memory order and permission of an array, and borrows it for writing.
pub(crate) fn writeable<'py, T: Element, D: ndarray::Dimension>(
    name: &str,
    value: &Bound<'py, PyAny>,
    shape: &[usize],
) -> PyResult<PyReadwriteArray<'py, T, D>> {
    let array = checked::<T, D>(name, value, shape)?;
    if !array.is_c_contiguous() {
        return Err(PyValueError::new_err(format!("{name} must be C-contiguous")));
    }
    let array = array.try_readwrite();
    array.map_err(|error| PyValueError::new_err(format!("{name} must be writeable: {error}")))
}

fn checked<'py, T: Element, D: ndarray::Dimension>(
    name: &str,
    value: &Bound<'py, PyAny>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    let expected = T::get_dtype(value.py());
    let Ok(array) = value.cast::<PyUntypedArray>() else {
        let got = value.get_type().name()?;
        return Err(PyTypeError::new_err(format!(
            "{name} must be an array of {expected}, got {got}"
        )));
    };
    if !array.dtype().is_equiv_to(&expected) {
        let got = array.dtype();
        return Err(PyTypeError::new_err(format!(
            "{name} must be an array of {expected}, got {got}"
        )));
    }
    if array.shape() != shape {
        let (expected, got) = (tuple(shape), tuple(array.shape()));
        return Err(PyValueError::new_err(format!("{name} must have shape {expected}, got {got}")));
    }
    Ok(value.cast::<PyArray<T, D>>()?.clone())
}

/// The shape of an array, which must have `N` axes.
pub(crate) fn sizes<const N: usize>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<[usize; N]> {
    let Ok(array) = value.cast::<PyUntypedArray>() else {
        let got = value.get_type().name()?;
        return Err(PyTypeError::new_err(format!("{name} must be an array, got {got}")));
    };
    array.shape().try_into().map_err(|_| {
        let got = tuple(array.shape());
        PyValueError::new_err(format!("{name} must have {N} axes, got shape {got}"))
    })
}

/// Checks that all values are finite.
pub(crate) fn finite(name: &str, values: &[f32]) -> PyResult<()> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(PyValueError::new_err(format!("{name} must be finite, got {value}"))),
    }
}

/// Values of an array in C order: borrowed if the array has that order, else copied.
pub(crate) fn values<'a, T: Element + Copy, D: ndarray::Dimension>(
    array: &'a PyReadonlyArray<'_, T, D>,
) -> Cow<'a, [T]> {
    match array.as_slice() {
        // The slice of an array in Fortran order has its values in that order.
        Ok(slice) if array.is_c_contiguous() => slice.into(),
        _ => array.as_array().iter().copied().collect::<Vec<_>>().into(),
    }
}

/// An input in C order, apart from the output: a copy if the two share memory, so that an array can be
/// given as both.
pub(crate) enum Input<'py, T: Element, D: ndarray::Dimension> {
    Borrowed(PyReadonlyArray<'py, T, D>),
    Copied(Vec<T>),
}

impl<'py, T: Element + Copy, D: ndarray::Dimension> Input<'py, T, D> {
    /// Checks element type and shape of an array; copies it if it has another order than C or shares
    /// memory with `out`, else borrows it.
    pub(crate) fn new(
        name: &str,
        value: &Bound<'py, PyAny>,
        shape: &[usize],
        out: &Bound<'py, PyAny>,
    ) -> PyResult<Self> {
        let array = readable(name, value, shape)?;
        let copied = match values(&array) {
            Cow::Borrowed(borrowed) if !shares_memory(borrowed, out) => None,
            values => Some(values.into_owned()),
        };
        Ok(copied.map_or(Self::Borrowed(array), Self::Copied))
    }

    pub(crate) fn values(&self) -> Cow<'_, [T]> {
        match self {
            Self::Borrowed(array) => values(array),
            Self::Copied(copied) => copied.into(),
        }
    }
}

/// Whether values lie in the memory of an output. An output that is not in C order is none.
fn shares_memory<T>(values: &[T], out: &Bound<'_, PyAny>) -> bool {
    let Ok(out) = out.cast::<PyArray<f32, IxDyn>>() else { return false };
    let Ok(out) = out.try_readonly() else { return false };
    let Ok(out) = out.as_slice() else { return false };
    let [values, out] = [address_range(values), address_range(out)];
    values.start < out.end && out.start < values.end
}

fn address_range<T>(values: &[T]) -> Range<usize> {
    let Range { start, end } = values.as_ptr_range();
    start.addr()..end.addr()
}

fn tuple(shape: &[usize]) -> String {
    let sizes = shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    if shape.len() == 1 { format!("({sizes},)") } else { format!("({sizes})") }
}

pub(crate) type Mask<'py> = PyReadonlyArray<'py, bool, Ix1>;
pub(crate) type RobotsMask<'py> = PyReadonlyArray<'py, bool, Ix2>;
pub(crate) type Keys<'py> = PyReadonlyArray<'py, u64, Ix1>;
pub(crate) type Rows<'py> = PyReadonlyArray<'py, f32, Ix2>;
pub(crate) type InputRows<'py> = Input<'py, f32, Ix2>;
pub(crate) type RowsOut<'py> = PyReadwriteArray<'py, f32, Ix2>;
pub(crate) type Commands<'py> = PyReadonlyArray<'py, f32, Ix3>;

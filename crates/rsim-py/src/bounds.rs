//! Clipping of observations and actions.

use std::ops::Neg;

use numpy::{
    Ix1, Ix3, IxDyn, PyArray, PyArrayMethods, PyReadonlyArray, PyReadwriteArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{self, Input, readable, sizes, writeable};
use crate::config::count;

/// Clips values (n, observers, o) to [-bounds, bounds] in place; `bounds` is (o,).
#[pyfunction]
pub(crate) fn clip_in_place(
    py: Python<'_>,
    values: &Bound<'_, PyAny>,
    bounds: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let [n, observers, size] = sizes("values", values)?;
    let mut values: PyReadwriteArray<'_, f32, Ix3> =
        writeable("values", values, &[n, observers, size])?;
    let bounds: PyReadonlyArray<'_, f32, Ix1> = readable("bounds", bounds, &[size])?;
    let (bounds, values) = (arrays::values(&bounds), values.as_slice_mut()?);
    check_bounds(&bounds)?;
    py.detach(|| values.chunks_exact_mut(size.max(1)).for_each(|row| clip_row(row, &bounds)));
    Ok(())
}

/// Writes values (n, observers, k), clipped to [-bounds, bounds], to the columns of `out` (n, observers, o) from `first`
/// on; `bounds` is (k,).
#[pyfunction]
pub(crate) fn write_clipped(
    py: Python<'_>,
    values: &Bound<'_, PyAny>,
    bounds: &Bound<'_, PyAny>,
    out: &Bound<'_, PyAny>,
    first: i64,
) -> PyResult<()> {
    let [n, observers, size] = sizes("values", values)?;
    let values: Input<'_, f32, Ix3> = Input::new("values", values, &[n, observers, size], out)?;
    let bounds: PyReadonlyArray<'_, f32, Ix1> = readable("bounds", bounds, &[size])?;
    let [_, _, columns] = sizes("out", out)?;
    let mut out: PyReadwriteArray<'_, f32, Ix3> = writeable("out", out, &[n, observers, columns])?;
    let first = count("first", first)?;
    if first.saturating_add(size) > columns {
        return Err(PyValueError::new_err(format!(
            "first must leave {size} of the {columns} columns of out, got {first}"
        )));
    }
    let (values, bounds, out) = (values.values(), arrays::values(&bounds), out.as_slice_mut()?);
    check_bounds(&bounds)?;
    py.detach(|| {
        let rows = out.chunks_exact_mut(columns.max(1)).zip(values.chunks_exact(size.max(1)));
        for (row, values) in rows {
            let row = &mut row[first..first + size];
            row.copy_from_slice(values);
            clip_row(row, &bounds);
        }
    });
    Ok(())
}

/// Checks that all bounds are 0 or above.
pub(crate) fn check_bounds(bounds: &[f32]) -> PyResult<()> {
    match bounds.iter().find(|bound| bound.is_nan() || **bound < 0.0) {
        None => Ok(()),
        Some(bound) => {
            Err(PyValueError::new_err(format!("bounds must be 0 or above, got {bound}")))
        }
    }
}

/// Clips each value of a row to its bound.
pub(crate) fn clip_row(row: &mut [f32], bounds: &[f32]) {
    for (value, bound) in row.iter_mut().zip(bounds) {
        *value = clip(*value, *bound);
    }
}

/// Returns a copy clipped to [-1, 1] of a finite float32 array of this shape, else None.
#[pyfunction]
pub(crate) fn clip_actions<'py>(
    value: &Bound<'py, PyAny>,
    shape: Vec<usize>,
) -> Option<Bound<'py, PyArray<f32, IxDyn>>> {
    let array = value.cast::<PyArray<f32, IxDyn>>().ok()?;
    if array.shape() != shape {
        return None;
    }
    let given = array.try_readonly().ok()?;
    let given = arrays::values(&given);
    if !given.iter().all(|value| value.is_finite()) {
        return None;
    }
    let clipped = PyArray::zeros(value.py(), shape, false);
    {
        let mut out = clipped.readwrite();
        for (out, value) in out.as_slice_mut().ok()?.iter_mut().zip(&*given) {
            *out = clip(*value, 1.0);
        }
    }
    Some(clipped)
}

/// Clips a value to [-bound, bound]; NaN stays. Unlike `clamp` this has nothing to check, so a loop
/// of it is vectorized: each of the two choices is one instruction for several values.
pub(crate) fn clip<T: Copy + PartialOrd + Neg<Output = T>>(value: T, bound: T) -> T {
    let value = if bound < value { bound } else { value };
    if -bound > value { -bound } else { value }
}

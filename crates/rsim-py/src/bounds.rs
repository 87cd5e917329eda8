//! Bounds on numbers that are looked at in every step.

use numpy::{
    Ix1, IxDyn, PyArray, PyArrayMethods, PyReadonlyArray, PyReadwriteArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{readable, sizes, values, writeable};

/// Clips numbers (n, seers, o) to [-most, most], in place; `most` is (o,).
#[pyfunction]
pub(crate) fn limit(
    py: Python<'_>,
    numbers: &Bound<'_, PyAny>,
    most: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let [n, seers, size] = sizes("numbers", numbers)?;
    let mut numbers: PyReadwriteArray<'_, f32, numpy::Ix3> =
        writeable("numbers", numbers, &[n, seers, size])?;
    let most: PyReadonlyArray<'_, f32, Ix1> = readable("most", most, &[size])?;
    let (most, numbers) = (values(&most), numbers.as_slice_mut()?);
    if most.iter().any(|most| most.is_nan() || *most < 0.0) {
        return Err(PyValueError::new_err("most must be 0 or above"));
    }
    py.detach(|| {
        for row in numbers.chunks_exact_mut(size.max(1)) {
            for (number, most) in row.iter_mut().zip(&*most) {
                *number = clip(*number, *most);
            }
        }
    });
    Ok(())
}

/// A copy clipped to [-1, 1] of a float32 array that has this shape and is finite, else None.
#[pyfunction]
pub(crate) fn clipped<'py>(
    value: &Bound<'py, PyAny>,
    shape: Vec<usize>,
) -> Option<Bound<'py, PyArray<f32, IxDyn>>> {
    let array = value.cast::<PyArray<f32, IxDyn>>().ok()?;
    if array.shape() != shape {
        return None;
    }
    let given = array.try_readonly().ok()?;
    let given = values(&given);
    if !given.iter().all(|number| number.is_finite()) {
        return None;
    }
    let clipped = PyArray::zeros(value.py(), shape, false);
    {
        let mut out = clipped.readwrite();
        for (out, number) in out.as_slice_mut().ok()?.iter_mut().zip(&*given) {
            *out = clip(*number, 1.0);
        }
    }
    Some(clipped)
}

/// Within [-most, most]. Unlike `clamp` it has nothing to check, so a loop of it is vectorised.
fn clip(number: f32, most: f32) -> f32 {
    if number > most {
        most
    } else if number < -most {
        -most
    } else {
        number
    }
}

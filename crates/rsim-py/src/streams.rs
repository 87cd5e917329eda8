//! Draws from the random number streams of many worlds.

use std::f32::consts::TAU;

use numpy::{Element, Ix1, PyArray2, PyReadonlyArray, ndarray::Array2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::streams::{unit, units, words};

use crate::arrays::{self, readable, sizes};

/// More numbers than anybody needs at once; a larger number is a mistake.
const MAX_TOTAL: usize = 1 << 31;

type Drawn<'py, T> = Bound<'py, PyArray2<T>>;

/// Returns the next words (n, count) of streams with these states (n,).
#[pyfunction]
pub(crate) fn random_words<'py>(
    py: Python<'py>,
    states: &Bound<'py, PyAny>,
    count: usize,
) -> PyResult<Drawn<'py, u64>> {
    drawn(py, states, count, |word| word)
}

/// Returns numbers (n, count) from `low` to below `low + width` of streams with these states (n,).
#[pyfunction]
pub(crate) fn uniform<'py>(
    py: Python<'py>,
    states: &Bound<'py, PyAny>,
    count: usize,
    low: f32,
    width: f32,
) -> PyResult<Drawn<'py, f32>> {
    drawn(py, states, count, |word| low + width * unit(word))
}

/// Returns inputs (n, count) of the Box-Muller transform of streams with these states (n,): of its
/// logarithm, and the angles.
#[pyfunction]
pub(crate) fn normal_inputs<'py>(
    py: Python<'py>,
    states: &Bound<'py, PyAny>,
    count: usize,
) -> PyResult<(Drawn<'py, f32>, Drawn<'py, f32>)> {
    let [n] = sizes("states", states)?;
    let states: PyReadonlyArray<'_, u64, Ix1> = readable("states", states, &[n])?;
    let all = total(n, count)?;
    let [mut first, mut second] = [(); 2].map(|()| Vec::with_capacity(all));
    for word in words(&arrays::values(&states), count) {
        let [one, other] = units(word);
        first.push(one);
        second.push(TAU * other);
    }
    Ok((array(py, n, count, first), array(py, n, count, second)))
}

/// A number of each word.
fn drawn<'py, T: Element>(
    py: Python<'py>,
    states: &Bound<'py, PyAny>,
    count: usize,
    number: impl Fn(u64) -> T,
) -> PyResult<Drawn<'py, T>> {
    let [n] = sizes("states", states)?;
    let states: PyReadonlyArray<'_, u64, Ix1> = readable("states", states, &[n])?;
    let mut all = Vec::with_capacity(total(n, count)?);
    all.extend(words(&arrays::values(&states), count).map(number));
    Ok(array(py, n, count, all))
}

/// Numbers of `n` streams together.
fn total(n: usize, count: usize) -> PyResult<usize> {
    n.max(1).checked_mul(count).filter(|total| *total <= MAX_TOTAL).map(|_| n * count).ok_or_else(
        || {
            let expected = MAX_TOTAL / n.max(1);
            PyValueError::new_err(format!("count must be at most {expected}, got {count}"))
        },
    )
}

fn array<T: Element>(py: Python<'_>, n: usize, count: usize, all: Vec<T>) -> Drawn<'_, T> {
    let array = Array2::from_shape_vec((n, count), all).expect("one number of each word");
    PyArray2::from_owned_array(py, array)
}

//! Running means and variances of columns, and rows normalized with them.

use numpy::{Ix1, Ix2, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{self, readable, sizes};
use crate::bounds::clip;

type Column<'py> = Bound<'py, PyArray1<f64>>;
type Rows<'py> = PyReadonlyArray<'py, f32, Ix2>;
type Numbers<'py> = PyReadonlyArray<'py, f64, Ix1>;

/// Returns means and variances (o,) of `count` earlier rows and of rows (n, o) together.
///
/// Deviations are from the earlier mean, so their squares lose no digits once it is near.
#[pyfunction]
pub(crate) fn pooled_moments<'py>(
    py: Python<'py>,
    rows: &Bound<'py, PyAny>,
    mean: &Bound<'py, PyAny>,
    variance: &Bound<'py, PyAny>,
    count: f64,
) -> PyResult<(Column<'py>, Column<'py>)> {
    let ([n, size], rows, mean, variance) = borrow(rows, mean, variance)?;
    let total = total("rows", n, count)?;
    let (rows, mean) = (arrays::values(&rows), arrays::values(&mean));
    let (mut sums, mut squares) = (vec![0.0; size], vec![0.0; size]);
    for row in rows.chunks_exact(size.max(1)) {
        let columns = sums.iter_mut().zip(&mut squares);
        for ((sum, square), (value, mean)) in columns.zip(row.iter().zip(&*mean)) {
            let deviation = f64::from(*value) - mean;
            *sum += deviation;
            *square += deviation * deviation;
        }
    }
    let columns = sums.iter_mut().zip(&mut squares);
    for ((sum, square), (mean, variance)) in
        columns.zip(mean.iter().zip(&*arrays::values(&variance)))
    {
        (*sum, *square) = pooled(*mean, *variance * count + *square, *sum / total, total);
    }
    Ok((PyArray1::from_vec(py, sums), PyArray1::from_vec(py, squares)))
}

/// Multiplies returns (n,) by a discount and adds rewards (n,) to them, in place; returns mean and
/// variance of `count` earlier returns and of these together.
#[pyfunction]
pub(crate) fn add_rewards(
    returns: &Bound<'_, PyArray1<f64>>,
    rewards: &Bound<'_, PyAny>,
    discount: f64,
    mean: f64,
    variance: f64,
    count: f64,
) -> PyResult<(f64, f64)> {
    let mut returns = returns.try_readwrite()?;
    let returns = returns.as_slice_mut()?;
    let rewards: PyReadonlyArray<'_, f32, Ix1> = readable("rewards", rewards, &[returns.len()])?;
    let total = total("returns", returns.len(), count)?;
    let (mut sum, mut squares) = (0.0, 0.0);
    for (value, reward) in returns.iter_mut().zip(&*arrays::values(&rewards)) {
        *value = *value * discount + f64::from(*reward);
        let deviation = *value - mean;
        sum += deviation;
        squares += deviation * deviation;
    }
    Ok(pooled(mean, variance * count + squares, sum / total, total))
}

/// Borrows rows (n, o), mean (o,) and variance (o,); returns n and o, too.
fn borrow<'py>(
    rows: &Bound<'py, PyAny>,
    mean: &Bound<'py, PyAny>,
    variance: &Bound<'py, PyAny>,
) -> PyResult<([usize; 2], Rows<'py>, Numbers<'py>, Numbers<'py>)> {
    let [n, size] = sizes("rows", rows)?;
    Ok((
        [n, size],
        readable("rows", rows, &[n, size])?,
        readable("mean", mean, &[size])?,
        readable("variance", variance, &[size])?,
    ))
}

/// Mean and variance of `total` values, from their sum of squares and their mean deviation, both
/// relative to an earlier mean.
fn pooled(mean: f64, squares: f64, shift: f64, total: f64) -> (f64, f64) {
    (mean + shift, squares / total - shift * shift)
}

/// Number of earlier values and further ones, which must be above 0.
fn total(name: &str, further: usize, count: f64) -> PyResult<f64> {
    #[allow(clippy::cast_precision_loss)] // fewer than 2^53
    let total = count + further as f64;
    if count >= 0.0 && total > 0.0 {
        return Ok(total);
    }
    Err(PyValueError::new_err(format!(
        "count must be 0 or above, and above 0 without {name}, got {count}"
    )))
}

/// Returns rows (n, o) less their mean, divided by sqrt(variance + epsilon) and clipped to
/// [-limit, limit].
#[pyfunction]
pub(crate) fn normalized<'py>(
    py: Python<'py>,
    rows: &Bound<'py, PyAny>,
    mean: &Bound<'py, PyAny>,
    variance: &Bound<'py, PyAny>,
    epsilon: f64,
    limit: f64,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let ([n, size], rows, mean, variance) = borrow(rows, mean, variance)?;
    if limit.is_nan() || limit < 0.0 {
        return Err(PyValueError::new_err(format!("limit must be 0 or above, got {limit}")));
    }
    let factors: Vec<f64> =
        arrays::values(&variance).iter().map(|each| 1.0 / (each + epsilon).sqrt()).collect();
    let (rows, mean) = (arrays::values(&rows), arrays::values(&mean));
    let out = PyArray2::zeros(py, [n, size], false);
    let mut values = out.readwrite();
    let size = size.max(1);
    let pairs = values.as_slice_mut()?.chunks_exact_mut(size).zip(rows.chunks_exact(size));
    for (out, row) in pairs {
        let columns = mean.iter().zip(&factors);
        for ((out, value), (mean, factor)) in out.iter_mut().zip(row).zip(columns) {
            #[allow(clippy::cast_possible_truncation)] // float32, as rows are
            let normalized = clip((f64::from(*value) - mean) * factor, limit) as f32;
            *out = normalized;
        }
    }
    drop(values);
    Ok(out)
}

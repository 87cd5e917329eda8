//! Threads that share the work on many rows.

use numpy::{IxDyn, PyReadonlyArray, PyReadwriteArray, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arguments::required;
use crate::arrays::{readable, values, writeable};
use crate::config::{count, invalid};

/// Most values that are copied by the caller's thread alone: waking others would take longer.
const COPIED_ALONE: usize = 128 * 1024;

/// Threads that the caller's thread shares work with.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Threads(pub(crate) rsim_core::Threads);

#[pymethods]
impl Threads {
    #[new]
    #[pyo3(signature = (count = 1))]
    fn new(py: Python<'_>, count: i64) -> PyResult<Self> {
        let number = self::count("threads", count)?;
        py.detach(|| rsim_core::Threads::new(number)).map(Self).map_err(invalid)
    }

    #[getter]
    fn count(&self) -> usize {
        self.0.count()
    }

    fn copy(
        &self,
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let shape = source.cast::<PyUntypedArray>().map_or(vec![], |array| array.shape().to_vec());
        let source: PyReadonlyArray<'_, f32, IxDyn> = readable("source", source, &shape)?;
        let mut out: PyReadwriteArray<'_, f32, IxDyn> = writeable("out", out, &shape)?;
        let (source, out) = (values(&source), out.as_slice_mut()?);
        py.detach(|| {
            let portion = self.0.portion(out.len(), COPIED_ALONE / 2, usize::MAX);
            if out.len() <= COPIED_ALONE {
                return out.copy_from_slice(&source);
            }
            let portions = out.chunks_mut(portion).zip(source.chunks(portion));
            self.0.share(portions, |(out, source)| out.copy_from_slice(source));
        });
        Ok(())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (usize,)) {
        (slf.get_type().into_any(), (slf.get().count(),))
    }

    fn __repr__(&self) -> String {
        format!("Threads({})", self.count())
    }
}

/// Number of threads, or the threads themselves.
pub(crate) enum ThreadsOrCount<'py> {
    Threads(Bound<'py, Threads>),
    Count(i64),
}

impl<'py> ThreadsOrCount<'py> {
    /// Converts the argument `threads`.
    pub(crate) fn of_argument(value: &Bound<'py, PyAny>) -> PyResult<Self> {
        match value.cast::<Threads>() {
            Ok(threads) => Ok(Self::Threads(threads.clone())),
            Err(_) => required("threads", "a whole number or Threads", value).map(Self::Count),
        }
    }

    /// The given threads, or as many new ones as given.
    pub(crate) fn started(&self, py: Python<'_>) -> PyResult<rsim_core::Threads> {
        match self {
            Self::Threads(threads) => Ok(threads.get().0.clone()),
            Self::Count(number) => Ok(Threads::new(py, *number)?.0),
        }
    }
}

/// Writes rows of `out` on the given threads, or on the caller's thread alone; see
/// [`rsim_core::Threads::write_rows`].
pub(crate) fn write_rows<T: Send>(
    py: Python<'_>,
    threads: Option<&Threads>,
    out: &mut [T],
    size: usize,
    alone: usize,
    write: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    if out.is_empty() {
        return;
    }
    py.detach(|| match threads {
        Some(threads) => threads.0.write_rows(out, size, alone, write),
        None => out.chunks_exact_mut(size).enumerate().for_each(|(row, out)| write(row, out)),
    });
}

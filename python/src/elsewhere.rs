//! Evaluations of a run that are done elsewhere: what `gambol.train(..., cluster=...)` hands out.
//!
//! Nets and evaluations travel as MessagePack: smaller than JSON, and read without knowing the kind of net.

use crate::{episodes::registry, errors::wrong};
use gambol_runs::{config::RunConfig, training};
use ne_core::Evaluation;
use pyo3::{exceptions::PyRuntimeError, prelude::*, types::PyBytes};

/// The nets of a generation, or of a rung of it, that are to be evaluated.
#[pyclass(module = "gambol._gambol", frozen)]
pub(crate) struct Batch(training::Batch);

#[pymethods]
impl Batch {
    fn __len__(&self) -> usize {
        self.0.networks.len()
    }

    /// The nets from `start` to before `stop`, as bytes.
    fn piece<'py>(&self, py: Python<'py>, start: usize, stop: usize) -> PyResult<Bound<'py, PyBytes>> {
        let networks = self.0.networks.get(start..stop).ok_or_else(|| {
            wrong(format!("there is no piece from {start} to {stop} of {} individuals", self.0.networks.len()))
        })?;
        let bytes = py.detach(|| {
            let piece = training::Batch { networks: networks.to_vec(), rung: self.0.rung, seed: self.0.seed };
            rmp_serde::to_vec_named(&piece).map_err(wrong)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// Evaluates pieces of a run's batches, without the run.
#[pyclass(module = "gambol._gambol", frozen)]
pub(crate) struct BatchEvaluator(training::BatchEvaluator);

#[pymethods]
impl BatchEvaluator {
    /// `config`: that of the run, or of its stage, as JSON.
    #[new]
    fn new(config: &str) -> PyResult<Self> {
        let config = serde_json::from_str(config).map_err(wrong)?;
        Ok(Self(training::BatchEvaluator::new(&config, &registry()).map_err(wrong)?))
    }

    /// The evaluations of a piece, in its order, as bytes.
    fn evaluate<'py>(&self, py: Python<'py>, piece: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| {
            let piece = rmp_serde::from_slice(piece).map_err(wrong)?;
            rmp_serde::to_vec_named(&self.0.evaluate(piece)).map_err(wrong)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// Asks Python for the evaluations of a batch: `elsewhere` is called with the configuration and the batch, and returns the evaluations of
/// its pieces in their order, or `None` if they had better be done here.
pub(crate) fn ask(
    elsewhere: &Py<PyAny>,
    config: Option<&RunConfig>,
    batch: training::Batch,
) -> PyResult<Option<Vec<Evaluation>>> {
    let config = serde_json::to_string(&config).map_err(wrong)?;
    let pieces = Python::attach(|py| {
        let pieces = elsewhere.bind(py).call1((config, Batch(batch)))?;
        if pieces.is_none() { Ok(None) } else { pieces.extract::<Vec<Vec<u8>>>().map(Some) }
    })?;
    let Some(pieces) = pieces else { return Ok(None) };
    let read = |piece: &Vec<u8>| rmp_serde::from_slice::<Vec<Evaluation>>(piece);
    let evaluations: Result<Vec<_>, _> = pieces.iter().map(read).collect();
    Ok(Some(evaluations.map_err(|error| PyRuntimeError::new_err(error.to_string()))?.concat()))
}

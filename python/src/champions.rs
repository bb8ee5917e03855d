//! Champion files: what Python's `gambol.Champion` is made of.

use crate::{
    episodes::{names_in, registry},
    errors::wrong,
    movements::raised,
};
use gambol_exports::{Destination, Format, Options, Picture, export};
use gambol_reports::report;
use gambol_runs::{
    champion::Champion,
    gait,
    robust::{Perturbations, PerturbedReplays},
};
use ne_core::Phenotype as _;
use ne_net::Network;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::{
    exceptions::{PyFileExistsError, PyOSError},
    prelude::*,
};
use std::path::{Path, PathBuf};

/// A champion file, as JSON, once it has been checked.
#[pyfunction]
pub(crate) fn read_champion(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    py.detach(|| serde_json::to_string(&champion(&path)?).map_err(wrong))
}

/// Replays a champion in rapier: whether it repeats itself to the bit, its fitness now, and the first step that differs.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>, path: PathBuf) -> PyResult<(bool, Option<f64>, Option<u32>)> {
    py.detach(|| {
        let champion = champion(&path)?;
        let verification = believed(&champion, || champion.verify(&registry()).map_err(wrong))?;
        let fitness = verification.evaluation.fitness().map(ne_core::Fitness::get);
        Ok((verification.is_identical(), fitness, verification.diverges_at))
    })
}

/// The gait of a champion, measured and judged, as JSON.
#[pyfunction]
pub(crate) fn judge_gait(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    py.detach(|| {
        let champion = champion(&path)?;
        let judge = || own_threads()?.install(|| gait::judge(&champion, &registry()).map_err(wrong));
        let report = believed(&champion, judge)?;
        serde_json::to_string(&report).map_err(wrong)
    })
}

/// What is left of a champion's gait in perturbed worlds, as JSON.
#[pyfunction]
pub(crate) fn champion_robustness(
    py: Python<'_>,
    path: PathBuf,
    worlds: u32,
    seed: u64,
    variation: Option<String>,
) -> PyResult<String> {
    py.detach(|| {
        let variation = variation.map(|name| registry().variations.find(&name).cloned()).transpose().map_err(wrong)?;
        let perturbations = Perturbations { count: worlds, seed, variation };
        let champion = champion(&path)?;
        let threads = own_threads()?;
        let replay = || {
            let mut replays =
                threads.install(|| PerturbedReplays::new(&champion, &registry(), &perturbations)).map_err(wrong)?;
            while replays.progress()[0] < worlds as usize {
                threads.install(|| replays.go_on(threads.current_num_threads() * PerturbedReplays::FEW));
                // Here and not among the replays: signals reach the thread that called alone.
                Python::attach(|py| py.check_signals())?;
            }
            Ok(replays.robustness())
        };
        let robustness = believed(&champion, replay)?;
        serde_json::to_string(&robustness).map_err(wrong)
    })
}

/// What comes of a champion, unless a movement that is written in Python has raised something.
fn believed<T>(champion: &Champion, what: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    let movements = names_in(&champion.movement);
    // What others have left.
    let _ = raised(&movements);
    let found = what();
    raised(&movements)?;
    found
}

/// The champion is not written over, even where files may be.
fn is_another(file: &Path, champion: &Path) -> PyResult<()> {
    match (file.canonicalize(), champion.canonicalize()) {
        (Ok(file), Ok(champion)) if file == champion => {
            Err(wrong(format!("{} is the champion itself", champion.display())))
        }
        _ => Ok(()),
    }
}

/// Threads that all share are gone in a process that was forked.
fn own_threads() -> PyResult<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().build().map_err(wrong)
}

/// Writes a champion in another format. Returns the files; `out` is the first of them.
#[pyfunction]
#[pyo3(signature = (path, format, out, *, seconds, size, rate, ground, overwrite))]
#[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
pub(crate) fn export_champion(
    py: Python<'_>,
    path: PathBuf,
    format: &str,
    out: Option<PathBuf>,
    seconds: Option<f64>,
    size: Option<u32>,
    rate: Option<f64>,
    ground: bool,
    overwrite: bool,
) -> PyResult<Vec<PathBuf>> {
    let format = self::format(format)?;
    py.detach(|| {
        let champion = champion(&path)?;
        let destination = Destination::new(format, &champion, out).map_err(wrong)?;
        destination.paths.iter().try_for_each(|file| is_another(file, &path))?;
        let check = || match destination.paths.iter().find(|path| path.exists()).filter(|_| !overwrite) {
            Some(there) => {
                let message = format!("{} is there: overwrite=True overwrites it", there.display());
                Err(PyFileExistsError::new_err(message))
            }
            None => Ok(()),
        };
        check()?;
        let steps = seconds.map(|seconds| champion.steps_in(seconds)).transpose().map_err(wrong)?;
        let usual = Picture::default();
        let picture = Picture { size: size.unwrap_or(usual.size), rate: rate.unwrap_or(usual.rate), ground };
        let options = Options { name: destination.name.clone(), steps, picture };
        let files = believed(&champion, || export(&champion, &registry(), format, &options).map_err(wrong))?;
        // What has come there since is not overwritten unasked either.
        check()?;
        destination.write(&files).map_err(|error| PyOSError::new_err(error.to_string()))?;
        Ok(destination.paths)
    })
}

/// Writes a page that replays a champion.
#[pyfunction]
pub(crate) fn write_replay(py: Python<'_>, path: PathBuf, page: PathBuf, seconds: Option<f64>) -> PyResult<()> {
    py.detach(|| {
        let champion = champion(&path)?;
        let steps = seconds.map(|seconds| champion.steps_in(seconds)).transpose().map_err(wrong)?;
        is_another(&page, &path)?;
        let write = || report::write_replay(&champion, &registry(), steps, &page);
        let write = || own_threads()?.install(|| write().map_err(|error| PyOSError::new_err(error.to_string())));
        believed(&champion, write)
    })
}

/// A champion's net.
#[pyclass(module = "gambol._gambol")]
pub(crate) struct Net(Network);

impl From<Network> for Net {
    fn from(network: Network) -> Self {
        Self(network)
    }
}

#[pymethods]
impl Net {
    /// Of a champion file.
    #[staticmethod]
    fn of_champion(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| Ok(Self(champion(&path)?.network)))
    }

    /// Of the JSON of a net.
    #[staticmethod]
    fn of_text(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(wrong)
    }

    /// Its JSON.
    fn text(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(wrong)
    }

    /// How many inputs and outputs it has.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.0.inputs(), self.0.outputs())
    }

    /// The outputs for each row of inputs, one row after the other; a recurrent net remembers the rows before.
    fn activate<'py>(
        &mut self,
        py: Python<'py>,
        inputs: PyReadonlyArray2<'py, f32>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (wide, outputs) = self.shape();
        let inputs = inputs.as_array();
        if inputs.ncols() != wide {
            return Err(wrong(format!("inputs must have {wide} columns, found {}", inputs.ncols())));
        }
        let rows = inputs.nrows();
        let inputs: Vec<f32> = inputs.iter().copied().collect();
        let found = py.detach(|| {
            let mut found = vec![0.0; rows * outputs];
            for (inputs, outputs) in inputs.chunks(wide.max(1)).zip(found.chunks_mut(outputs.max(1))) {
                self.0.activate(inputs, outputs);
            }
            found
        });
        PyArray1::from_vec(py, found).reshape([rows, outputs])
    }

    /// Forgets all inputs before.
    fn reset(&mut self) {
        self.0.reset();
    }
}

fn champion(path: &Path) -> PyResult<Champion> {
    Champion::read(path).map_err(|error| PyOSError::new_err(error.to_string()))
}

fn format(name: &str) -> PyResult<Format> {
    Format::ALL.into_iter().find(|format| format.name() == name).ok_or_else(|| {
        let known = Format::ALL.map(Format::name).join(", ");
        wrong(format!("there is no format \"{name}\" (there are: {known})"))
    })
}

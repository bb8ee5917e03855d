//! Whole runs: what Python's `gambol.train` does, and what it reads of a run folder.

use crate::{episodes::registry, errors::wrong};
use gambol_runs::{
    champion::Champion,
    gait,
    request::Request,
    run::Run,
    run_folder::{FolderError, RunFolder},
    shaping::{ShapingError, StageProgress},
    training::{Outcome, Resources, TrainError},
};
use ne_core::StopReason;
use pyo3::{
    exceptions::{PyKeyboardInterrupt, PyOSError, PyRuntimeError},
    prelude::*,
};
use std::path::{Path, PathBuf};

/// What is said of a run that has ended: why, and the generations, the evaluations and the steps it used.
type Ended = (String, u64, u64, u64);

/// Begins a run in a new folder, and goes on until it ends. `callback`: called after each generation with its log line as
/// JSON; the run ends if it returns true.
#[pyfunction]
#[pyo3(signature = (creature, movement, folder, *, preset, strategy, terrain, variation, engine, seed, generations, population, config, settings, threads, callback))]
#[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
pub(crate) fn train(
    py: Python<'_>,
    creature: Option<String>,
    movement: Option<String>,
    folder: PathBuf,
    preset: Option<String>,
    strategy: Option<String>,
    terrain: Option<String>,
    variation: Option<String>,
    engine: Option<String>,
    seed: Option<u64>,
    generations: Option<u64>,
    population: Option<usize>,
    config: Option<PathBuf>,
    settings: Vec<String>,
    threads: usize,
    callback: Option<Py<PyAny>>,
) -> PyResult<Ended> {
    let request = Request {
        creature,
        movement,
        preset,
        strategy,
        terrain,
        variation,
        engine,
        config,
        set: settings,
        ..Request::default()
    };
    py.detach(|| {
        let mut config = request.resolve(registry()).map_err(wrong)?;
        config.seed = seed.unwrap_or(config.seed);
        config.stop.generations = generations.or(config.stop.generations);
        if let Some(population) = population {
            config.strategy.set_population(population);
        }
        let run = Run::begin(&config, &folder, resources(threads)).map_err(broken)?;
        until_it_ends(run, callback.as_ref())
    })
}

/// Goes on with a run from where it stopped, until it ends.
#[pyfunction]
pub(crate) fn resume(
    py: Python<'_>,
    folder: PathBuf,
    generations: Option<u64>,
    threads: usize,
    callback: Option<Py<PyAny>>,
) -> PyResult<Ended> {
    py.detach(|| {
        let stop = match generations {
            None => None,
            Some(generations) => {
                let config = RunFolder::open(&folder).and_then(|folder| folder.read_config()).map_err(unreadable)?;
                Some(ne_core::StopConditions { generations: Some(generations), ..config.stop })
            }
        };
        let run = Run::resume(&folder, stop, resources(threads)).map_err(broken)?;
        until_it_ends(run, callback.as_ref())
    })
}

fn resources(threads: usize) -> Resources {
    Resources { threads, registry: registry().clone(), signal: ne_core::StopSignal::default() }
}

/// One generation after the other. Between two of them Python is asked whether somebody pressed Ctrl-C; whatever ends the run,
/// what it has found is saved.
fn until_it_ends(mut run: Run, callback: Option<&Py<PyAny>>) -> PyResult<Ended> {
    loop {
        let mut line = None;
        let mut on_generation = |generation: &ne_core::Generation<'_, gambol_runs::strategies::AnyStrategy>| {
            line = callback.and_then(|_| serde_json::to_string(generation.report).ok());
        };
        let mut on_stage_run = |_: &_, _: Option<&_>| {};
        let mut stages = StageProgress { on_stage_run: &mut on_stage_run };
        if let Some(reason) = run.generation(&mut stages, &mut on_generation).map_err(broken)? {
            return Ok(ended(&run.finish(reason).map_err(broken)?));
        }
        let asked = Python::attach(|py| {
            py.check_signals()?;
            match callback.zip(line) {
                Some((callback, line)) => callback.bind(py).call1((line,))?.is_truthy(),
                None => Ok(false),
            }
        });
        let interrupted = |error: &PyErr| Python::attach(|py| error.is_instance_of::<PyKeyboardInterrupt>(py));
        match asked {
            Ok(false) => {}
            Err(error) if !interrupted(&error) => {
                run.finish(StopReason::Interrupted).map_err(broken)?;
                return Err(error);
            }
            Ok(true) | Err(_) => return Ok(ended(&run.finish(StopReason::Interrupted).map_err(broken)?)),
        }
    }
}

fn ended(Outcome { reason, progress, .. }: &Outcome) -> Ended {
    (reason.to_string(), progress.generations, progress.evaluations, progress.steps)
}

/// What a run that cannot begin or go on says.
fn broken(error: ShapingError) -> PyErr {
    match error {
        ShapingError::Train(TrainError::Setup(error)) => wrong(error),
        ShapingError::Train(TrainError::Folder(error)) | ShapingError::Folder(error) => unreadable(error),
        error => PyRuntimeError::new_err(error.to_string()),
    }
}

fn unreadable(error: FolderError) -> PyErr {
    PyOSError::new_err(error.to_string())
}

/// The log of a run, a JSON object for each generation.
#[pyfunction]
pub(crate) fn read_log(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<String>> {
    py.detach(|| {
        let lines = RunFolder::open(&folder).and_then(|folder| folder.read_log()).map_err(unreadable)?;
        lines.iter().map(|line| serde_json::to_string(line).map_err(wrong)).collect()
    })
}

/// The configuration of a run, as JSON.
#[pyfunction]
pub(crate) fn read_config(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    py.detach(|| {
        let config = RunFolder::open(&folder).and_then(|folder| folder.read_config()).map_err(unreadable)?;
        serde_json::to_string(&config).map_err(wrong)
    })
}

/// A champion file, as JSON, once it has been checked.
#[pyfunction]
pub(crate) fn read_champion(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    py.detach(|| serde_json::to_string(&champion(&path)?).map_err(wrong))
}

/// Replays a champion in rapier: whether it repeats itself to the bit, its fitness now, and the first step that differs.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>, path: PathBuf) -> PyResult<(bool, Option<f64>, Option<u32>)> {
    py.detach(|| {
        let verification = champion(&path)?.verify(registry()).map_err(wrong)?;
        let fitness = verification.evaluation.fitness().map(ne_core::Fitness::get);
        Ok((verification.is_identical(), fitness, verification.diverges_at))
    })
}

/// The gait of a champion, measured and judged, as JSON.
#[pyfunction]
pub(crate) fn judge_gait(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    py.detach(|| {
        let report = gait::judge(&champion(&path)?, registry()).map_err(wrong)?;
        serde_json::to_string(&report).map_err(wrong)
    })
}

fn champion(path: &Path) -> PyResult<Champion> {
    Champion::read(path).map_err(|error| PyOSError::new_err(error.to_string()))
}

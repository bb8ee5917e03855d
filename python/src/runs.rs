//! Whole runs: what Python's `gambol.train` does, and what it reads of a run folder.

use crate::{
    elsewhere,
    episodes::{names_in, registry},
    errors::{check_threads, wrong},
    movements,
};
use gambol_runs::{
    Registry,
    request::Request,
    run::Run,
    run_folder::{FolderError, RunFolder},
    shaping::{ShapingError, StageProgress},
    strategies::AnyStrategy,
    training::{Answers, Outcome, Resources, Step, TrainError},
};
use ne_core::{Generation, StopConditions, StopReason};
use pyo3::{
    exceptions::{PyKeyboardInterrupt, PyOSError, PyRuntimeError},
    prelude::*,
};
use std::path::PathBuf;

/// What is said of a run that has ended: why, and the generations, the evaluations and the steps it used.
type Ended = (String, u64, u64, u64);

/// Begins a run in a new folder, and goes on until it ends. `callback`: called after each generation with its log line as
/// JSON; the run ends if it returns true. `elsewhere`: see
/// [`elsewhere::ask`].
#[pyfunction]
#[pyo3(signature = (creature, movement, folder, *, preset, strategy, terrain, variation, engine, seed, generations, population, config, settings, threads, callback, elsewhere))]
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
    elsewhere: Option<Py<PyAny>>,
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
        seed,
        population,
        limits: StopConditions { generations, ..StopConditions::default() },
        set: settings,
        ..Request::default()
    };
    py.detach(|| {
        let config = request.resolve(&registry()).map_err(wrong)?;
        let run = Run::begin(&config, &folder, resources(threads)?).map_err(broken)?;
        until_it_ends(run, callback.as_ref(), elsewhere.as_ref())
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
    elsewhere: Option<Py<PyAny>>,
) -> PyResult<Ended> {
    py.detach(|| {
        let stop = match generations {
            None => None,
            Some(generations) => {
                let config = RunFolder::open(&folder).and_then(|folder| folder.read_config()).map_err(unreadable)?;
                let more = StopConditions { generations: Some(generations), ..StopConditions::default() };
                Some(config.stop.resumed_with(more))
            }
        };
        let run = Run::resume(&folder, stop, resources(threads)?).map_err(broken)?;
        until_it_ends(run, callback.as_ref(), elsewhere.as_ref())
    })
}

fn resources(threads: usize) -> PyResult<Resources> {
    check_threads(threads)?;
    Ok(Resources { threads, registry: Registry::clone(&registry()), signal: ne_core::StopSignal::default() })
}

/// One generation after the other. Between two of them Python is asked whether Ctrl-C was pressed; whatever ends the run, what it has
/// found is saved.
fn until_it_ends(mut run: Run, callback: Option<&Py<PyAny>>, elsewhere: Option<&Py<PyAny>>) -> PyResult<Ended> {
    let mut answers = Answers::default();
    let mut here = elsewhere.is_none();
    loop {
        let mut line = None;
        let movements = run.stage_config().map_or_else(Vec::new, |config| names_in(&config.movement));
        let step = step(&mut run, (!here).then_some(&mut answers), &mut |generation| {
            line = callback.and_then(|_| serde_json::to_string(generation.report).ok());
        })?;
        let stops = match (step, elsewhere) {
            (Step::Over(reason), _) => {
                let done = run.finish(reason).map_err(broken)?;
                return movements::raised(&movements).map(|()| ended(&done));
            }
            (Step::Wants(batch), Some(elsewhere)) => match elsewhere::ask(elsewhere, run.stage_config(), batch) {
                Ok(Some(evaluations)) => {
                    answers.give(evaluations);
                    continue;
                }
                Ok(None) => {
                    (answers, here) = (Answers::default(), true);
                    continue;
                }
                Err(error) => Err(error),
            },
            _ => {
                here = elsewhere.is_none();
                asked(callback, line, &movements)
            }
        };
        let interrupted = |error: &PyErr| Python::attach(|py| error.is_instance_of::<PyKeyboardInterrupt>(py));
        match stops {
            Ok(false) => {}
            Err(error) if !interrupted(&error) => {
                let finished = run.finish(StopReason::Interrupted).map_err(broken);
                // The champion was played once more: what it raised then is no news.
                let _ = movements::raised(&movements);
                return finished.and(Err(error));
            }
            Ok(true) | Err(_) => return Ok(ended(&run.finish(StopReason::Interrupted).map_err(broken)?)),
        }
    }
}

/// A generation here, or as much of it as there are answers for.
fn step(
    run: &mut Run,
    answers: Option<&mut Answers>,
    on_generation: &mut dyn FnMut(&Generation<'_, AnyStrategy>),
) -> PyResult<Step> {
    let mut on_stage_run = |_: &_, _: Option<&_>| {};
    let mut stages = StageProgress { on_stage_run: &mut on_stage_run };
    match answers {
        Some(answers) => run.generation_by(answers, &mut stages, on_generation).map_err(broken),
        None => {
            let over = run.generation(&mut stages, on_generation).map_err(broken)?;
            Ok(over.map_or(Step::Done, Step::Over))
        }
    }
}

/// Whether the run is to end now, after the generation with this line, of these movements.
fn asked(callback: Option<&Py<PyAny>>, line: Option<String>, movements: &[String]) -> PyResult<bool> {
    movements::raised(movements)?;
    Python::attach(|py| {
        py.check_signals()?;
        match callback.zip(line) {
            Some((callback, line)) => callback.bind(py).call1((line,))?.is_truthy(),
            None => Ok(false),
        }
    })
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

//! Experiments whose runs are done anywhere: what `gambol.cluster` hands out.

use crate::{episodes::registry, errors::wrong};
use gambol_experiments::{
    compare::{Method, PlanRequest},
    distributed::{self, Failed, GaitStudy},
    reproduce,
    tune::TuneRequest,
};
use gambol_runs::request::Request;
use ne_core::StopConditions;
use pyo3::{exceptions::PyRuntimeError, prelude::*};
use std::path::PathBuf;

/// Many runs that know nothing of each other.
#[pyclass(module = "gambol._gambol", frozen)]
pub(crate) struct Experiment {
    experiment: Box<dyn distributed::Experiment>,
}

#[pymethods]
impl Experiment {
    /// Strategies against each other, as `gambol compare`.
    #[staticmethod]
    #[pyo3(signature = (strategies, creatures, movements, seeds, *, evaluations, steps, preset, engine, variation, settings))]
    #[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
    fn compare(
        strategies: Vec<String>,
        creatures: Vec<String>,
        movements: Vec<String>,
        seeds: Vec<u64>,
        evaluations: Option<u64>,
        steps: Option<u64>,
        preset: Option<String>,
        engine: Option<String>,
        variation: Option<String>,
        settings: Vec<String>,
    ) -> PyResult<Self> {
        let methods = strategies.iter().map(|text| Method::parse(text, &registry())).collect::<Result<_, _>>();
        let request = PlanRequest {
            methods: methods.map_err(wrong)?,
            creatures,
            movements,
            seeds,
            budget: StopConditions { evaluations, steps, ..StopConditions::default() },
            preset,
            set: settings,
            engine,
            variation,
        };
        Ok(Self { experiment: Box::new(request.plan(&registry()).map_err(wrong)?) })
    }

    /// A strategy's settings, as `gambol tune`.
    #[staticmethod]
    #[pyo3(signature = (strategy, creatures, movements, seeds, evaluations, *, trials, spread, draw_seed, preset, settings))]
    #[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
    fn tune(
        py: Python<'_>,
        strategy: String,
        creatures: Vec<String>,
        movements: Vec<String>,
        seeds: Vec<u64>,
        evaluations: u64,
        trials: u32,
        spread: f64,
        draw_seed: u64,
        preset: String,
        settings: Vec<String>,
    ) -> PyResult<Self> {
        if !(1..=1000).contains(&trials) {
            return Err(wrong(format!("trials = {trials}: must be from 1 to 1000")));
        }
        if !(spread > 1.0 && spread <= 1000.0) {
            return Err(wrong(format!("spread = {spread}: must be above 1 and at most 1000")));
        }
        let plan = PlanRequest {
            creatures,
            movements,
            seeds,
            budget: StopConditions { evaluations: Some(evaluations), ..StopConditions::default() },
            preset: Some(preset),
            set: settings,
            ..PlanRequest::default()
        };
        let request = TuneRequest { strategy, trials, draw_seed, spread, plan };
        let tuning = py.detach(|| request.tuning(&registry())).map_err(wrong)?;
        Ok(Self { experiment: Box::new(tuning) })
    }

    /// The experiments of the thesis, as `gambol reproduce thesis` without timed runs.
    #[staticmethod]
    fn reproduce(
        creatures: Vec<String>,
        movements: Vec<String>,
        presets: Vec<String>,
        runs: u64,
        generations: u64,
    ) -> PyResult<Self> {
        let request = reproduce::Request { creatures, movements, presets, runs, generations, clock_minutes: None };
        Ok(Self { experiment: Box::new(request.plan(&registry()).map_err(wrong)?) })
    }

    /// How many gaits are usable, as `gambol bench gaits --steps`.
    #[staticmethod]
    #[pyo3(signature = (creatures, movements, seeds, steps, *, preset, strategy, variation, settings, whole, robust))]
    #[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
    fn gaits(
        creatures: Vec<String>,
        movements: Vec<String>,
        seeds: Vec<u64>,
        steps: u64,
        preset: Option<String>,
        strategy: Option<String>,
        variation: Option<String>,
        settings: Vec<String>,
        whole: bool,
        robust: bool,
    ) -> PyResult<Self> {
        let mut requests = Vec::new();
        for creature in &creatures {
            for movement in &movements {
                requests.push(Request {
                    creature: Some(creature.clone()),
                    movement: Some(movement.clone()),
                    preset: preset.clone(),
                    strategy: strategy.clone(),
                    variation: variation.clone(),
                    set: settings.clone(),
                    ..Request::default()
                });
            }
        }
        let stop = StopConditions { steps: Some(steps), ..StopConditions::default() };
        let study = GaitStudy::new(&requests, seeds, stop, robust, &registry()).map_err(wrong)?;
        let study = if whole { study } else { study.until_usable(&registry()).map_err(wrong)? };
        Ok(Self { experiment: Box::new(study) })
    }

    /// How many runs there are.
    #[getter]
    fn runs(&self) -> usize {
        self.experiment.runs()
    }

    /// What a run is called.
    fn name(&self, run: usize) -> String {
        self.experiment.name(run)
    }

    /// What decides all results.
    #[getter]
    fn digest(&self) -> PyResult<String> {
        Ok(self.experiment.digest().map_err(failed)?.to_string())
    }

    /// Makes the folder, or goes on with one.
    fn begin(&self, folder: PathBuf) -> PyResult<()> {
        self.experiment.begin(&folder).map_err(failed)
    }

    /// The runs whose results are not in the folder.
    fn missing(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<usize>> {
        py.detach(|| {
            let mut missing = Vec::new();
            for run in 0..self.experiment.runs() {
                if !self.experiment.is_done(&folder, run).map_err(failed)? {
                    missing.push(run);
                }
            }
            Ok(missing)
        })
    }

    /// Does a run, and gives the text of its result.
    fn carry_out(&self, py: Python<'_>, run: usize) -> PyResult<String> {
        py.detach(|| self.experiment.carry_out(run, &registry())).map_err(failed)
    }

    /// Writes the result of a run into the folder, and says where.
    fn place(&self, py: Python<'_>, folder: PathBuf, run: usize, result: &str) -> PyResult<PathBuf> {
        py.detach(|| self.experiment.place(&folder, run, result)).map_err(failed)
    }

    /// Whether two results say the same, but for seconds.
    fn agree(&self, one: &str, other: &str) -> PyResult<bool> {
        self.experiment.agree(one, other).map_err(failed)
    }

    /// Writes what came of it, and names the files.
    fn conclude(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        py.detach(|| self.experiment.conclude(&folder, &registry())).map_err(failed)
    }
}

fn failed(error: Failed) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

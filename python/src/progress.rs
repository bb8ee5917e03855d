//! What a search by ask and tell has come to, beside the state of its strategy.

use crate::{episodes::registry, errors::wrong};
use gambol_runs::config::StrategySettings;
use ne_core::{Evaluation, Fitness, Seed};
use ne_net::Topology;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::{exceptions::PyRuntimeError, prelude::*};
use serde::{Deserialize, Serialize};

/// Of a saved search.
pub(crate) const WRONG_SIZE: &str = "the generation that waits for its results is not of the size that is said";

/// The generations of a search, and the best it has found.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Progress<G> {
    seed: u64,
    /// Told so far.
    pub(crate) generations: u64,
    /// How many were asked and not told yet.
    pub(crate) asked: Option<usize>,
    /// How many objectives were told first.
    objectives: Option<usize>,
    pub(crate) best: Option<Best<G>>,
}

/// The best so far, of equals the first.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Best<G> {
    pub(crate) genome: G,
    pub(crate) fitness: Fitness,
    /// The generation it was asked in, from 1.
    pub(crate) generation: u64,
}

impl<G> Progress<G> {
    /// Nothing is asked yet.
    pub(crate) fn new(seed: u64) -> Self {
        Self { seed, generations: 0, asked: None, objectives: None, best: None }
    }

    /// That of the generation that is asked next or waits for its results.
    pub(crate) fn seed(&self) -> Seed {
        Seed::of_run(self.seed).generation(self.generations + 1)
    }

    /// What was told, as evaluations of the generation that waits for them; the best of them is remembered, with the genome at its
    /// place. The generation is told then.
    pub(crate) fn told(
        &mut self,
        fitness: PyReadonlyArray1<'_, f64>,
        objectives: Option<PyReadonlyArray2<'_, f64>>,
        genome: impl FnOnce(usize) -> G,
    ) -> PyResult<Vec<Evaluation>> {
        let Some(count) = self.asked else {
            return Err(PyRuntimeError::new_err("ask before tell: there is no generation that waits for its results"));
        };
        let fitness = fitness.as_slice()?;
        if fitness.len() != count {
            return Err(wrong(format!("fitness must be of length {count}, found {}", fitness.len())));
        }
        let mut evaluations: Vec<Evaluation> = fitness.iter().copied().map(Evaluation::new).collect();
        if let Some(objectives) = objectives {
            let objectives = objectives.as_array();
            if objectives.nrows() != count {
                return Err(wrong(format!("objectives must have {count} rows, found {}", objectives.nrows())));
            }
            let (first, now) = (*self.objectives.get_or_insert(objectives.ncols()), objectives.ncols());
            if first != now {
                return Err(wrong(format!("objectives must have {first} columns as before, found {now}")));
            }
            for (evaluation, row) in evaluations.iter_mut().zip(objectives.rows()) {
                evaluation.objectives = row.to_vec();
            }
        } else if let Some(first) = self.objectives {
            return Err(wrong(format!("objectives must have {first} columns as before, found none")));
        }
        let generation = self.generations + 1;
        let better =
            best_of(&evaluations).filter(|(_, fitness)| self.best.as_ref().is_none_or(|best| *fitness > best.fitness));
        if let Some((index, fitness)) = better {
            self.best = Some(Best { genome: genome(index), fitness, generation });
        }
        (self.asked, self.generations) = (None, generation);
        Ok(evaluations)
    }
}

/// The settings of a strategy: a JSON object laid over its defaults, checked so that a message names the setting as a
/// configuration file has it.
pub(crate) fn settings(name: &str, over: &str, topology: &Topology) -> PyResult<StrategySettings> {
    let registry = registry();
    let entry = registry.strategies.find(name).ok_or_else(|| wrong(format!("{name} is not registered")))?;
    let mut settings = entry.settings();
    settings.lay_over(serde_json::from_str(over).map_err(wrong)?);
    registry.strategies.validate(&settings, topology).map_err(wrong)?;
    Ok(settings)
}

/// The best of a generation, of equals the first.
fn best_of(evaluations: &[Evaluation]) -> Option<(usize, Fitness)> {
    let fitnesses = evaluations.iter().enumerate().filter_map(|(index, it)| Some((index, it.fitness()?)));
    fitnesses.reduce(|best, next| if next.1 > best.1 { next } else { best })
}

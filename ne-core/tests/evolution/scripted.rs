//! A run whose fitnesses are written down beforehand.

use ne_core::{
    Evaluation, Evaluator, Evolution, Failure, Genome, Phenotype, Seed, Statistic, StopConditions, Strategy, Task,
    conformance::Puppet,
};
use serde::{Deserialize, Serialize};

/// Asks for as many genomes as the script of the generation is long; genome k of generation g has character 100 g + k. Then it
/// recommends the next of these characters.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Script {
    /// Fitnesses generation by generation; NaN fails. The last line is repeated for ever.
    pub(crate) lines: Vec<Vec<f64>>,
    asked: Vec<Puppet>,
    recommended: Option<Puppet>,
    /// What it tells of itself.
    pub(crate) statistics: Vec<Statistic>,
}

impl Script {
    pub(crate) fn line(&self, generation: u64) -> &[f64] {
        let last = self.lines.len() - 1;
        &self.lines[last.min(generation as usize - 1)]
    }

    pub(crate) fn new(lines: &[&[f64]]) -> Self {
        let lines = lines.iter().map(|line| line.to_vec()).collect();
        Self { lines, asked: Vec::new(), recommended: None, statistics: Vec::new() }
    }

    pub(crate) fn evolution(lines: &[&[f64]], stop: StopConditions) -> Evolution<Self> {
        Evolution::new(Self::new(lines), Seed::of_run(1), stop)
    }
}

impl Strategy for Script {
    type Genome = Puppet;

    fn name(&self) -> &str {
        "script"
    }

    fn ask(&mut self, seed: Seed) -> &[Puppet] {
        let generation = seed.generation_index();
        let count = self.line(generation).len() as u64;
        let genome = |index| Puppet::new(0, 1, 100 * generation + index);
        self.asked = (0..count).map(genome).collect();
        self.recommended = Some(genome(count));
        &self.asked
    }

    fn tell(&mut self, _: &[Evaluation], _: Seed) {}

    fn statistics(&self) -> Vec<Statistic> {
        self.statistics.clone()
    }

    fn recommendation(&self) -> Option<Puppet> {
        self.recommended.clone()
    }
}

/// Reads the fitnesses from the script; each evaluation takes 10 steps.
pub(crate) struct Prompter(pub(crate) Vec<Vec<f64>>);

impl Prompter {
    pub(crate) fn of(evolution: &Evolution<Script>) -> Self {
        Self(evolution.strategy().lines.clone())
    }
}

impl Evaluator for Prompter {
    fn evaluate<G: Genome>(&self, _: &dyn Task, _: &[G], seed: Seed) -> Vec<Evaluation> {
        let line = &self.0[(self.0.len() - 1).min(seed.generation_index() as usize - 1)];
        line.iter().map(|&fitness| Evaluation::new(fitness).with_steps(10)).collect()
    }
}

/// A task on which no individual is evaluated.
pub(crate) struct Unused;

impl Task for Unused {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, _: &mut dyn Phenotype, _: Seed) -> Evaluation {
        Evaluation::failed(Failure::Other { what: "this task is not to be evaluated".into() })
    }
}

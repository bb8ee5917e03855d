use crate::{
    Checkpoint, Evaluation, Evaluator, Fitness, Generation, GenerationReport, Observer, ObserverError, Quantiles, Seed,
    StopConditions, StopReason, StopSignal, Strategy, Task, archive::ArchiveError, checkpoint,
};
use serde::{Deserialize, Serialize};
use std::{path::Path, time::Instant};

/// The loop: asks the strategy, has its genomes evaluated, tells it the results, keeps the best, until it is time to
/// stop.
///
/// An evolution is a function of (strategy with its settings, task, seed): evaluator, observers and interruptions do
/// not change it.
#[derive(Debug)]
pub struct Evolution<S: Strategy> {
    strategy: S,
    seed: Seed,
    stop: StopConditions,
    signal: StopSignal,
    progress: Progress,
    champion: Option<Champion<S::Genome>>,
}

/// What a run has used up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    /// Generations done.
    pub generations: u64,
    /// Evaluations done.
    pub evaluations: u64,
    /// Steps of work done.
    pub steps: u64,
    /// Generations since the champion was found.
    pub stagnation: u64,
}

/// The best individual of a run: the one with the highest fitness, of equals the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Champion<G> {
    /// The genome.
    pub genome: G,
    /// Its fitness.
    pub fitness: Fitness,
    /// The generation it was evaluated in, from 1.
    pub generation: u64,
    /// The seed it was evaluated with: with it the task gives the fitness again.
    pub seed: Seed,
}

/// Why a run could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvolutionError {
    /// An observer could not do its work.
    #[error(transparent)]
    Observer(#[from] ObserverError),
    /// The strategy asked for nothing.
    #[error("the strategy \"{strategy}\" asked for the evaluation of no genome in generation {generation}")]
    EmptyPopulation {
        /// The strategy's name.
        strategy: String,
        /// The generation, from 1.
        generation: u64,
    },
    /// The evaluator lost or invented evaluations.
    #[error("the evaluator gave {found} evaluations for {expected} genomes in generation {generation}")]
    EvaluationCount {
        /// Evaluations given.
        found: usize,
        /// Genomes handed over.
        expected: usize,
        /// The generation, from 1.
        generation: u64,
    },
}

impl<S: Strategy> Evolution<S> {
    /// A new run. The stop conditions are used as they are; see [`StopConditions::validate`].
    pub fn new(strategy: S, seed: Seed, stop: StopConditions) -> Self {
        let (signal, progress) = (StopSignal::default(), Progress::default());
        Self { strategy, seed, stop, signal, progress, champion: None }
    }

    /// Goes on where a checkpoint was written.
    pub fn resume(checkpoint: Checkpoint<S>, stop: StopConditions) -> Self {
        let Checkpoint { seed, progress, champion, strategy } = checkpoint;
        Self { strategy, seed, stop, signal: StopSignal::default(), progress, champion }
    }

    /// Uses this switch to end the run early.
    #[must_use]
    pub fn with_signal(self, signal: StopSignal) -> Self {
        Self { signal, ..self }
    }

    /// Runs until a stop condition is met.
    ///
    /// # Errors
    /// If an observer fails, the strategy asks for nothing, or the evaluator does not give one evaluation for each
    /// genome. The evolution stays whole: it can be saved or run again.
    pub fn run(
        &mut self,
        task: &dyn Task,
        evaluator: &impl Evaluator,
        observers: &mut [Box<dyn Observer<S> + '_>],
    ) -> Result<StopReason, EvolutionError> {
        let start = Instant::now();
        loop {
            let best = self.champion.as_ref().map(|champion| champion.fitness);
            if let Some(reason) = self.stop.reached(&self.progress, best, start.elapsed()) {
                return Ok(reason);
            }
            if self.signal.is_set() {
                return Ok(StopReason::Interrupted);
            }
            self.generation(task, evaluator, observers)?;
        }
    }

    /// Runs one generation, whatever the stop conditions say.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn generation(
        &mut self,
        task: &dyn Task,
        evaluator: &impl Evaluator,
        observers: &mut [Box<dyn Observer<S> + '_>],
    ) -> Result<GenerationReport, EvolutionError> {
        let generation = self.progress.generations + 1;
        let seed = self.seed.generation(generation);
        let genomes = self.strategy.ask(seed).to_vec();
        if genomes.is_empty() {
            return Err(EvolutionError::EmptyPopulation { strategy: self.strategy.name().into(), generation });
        }
        let evaluations = evaluator.evaluate(task, &genomes, seed);
        if evaluations.len() != genomes.len() {
            let (found, expected) = (evaluations.len(), genomes.len());
            return Err(EvolutionError::EvaluationCount { found, expected, generation });
        }
        self.strategy.tell(&evaluations, seed);
        self.progress.generations = generation;
        self.progress.evaluations += evaluations.len() as u64;
        self.progress.steps += evaluations.iter().map(|evaluation| evaluation.steps).sum::<u64>();
        let improved = self.crown(&genomes, &evaluations, seed);
        let report = GenerationReport {
            generation,
            evaluations: self.progress.evaluations,
            steps: self.progress.steps,
            best_so_far: self.champion.as_ref().map(|champion| champion.fitness),
            fitness: Quantiles::of(&evaluations),
            failures: evaluations.iter().filter(|evaluation| evaluation.outcome.is_err()).count() as u64,
            population: genomes.len() as u64,
            strategy: self.strategy.statistics(),
            species: self.strategy.species(),
        };
        tracing::debug!(generation, best = ?report.best_so_far, failures = report.failures, "generation done");
        let event = Generation {
            report: &report,
            genomes: &genomes,
            evaluations: &evaluations,
            champion: self.champion.as_ref(),
            improved,
            strategy: &self.strategy,
            progress: self.progress,
            seed: self.seed,
            stop: &self.stop,
        };
        for observer in observers {
            observer.generation(&event)?;
        }
        Ok(report)
    }

    /// Makes the best of this generation champion if it beats the old one.
    fn crown(&mut self, genomes: &[S::Genome], evaluations: &[Evaluation], seed: Seed) -> bool {
        let fitnesses =
            evaluations.iter().enumerate().filter_map(|(index, evaluation)| Some((index, evaluation.fitness()?)));
        // `max_by_key` keeps the last of equals; reversed, the first.
        let best = fitnesses.rev().max_by_key(|&(_, fitness)| fitness);
        let reigning = self.champion.as_ref().map(|champion| champion.fitness);
        match best {
            Some((index, fitness)) if Some(fitness) > reigning => {
                let genome = genomes[index].clone();
                self.champion = Some(Champion { genome, fitness, generation: self.progress.generations, seed });
                self.progress.stagnation = 0;
                true
            }
            _ => {
                self.progress.stagnation += 1;
                false
            }
        }
    }

    /// The best so far, if any evaluation succeeded.
    pub fn champion(&self) -> Option<&Champion<S::Genome>> {
        self.champion.as_ref()
    }

    /// What has been used up.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// The strategy between two generations.
    pub fn strategy(&self) -> &S {
        &self.strategy
    }

    /// The run's seed.
    pub fn seed(&self) -> Seed {
        self.seed
    }

    /// Writes a checkpoint, whole or not at all; [`Checkpoint::read`] and [`resume`](Self::resume) bring it back.
    ///
    /// # Errors
    /// If the file cannot be written; an older one is then still there.
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), ArchiveError> {
        let (seed, progress, strategy) = (self.seed, self.progress, &self.strategy);
        let champion = self.champion.as_ref();
        checkpoint::write_parts(path, &checkpoint::CheckpointRef { seed, progress, champion, strategy })
    }
}

impl<S: Strategy> Generation<'_, S> {
    /// Writes the checkpoint of this moment, as [`Evolution::write_checkpoint`] does.
    ///
    /// # Errors
    /// If the file cannot be written; an older one is then still there.
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), ArchiveError> {
        let (seed, progress, champion, strategy) = (self.seed, self.progress, self.champion, self.strategy);
        checkpoint::write_parts(path, &checkpoint::CheckpointRef { seed, progress, champion, strategy })
    }
}

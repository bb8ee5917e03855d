use crate::{
    Checkpoint, Decision, Evaluation, Evaluator, Finalist, Fitness, Generation, GenerationReport, HearingReport,
    Hearings, Jury, Moment, Observer, ObserverError, Promotion, Quantiles, Seed, Standing, StopConditions, StopReason,
    StopSignal, Strategy, Task,
    archive::ArchiveError,
    checkpoint,
    jury::{Court, ranking},
};
use serde::{Deserialize, Serialize};
use std::{fmt, path::Path, time::Instant};

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
    finalists: Vec<Finalist<S::Genome>>,
    court: Option<Court<S::Genome>>,
    promotion: Option<Rules>,
    decision: Decision,
}

/// A promotion that can be shown.
struct Rules(Box<dyn Promotion>);

impl fmt::Debug for Rules {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Promotion")
    }
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
    /// Generations since the champion was found; with a [`Jury`], as of the last hearing.
    pub stagnation: u64,
}

/// The best individual of a run: the one with the highest fitness, of equals the first. With a [`Jury`] the fitness that
/// counts is the one before the jury.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Champion<G> {
    /// The genome.
    pub genome: G,
    /// Its fitness.
    pub fitness: Fitness,
    /// The generation it was evaluated in, from 1.
    pub generation: u64,
    /// The seed it was evaluated with: with it the task, or the jury, gives the fitness again.
    pub seed: Seed,
    /// The fitness it had in its generation, if a jury has judged it since.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trained: Option<Fitness>,
    /// Whether the jury's two ways of evaluating [parted](crate::Judgement::parted) at its hearing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub parted: bool,
    /// The [grade](crate::Judgement::grades) the jury gave it; 0 without a jury.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub grade: u8,
}

impl<G> Champion<G> {
    /// Where it stands.
    pub fn standing(&self) -> Standing {
        Standing { grade: self.grade, fitness: self.fitness }
    }

    /// The same champion with its genome as another type.
    pub fn map<H>(self, convert: impl FnOnce(G) -> H) -> Champion<H> {
        let Self { genome, fitness, generation, seed, trained, parted, grade } = self;
        Champion { genome: convert(genome), fitness, generation, seed, trained, parted, grade }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(grade: &u8) -> bool {
    *grade == 0
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
        let (progress, finalists, decision) = (Progress::default(), Vec::new(), Decision::Stay);
        Self::resume(Checkpoint { seed, progress, champion: None, finalists, decision, strategy }, stop)
    }

    /// Goes on where a checkpoint was written. A run with a jury needs it [again](Self::with_jury), and so does one with a
    /// [promotion](Self::with_promotion).
    pub fn resume(checkpoint: Checkpoint<S>, stop: StopConditions) -> Self {
        let Checkpoint { seed, progress, champion, finalists, decision, strategy } = checkpoint;
        let (signal, court, promotion) = (StopSignal::default(), None, None);
        Self { strategy, seed, stop, signal, progress, champion, finalists, court, promotion, decision }
    }

    /// Lets a jury choose the champion. The best of each generation becomes a finalist; at every hearing
    /// the jury judges them and the best of that generation, and the best of them becomes champion if its fitness before
    /// the jury is above the champion's. Hearings are used as they are; see [`Hearings::validate`].
    #[must_use]
    pub fn with_jury(self, hearings: Hearings, jury: impl Jury<S::Genome> + 'static) -> Self {
        Self { court: Some(Court { hearings, jury: Box::new(jury) }), ..self }
    }

    /// Asks a promotion after every generation; with its decision the run ends.
    #[must_use]
    pub fn with_promotion(self, promotion: impl Promotion + 'static) -> Self {
        Self { promotion: Some(Rules(Box::new(promotion))), ..self }
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
            match self.decision {
                Decision::Stay => {}
                Decision::Promote => return Ok(StopReason::Promoted),
                Decision::Demote => return Ok(StopReason::Demoted),
            }
            let best = self.champion.as_ref().map(Champion::standing);
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
        let (improved, hearing) = match self.court.take() {
            None => (self.crown(best_of(&genomes, &evaluations, seed), 1), None),
            Some(court) => {
                let outcome = self.nominate(&court, &genomes, &evaluations);
                self.court = Some(court);
                outcome
            }
        };
        let report = GenerationReport {
            generation,
            evaluations: self.progress.evaluations,
            steps: self.progress.steps,
            best_so_far: self.champion.as_ref().map(|champion| champion.fitness),
            grade: self.champion.as_ref().map_or(0, |champion| champion.grade),
            fitness: Quantiles::of(&evaluations),
            failures: evaluations.iter().filter(|evaluation| evaluation.outcome.is_err()).count() as u64,
            population: genomes.len() as u64,
            strategy: self.strategy.statistics(),
            species: self.strategy.species(),
            hearing,
        };
        if let Some(Rules(promotion)) = &self.promotion {
            let champion = self.champion.as_ref().map(Champion::standing);
            let moment = Moment { report: &report, evaluations: &evaluations, champion, progress: self.progress };
            self.decision = promotion.decide(&moment);
        }
        tracing::debug!(generation, best = ?report.best_so_far, failures = report.failures, "generation done");
        let event = Generation {
            report: &report,
            genomes: &genomes,
            evaluations: &evaluations,
            champion: self.champion.as_ref(),
            improved,
            finalists: &self.finalists,
            strategy: &self.strategy,
            progress: self.progress,
            seed: self.seed,
            decision: self.decision,
            stop: &self.stop,
        };
        for observer in observers {
            observer.generation(&event)?;
        }
        Ok(report)
    }

    /// Makes the candidate champion if it beats the old one; otherwise so many more generations have passed without.
    fn crown(&mut self, candidate: Option<Champion<S::Genome>>, generations: u64) -> bool {
        let reigning = self.champion.as_ref().map(Champion::standing);
        let improved = candidate.as_ref().is_some_and(|candidate| Some(candidate.standing()) > reigning);
        if improved {
            self.champion = candidate;
            self.progress.stagnation = 0;
        } else {
            self.progress.stagnation += generations;
        }
        improved
    }

    /// Makes the best of this generation a finalist; if it is time for a hearing, holds it.
    fn nominate(
        &mut self,
        court: &Court<S::Genome>,
        genomes: &[S::Genome],
        evaluations: &[Evaluation],
    ) -> (bool, Option<HearingReport>) {
        let generation = self.progress.generations;
        let span = court.hearings.span(generation);
        let count = if span.is_some() { court.hearings.finalists.max(1) } else { 1 };
        let best = ranking(evaluations).into_iter().take(count);
        self.finalists.extend(best.map(|(index, fitness)| Finalist {
            genome: genomes[index].clone(),
            fitness,
            generation,
        }));
        let Some(span) = span else { return (false, None) };
        let (report, best) =
            court.hear(&std::mem::take(&mut self.finalists), self.champion.as_ref().map(Champion::standing));
        (self.crown(best, span), Some(report))
    }

    /// The best so far, if any evaluation succeeded.
    pub fn champion(&self) -> Option<&Champion<S::Genome>> {
        self.champion.as_ref()
    }

    /// The champion there would be if a hearing were held now: the best so far, and of those who wait for one. Changes
    /// nothing. Without a jury, or with nobody waiting, the [champion](Self::champion).
    pub fn champion_if_heard(&self) -> Option<Champion<S::Genome>> {
        let standing = self.champion.clone();
        let Some(court) = self.court.as_ref().filter(|_| !self.finalists.is_empty()) else { return standing };
        let (_, best) = court.hear(&self.finalists, self.champion.as_ref().map(Champion::standing));
        let place = |champion: &Option<Champion<S::Genome>>| champion.as_ref().map(Champion::standing);
        if place(&best) > place(&standing) { best } else { standing }
    }

    /// Those who wait for the next hearing, in the order in which they were evaluated.
    pub fn finalists(&self) -> &[Finalist<S::Genome>] {
        &self.finalists
    }

    /// What the promotion said after the last generation.
    pub fn decision(&self) -> Decision {
        self.decision
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
        let (seed, progress, decision, strategy) = (self.seed, self.progress, self.decision, &self.strategy);
        let (champion, finalists) = (self.champion.as_ref(), self.finalists.as_slice());
        let parts = checkpoint::CheckpointRef { seed, progress, champion, finalists, decision, strategy };
        checkpoint::write_parts(path, &parts)
    }
}

impl<S: Strategy> Generation<'_, S> {
    /// Writes the checkpoint of this moment, as [`Evolution::write_checkpoint`] does.
    ///
    /// # Errors
    /// If the file cannot be written; an older one is then still there.
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), ArchiveError> {
        let Self { seed, progress, champion, finalists, decision, strategy, .. } = *self;
        let parts = checkpoint::CheckpointRef { seed, progress, champion, finalists, decision, strategy };
        checkpoint::write_parts(path, &parts)
    }
}

/// The best of a generation, of equals the first, as the champion it would make.
fn best_of<G: Clone>(genomes: &[G], evaluations: &[Evaluation], seed: Seed) -> Option<Champion<G>> {
    let &(index, fitness) = ranking(evaluations).first()?;
    let genome = genomes[index].clone();
    Some(Champion {
        genome,
        fitness,
        generation: seed.generation_index(),
        seed,
        trained: None,
        parted: false,
        grade: 0,
    })
}

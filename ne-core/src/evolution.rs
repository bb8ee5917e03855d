use crate::{
    Candidate, Champion, Checkpoint, Evaluation, Evaluator, Generation, GenerationReport, Observer, ObserverError,
    Progress, Quantiles, Seed, StopConditions, StopReason, StopSignal, Strategy, Task,
    archive::ArchiveError,
    champion::ranking,
    champion_selection::{
        ChampionSelection, ReEvaluated, ReEvaluationReport, ReEvaluations, ScheduledSelection, WrongCount,
    },
    checkpoint,
    promotion::{Decision, Promotion, StageState},
    statistics::commonest_failure,
};
use std::{
    fmt,
    path::Path,
    time::{Duration, Instant},
};

/// The loop: asks the strategy, has its genomes evaluated, tells it the results, keeps the best, until it is time to
/// stop.
///
/// An evolution is a function of (strategy with its settings, task, seed): evaluator, observers and interruptions do
/// not change it.
#[derive(Debug)]
pub struct Evolution<S: Strategy> {
    strategy: S,
    seed: Seed,
    label: String,
    stop: StopConditions,
    signal: StopSignal,
    progress: Progress,
    champion: Option<Champion<S::Genome>>,
    candidates: Vec<Candidate<S::Genome>>,
    /// Asked of the strategy, and not evaluated yet.
    asked: Option<Vec<S::Genome>>,
    selection: Option<ScheduledSelection<S::Genome>>,
    promotion: Option<BoxedPromotion>,
    decision: Decision,
}

/// A promotion that can be shown.
struct BoxedPromotion(Box<dyn Promotion>);

impl fmt::Debug for BoxedPromotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Promotion")
    }
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
    /// The strategy tells a number of itself that is none, which no log can hold.
    #[error(
        "the strategy \"{strategy}\" tells a \"{statistic}\" of {value} in generation {generation}: it must be finite"
    )]
    Statistic {
        /// The strategy's name.
        strategy: String,
        /// What it tells of.
        statistic: String,
        /// What it tells.
        value: f64,
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
    /// The champion selection lost or invented evaluations.
    #[error("the champion selection gave {found} evaluations for {expected} candidates in generation {generation}")]
    ReEvaluationCount {
        /// Evaluations given.
        found: usize,
        /// Candidates handed over.
        expected: usize,
        /// The generation, from 1.
        generation: u64,
    },
}

impl EvolutionError {
    /// The generation, from 1, if the error knows it; an observer's does not: it was told of the last that is over.
    pub fn generation(&self) -> Option<u64> {
        match *self {
            Self::Observer(_) => None,
            Self::EmptyPopulation { generation, .. }
            | Self::Statistic { generation, .. }
            | Self::EvaluationCount { generation, .. }
            | Self::ReEvaluationCount { generation, .. } => Some(generation),
        }
    }
}

impl<S: Strategy> Evolution<S> {
    /// A new run. The stop conditions are used as they are; see [`StopConditions::validate`].
    pub fn new(strategy: S, seed: Seed, stop: StopConditions) -> Self {
        let (label, progress, candidates, decision) = (String::new(), Progress::default(), Vec::new(), Decision::Stay);
        let checkpoint =
            Checkpoint { seed, label, progress, champion: None, candidates, decision, last: false, strategy };
        Self::resume(checkpoint, stop)
    }

    /// Goes on where a checkpoint was written. A run with a champion selection needs it
    /// [again](Self::with_champion_selection), and so does one with a [promotion](Self::with_promotion).
    pub fn resume(checkpoint: Checkpoint<S>, stop: StopConditions) -> Self {
        let Checkpoint { seed, label, progress, champion, candidates, decision, strategy, .. } = checkpoint;
        let (signal, asked, selection, promotion) = (StopSignal::default(), None, None, None);
        Self {
            strategy,
            seed,
            label,
            stop,
            signal,
            progress,
            champion,
            candidates,
            asked,
            selection,
            promotion,
            decision,
        }
    }

    /// Writes a text in every checkpoint, such as a digest of the task's settings: by it a caller tells whether a checkpoint is
    /// of the run that it wants to go on with. It changes nothing else, and a resumed run has that of its checkpoint.
    #[must_use]
    pub fn with_label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// Lets a champion selection choose the champion. The best of each generation, or of a [group](ReEvaluations::group) of them, becomes a
    /// candidate. At every re-evaluation the
    /// champion selection judges all candidates; the best becomes champion if it is better than the present one.
    /// `re_evaluations` is used as it is; see [`ReEvaluations::validate`].
    #[must_use]
    pub fn with_champion_selection(
        self,
        re_evaluations: ReEvaluations,
        champion_selection: impl ChampionSelection<S::Genome> + 'static,
    ) -> Self {
        Self {
            selection: Some(ScheduledSelection { re_evaluations, champion_selection: Box::new(champion_selection) }),
            ..self
        }
    }

    /// Adds a candidate from before the run, the first that a champion selection judges: what another search has found is not lost
    /// before this one finds something better. Without a champion selection it is never looked at.
    #[must_use]
    pub fn with_candidate(mut self, genome: S::Genome) -> Self {
        self.candidates.insert(0, Candidate { genome, fitness: None, generation: 0 });
        self
    }

    /// Asks a promotion after every generation; with its decision the run ends.
    #[must_use]
    pub fn with_promotion(self, promotion: impl Promotion + 'static) -> Self {
        Self { promotion: Some(BoxedPromotion(Box::new(promotion))), ..self }
    }

    /// Uses this switch to end the run early.
    #[must_use]
    pub fn with_signal(self, signal: StopSignal) -> Self {
        Self { signal, ..self }
    }

    /// Runs until a stop condition is met.
    ///
    /// # Errors
    /// If an observer fails, the strategy asks for nothing, or evaluator or champion selection do not give one evaluation for
    /// each genome. The evolution stays whole: it can be saved or run again.
    pub fn run(
        &mut self,
        task: &dyn Task,
        evaluator: &impl Evaluator,
        observers: &mut [Box<dyn Observer<S> + '_>],
    ) -> Result<StopReason, EvolutionError> {
        // The clock is not read without need: not everywhere is there one.
        let start = self.stop.minutes.map(|_| Instant::now());
        loop {
            if let Some(reason) = self.stop_reason(start.map_or(Duration::ZERO, |start| start.elapsed())) {
                return Ok(reason);
            }
            self.generation(task, evaluator, observers)?;
        }
    }

    /// Why it is to end before the next generation, `elapsed` after it began; `None`: it goes on.
    pub fn stop_reason(&self, elapsed: Duration) -> Option<StopReason> {
        match self.decision {
            Decision::Stay => {}
            Decision::Promote => return Some(StopReason::Promoted),
            Decision::Demote => return Some(StopReason::Demoted),
            Decision::GiveUp => return Some(StopReason::GivenUp),
        }
        let best = self.champion.as_ref().map(Champion::standing);
        let reached = self.stop.reached(&self.progress, best, elapsed);
        reached.or_else(|| self.signal.is_set().then_some(StopReason::Interrupted))
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
        let _span = tracing::debug_span!("generation", generation).entered();
        let seed = self.seed.generation(generation);
        // After an evaluator that gave none, the genomes are those it had.
        let genomes = self.asked.take().unwrap_or_else(|| self.strategy.ask(seed).to_vec());
        if genomes.is_empty() {
            return Err(EvolutionError::EmptyPopulation { strategy: self.strategy.name().into(), generation });
        }
        let evaluate = || evaluator.evaluate(task, &genomes, seed);
        let evaluations = tracing::debug_span!("evaluation", individuals = genomes.len()).in_scope(evaluate);
        if evaluations.len() != genomes.len() {
            let (found, expected) = (evaluations.len(), genomes.len());
            self.asked = Some(genomes);
            return Err(EvolutionError::EvaluationCount { found, expected, generation });
        }
        self.strategy.tell(&evaluations, seed);
        self.progress.generations = generation;
        self.progress.evaluations += evaluations.len() as u64;
        self.progress.steps += evaluations.iter().map(|evaluation| evaluation.steps).sum::<u64>();
        let (improved, re_evaluation) = match self.selection.take() {
            None => (self.make_champion(best_of(&genomes, &evaluations, seed), 1), None),
            Some(selection) => {
                let outcome = self.nominate(&selection, &genomes, &evaluations);
                self.selection = Some(selection);
                outcome.map_err(|wrong| wrong.into_error(generation))?
            }
        };
        let statistics = self.strategy.statistics();
        if let Some(found) = statistics.iter().find(|statistic| !statistic.value.is_finite()) {
            let (strategy, statistic) = (self.strategy.name().to_owned(), found.name.clone());
            return Err(EvolutionError::Statistic { strategy, statistic, value: found.value, generation });
        }
        let report = GenerationReport {
            generation,
            evaluations: self.progress.evaluations,
            steps: self.progress.steps,
            best_so_far: self.champion.as_ref().map(|champion| champion.fitness),
            tier: self.champion.as_ref().map_or(0, |champion| champion.tier),
            fitness: Quantiles::of(&evaluations),
            failures: evaluations.iter().filter(|evaluation| evaluation.outcome.is_err()).count() as u64,
            failure: commonest_failure(&evaluations),
            population: genomes.len() as u64,
            strategy: statistics,
            species: self.strategy.species(),
            re_evaluation,
        };
        if let Some(BoxedPromotion(promotion)) = &self.promotion {
            let champion = self.champion.as_ref().map(Champion::standing);
            let state = StageState { report: &report, evaluations: &evaluations, champion, progress: self.progress };
            self.decision = promotion.decide(&state);
        }
        tracing::debug!(generation, best = ?report.best_so_far, failures = report.failures, "generation done");
        let event = Generation {
            report: &report,
            genomes: &genomes,
            evaluations: &evaluations,
            champion: self.champion.as_ref(),
            improved,
            candidates: &self.candidates,
            strategy: &self.strategy,
            progress: self.progress,
            seed: self.seed,
            label: &self.label,
            decision: self.decision,
            stop: &self.stop,
        };
        for observer in observers {
            observer.generation(&event)?;
        }
        Ok(report)
    }

    /// Makes the candidate champion if it beats the old one; otherwise so many more generations have passed without.
    fn make_champion(&mut self, candidate: Option<Champion<S::Genome>>, generations: u64) -> bool {
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

    /// Makes the best of this generation a candidate, or of its [group](ReEvaluations::group); if it is time for a re-evaluation, does it.
    fn nominate(
        &mut self,
        selection: &ScheduledSelection<S::Genome>,
        genomes: &[S::Genome],
        evaluations: &[Evaluation],
    ) -> Result<(bool, Option<ReEvaluationReport>), WrongCount> {
        let generation = self.progress.generations;
        let span = selection.re_evaluations.span(generation);
        let count = if span.is_some() { selection.re_evaluations.candidates.max(1) } else { 1 };
        let best = ranking(evaluations).into_iter().take(count);
        let candidate = |(index, fitness): (usize, _)| Candidate {
            genome: genomes[index].clone(),
            fitness: Some(fitness),
            generation,
        };
        let best = best.map(candidate);
        match span {
            Some(_) => self.candidates.extend(best),
            None => best.for_each(|best| selection.re_evaluations.keep(&mut self.candidates, best)),
        }
        let Some(span) = span else { return Ok((false, None)) };
        let (report, best) = self.re_evaluate(selection)?;
        self.candidates.clear();
        Ok((self.make_champion(best, span), Some(report)))
    }

    /// Re-evaluates those that wait and, if the champion selection asks for it, what the strategy recommends.
    fn re_evaluate(&self, selection: &ScheduledSelection<S::Genome>) -> ReEvaluated<S::Genome> {
        let asked = selection.champion_selection.takes_recommendation();
        let recommended = asked.then(|| self.strategy.recommendation()).flatten();
        let generation = self.progress.generations;
        let recommended = recommended.map(|genome| Candidate { genome, fitness: None, generation });
        let candidates: Vec<_> = self.candidates.iter().cloned().chain(recommended).collect();
        selection.re_evaluate(&candidates, self.champion.as_ref().map(Champion::standing))
    }

    /// The best so far, if any evaluation succeeded.
    pub fn champion(&self) -> Option<&Champion<S::Genome>> {
        self.champion.as_ref()
    }

    /// The champion there would be if a re-evaluation were done now: the best of the present one and all candidates. Changes
    /// nothing. Without a champion selection, or without candidates, the [champion](Self::champion).
    ///
    /// # Errors
    /// If the champion selection does not give one evaluation for each candidate.
    pub fn champion_if_re_evaluated(&self) -> Result<Option<Champion<S::Genome>>, EvolutionError> {
        let present = self.champion.clone();
        let Some(selection) = self.selection.as_ref().filter(|_| !self.candidates.is_empty()) else {
            return Ok(present);
        };
        let standing = |champion: &Option<Champion<S::Genome>>| champion.as_ref().map(Champion::standing);
        let (_, best) = self.re_evaluate(selection).map_err(|wrong| wrong.into_error(self.progress.generations))?;
        Ok(if standing(&best) > standing(&present) { best } else { present })
    }

    /// Those that wait for the next re-evaluation, in the order in which they were evaluated.
    pub fn candidates(&self) -> &[Candidate<S::Genome>] {
        &self.candidates
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
        self.write(path, false)
    }

    /// As [`write_checkpoint`](Self::write_checkpoint), and [marks](Checkpoint::last) it as the last. To be written after all
    /// else that is made at the end of a run: one that is killed before it is seen to lack its end.
    ///
    /// # Errors
    /// If the file cannot be written; an older one is then still there.
    pub fn write_last_checkpoint(&self, path: &Path) -> Result<(), ArchiveError> {
        self.write(path, true)
    }

    fn write(&self, path: &Path, last: bool) -> Result<(), ArchiveError> {
        let (seed, progress, decision, strategy) = (self.seed, self.progress, self.decision, &self.strategy);
        let (champion, candidates) = (self.champion.as_ref(), self.candidates.as_slice());
        let label = self.label.as_str();
        let parts = checkpoint::CheckpointRef { seed, label, progress, champion, candidates, decision, last, strategy };
        checkpoint::write_parts(path, &parts)
    }
}

impl<S: Strategy> Generation<'_, S> {
    /// Writes the checkpoint of this moment, as [`Evolution::write_checkpoint`] does.
    ///
    /// # Errors
    /// If the file cannot be written; an older one is then still there.
    pub fn write_checkpoint(&self, path: &Path) -> Result<(), ArchiveError> {
        let Self { seed, label, progress, champion, candidates, decision, strategy, .. } = *self;
        let last = false;
        let parts = checkpoint::CheckpointRef { seed, label, progress, champion, candidates, decision, last, strategy };
        checkpoint::write_parts(path, &parts)
    }
}

impl WrongCount {
    fn into_error(self, generation: u64) -> EvolutionError {
        EvolutionError::ReEvaluationCount { found: self.found, expected: self.expected, generation }
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
        diverged: false,
        tier: 0,
    })
}

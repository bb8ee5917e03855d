use crate::{
    Candidate, Champion, Evaluation, GenerationReport, Progress, Seed, StopConditions, Strategy, promotion::Decision,
};

/// What an observer reports when it cannot do its work (a disk is full): the run ends with this error, nothing lost.
pub type ObserverError = Box<dyn std::error::Error + Send + Sync>;

/// Is told of each generation, and changes nothing.
///
/// Observers get shared references and run between generations on the thread of the loop; what takes long belongs on a
/// thread of its own. With or without observers a run gives the same bits.
pub trait Observer<S: Strategy> {
    /// A generation was evaluated and told to the strategy.
    ///
    /// # Errors
    /// An error ends the run; the evolution itself stays whole and can go on.
    fn generation(&mut self, generation: &Generation<'_, S>) -> Result<(), ObserverError>;
}

/// An observer that is lent can be read after the run: `&mut [Box::new(&mut progress)]`.
impl<S: Strategy, O: Observer<S> + ?Sized> Observer<S> for &mut O {
    fn generation(&mut self, generation: &Generation<'_, S>) -> Result<(), ObserverError> {
        (**self).generation(generation)
    }
}

/// All there is to know of a generation that has just been told to the strategy.
#[derive(Debug)]
pub struct Generation<'a, S: Strategy> {
    /// The numbers.
    pub report: &'a GenerationReport,
    /// The genomes that were evaluated; the strategy owned them and has bred nothing from them yet.
    pub genomes: &'a [S::Genome],
    /// Their evaluations, in the same order.
    pub evaluations: &'a [Evaluation],
    /// The best of the run so far, if any evaluation succeeded.
    pub champion: Option<&'a Champion<S::Genome>>,
    /// Whether the champion is new: of this generation or, with a champion selection, of this re-evaluation.
    pub improved: bool,
    /// The candidates that wait for the next re-evaluation; none without a champion selection.
    pub candidates: &'a [Candidate<S::Genome>],
    /// The strategy after `tell`.
    pub strategy: &'a S,
    /// Budgets used.
    pub progress: Progress,
    /// The run's seed.
    pub seed: Seed,
    /// What [`with_label`](crate::Evolution::with_label) was told; empty without.
    pub label: &'a str,
    /// What a [`Promotion`](crate::promotion::Promotion) says; without one always to stay.
    pub decision: Decision,
    /// When the run will end.
    pub stop: &'a StopConditions,
}

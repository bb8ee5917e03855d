//! When a population has learned enough to go on to something else.

mod rule;

pub use rule::{MeasurementBound, PopulationShare, PromotionRule};

use crate::{Evaluation, GenerationReport, Progress, TieredFitness};
use serde::{Deserialize, Serialize};

/// Says when a population leaves the task it is on: for the next stage of a curriculum, or back to the one before.
///
/// With a promotion ([`Evolution::with_promotion`](crate::Evolution::with_promotion)) a run ends after the generation that
/// brings a decision, whatever the stop conditions say; the decision is part of the checkpoint. What comes next is up to
/// the caller that runs the stages. [`PromotionRule`] has the usual ones.
///
/// An implementor owes: the same decision for the same state. All that it needs to remember is in the state, or a run that
/// was killed and resumed would take another way.
///
/// ```
/// use ne_core::promotion::{Decision, Promotion, StageState};
///
/// /// Enough once half of the population can do what the best could do for ten generations.
/// struct Consolidated;
/// impl Promotion for Consolidated {
///     fn decide(&self, state: &StageState<'_>) -> Decision {
///         let median = state.report.fitness.map(|fitness| fitness.median);
///         let good = state.report.best_so_far.map(|best| best.get() * 0.8);
///         let settled = state.progress.stagnation >= 10;
///         if settled && median >= good { Decision::Promote } else { Decision::Stay }
///     }
/// }
/// ```
pub trait Promotion: Send + Sync {
    /// What is to be done after this generation.
    fn decide(&self, state: &StageState<'_>) -> Decision;
}

/// What a [`Promotion`] is shown: a generation of a stage that has just been told to the strategy.
#[derive(Clone, Copy, Debug)]
pub struct StageState<'a> {
    /// The numbers of the generation.
    pub report: &'a GenerationReport,
    /// Its evaluations, in the order of the individuals.
    pub evaluations: &'a [Evaluation],
    /// Where the champion of the stage stands.
    pub champion: Option<TieredFitness>,
    /// What the stage has used up.
    pub progress: Progress,
}

/// What becomes of a population.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Decision {
    /// It goes on where it is.
    #[default]
    Stay,
    /// It goes on to the next stage.
    Promote,
    /// It goes back to the stage before.
    Demote,
    /// It is given up: another begins anew, at an earlier stage or this one.
    GiveUp,
}

impl Decision {
    pub(crate) fn is_stay(&self) -> bool {
        *self == Self::Stay
    }
}

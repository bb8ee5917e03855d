//! When a population has learned enough to go on to something else.

mod rule;

pub use rule::{PopulationShare, Reached, Rule};

use crate::{Evaluation, GenerationReport, Progress, Standing};
use serde::{Deserialize, Serialize};

/// Says when a population leaves the task it is on: for the next stage of a longer education, or back to the one before.
///
/// With a promotion ([`Evolution::with_promotion`](crate::Evolution::with_promotion)) a run ends after the generation that
/// brings a decision, whatever the stop conditions say; the decision is part of the checkpoint. What comes next is up to
/// whoever runs the stages. [`Rule`] has the usual ones.
///
/// An implementor owes: the same decision for the same moment. Whatever it needs to remember is in the moment, or a run that
/// was killed and resumed would take another way.
///
/// ```
/// use ne_core::{Decision, Moment, Promotion};
///
/// /// Enough once half of the population can do what the best could do for ten generations.
/// struct Consolidated;
/// impl Promotion for Consolidated {
///     fn decide(&self, moment: &Moment<'_>) -> Decision {
///         let median = moment.report.fitness.map(|fitness| fitness.median);
///         let good = moment.report.best_so_far.map(|best| best.get() * 0.8);
///         let settled = moment.progress.stagnation >= 10;
///         if settled && median >= good { Decision::Promote } else { Decision::Stay }
///     }
/// }
/// ```
pub trait Promotion: Send + Sync {
    /// What is to be done after this generation.
    fn decide(&self, moment: &Moment<'_>) -> Decision;
}

/// What a [`Promotion`] is shown: a generation of a stage that has just been told to the strategy.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The numbers of the generation.
    pub report: &'a GenerationReport,
    /// Its evaluations, in the order of the individuals.
    pub evaluations: &'a [Evaluation],
    /// Where the champion of the stage stands.
    pub champion: Option<Standing>,
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
}

impl Decision {
    pub(crate) fn is_stay(&self) -> bool {
        *self == Self::Stay
    }
}

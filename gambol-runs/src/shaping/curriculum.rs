use super::StageRun;
use crate::config::{RunConfig, Transferred};
use ne_core::promotion::Promotion;
use std::sync::Arc;

/// Says which stage comes next.
///
/// [`Stages`](super::Stages) follows the list in a configuration. One of your own may make stages up as it goes along: raise
/// the difficulty of a terrain with every stage passed, lower it after a demotion.
///
/// An implementor owes: the same stage for the same stage runs. A run that is resumed asks for all of them again.
pub trait Curriculum: Send + Sync {
    /// The stage after these stage runs, which is the first after none; `None`: the run is done.
    fn next(&self, stage_runs: &[StageRun]) -> Option<PlannedStage>;
}

impl<C: Curriculum + ?Sized> Curriculum for &C {
    fn next(&self, stage_runs: &[StageRun]) -> Option<PlannedStage> {
        (**self).next(stage_runs)
    }
}

/// Where a stage run begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beginning {
    /// Where the stage run before has ended; the first from nothing.
    #[default]
    Before,
    /// Where the stage run of this [number](StageRun::number) has ended.
    After(usize),
    /// From nothing.
    Nothing,
}

/// A stage that is to come.
#[derive(Clone)]
pub struct PlannedStage {
    /// Its index: a stage that is visited again has the same.
    pub stage: usize,
    /// Its name, of which its folder is made: lower-case letters, digits and hyphens.
    pub name: String,
    /// Everything that determines it, but for its seed and its limits, which follow from those of the whole run.
    pub config: RunConfig,
    /// When it is passed; `None`: it goes on until the run ends.
    pub promotion: Option<Arc<dyn Promotion>>,
    /// Whether it learns what the whole run is for, so that the fitness or the tier that the run is to reach can end it here.
    pub is_goal: bool,
    /// Where it begins.
    pub begins: Beginning,
    /// What it takes from the stage run in which it begins; `None`: as much as it can.
    pub transfer: Option<Transferred>,
    /// Whether inputs, outputs and weights may be given up.
    pub allow_loss: bool,
}

//! Shaping: what was learned on one task is transferred to the next.
//!
//! A run with [`stages`](crate::config::RunConfig::stages) learns one after the other: first to run on the flat, then over
//! gaps, with eyes, then with less energy. Its one decision: **every stage is a run folder of its own** inside the run's,
//! which begins where the one before ended. So everything that looks at a run looks at a stage as well, and a stage that was
//! killed is resumed as any run is. The same passage from one folder to the next is there for single runs: [`train_from`].
//!
//! | piece | what it is |
//! |---|---|
//! | [`StageSettings`](crate::config::StageSettings) | a stage in a configuration: what changes, when it is passed |
//! | [`Curriculum`] | says which stage comes next; [`Stages`] follows the list in a configuration, yours does what it likes |
//! | [`Promotion`](ne_core::promotion::Promotion) | says when a stage is passed; [`PromotionRule`](ne_core::promotion::PromotionRule) has the usual conditions |
//! | [`Transferred`](crate::config::Transferred), [`Origin`](crate::config::Origin) | what goes from one stage to the next, and what went |
//! | [`train_stages`], [`resume_stages`] | the way through the stages; a [`StagedTraining`] goes it one generation at a time |

mod curriculum;
mod guess;
mod source;
mod stage_progress;
mod stage_runs;
mod staged_training;
mod stages;
mod transfer;

pub use curriculum::{Beginning, Curriculum, PlannedStage};
pub use stage_progress::{
    ENDED_EARLY, ShapingError, StageProgress, adopt, begin_from, configured_from, is_of_goal, outcome_of,
    resume_curriculum, resume_stages, train_curriculum, train_from, train_stages,
};
pub use stage_runs::{StageRun, check_whole, leading, run_of_stage, stage_runs, why_all_failed};
pub use staged_training::StagedTraining;
pub use stages::{StageError, StageProblem, Stages};
pub use transfer::TransferError;

#[cfg(test)]
mod tests;

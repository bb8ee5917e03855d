//! One run: trained, judged, perturbed.

use super::GaitsError;
use creatures::Blueprint;
use gambol_runs::{
    Registry,
    champion::Champion,
    config::{Origin, RunConfig},
    gait,
    judge::USABLE,
    robust::{Perturbations, robustness},
    run::Run,
    shaping::{PlannedStage, ShapingError, StageProgress},
    strategies::AnyStrategy,
    training::{Outcome, Resources},
};
use ne_core::{Generation, StopReason};
use serde::{Deserialize, Serialize};
use std::{cell::Cell, path::Path, time::Instant};
use tasks::gait::Goal;

/// What came of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GaitRun {
    /// The creature's name.
    pub creature: String,
    /// The movement's name.
    pub movement: String,
    /// The seed.
    pub seed: u64,
    /// Whether the saved champion is usable.
    pub usable: bool,
    /// What speaks against it.
    pub reasons: Vec<String>,
    /// Seconds until the champion was first usable; of a run with stages in one that learns what the whole run is for.
    pub seconds_to_usable: Option<f64>,
    /// Physics steps until then; of a run with stages those of all that came before.
    pub steps_to_usable: Option<u64>,
    /// Seconds the training took, champion selection included.
    pub seconds: f64,
    /// Generations.
    pub generations: u64,
    /// Physics steps; those of the champion selection are not counted.
    pub steps: u64,
    /// Body lengths a second in the second half of the judged episode (running), or the torso's rise in its best flight
    /// over its start height (jumping).
    pub quality: Option<f64>,
    /// Share of perturbed worlds in which it is usable, 0 to 1; `None` if it was not asked for.
    pub robust: Option<f64>,
}

impl GaitRun {
    /// Trains, and judges the champion. `threads`: 0 means one for each core. `robust`: whether it is replayed in
    /// perturbed worlds.
    ///
    /// # Errors
    /// If the configuration is refused, or a temporary folder cannot be written.
    pub(super) fn measure(
        config: &RunConfig,
        registry: &Registry,
        threads: usize,
        robust: bool,
    ) -> Result<Self, GaitsError> {
        let folder = tempfile::tempdir().map_err(GaitsError::Temporary)?;
        let began = Instant::now();
        let resources = Resources { threads, registry: registry.clone(), signal: Default::default() };
        let (outcome, first) = until_over(config, &folder.path().join("run"), resources, began)?;
        let seconds = began.elapsed().as_secs_f64();
        let mut run = Self {
            creature: config.creature.name.clone(),
            movement: config.movement.name.clone(),
            seed: config.seed,
            usable: false,
            reasons: vec!["every evaluation failed".into()],
            seconds_to_usable: first.map(|(seconds, _)| seconds),
            steps_to_usable: first.map(|(_, steps)| steps),
            seconds,
            generations: outcome.progress.generations,
            steps: outcome.progress.steps,
            quality: None,
            robust: None,
        };
        if let Some(champion) = &outcome.champion {
            run.judge(champion, registry, robust)?;
        }
        Ok(run)
    }

    fn judge(&mut self, champion: &Champion, registry: &Registry, robust: bool) -> Result<(), GaitsError> {
        let report = gait::judge(champion, registry)?;
        let Some(verdict) = &report.verdict else {
            self.reasons = vec!["the movement is not judged".into()];
            return Ok(());
        };
        self.usable = verdict.usable;
        self.reasons = verdict.reasons.iter().map(ToString::to_string).collect();
        let start_height = f64::from(Blueprint::new(champion.creature.clone())?.start_height());
        self.quality = Some(match report.view.goal {
            Goal::Distance => report.travel.second_half_relative_speed,
            Goal::Height => report.best_flight().map_or(0.0, |flight| flight.rise / start_height),
        });
        // A run whose champion is usable at the last re-evaluation only, after the last generation.
        if self.usable && self.seconds_to_usable.is_none() {
            (self.seconds_to_usable, self.steps_to_usable) = (Some(self.seconds), Some(self.steps));
        }
        if robust {
            self.robust = Some(robustness(champion, registry, &Perturbations::default())?.usable_share);
        }
        Ok(())
    }
}

/// When a champion was first usable: seconds, and physics steps.
type First = Option<(f64, u64)>;

/// The run to its end, with stages or without.
fn until_over(
    config: &RunConfig,
    folder: &Path,
    resources: Resources,
    began: Instant,
) -> Result<(Outcome, First), ShapingError> {
    let (is_goal, before, in_stage) = (Cell::new(config.stages.is_empty()), Cell::new(0), Cell::new(0));
    let mut run = Run::begin(config, folder, resources)?;
    let mut first = None;
    let reason: StopReason = loop {
        let mut on_stage_run = |stage: &PlannedStage, _: Option<&Origin>| {
            is_goal.set(stage.is_goal);
            before.set(before.get() + in_stage.take());
        };
        let mut on_generation = |generation: &Generation<'_, AnyStrategy>| {
            in_stage.set(generation.report.steps);
            if first.is_none() && is_goal.get() && generation.report.tier >= USABLE {
                first = Some((began.elapsed().as_secs_f64(), before.get() + in_stage.get()));
            }
        };
        if let Some(reason) =
            run.generation(&mut StageProgress { on_stage_run: &mut on_stage_run }, &mut on_generation)?
        {
            break reason;
        }
    };
    Ok((run.finish(reason)?, first))
}

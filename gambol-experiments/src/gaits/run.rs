//! One run: trained, judged, perturbed.

use super::GaitsError;
use creatures::Blueprint;
use gambol_runs::{
    Registry,
    champion::Champion,
    config::{Origin, RunConfig},
    gait,
    judge::{USABLE, tier_to_reach},
    robust::{Perturbations, robustness},
    run::Run,
    run_folder::RunFolder,
    shaping::{ENDED_EARLY, PlannedStage, ShapingError, StageProgress, is_of_goal, leading, stage_runs},
    strategies::AnyStrategy,
    training::{Outcome, Resources},
};
use ne_core::{Generation, StopReason};
use serde::{Deserialize, Serialize};
use std::{path::Path, time::Instant};
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
    /// Seconds until the champion first had the [tier to reach](tier_to_reach); of a run with stages in one that learns what the
    /// whole run is for. `None` where only the verdict at the end, which is of one episode, is good.
    pub seconds_to_usable: Option<f64>,
    /// Physics steps until then, of all stages together.
    pub steps_to_usable: Option<u64>,
    /// Seconds the training took, champion selection included.
    pub seconds: f64,
    /// Generations.
    pub generations: u64,
    /// Physics steps; those of the champion selection are not counted.
    pub steps: u64,
    /// Body lengths a second in the second half of the judged episode (running), or the torso's rise in its best flight
    /// over its start height (jumping); 0 without a champion.
    pub quality: Option<f64>,
    /// Share of perturbed worlds in which it is usable, 0 to 1; 0 without a champion; `None` if it was not asked for.
    pub robust: Option<f64>,
}

impl GaitRun {
    /// Trains, and judges the champion. `robust`: whether it is replayed in perturbed worlds.
    ///
    /// # Errors
    /// If the configuration is refused, a temporary folder cannot be written, or the signal was given.
    pub(super) fn measure(config: &RunConfig, resources: Resources, robust: bool) -> Result<Self, GaitsError> {
        let registry = &resources.registry.clone();
        let folder = tempfile::tempdir().map_err(GaitsError::Temporary)?;
        let began = Instant::now();
        let tier = tier_to_reach(config, registry);
        let (outcome, first) = until_over(config, &folder.path().join("run"), resources, tier, began)?;
        if outcome.reason == StopReason::Interrupted {
            return Err(GaitsError::Interrupted);
        }
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
        match &outcome.champion {
            Some(champion) => run.judge(champion, &outcome.folder, registry, robust)?,
            None if registry.movements.rules(&run.movement).is_some() => {
                (run.quality, run.robust) = (Some(0.0), robust.then_some(0.0));
            }
            None => {}
        }
        // At the last re-evaluation, after the last generation. The verdict at the end is of one episode: it says nothing of a higher tier.
        if run.usable && first.is_none() && (tier == USABLE || tier_of_stages(&outcome.folder)? >= Some(tier)) {
            (run.seconds_to_usable, run.steps_to_usable) = (Some(run.seconds), Some(run.steps));
        }
        Ok(run)
    }

    fn judge(
        &mut self,
        champion: &Champion,
        folder: &RunFolder,
        registry: &Registry,
        robust: bool,
    ) -> Result<(), GaitsError> {
        let report = gait::judge(champion, registry)?;
        let Some(verdict) = &report.verdict else {
            self.reasons = vec!["the movement is not judged".into()];
            return Ok(());
        };
        self.usable = verdict.usable;
        self.reasons = verdict.reasons.iter().map(ToString::to_string).collect();
        // That it moves as it is told says nothing of jumps, which a later stage is about.
        if !is_of_goal(folder, registry)? {
            self.usable = false;
            self.reasons.push(ENDED_EARLY.into());
        }
        let start_height = f64::from(Blueprint::new(champion.creature.clone())?.start_height());
        self.quality = Some(match report.view.goal {
            Goal::Distance => report.travel.second_half_relative_speed,
            Goal::Height => report.best_flight().map_or(0.0, |flight| flight.rise / start_height),
        });
        if robust {
            self.robust = Some(robustness(champion, registry, &Perturbations::default())?.usable_share);
        }
        Ok(())
    }
}

/// The tier of the champion of a run with stages.
fn tier_of_stages(folder: &RunFolder) -> Result<Option<u8>, ShapingError> {
    let stage_runs = stage_runs(folder)?;
    Ok(leading(&stage_runs).and_then(|stage_run| stage_run.champion).map(|champion| champion.tier))
}

/// When the champion first had the tier to reach: seconds, and physics steps.
type First = Option<(f64, u64)>;

/// The run to its end, with stages or without.
fn until_over(
    config: &RunConfig,
    folder: &Path,
    resources: Resources,
    tier_to_reach: u8,
    began: Instant,
) -> Result<(Outcome, First), ShapingError> {
    let mut run = Run::begin(config, folder, resources)?;
    let (mut is_goal, mut before, mut in_stage) = (config.stages.is_empty(), 0, 0);
    let mut first = None;
    loop {
        let (mut begun, mut done) = (None, None);
        let mut on_stage_run = |stage: &PlannedStage, _: Option<&Origin>| begun = Some(stage.is_goal);
        let mut on_generation =
            |generation: &Generation<'_, AnyStrategy>| done = Some((generation.report.tier, generation.report.steps));
        let over = run.generation(&mut StageProgress { on_stage_run: &mut on_stage_run }, &mut on_generation)?;
        if let Some(begun) = begun {
            (is_goal, before, in_stage) = (begun, before + in_stage, 0);
        }
        if let Some((tier, steps)) = done {
            in_stage = steps;
            if first.is_none() && is_goal && tier >= tier_to_reach {
                first = Some((began.elapsed().as_secs_f64(), before + in_stage));
            }
        }
        if let Some(reason) = over {
            return Ok((run.finish(reason)?, first));
        }
    }
}

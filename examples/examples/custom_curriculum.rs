//! A curriculum of one's own: gaps that grow wider as long as the creature keeps up, and narrower when it does not.
//!
//! The stages are not listed anywhere; each is made from how the ones before it went.

use gambol::Registry;
use gambol::{
    config::RunConfig,
    report::write_report,
    shaping::{Beginning, Curriculum, PlannedStage, StageProgress, StageRun, stage_runs, train_curriculum},
    training::TrainOptions,
};
use ne_core::promotion::{Decision, Promotion, StageState};
use std::sync::Arc;

/// Gaps of a width that follows from how often stages were passed.
struct WiderAndWider {
    base: RunConfig,
    stages: usize,
}

/// How much harder, of 1, each stage is than the one before.
const STEP: f64 = 0.1;

impl Curriculum for WiderAndWider {
    fn next(&self, legs: &[StageRun]) -> Option<PlannedStage> {
        let passed = |leg: &StageRun| if leg.decision == Decision::Promote { 1.0 } else { -1.0 };
        let level = legs.iter().map(passed).sum::<f64>().max(0.0);
        let mut config = self.base.clone();
        config.terrain.difficulty = (level * STEP).min(1.0) as f32;
        let stage = level as usize;
        (legs.len() < self.stages).then(|| PlannedStage {
            stage,
            name: format!("gaps-{stage}0"),
            config,
            promotion: Some(Arc::new(KeepsUp)),
            is_goal: false,
            begins: Beginning::Before,
            transfer: None,
            allow_loss: false,
        })
    }
}

/// Passed when the average individual lasts most of an episode; too hard when even the best have stopped getting better.
struct KeepsUp;

impl Promotion for KeepsUp {
    fn decide(&self, moment: &StageState<'_>) -> Decision {
        let seconds = moment.evaluations.iter().filter_map(|evaluation| evaluation.measurements.get("duration"));
        let mean = seconds.sum::<f64>() / moment.evaluations.len() as f64;
        match moment.progress.generations {
            _ if mean > 1.0 => Decision::Promote,
            0..4 => Decision::Stay,
            _ => Decision::Demote,
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut base = Registry::default().config("default", creatures::find("tetrapod-2")?, "running")?;
    base.terrain = Registry::default().terrains.terrain("gaps")?;
    base.strategy.set_population(16);
    base.training_steps = Some(100);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let options = TrainOptions {
        threads: 0,
        registry: Registry::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let curriculum = WiderAndWider { base: base.clone(), stages: 6 };
    let told = &mut |stage: &PlannedStage, _: Option<&_>| println!("{}", stage.name);
    let outcome = train_curriculum(&curriculum, &base, &path, StageProgress { on_stage_run: told }, options)?;
    for leg in stage_runs(&outcome.folder)? {
        println!("{:02}-{}: {:?} after {} generations", leg.number, leg.name, leg.decision, leg.progress.generations);
    }
    write_report(&outcome.folder, &Registry::default(), Some(outcome.reason))?;
    println!("the report has {} KB", std::fs::metadata(outcome.folder.report())?.len() / 1000);
    let champion = outcome.champion.ok_or("there is no champion")?;
    println!("the champion of the last stage runs {:.1} m", champion.fitness);
    if champion.verify(&Registry::default())?.is_identical() { Ok(()) } else { Err("it cannot be repeated".into()) }
}

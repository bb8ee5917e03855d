//! A run that is done one generation at a time, or evaluated elsewhere, is the run that `train` does.

use gambol_runs::{
    Registry,
    config::RunConfig,
    request::Request,
    run::Run,
    shaping::{StageProgress, train_stages},
    training::{Answers, BatchEvaluator, Resources, Step, TrainOptions, train},
};
use ne_core::StopReason;
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn config(creature: &str, movement: &str, set: &[&str]) -> Result<RunConfig, Box<dyn std::error::Error>> {
    by(None, creature, movement, set)
}

fn by(
    strategy: Option<&str>,
    creature: &str,
    movement: &str,
    set: &[&str],
) -> Result<RunConfig, Box<dyn std::error::Error>> {
    let request = Request {
        creature: Some(creature.into()),
        movement: Some(movement.into()),
        strategy: strategy.map(Into::into),
        set: set.iter().map(|&set| set.into()).collect(),
        ..Request::default()
    };
    Ok(request.resolve(&Registry::default())?)
}

fn options(
    on_generation: &mut dyn FnMut(&ne_core::Generation<'_, gambol_runs::strategies::AnyStrategy>),
) -> TrainOptions<'_> {
    TrainOptions { threads: 1, registry: Registry::default(), signal: Default::default(), on_generation }
}

fn resources() -> Resources {
    Resources { threads: 1, registry: Registry::default(), signal: Default::default() }
}

/// Another run may have the place by then.
#[cfg(unix)]
#[test]
fn a_run_whose_folder_is_moved_ends_and_touches_nothing_there() -> Outcome {
    let place = tempfile::tempdir()?;
    let [folder, moved] = ["run", "moved"].map(|name| place.path().join(name));
    let config = config(
        "biped-1",
        "running",
        &["movement.steps=40", "strategy.cma-es.population=8", "record.checkpoint_every=2"],
    )?;
    let first = || {
        let mut training = gambol_runs::training::Training::begin(&config, &folder, &resources())?;
        training.generation(&mut |_| {})?;
        Ok::<_, Box<dyn std::error::Error>>(training)
    };
    let mut training = first()?;
    fs::rename(&folder, &moved)?;
    let says = "was moved, removed or replaced while its run was at work";
    let gone = training.generation(&mut |_| {}).expect_err("its folder is gone").to_string();
    assert!(gone.contains(says), "{gone}");
    assert!(!folder.exists());
    let training = first()?;
    fs::remove_dir_all(&folder)?;
    drop(train(&config, &folder, options(&mut |_| {}))?);
    let other = bytes(&folder);
    let gone = training.finish(StopReason::Interrupted).expect_err("another run has its folder").to_string();
    assert!(gone.contains(says), "{gone}");
    assert!(bytes(&folder) == other, "the other run is as it was");
    Ok(())
}

/// All files below a folder that are the same for the same run.
fn bytes(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with("timing.jsonl") {
                let name = path.strip_prefix(folder).expect("below").display().to_string();
                files.push((name, fs::read(&path).expect("a file")));
            }
        }
    }
    files.sort();
    files
}

fn same(one: &Path, other: &Path) {
    let (one, other) = (bytes(one), bytes(other));
    let names = |files: &[(String, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&one), names(&other));
    for ((name, one), (_, other)) in one.iter().zip(&other) {
        assert!(one == other, "{name} differs");
    }
}

/// Does a run to its end, with evaluations from elsewhere, each batch in pieces, the last piece first.
fn by_pieces(mut run: Run, piece: usize) -> Outcome {
    let (mut answers, mut wanted) = (Answers::default(), 0);
    let mut on_stage_run = |_: &gambol_runs::shaping::PlannedStage, _: Option<&_>| {};
    let mut stage_progress = StageProgress { on_stage_run: &mut on_stage_run };
    loop {
        match run.generation_by(&mut answers, &mut stage_progress, &mut |_| {})? {
            Step::Done => {}
            Step::Over(reason) => {
                run.finish(reason)?;
                assert!(wanted > 0, "nothing was evaluated elsewhere");
                return Ok(());
            }
            Step::Wants(batch) => {
                wanted += 1;
                let config = serde_json::to_string(run.stage_config().ok_or("it trains")?)?;
                let elsewhere = BatchEvaluator::new(&serde_json::from_str(&config)?, &Registry::default())?;
                let pieces = batch.networks.chunks(piece).rev();
                let mut found = pieces
                    .map(|networks| {
                        let piece = serde_json::to_string(&gambol_runs::training::Batch {
                            networks: networks.to_vec(),
                            ..batch.clone()
                        })?;
                        let found = elsewhere.evaluate(serde_json::from_str(&piece)?);
                        serde_json::from_str::<Vec<ne_core::Evaluation>>(&serde_json::to_string(&found)?)
                    })
                    .collect::<Result<Vec<_>, serde_json::Error>>()?;
                found.reverse();
                answers.give(found.concat());
            }
        }
    }
}

#[test]
fn evaluated_elsewhere_it_has_the_same_bytes() -> Outcome {
    // Rungs ask for several batches a generation, NEAT for nets of any graph.
    let rungs = r#"rungs=[{"steps":60,"share":0.5},{"trials":1,"share":0.5}]"#;
    let cases =
        [(None, ["strategy.cma-es.population=16", rungs]), (Some("neat"), ["strategy.neat.population=20", "seed=3"])];
    for (strategy, set) in cases {
        let folder = tempfile::tempdir()?;
        let mut config = by(strategy, "biped-1", "running", &set)?;
        config.stop.generations = Some(12);
        train(&config, &folder.path().join("whole"), options(&mut |_| {}))?;
        by_pieces(Run::begin(&config, &folder.path().join("pieces"), resources())?, 5)?;
        same(&folder.path().join("whole"), &folder.path().join("pieces"));
    }
    Ok(())
}

#[test]
fn a_run_with_stages_does_too() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = config("tetrapod-1", "playing", &["strategy.cma-es.population=16"])?;
    (config.stop.generations, config.stop.steps) = (Some(14), None);
    assert!(!config.stages.is_empty());
    // Passed soon, so that there are several.
    for stage in config.stages.iter_mut().rev().skip(1) {
        stage.promotion = Some(serde_json::from_value(serde_json::json!({ "generations": 4 }))?);
        stage.give_up = None;
    }
    let mut on_stage_run = |_: &gambol_runs::shaping::PlannedStage, _: Option<&_>| {};
    let stage_progress = StageProgress { on_stage_run: &mut on_stage_run };
    train_stages(&config, &folder.path().join("whole"), stage_progress, options(&mut |_| {}))?;
    by_pieces(Run::begin(&config, &folder.path().join("pieces"), resources())?, 7)?;
    same(&folder.path().join("whole"), &folder.path().join("pieces"));
    Ok(())
}

#[test]
fn dropped_after_any_generation_it_is_resumed_to_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = config("biped-1", "running", &["strategy.cma-es.population=16"])?;
    config.stop.generations = Some(15);
    train(&config, &folder.path().join("whole"), options(&mut |_| {}))?;
    let path = folder.path().join("dropped");
    let mut run = Run::begin(&config, &path, resources())?;
    let mut generations = 0;
    loop {
        let mut on_stage_run = |_: &gambol_runs::shaping::PlannedStage, _: Option<&_>| {};
        let mut stage_progress = StageProgress { on_stage_run: &mut on_stage_run };
        match run.generation(&mut stage_progress, &mut |_| {})? {
            Some(reason) => {
                assert_eq!(reason, StopReason::Generations);
                run.finish(reason)?;
                break;
            }
            None => generations += 1,
        }
        if [3, 8, 14].contains(&generations) {
            drop(run);
            run = Run::resume(&path, None, resources())?;
        }
    }
    same(&folder.path().join("whole"), &path);
    Ok(())
}

#[test]
fn wrong_answers_break_a_run_off() -> Outcome {
    let folder = tempfile::tempdir()?;
    let config = config("biped-1", "running", &["strategy.cma-es.population=16"])?;
    let mut run = Run::begin(&config, &folder.path().join("run"), resources())?;
    let mut on_stage_run = |_: &gambol_runs::shaping::PlannedStage, _: Option<&_>| {};
    let mut stage_progress = StageProgress { on_stage_run: &mut on_stage_run };
    let mut answers = Answers::default();
    assert!(matches!(run.generation_by(&mut answers, &mut stage_progress, &mut |_| {})?, Step::Wants(_)));
    answers.give(Vec::new());
    let error = run.generation_by(&mut answers, &mut stage_progress, &mut |_| {}).expect_err("none is given");
    assert!(error.to_string().contains("the evaluator gave 0 evaluations for 16 genomes in generation 1"), "{error}");
    Ok(())
}

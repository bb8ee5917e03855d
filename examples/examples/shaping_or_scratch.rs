//! The experiment behind shaping: does it help to run on the flat before leaping gaps? `thrift.rs` has the one on thrift.
//!
//! Both learn on gaps that are laid out anew in every trial, and both are judged on twenty layouts that neither has seen.
//! Without arguments it is a matter of seconds and proves nothing; thirty paired seeds:
//!
//! ```text
//! cargo run --release -p gambol-examples --example shaping_or_scratch -- 30 20000000 runs/shaping
//! ```
//!
//! Arguments: seeds, physics steps of each run, a folder for the runs.

use creatures::Terrain;
use gambol::Registry;
use gambol::{
    champion::Champion,
    config::RunConfig,
    episode_parts::EpisodeParts,
    obstacles::ObstaclesPassed,
    request::Request,
    run_folder::RunFolder,
    shaping::{StageProgress, Stages, train_stages},
    training::{Outcome, TrainOptions, train},
    trajectory::Recording,
};
use ne_core::{Seed, StopConditions};
use ne_statistics::{Bootstrap, Comparison, Scores, mean, quantile};
use std::{error::Error, fs, path::Path};
use tasks::MovementSpec;

/// Crossing so many gaps within 40 s, the mean over all layouts, is a success.
const GAPS: f64 = 10.0;
const SECONDS: f32 = 40.0;
/// The terrain's seeds of the layouts that champions are judged on. Training draws its own from 64 bits.
const LAYOUTS: std::ops::Range<u64> = 5001..5021;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize, otherwise: u64| arguments.get(index).map_or(Ok(otherwise), |text| text.parse());
    let (seeds, steps) = (number(0, 1)?, number(1, 60_000)?);
    let temporary = tempfile::tempdir()?;
    let folder = arguments.get(2).map_or(temporary.path(), |path| Path::new(path));

    let story = concat!(env!("CARGO_MANIFEST_DIR"), "/../shaping/run-then-unseen-gaps.json");
    let request = Request { config: Some(story.into()), ..Request::default() };
    let registry = Registry::default();
    let mut shaped = request.resolve(&registry)?;
    shaped.stop = StopConditions { steps: Some(steps), ..StopConditions::default() };
    // Of the last stage alone: the same gaps, sensors, terms and search, and all the steps.
    let gaps = Stages::new(&shaped, &registry)?.configs().last().map(|(_, config)| config.clone());
    let scratch = gaps.ok_or("no stages")?;

    println!("| seed | gaps in 40 s, shaped | from scratch | m in 40 s, shaped | from scratch |");
    println!("|---|---|---|---|---|");
    let mut distances = [Vec::new(), Vec::new()];
    let mut successes = [0, 0];
    for seed in 1..=seeds {
        let mut crossed = [0.0, 0.0];
        for (arm, config) in [&shaped, &scratch].into_iter().enumerate() {
            let path = folder.join(format!("{}-{seed}", ["shaped", "scratch"][arm]));
            run(&RunConfig { seed, ..config.clone() }, &path)?;
            let (gaps, distance) = cross(&path, &scratch, &registry)?;
            crossed[arm] = gaps;
            successes[arm] += usize::from(gaps >= GAPS);
            distances[arm].push(distance);
        }
        let of = |arm: usize| distances[arm].last().copied().unwrap_or(0.0);
        println!("| {seed} | {:.1} | {:.1} | {:.1} | {:.1} |", crossed[0], crossed[1], of(0), of(1));
    }
    let [with, without] = distances;
    let comparison = Comparison::paired(Scores::new(&[with])?, Scores::new(&[without])?)?;
    let difference = |both: &Comparison| mean(both.x()) - mean(both.y());
    let interval = Bootstrap::default().comparison(&comparison, difference, Seed::of_run(1));
    println!("\nat least {GAPS} gaps: {} of {seeds} shaped, {} of {seeds} from scratch", successes[0], successes[1]);
    println!(
        "shaping is worth {:.1} m in 40 s, 95 % interval {:.1} to {:.1}; medians {:.1} and {:.1} m",
        interval.estimate,
        interval.low,
        interval.high,
        median(comparison.x()),
        median(comparison.y())
    );
    Ok(())
}

fn median(scores: &Scores) -> f64 {
    scores.rows().next().and_then(|row| quantile(row, 0.5)).unwrap_or(f64::NAN)
}

/// One run, unless it is there already. It has another name until it is complete, so that a killed one is not taken for one.
fn run(config: &RunConfig, folder: &Path) -> Result<(), Box<dyn Error>> {
    if folder.exists() {
        return match RunFolder::at(folder).read_config()? == *config {
            true => Ok(()),
            false => Err(format!("{} is of another experiment; name another folder", folder.display()).into()),
        };
    }
    let part = folder.with_extension("part");
    if part.exists() {
        fs::remove_dir_all(&part)?;
    }
    let options = TrainOptions {
        threads: 0,
        registry: Registry::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let _: Outcome = match config.stages.is_empty() {
        true => train(config, &part, options)?,
        false => train_stages(config, &part, StageProgress { on_stage_run: &mut |_, _| {} }, options)?,
    };
    Ok(fs::rename(part, folder)?)
}

/// How many gaps the champion crosses in 40 s, in rapier, and how far it gets, m: means over layouts it has not seen. One of a stage
/// before the last is put on the ground of the last.
fn cross(folder: &Path, last: &RunConfig, registry: &Registry) -> Result<(f64, f64), Box<dyn Error>> {
    let Ok(champion) = Champion::read(&folder.join("champion.json")) else { return Ok((0.0, 0.0)) };
    let steps = (SECONDS / last.physics.time_step).round() as u32;
    let movement = MovementSpec { steps: Some(steps), ..MovementSpec::new("running") };
    let (mut gaps, mut meters) = (Vec::new(), Vec::new());
    for seed in LAYOUTS {
        let terrain = Terrain { seed, ..last.terrain.clone() };
        let parts = EpisodeParts { movement: &movement, terrain: &terrain, ..champion.episode_parts() };
        let episode = parts.reference().build(registry)?;
        let mut recording = Recording::default();
        episode.play(&mut champion.network.clone(), Seed::of_run(1), &mut recording);
        let passed = ObstaclesPassed::count(episode.environment().landscape(), &recording.snapshots);
        gaps.push(passed.iter().map(|passed| passed.passed).sum::<usize>() as f64);
        let ends = recording.snapshots.first().zip(recording.snapshots.last());
        meters.push(ends.map_or(0.0, |(first, last)| f64::from(last.torso().x - first.torso().x)));
    }
    Ok((mean_of(&gaps), mean_of(&meters)))
}

fn mean_of(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

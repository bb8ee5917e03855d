//! The experiment behind the movement `cruising`: how much energy a metre does a population that can run save by
//! learning thrift?
//!
//! Without arguments it is a matter of seconds and proves nothing; ten seeds, as docs/shaping.md has them:
//!
//! ```text
//! cargo run --release -p gambol-examples --example thrift -- 10 760 runs/thrift
//! ```
//!
//! Arguments: seeds, generations of each run, a folder for the runs. With two numbers for the seeds, `11-14`, these.

use gambol::Registry;
use gambol::{
    champion::Champion,
    config::RunConfig,
    judge::Judge,
    request::Request,
    shaping::{StageProgress, train_stages},
    training::TrainOptions,
};
use ne_core::StopConditions;
use ne_statistics::quantile;
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};
use tasks::Environment;

/// A champion's gait, as `gambol gait` judges it: 60 s in rapier, without variation.
struct Gait {
    /// Body lengths a second.
    speed: f64,
    /// J/m; `None` for one that gets nowhere.
    cost: Option<f64>,
    usable: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |index: usize, otherwise| arguments.get(index).map_or(otherwise, String::as_str);
    let seeds = argument(0, "1");
    let (first, last) = seeds.split_once('-').unwrap_or(("1", seeds));
    let (first, last): (u64, u64) = (first.parse()?, last.parse()?);
    let generations = argument(1, "200").parse()?;
    let temporary = tempfile::tempdir()?;
    let folder = arguments.get(2).map_or(temporary.path(), |path| Path::new(path));

    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../shaping/run-then-thrift.json");
    let registry = Registry::default();
    let mut config = Request { config: Some(file.into()), ..Request::default() }.resolve(&registry)?;
    config.stop = StopConditions { generations: Some(generations), ..StopConditions::default() };

    println!("| seed | run: body lengths/s | J/m | thrift: body lengths/s | J/m | speed, % | J/m, % |");
    println!("|---|---|---|---|---|---|---|");
    let (mut speeds, mut costs) = (Vec::new(), Vec::new());
    for seed in first..=last {
        let path = folder.join(seed.to_string());
        train(&RunConfig { seed, ..config.clone() }, &path)?;
        if !stage_folder(&path, "02-thrift").exists() {
            println!("| {seed} | no usable gait to go on with | | | | | |");
            continue;
        }
        let [run, thrift] = [judge(&path, "01-run", &registry)?, judge(&path, "02-thrift", &registry)?];
        let (Some(before), Some(after)) = (run.cost, thrift.cost) else {
            println!("| {seed} | gets nowhere | | | | | |");
            continue;
        };
        let (speed, cost) = (100.0 * thrift.speed / run.speed, 100.0 * after / before);
        let remark = |gait: &Gait| if gait.usable { "" } else { " (not usable)" };
        println!(
            "| {seed} | {:.2}{} | {before:.1} | {:.2}{} | {after:.1} | {speed:.0} | {cost:.0} |",
            run.speed,
            remark(&run),
            thrift.speed,
            remark(&thrift)
        );
        speeds.push(speed);
        costs.push(cost);
    }
    match (quantile(&speeds, 0.5), quantile(&costs, 0.5)) {
        (Some(speed), Some(cost)) => {
            println!("\nmedians: {speed:.0} % of the speed, {cost:.0} % of the energy a metre")
        }
        _ => println!("\nno seed to compare"),
    }
    Ok(())
}

/// One run, unless it is there already. It has another name until it is complete, so that a killed one is not taken for one.
fn train(config: &RunConfig, folder: &Path) -> Result<(), Box<dyn Error>> {
    if folder.exists() {
        return Ok(());
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
    train_stages(config, &part, StageProgress { on_stage_run: &mut |_, _| {} }, options)?;
    Ok(fs::rename(part, folder)?)
}

fn stage_folder(run: &Path, stage: &str) -> PathBuf {
    run.join("stages").join(stage)
}

/// What the champion of a stage does.
fn judge(run: &Path, stage: &str, registry: &Registry) -> Result<Gait, Box<dyn Error>> {
    let champion = Champion::read(&stage_folder(run, stage).join("champion.json"))?;
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let report = judge.judge(&champion.network).ok_or("its body explodes")?;
    let body = judge.environment().body().ok_or("an unknown body")?;
    let weight = f64::from(body.mass() * body.gravity);
    Ok(Gait {
        speed: report.travel.relative_speed,
        cost: report.travel.cost_of_transport.map(|cost| cost * weight),
        usable: report.verdict.is_some_and(|verdict| verdict.usable),
    })
}

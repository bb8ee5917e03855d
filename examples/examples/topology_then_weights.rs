//! The experiment behind a stage for the topology: does it help that NEAT finds a net, in one body or in a class of them,
//! and CMA-ES its weights?
//!
//! Without arguments it is a matter of seconds and proves nothing; ten paired seeds, as docs/shaping.md has them:
//!
//! ```text
//! cargo run --release -p gambol-examples --example topology_then_weights -- 10 2000000 runs/topology
//! ```
//!
//! Arguments: seeds, physics steps of each run, a folder for the runs, a shipped creature whose legs are boxes, the share of
//! all connections from inputs to outputs that NEAT starts with.

use creatures::{Creature, Shape};
use gambol::Registry;
use gambol::{
    champion::Champion,
    config::{FrozenTopology, RunConfig},
    episode_parts::EpisodeParts,
    gait,
    request::Request,
    shaping::{StageProgress, train_stages},
    training::{TrainOptions, train},
};
use ne_core::{Seed, StopConditions, Task, promotion::PromotionRule};
use ne_statistics::{Bootstrap, Comparison, Scores, mean, quantile};
use std::{error::Error, fs, path::Path};
use tasks::MovementSpec;

const ARMS: [&str; 5] = ["topology-then-weights", "class-then-weights", "neat", "dense", "limbs"];
/// In a body whose legs are longer than any searched: CMA-ES from nothing, on nets that were found elsewhere or not.
const STRANGERS: [&str; 4] = ["stranger-of-one-body", "stranger-of-the-class", "stranger-dense", "stranger-limbs"];
/// How long the legs of the class of bodies are, beside the creature's own, and those of the stranger.
const CLASS: [f32; 2] = [0.8, 1.2];
const STRANGER: f32 = 1.15 * CLASS[1];

struct Experiment<'a> {
    creature: Creature,
    /// Settings of NEAT.
    start: Vec<String>,
    folder: &'a Path,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize, otherwise: u64| arguments.get(index).map_or(Ok(otherwise), |text| text.parse());
    let (seeds, steps) = (number(0, 1)?, number(1, 60_000)?);
    let temporary = tempfile::tempdir()?;
    let folder = arguments.get(2).map_or(temporary.path(), |path| Path::new(path));
    let creature = creatures::find(arguments.get(3).map_or("tetrapod-2", |name| name))?;
    let start =
        arguments.get(4).map(|share| format!("strategy.neat.start={{\"partly-connected\":{{\"share\":{share}}}}}"));
    let experiment = Experiment { creature, start: start.into_iter().collect(), folder };

    let arms = [&ARMS[..], &STRANGERS].concat();
    let mut distances = vec![Vec::new(); arms.len()];
    let mut usable = vec![0; arms.len()];
    for seed in 1..=seeds {
        for (arm, name) in arms.iter().enumerate() {
            let path = folder.join(format!("{name}-{seed}"));
            run(&config(name, seed, steps, &experiment)?, &path)?;
            let (distance, is_usable) = judge(&path)?;
            distances[arm].push(distance);
            usable[arm] += usize::from(is_usable);
        }
    }
    println!("| | median distance in 20 s | usable |\n|---|---|---|");
    for (arm, name) in arms.iter().enumerate() {
        println!(
            "| {name} | {:.1} m | {} of {seeds} |",
            quantile(&distances[arm], 0.5).unwrap_or(f64::NAN),
            usable[arm]
        );
    }
    println!("\nworth on average, with its 95 % interval:");
    for (x, y) in [(0, 2), (0, 3), (0, 4), (1, 0), (1, 3), (5, 7), (6, 7), (6, 5), (6, 8)] {
        let of = |arm: usize| Scores::new(std::slice::from_ref(&distances[arm]));
        let comparison = Comparison::paired(of(x)?, of(y)?)?;
        let difference = |both: &Comparison| mean(both.x()) - mean(both.y());
        let it = Bootstrap::default().comparison(&comparison, difference, Seed::of_run(1));
        println!("{} over {}: {:.1} m, {:.1} to {:.1}", arms[x], arms[y], it.estimate, it.low, it.high);
    }
    Ok(())
}

/// The configuration of an arm. Those in the stranger come after the arms whose nets they have.
fn config(arm: &str, seed: u64, steps: u64, experiment: &Experiment) -> Result<RunConfig, Box<dyn Error>> {
    let Experiment { creature, start, folder } = experiment;
    let plan = concat!(env!("CARGO_MANIFEST_DIR"), "/../shaping/topology-then-weights.json");
    let mut request = Request { creature: Some(creature.name.clone()), ..Request::default() };
    match arm {
        "topology-then-weights" | "class-then-weights" => {
            (request.config, request.set) = (Some(plan.into()), start.clone())
        }
        "neat" => (request.strategy, request.set) = (Some("neat".into()), start.clone()),
        _ => {}
    }
    request.movement = Some("running".into());
    let mut config = request.resolve(&Registry::default())?;
    let is_stranger = STRANGERS.contains(&arm);
    if is_stranger {
        config.creature = with_legs(creature, STRANGER);
    }
    config.seed = seed;
    // In the stranger there is only the second half to be done.
    let limit = if is_stranger { steps / 2 } else { steps };
    config.stop = StopConditions { steps: Some(limit), ..StopConditions::default() };
    if let Some(first) = config.stages.first_mut() {
        first.promotion = Some(PromotionRule::Steps(steps / 2));
    }
    let found = |arm: &str| -> Result<FrozenTopology, Box<dyn Error>> {
        let champion = folder.join(format!("{arm}-{seed}/stages/01-topology/champion.json"));
        Ok(FrozenTopology::of(&Champion::read(&champion)?))
    };
    match arm {
        "class-then-weights" => config.further_bodies = CLASS.map(|scale| with_legs(creature, scale)).into(),
        "dense" | "stranger-dense" => config.controller.modular = None,
        "stranger-of-one-body" => config.topology = Some(found("topology-then-weights")?),
        "stranger-of-the-class" => config.topology = Some(found("class-then-weights")?),
        _ => {}
    }
    Ok(config)
}

/// The creature with legs this many times as long: everything below the torso is stretched upwards from the ground.
fn with_legs(creature: &Creature, scale: f32) -> Creature {
    let mut scaled = Creature { name: format!("{}-{:.0}", creature.name, 100.0 * scale), ..creature.clone() };
    let torso = &creature.parts[0].name;
    let hip = creature.joints.iter().find(|joint| joint.parent == *torso).map_or(0.0, |joint| joint.anchor[1]);
    for (index, part) in scaled.parts.iter_mut().enumerate() {
        match &mut part.shape {
            _ if index == 0 => part.position[1] += hip * (scale - 1.0),
            Shape::Box { height, .. } => (*height, part.position[1]) = (*height * scale, part.position[1] * scale),
            _ => {}
        }
    }
    scaled.joints.iter_mut().for_each(|joint| joint.anchor[1] *= scale);
    scaled
}

/// One run, unless it is there already. It has another name until it is complete, so that a killed one is not taken for one.
fn run(config: &RunConfig, folder: &Path) -> Result<(), Box<dyn Error>> {
    if folder.exists() {
        return Ok(());
    }
    let part = folder.with_extension("part");
    if part.exists() {
        fs::remove_dir_all(&part)?;
    }
    let registry = Registry::default();
    let options = TrainOptions { threads: 0, registry, signal: Default::default(), on_generation: &mut |_| {} };
    match config.stages.is_empty() {
        true => train(config, &part, options)?,
        false => train_stages(config, &part, StageProgress { on_stage_run: &mut |_, _| {} }, options)?,
    };
    Ok(fs::rename(part, folder)?)
}

/// How far the champion gets in 20 s without variation, in rapier, coaching left aside; and whether its gait is usable.
fn judge(folder: &Path) -> Result<(f64, bool), Box<dyn Error>> {
    let registry = Registry::default();
    let Ok(champion) = Champion::read(&folder.join("champion.json")) else { return Ok((0.0, false)) };
    let movement = MovementSpec { steps: Some(1000), ..MovementSpec::new("running") };
    let episode = EpisodeParts { movement: &movement, ..champion.episode_parts() }.reference().build(&registry)?;
    let distance = episode.evaluate(&mut champion.network.clone(), Seed::of_run(1)).fitness().map_or(0.0, f64::from);
    let verdict = gait::judge(&champion, &registry)?.verdict;
    Ok((distance, verdict.is_some_and(|verdict| verdict.usable)))
}

//! Compares the default preset with the algorithm of the thesis on paired seeds, and prints a table in Markdown.
//!
//! Without arguments it is a matter of a second. The whole comparison of all 14 scenarios, five seeds, 300 generations
//! takes hours; it goes on where it was interrupted:
//!
//! ```text
//! cargo run --release -p gambol-examples --example compare_presets -- 300 5 runs/presets
//! ```
//!
//! Arguments: generations, seeds, a folder for the runs, and optionally scenarios such as `biped-1/running`.

use creatures::Blueprint;
use gambol::Registry;
use gambol::{
    champion::Champion,
    episode_parts::EpisodeParts,
    run_folder::RunFolder,
    training::{TrainOptions, resume, train},
};
use ne_core::{Seed, StopConditions, Task};
use std::{error::Error, path::Path};
use tasks::MovementSpec;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize, otherwise: u64| arguments.get(index).map_or(Ok(otherwise), |text| text.parse());
    let (generations, seeds) = (number(0, 2)?, number(1, 2)?);
    let temporary = tempfile::tempdir()?;
    let folder = arguments.get(2).map_or(temporary.path(), |path| Path::new(path));
    let mut scenarios: Vec<String> = arguments.iter().skip(3).cloned().collect();
    if arguments.len() < 3 {
        scenarios.push("biped-1/jumping".into());
    } else if scenarios.is_empty() {
        let all = |movement: &'static str| creatures::shipped().iter().map(move |c| format!("{}/{movement}", c.name));
        scenarios = all("jumping").chain(all("running")).collect();
    }
    println!("| scenario | thesis, median | default, median | body lengths/s, thesis | default | default wins |");
    println!("|---|---|---|---|---|---|");
    let mut won = 0;
    for scenario in &scenarios {
        let (name, movement) = scenario.split_once('/').ok_or("a scenario is CREATURE/MOVEMENT")?;
        let fitness = |preset: &str| -> Result<Vec<f64>, Box<dyn Error>> {
            (1..=seeds).map(|seed| best(preset, name, movement, seed, generations, folder)).collect()
        };
        let (thesis, ours) = (fitness("thesis")?, fitness("default")?);
        let wins = ours.iter().zip(&thesis).filter(|(ours, thesis)| ours > thesis).count();
        let (thesis, ours) = (median(thesis), median(ours));
        won += usize::from(ours > thesis);
        let length = f64::from(Blueprint::new(creatures::find(name)?)?.body_length());
        let speed = |metres: f64| match movement {
            "running" => format!("{:.2}", metres / 40.0 / length),
            _ => "–".into(),
        };
        let (slow, fast) = (speed(thesis), speed(ours));
        println!("| {name} {movement} | {thesis:.2} m | {ours:.2} m | {slow} | {fast} | {wins} of {seeds} |");
    }
    println!("\nbetter median: {won} of {} scenarios", scenarios.len());
    Ok(())
}

/// What the champion of one run is worth; a run that is there already is read, one that was interrupted goes on.
fn best(
    preset_name: &str,
    creature: &str,
    movement: &str,
    seed: u64,
    generations: u64,
    folder: &Path,
) -> Result<f64, Box<dyn Error>> {
    let path = folder.join(preset_name).join(format!("{creature}-{movement}-{seed}"));
    let mut config = Registry::default().config(preset_name, creatures::find(creature)?, movement)?;
    config.seed = seed;
    config.stop.generations = Some(generations);
    config.record.populations_at.clear();
    let log = |folder: &RunFolder| folder.read_log().unwrap_or_default();
    let ended = |folder: &RunFolder| log(folder).len() as u64 >= generations;
    let options = TrainOptions {
        threads: 0,
        registry: Registry::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let folder = match RunFolder::open(&path) {
        Ok(folder) if ended(&folder) => folder,
        Ok(folder) => {
            let stop = StopConditions { generations: Some(generations), ..Default::default() };
            resume(folder.path(), Some(stop), options)?.folder
        }
        Err(_) => train(&config, &path, options)?.folder,
    };
    // What counts is how far or high it gets in rapier in an episode of the usual length, whatever it was trained for:
    // presets differ in their terms and in the length of their episodes.
    let Ok(champion) = Champion::read(&folder.champion()) else { return Ok(f64::NEG_INFINITY) };
    let plain = MovementSpec::new(movement);
    let parts = EpisodeParts { movement: &plain, ..champion.episode_parts() };
    let episode = parts.reference().build(&Registry::default())?;
    let evaluation = episode.evaluate(&mut champion.network.clone(), Seed::of_run(seed));
    Ok(evaluation.fitness().map_or(f64::NEG_INFINITY, f64::from))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

//! What champions of training in lanes are worth in rapier, on every creature and movement.

use gambol::Registry;
use gambol::{
    champion::Champion,
    config::EngineChoice,
    setup::Setup,
    training::{TrainOptions, train},
};
use ne_core::{Seed, Task};
use std::error::Error;
use tasks::Trials;

const GENERATIONS: u64 = 100;
const SEEDS: u64 = 5;

/// Trains with light variation in lanes; gives the champion's fitness in lanes and in rapier, in the world without
/// variation, and whether each ends with the torso on the ground.
fn transfer(creature: &str, movement: &str, seed: u64) -> Result<[(f64, bool); 2], Box<dyn Error>> {
    let registry = Registry::default();
    let mut config = Registry::default().config("default", creatures::find(creature)?, movement)?;
    assert!(!config.variation.is_none(), "light variation is the default");
    assert_eq!(config.engine, EngineChoice::Lanes, "lanes are the default");
    config.seed = seed;
    config.stop.generations = Some(GENERATIONS);
    let folder = tempfile::tempdir()?;
    let options = TrainOptions {
        threads: 0,
        registry: Registry::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let outcome = train(&config, &folder.path().join("run"), options)?;
    let champion: Champion = outcome.champion.ok_or("every evaluation failed")?;
    assert!(champion.verify(&registry)?.is_identical());
    let worth = |engine| -> Result<(f64, bool), Box<dyn Error>> {
        let reference = gambol::config::RunConfig {
            engine,
            variation: Default::default(),
            trials: Trials::default(),
            training_steps: None,
            ..config.clone()
        };
        let mut fallen = reference.clone();
        // A term that ends an episode says whether it would have ended.
        fallen.movement.terms.push(serde_json::from_value(serde_json::json!({ "term": "fall-ends", "weight": 0.0 }))?);
        let evaluate = |config: &gambol::config::RunConfig| -> Result<ne_core::Evaluation, Box<dyn Error>> {
            let setup = Setup::new(config, &registry)?;
            Ok(setup.task.evaluate(&mut champion.network.clone(), Seed::of_run(seed)))
        };
        let fitness = evaluate(&reference)?.fitness().map_or(f64::NEG_INFINITY, f64::from);
        let falls = evaluate(&fallen)?.measurements.get("fall-ends").is_some_and(|falls| falls > 0.0);
        Ok((fitness, falls))
    };
    Ok([worth(EngineChoice::Lanes)?, worth(EngineChoice::Rapier)?])
}

#[test]
#[ignore = "some minutes: cargo test --release -p gambol-tests transfer -- --ignored --nocapture"]
#[expect(clippy::print_stdout, reason = "a table for the reader")]
fn champions_keep_their_fitness_in_rapier() -> Result<(), Box<dyn Error>> {
    println!(
        "{GENERATIONS} generations in lanes; of {SEEDS} champions, m in rapier, and how much of it they had in lanes"
    );
    let (mut kept, mut all, mut differences) = (0, 0, 0);
    for creature in creatures::shipped() {
        for movement in ["running", "jumping"] {
            let mut row = Vec::new();
            for seed in 1..=SEEDS {
                let [(lanes, falls_in_lanes), (rapier, falls)] = transfer(creature.name, movement, seed)?;
                assert!(!falls || falls_in_lanes, "{creature:?} {movement} {seed} falls in rapier alone");
                all += 1;
                kept += usize::from(rapier >= 0.95 * lanes);
                differences += usize::from(rapier != lanes);
                row.push(format!("{rapier:.2} ({:.0} %)", 100.0 * rapier / lanes));
            }
            println!("{:<11} {movement:<8} {}", creature.name, row.join("  "));
        }
    }
    println!("{kept} of {all} kept 95 %; {differences} differ at all");
    assert!(kept * 70 >= 66 * all, "{kept} of {all}");
    Ok(())
}

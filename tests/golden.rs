//! Runs come out as they always did, to the bit.
//!
//! For each preset and strategy, shipped creature and movement a tiny run is trained, in lanes and in rapier, and what
//! came out is compared with what is written in the folder `golden`. Where a number differs, every recorded run comes
//! out differently too, and every saved champion may fail to verify. If that is wanted, say so in the changelog, and
//! write the numbers anew:
//!
//! ```text
//! GAMBOL_GOLDEN=write cargo test -p gambol-tests golden
//! ```

use crate::root;
use gambol::{
    Registry,
    config::EngineChoice,
    training::{TrainOptions, train},
};
use ne_core::digest::Digest;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, env, error::Error, fs};
use tasks::TermSpec;

/// What a run is known by.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Golden {
    /// Shows readers how far apart two runs are.
    fitness: f64,
    /// Of the champion.
    trajectory: String,
    /// Of the log, which has the numbers of every generation.
    log: String,
}

/// What a run starts from: a preset, or a strategy with its default settings, without variation.
#[derive(Clone, Copy)]
enum From {
    Preset(&'static str),
    Strategy(&'static str),
}

fn tiny_run(from: From, creature: &str, movement: &str, engine: EngineChoice) -> Result<Golden, Box<dyn Error>> {
    let registry = Registry::default();
    let base = |preset| Ok::<_, Box<dyn Error>>(registry.config(preset, creatures::find(creature)?, movement)?);
    let mut config = match from {
        From::Preset(name) => base(name)?,
        From::Strategy(name) => {
            let mut config = base("default")?;
            config.strategy = registry.strategies.find(name).ok_or("there is no such strategy")?.settings();
            config.variation = Default::default();
            if name == "nsga2" {
                // It shows what it can only with something to choose between.
                let term = |term: &str, weight| TermSpec::new(term, weight);
                config.movement.objectives = vec![term(movement, 1.0), term("energy", -1.0)];
            }
            config
        }
    };
    config.engine = engine;
    config.seed = 1;
    config.strategy.set_population(if matches!(from, From::Preset(_)) { 6 } else { 12 });
    config.stop.generations = Some(3);
    config.movement.steps = Some(100);
    let folder = tempfile::tempdir()?;
    let options = TrainOptions { threads: 1, registry, signal: Default::default(), on_generation: &mut |_| {} };
    let outcome = train(&config, &folder.path().join("run"), options)?;
    let champion = outcome.champion.ok_or("every evaluation failed")?;
    let mut log = Digest::default();
    log.add(&fs::read(outcome.folder.log())?);
    Ok(Golden { fitness: champion.fitness.get(), trajectory: champion.trajectory.digest, log: log.to_string() })
}

fn check(from: From) -> Result<(), Box<dyn Error>> {
    let (From::Preset(name) | From::Strategy(name)) = from;
    let path = root().join("tests/golden").join(name).with_extension("json");
    let mut found = BTreeMap::new();
    for creature in creatures::shipped() {
        for movement in ["running", "jumping"] {
            let [lanes, rapier] = EngineChoice::ALL.map(|engine| tiny_run(from, creature.name, movement, engine));
            let run = lanes?;
            assert_eq!(run, rapier?, "{} {movement} in lanes and in rapier", creature.name);
            found.insert(format!("{} {movement}", creature.name), run);
        }
    }
    if env::var("GAMBOL_GOLDEN").is_ok_and(|wish| wish == "write") {
        fs::write(&path, serde_json::to_string_pretty(&found)? + "\n")?;
        return Ok(());
    }
    let expected: BTreeMap<String, Golden> = serde_json::from_str(&fs::read_to_string(&path)?)?;
    let differing: Vec<String> = found
        .iter()
        .filter(|(name, run)| expected.get(*name) != Some(run))
        .map(|(name, run)| format!("{name}: {run:?}\n  recorded: {:?}", expected.get(name)))
        .collect();
    assert!(
        differing.is_empty() && expected.len() == found.len(),
        "runs of {name} come out differently from what {} says. A change of these numbers changes every \
         recorded run; if it is wanted, the top of golden.rs says how to write them anew.\n{}",
        path.display(),
        differing.join("\n")
    );
    Ok(())
}

#[test]
fn runs_of_the_presets_come_out_as_recorded() -> Result<(), Box<dyn Error>> {
    ["default", "thesis", "stanley-2002"].into_iter().try_for_each(|name| check(From::Preset(name)))
}

#[test]
fn runs_of_the_strategies_come_out_as_recorded() -> Result<(), Box<dyn Error>> {
    ["neat", "cma-es", "open-es", "cosyne", "nsga2"].into_iter().try_for_each(|name| check(From::Strategy(name)))
}

//! Runs come out as they always did, to the bit.
//!
//! For each preset, shipped creature and movement a tiny run is trained, and what came out is compared with what is
//! written in the folder `golden`. Where a number differs, every run anybody has recorded comes out differently too, and
//! every saved champion may fail to verify. If that is wanted, say so in the changelog, and write the numbers anew:
//!
//! ```text
//! GAMBOL_GOLDEN=write cargo test -p gambol-tests golden
//! ```

use crate::root;
use gambol::{
    config::preset,
    training::{TrainOptions, train},
};
use ne_core::digest::Digest;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, env, error::Error, fs};
use tasks::MovementCatalogue;

/// What a run is known by.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Golden {
    /// For a reader who wants to know how far apart two runs are.
    fitness: f64,
    /// Of the champion.
    trajectory: String,
    /// Of the log, which has the numbers of every generation.
    log: String,
}

fn tiny_run(preset_name: &str, creature: &str, movement: &str) -> Result<Golden, Box<dyn Error>> {
    let mut config = preset(preset_name).ok_or("there is no such preset")?.config(creatures::find(creature)?, movement);
    config.seed = 1;
    config.strategy.set_population(6);
    config.stop.generations = Some(3);
    config.movement.steps = Some(100);
    let folder = tempfile::tempdir()?;
    let options = TrainOptions {
        threads: 1,
        catalogue: MovementCatalogue::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let outcome = train(&config, &folder.path().join("run"), options)?;
    let champion = outcome.champion.ok_or("every evaluation failed")?;
    let mut log = Digest::default();
    log.add(&fs::read(outcome.folder.log())?);
    Ok(Golden { fitness: champion.fitness.get(), trajectory: champion.trajectory.digest, log: log.to_string() })
}

fn check(preset: &str) -> Result<(), Box<dyn Error>> {
    let path = root().join("tests/golden").join(preset).with_extension("json");
    let mut found = BTreeMap::new();
    for creature in creatures::shipped() {
        for movement in ["running", "jumping"] {
            found.insert(format!("{} {movement}", creature.name), tiny_run(preset, creature.name, movement)?);
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
        "runs of the preset {preset} come out differently from what {} says. A change of these numbers changes every \
         recorded run; if it is wanted, the top of golden.rs says how to write them anew.\n{}",
        path.display(),
        differing.join("\n")
    );
    Ok(())
}

#[test]
fn runs_of_the_default_preset_come_out_as_recorded() -> Result<(), Box<dyn Error>> {
    check("default")
}

#[test]
fn runs_of_the_thesis_preset_come_out_as_recorded() -> Result<(), Box<dyn Error>> {
    check("thesis")
}

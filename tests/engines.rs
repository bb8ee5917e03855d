//! Training in lanes and training in rapier find the same, to the bit; only what they say of the engine differs.

use envs_rapier::Variation;
use gambol::Registry;
use gambol::{
    champion::Champion,
    config::{EngineChoice, RunConfig},
    training::{TrainOptions, train},
};
use std::{error::Error, fs};
use tasks::{Combine, Trials};

/// The champion, and the log and the gallery as they stand on the disk.
type Found = (Champion, [Vec<u8>; 2]);

fn run(config: &RunConfig) -> Result<Found, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let options = TrainOptions {
        threads: 2,
        registry: Registry::default(),
        signal: Default::default(),
        on_generation: &mut |_| {},
    };
    let outcome = train(config, &folder.path().join("run"), options)?;
    let champion = outcome.champion.ok_or("every evaluation failed")?;
    assert!(champion.verify(&Registry::default())?.is_identical());
    Ok((champion, [fs::read(outcome.folder.log())?, fs::read(outcome.folder.gallery())?]))
}

#[test]
fn a_run_in_lanes_is_the_run_in_rapier() -> Result<(), Box<dyn Error>> {
    let worst_of_three = Trials { count: 3, combine: Combine::Worst, lessons: false };
    for (creature, movement, variation, trials) in [
        ("biped-1", "running", Variation::default(), Trials::default()),
        ("biped-2", "jumping", Variation::light(), Trials::default()),
        ("apod", "running", Variation::light(), Trials::default()),
        ("tetrapod-1", "jumping", Variation::default(), worst_of_three),
        ("tetrapod-2", "running", Variation::light(), worst_of_three),
        ("decapod-1", "running", Variation::light(), Trials::default()),
        ("decapod-2", "jumping", Variation { time_step: [0.5, 1.5], ..Variation::default() }, Trials::default()),
    ] {
        let mut config = Registry::default().config("default", creatures::find(creature)?, movement)?;
        (config.variation, config.trials) = (variation, trials);
        config.strategy.set_population(9);
        config.stop.generations = Some(5);
        config.movement.steps = Some(80);
        config.record.checkpoint_every = 3;
        let [lanes, rapier] = EngineChoice::ALL.map(|engine| run(&RunConfig { engine, ..config.clone() }));
        let ((mut lanes, lanes_files), (mut rapier, rapier_files)) = (lanes?, rapier?);
        assert_eq!(lanes_files, rapier_files, "{creature} {movement}");
        let trained = lanes.trained.take().ok_or("it was trained in lanes")?;
        assert!(!trained.diverged);
        assert_eq!((trained.engine, trained.variation, trained.trials), (EngineChoice::Lanes, variation, trials));
        if let Some(in_rapier) = rapier.trained.take() {
            assert_eq!((in_rapier.engine, in_rapier.fitness), (EngineChoice::Rapier, trained.fitness));
        }
        assert_eq!(lanes, rapier, "{creature} {movement}");
        if !variation.is_none() {
            assert_eq!((lanes.variation, lanes.trials), (Variation::default(), Trials::default()), "as it was judged");
        }
    }
    Ok(())
}

//! A creature of one's own: a desk lamp on one foot, written down in `desk-lamp.json` beside this program.
//!
//! The program reads and checks the file, shows what the net will sense and move, trains the lamp to hop forwards
//! without falling over, writes the report, and proves that the champion does the same again. Nothing of this needs a
//! program: `gambol check` and `gambol train examples/examples/desk-lamp.json running` do it too.
//!
//! Run it: `cargo run --release -p gambol-examples --example custom_creature`

use gambol::Registry;
use gambol::{
    report::write_report,
    setup::Setup,
    source::creature_file,
    training::{TrainOptions, train},
};
use std::{error::Error, path::Path};
use tasks::TermSpec;

fn main() -> Result<(), Box<dyn Error>> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/desk-lamp.json");
    let creature = creature_file(Path::new(file))?;
    let registry = Registry::default();

    let mut config = Registry::default().config("default", creature, "running")?;
    config.movement.steps = Some(500);
    // A lamp whose shade touches the ground has fallen: its episode ends, and it gets as far as it got.
    config.movement.terms = vec![TermSpec::new("fall-ends", -1.0)];
    config.stop.generations = Some(40);

    let setup = Setup::new(&config, &registry)?;
    for channel in setup.inputs().iter().chain(setup.outputs()) {
        println!("{}, {} to {} {}", channel.name, channel.range[0], channel.range[1], channel.unit);
    }

    let folder = std::env::temp_dir().join(format!("gambol-desk-lamp-{}", std::process::id()));
    let options = TrainOptions {
        threads: 0,
        registry: registry.clone(),
        signal: Default::default(),
        on_generation: &mut |generation| {
            let report = generation.report;
            if let Some(fitness) = report.fitness {
                println!("generation {:2}: {:.2} m", report.generation, fitness.best);
            }
        },
    };
    let outcome = train(&config, &folder, options)?;
    write_report(&outcome.folder, &registry, Some(outcome.reason))?;

    let champion = outcome.champion.ok_or("every evaluation failed")?;
    println!("the lamp hops {:.2} m; watch it: {}", champion.fitness, outcome.folder.report().display());
    assert!(champion.verify(&registry)?.is_identical(), "the champion does not repeat itself");
    assert!(champion.fitness.get() > 1.0, "hopping was not learned");
    Ok(())
}

//! Digests of fitnesses: each shipped creature, in each engine, two generations in worlds that vary. They are the same on every
//! machine. Natively they are printed; WebAssembly, which has no terminal, exports the function. `.ci/long` compares the two.

#![allow(unsafe_code, reason = "Node calls an exported function by its name")]

use gambol_runs::{Registry, Setup, config::EngineChoice};
use ne_core::{Evaluator, Seed, Serial, Strategy, digest::Digest};

const ENGINES: [EngineChoice; 2] = [EngineChoice::Lanes, EngineChoice::Rapier];

/// The digest of a creature, by its place in the list, in lanes (0) or rapier (1).
///
/// # Panics
/// If there is no such creature or engine.
#[unsafe(no_mangle)]
pub extern "C" fn digest(creature: usize, engine: usize) -> u64 {
    let registry = Registry::default();
    let creature = registry.creatures.entries()[creature].value.clone();
    let mut config = registry.config("default", creature, "running").expect("a preset");
    config.engine = ENGINES[engine];
    config.movement.steps = Some(200);
    let setup = Setup::new(&config, &registry).expect("a valid configuration");
    let mut strategy = registry.strategies.build(&config.strategy, &setup.topology).expect("valid settings");
    let mut digest = Digest::default();
    for generation in 0..2 {
        let seed = Seed::of_run(1).generation(generation);
        let evaluations = Serial.evaluate(&setup.task, strategy.ask(seed), seed);
        for evaluation in &evaluations {
            digest
                .add(&evaluation.fitness().map_or(f64::NEG_INFINITY, |fitness| fitness.get()).to_bits().to_le_bytes());
            digest.add(&evaluation.steps.to_le_bytes());
        }
        strategy.tell(&evaluations, seed);
    }
    digest.value()
}

#[allow(clippy::print_stdout, reason = "it is a program")]
fn main() {
    for (index, name) in Registry::default().creatures.names().iter().enumerate() {
        println!("{name} {:016x} {:016x}", digest(index, 0), digest(index, 1));
    }
}

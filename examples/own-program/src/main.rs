//! The whole `gambol` program, with a movement, a strategy, a creature, a sensor, a terrain and a variation of one's own:
//! every command knows them by their names, judges the high kick, and searches by simulated annealing if asked to.
//!
//! `cargo run --release -p own-program -- train biped-2 high-kick --strategy annealing --until usable`

mod annealing;
mod high_kick;

use annealing::Annealing;
use creatures::{Obstacles, Terrain};
use envs_core::Variation;
use high_kick::{CleanKick, HighKick, Lift};

fn main() -> std::process::ExitCode {
    let mut registry = gambol::Registry::default();
    registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground").judged_by(CleanKick);
    registry.strategies.add::<Annealing>("simulated annealing: a walk that gets ever more careful");
    registry.creatures.add_file(include_str!("kicker.json")).expect("a test reads it");
    registry.sensors.add_sense::<Lift>("lift", "how far each joint is lifted; settings: most, degrees (90)");
    let kerb = Obstacles::Hurdles { height: Some(0.05), spacing: Some(3.0) };
    registry.terrains.add("kerbs", "kerbs 5 cm high", Terrain::of(vec![kerb]));
    registry.variations.add("icy", "any friction", Variation { friction: 0.9, ..Variation::default() });
    gambol::program(&registry)
}

//! The whole `gambol` program, with a movement and a strategy of one's own: every command knows the high kick, judges it, and
//! searches by simulated annealing if asked to.
//!
//! `cargo run --release -p own-program -- train biped-2 high-kick --strategy annealing --until usable`

mod annealing;
mod high_kick;

use annealing::Annealing;
use high_kick::{CleanKick, HighKick};

fn main() -> std::process::ExitCode {
    let mut registry = gambol::Registry::default();
    registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground").judged_by(CleanKick);
    registry.strategies.add::<Annealing>("simulated annealing: a walk that gets ever more careful");
    gambol::program(&registry)
}

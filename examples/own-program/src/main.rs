//! The whole `gambol` program, with a movement of one's own: every command knows the high kick and judges it.
//!
//! `cargo run --release -p own-program -- train biped-2 high-kick --until usable`

mod high_kick;

use high_kick::{CleanKick, HighKick};

fn main() -> std::process::ExitCode {
    let mut registry = gambol::Registry::default();
    registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground").judged_by(CleanKick);
    gambol::program(&registry)
}

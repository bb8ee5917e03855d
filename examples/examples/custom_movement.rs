//! A movement of one's own: the high kick. It is defined, trained, reported and verified in thirty lines of code.
//!
//! One `impl Movement` is all it takes. The program adds it to the registry and teaches it to the biped-2: that trains it
//! as `gambol train` does, writes the report, and proves that the champion does the same again.
//!
//! Run it: `cargo run --release -p gambol-examples --example custom_movement`

use gambol::Registry;
use gambol::complete_run::train_and_verify;
use std::error::Error;
use tasks::{Movement, Snapshot, Verdict, conformance::check_movement};

/// How high the highest part has been above the ground, in m.
#[derive(Clone, Default)]
struct HighKick(f32);

impl Movement for HighKick {
    fn name(&self) -> &str {
        "high-kick"
    }
    fn unit(&self) -> &str {
        "m"
    }
    fn begin(&mut self, _: &Snapshot) {
        self.0 = 0.0;
    }
    fn observe(&mut self, now: &Snapshot) -> Verdict {
        // All parts but the torso, which is the first.
        self.0 = now.parts[1..].iter().fold(self.0, |highest, part| highest.max(part.y));
        Verdict::GoOn
    }
    fn value(&self) -> f64 {
        self.0.into()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    check_movement(&HighKick::default())?;
    let mut registry = Registry::default();
    registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground");
    let mut config = registry.config("default", creatures::find("biped-2")?, "high-kick")?;
    config.stop.generations = Some(30);
    let folder = std::env::temp_dir().join(format!("gambol-high-kick-{}", std::process::id()));
    println!("{:.2} m; watch it: {}", train_and_verify(&config, &folder, &registry)?.fitness, folder.display());
    Ok(())
}

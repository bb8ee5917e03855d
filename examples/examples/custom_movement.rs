//! A movement of one's own: the moonwalk, which is to run backwards while facing forwards.
//!
//! One `impl Movement` is all it takes. The program adds it to the catalogue, trains the biped-2 with the library
//! behind `gambol train`, writes the report, and proves that the champion does the same again.
//!
//! Run it: `cargo run --release -p gambol-examples --example custom_movement`

use gambol::{
    config::preset,
    report::write_report,
    training::{TrainOptions, train},
};
use std::error::Error;
use tasks::{Movement, MovementCatalogue, PartState, Snapshot, Verdict, conformance::check_movement};

/// How far the torso has come backwards, in m, less a metre for each radian of its largest tilt.
#[derive(Clone, Default)]
struct Moonwalk {
    start: PartState,
    x: f32,
    largest_tilt: f32,
}

impl Movement for Moonwalk {
    fn name(&self) -> &str {
        "moonwalk"
    }
    fn unit(&self) -> &str {
        "m"
    }
    fn begin(&mut self, start: &Snapshot) {
        *self = Self { start: *start.torso(), x: start.torso().x, largest_tilt: 0.0 };
    }
    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let (start, now) = (&self.start, now.torso());
        // The angle between two directions. `libm`, not `std`: the same bits on every platform.
        let (cos, sin) = (start.cos * now.cos + start.sin * now.sin, start.cos * now.sin - start.sin * now.cos);
        self.largest_tilt = self.largest_tilt.max(libm::atan2f(sin, cos).abs());
        self.x = now.x;
        Verdict::GoOn
    }
    fn value(&self) -> f64 {
        f64::from(self.start.x - self.x) - f64::from(self.largest_tilt)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    check_movement(&Moonwalk::default())?;
    let mut catalogue = MovementCatalogue::default();
    catalogue.add::<Moonwalk>(Some(300), "distance the torso covers backwards, upright");

    let preset = preset("default").ok_or("there is a default preset")?;
    let mut config = preset.config(creatures::find("biped-2")?, "moonwalk");
    config.stop.generations = Some(100);
    let folder = std::env::temp_dir().join(format!("gambol-moonwalk-{}", std::process::id()));
    let options = TrainOptions {
        threads: 0,
        catalogue: catalogue.clone(),
        signal: Default::default(),
        on_generation: &mut |report| {
            if let Some(fitness) = report.fitness.filter(|_| report.generation.is_multiple_of(10)) {
                println!("generation {:3}: {:.2} m", report.generation, fitness.best);
            }
        },
    };
    let outcome = train(&config, &folder, options)?;
    write_report(&outcome.folder, &catalogue, Some(outcome.reason))?;

    let champion = outcome.champion.ok_or("every evaluation failed")?;
    let verification = champion.verify(&catalogue)?;
    println!("the champion moonwalks {:.2} m; watch it: {}", champion.fitness, outcome.folder.report().display());
    assert!(verification.is_identical(), "the champion does not repeat itself: {verification:?}");
    assert!(champion.fitness.get() > 1.0, "the moonwalk was not learned");
    Ok(())
}

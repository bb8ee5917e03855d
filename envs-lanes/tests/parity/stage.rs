//! The same creature in both engines.

use creatures::{Blueprint, Sensor};
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::LaneEnvironment;
use envs_rapier::RapierEnvironment;
use ne_core::{Purpose, Seed};
use rand::RngExt;
use tasks::Environment;

pub(crate) const SHIPPED: [&str; 7] =
    ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];

pub(crate) fn shipped(name: &str) -> Blueprint {
    Blueprint::new(creatures::find(name).expect("shipped")).expect("valid")
}

pub(crate) fn both(
    blueprint: &Blueprint,
    sensors: &[Sensor],
    settings: PhysicsSettings,
    variation: Variation,
) -> (RapierEnvironment, LaneEnvironment) {
    let rapier = RapierEnvironment::new(blueprint.clone(), sensors, 3.0, settings, variation);
    let lanes = LaneEnvironment::new(blueprint.clone(), sensors, 3.0, settings, variation);
    (rapier.expect("rapier takes it"), lanes.expect("lanes take it"))
}

/// Drives both with the same random outputs, each held for `hold` steps, and compares what they sense and where every
/// part is after each step.
pub(crate) fn drive(rapier: &mut RapierEnvironment, lanes: &mut LaneEnvironment, seed: u64, steps: u32, hold: u32) {
    let seed = Seed::of_run(seed);
    assert_eq!(rapier.reset(seed), lanes.reset(seed));
    let mut stream = seed.stream(Purpose::new("motor program"));
    let mut outputs = vec![0.0; rapier.outputs()];
    let mut inputs = [vec![0.0; rapier.inputs()], vec![0.0; rapier.inputs()]];
    let name = rapier.blueprint().name().to_owned();
    for step in 0..=steps {
        assert_eq!(rapier.snapshot(), lanes.snapshot(), "{name}, seed {seed:?}: step {step}");
        rapier.sense(&mut inputs[0]);
        lanes.sense(&mut inputs[1]);
        assert_eq!(inputs[0], inputs[1], "{name}, seed {seed:?}: inputs after step {step}");
        if step % hold == 0 {
            outputs.fill_with(|| stream.random::<f32>() * 2.4 - 1.2);
        }
        rapier.act(&outputs);
        lanes.act(&outputs);
        assert_eq!(rapier.step(), lanes.step(), "{name}, seed {seed:?}: step {step}");
    }
}

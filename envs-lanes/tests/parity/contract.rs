//! What every implementation of a contract promises.

use crate::stage::{SHIPPED, all_sensors, both, shipped};
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::LaneEpisode;
use ne_core::{Seed, Task, conformance::Puppet};
use tasks::{Combine, Energy, FallEnds, Jumping, Movement, Running, Sum, Trials};

#[test]
fn every_shipped_creature_passes_the_conformance_kit_of_environments() {
    for name in SHIPPED {
        for variation in [Variation::default(), Variation::light()] {
            let blueprint = shipped(name);
            let (_, lanes) = both(&blueprint, &all_sensors(&blueprint), PhysicsSettings::default(), variation);
            tasks::conformance::check_environment(&lanes, Seed::of_run(3))
                .unwrap_or_else(|broken| panic!("{name}: {broken}"));
        }
    }
}

#[test]
fn lane_episodes_pass_the_conformance_kit_of_tasks() {
    let movements: [Box<dyn Movement>; 4] = [
        Box::new(Running::default()),
        Box::new(Jumping::default()),
        Box::new(Sum::of(Running::default()).plus(-1.0, FallEnds::default())),
        Box::new(Sum::of(Running::default()).plus(-1e-3, Energy::default())),
    ];
    for name in ["biped-1", "tetrapod-2"] {
        let blueprint = shipped(name);
        for (movement, variation) in movements.iter().zip([Variation::default(), Variation::light()].iter().cycle()) {
            for trials in [Trials::default(), Trials { count: 3, combine: Combine::Worst, lessons: false }] {
                let (_, lanes) = both(&blueprint, &all_sensors(&blueprint), PhysicsSettings::default(), *variation);
                let task = LaneEpisode::new(lanes, movement.clone(), 60, trials).expect("valid");
                let sample = Puppet::sample(task.inputs(), task.outputs(), 20);
                ne_core::conformance::check_task(&task, &sample, Seed::of_run(4))
                    .unwrap_or_else(|broken| panic!("{name}, {}: {broken}", movement.name()));
            }
        }
    }
}

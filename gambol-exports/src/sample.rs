//! Bodies with made-up gaits, to test formats with.

use crate::{Cycle, Pose};
use creatures::Blueprint;
use std::f64::consts::TAU;

/// Every shipped creature, and one of every shape that swings through more than half a turn.
pub(crate) fn samples() -> Vec<(Blueprint, Cycle)> {
    let shipped = creatures::shipped().iter().filter_map(|entry| creatures::find(entry.name).ok());
    let bodies: Vec<Blueprint> =
        shipped.chain([shapes()]).filter_map(|creature| Blueprint::new(creature).ok()).collect();
    assert_eq!(bodies.len(), creatures::shipped().len() + 1);
    bodies.into_iter().map(|body| (body.clone(), cycle(&body))).collect()
}

fn shapes() -> creatures::Creature {
    let text = r##"{
        "format": "gambol creature", "version": 1, "name": "shapes",
        "parts": [
            {"name": "hub", "tag": "torso", "shape": {"circle": {"radius": 0.3}}, "density": 100,
             "position": [0.5, 1.2], "angle": 20, "look": {"colour": "#336699", "opacity": 0.5}},
            {"name": "arm", "tag": "leg", "shape": {"capsule": {"length": 0.5, "radius": 0.1}}, "density": 100,
             "position": [0.9, 1], "angle": 130},
            {"name": "hand", "tag": "leg", "shape": {"box": {"width": 0.3, "height": 0.1}}, "density": 100,
             "position": [1.2, 0.7], "angle": -10, "look": {"layer": -1, "corner_radius": 0.03}}
        ],
        "joints": [
            {"parent": "hub", "child": "arm", "anchor": [0.7, 1.15], "limits": [-90, 90],
             "motor": {"top_speed": 5, "top_torque": 50}},
            {"parent": "arm", "child": "hand", "anchor": [1.1, 0.8], "limits": [-150, 170],
             "motor": {"top_speed": 5, "top_torque": 50}}
        ]
    }"##;
    creatures::Creature::from_json(text).expect("a creature")
}

/// The torso rolls over once, joints swing.
fn cycle(blueprint: &Blueprint) -> Cycle {
    let count = 37;
    let pose = |index: usize| {
        let phase = TAU * index as f64 / count as f64;
        let hinge = |hinge: usize| 2.5 * libm::sin(phase + hinge as f64);
        Pose {
            x: 0.8 * index as f64 / count as f64 + 0.02 * libm::sin(phase),
            y: f64::from(blueprint.start_height()) + 0.05 * libm::cos(phase),
            angle: f64::from(blueprint.parts()[0].angle) + phase,
            hinges: (0..blueprint.hinges().len()).map(hinge).collect(),
        }
    };
    Cycle { seconds: 0.74, travel: 0.8, poses: (0..count).map(pose).collect() }
}

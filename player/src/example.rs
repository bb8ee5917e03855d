//! A character for examples and tests.

use crate::{Character, Facing, Hinge, Medium, Motor, Net, Neuron, Part, World};
use alloc::{string::ToString, vec, vec::Vec};
use creatures::{Actuation, Probe, Shape, Source};
use ne_net::Activation;

/// The file of a torso with one leg that swings with a clock.
///
/// # Panics
/// Never: the character is valid.
pub fn example() -> Vec<u8> {
    character().to_bytes().unwrap_or_default()
}

pub(crate) fn character() -> Character {
    let part = |name: &str, y: f32, foot: bool| Part {
        name: name.to_string(),
        shape: Shape::Box { width: 0.4, height: 0.2 },
        x: 0.1,
        y,
        angle: 0.3,
        density: 30.0,
        friction: 1.0,
        foot,
    };
    let neuron =
        |source: u16| Neuron { activation: Activation::Tanh, scale: 1.0, bias: 0.1, sources: vec![(source, 0.7)] };
    Character {
        name: "hopper".to_string(),
        movement: "running".to_string(),
        facing: Facing::Right,
        world: World {
            time_step: 0.02,
            gravity: 9.81,
            ground_friction: 1.0,
            motor_gain: 200.0,
            body_length: 0.8,
            rest_height: 0.5,
            medium: Medium::Air,
            self_collision: false,
        },
        parts: vec![part("torso", 0.5, false), part("leg", 0.2, true)],
        hinges: vec![Hinge {
            parent: 0,
            child: 1,
            parent_anchor: [0.1, -0.1],
            child_anchor: [0.05, 0.1],
            limits: [-0.5, 0.9],
            motor: Some(Motor { top_speed: 8.0, top_torque: 20.0 }),
        }],
        actuation: Actuation::Angle { gain: 10.0 },
        outputs: vec![0],
        input_range: 3.0,
        inputs: vec![
            Probe { source: Source::ClockSine { period: 0.5 }, middle: 0.0, factor: 3.0 },
            Probe { source: Source::JointAngle(0), middle: 0.0, factor: 2.0 },
        ],
        net: Net::new(2, &[neuron(0), neuron(2)], vec![3]).expect("the sources are nodes"),
    }
}

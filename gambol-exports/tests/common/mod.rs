//! Champions that were never trained, and so cost nothing.

use creatures::{Actuation, Sensor, TERRAINS, Terrain, TerrainEntry};
use gambol_runs::{Registry, champion::Champion, champion::Engine, config::RunConfig};
use ne_core::{Fitness, Seed};
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape, Network};
use std::error::Error;
use tasks::{CommandChange, Commands};

pub(crate) type Outcome = Result<(), Box<dyn Error>>;

/// Every sensor that a player knows.
pub(crate) fn all_sensors() -> Vec<Sensor> {
    vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::JointSpeeds,
        Sensor::TorsoVelocity,
        Sensor::TorsoHeight,
        Sensor::FootContacts,
        Sensor::Rangefinder { angles: vec![-30.0, 0.0, 170.0], length: 3.0 },
        Sensor::Clock { period: 0.7 },
        Sensor::TorsoSpin,
        Sensor::HeightAboveGround,
        Sensor::FootSlip,
        Sensor::NextGap { length: 4.0 },
        Sensor::LandingClock { period: 0.9 },
        Sensor::CommandedSpeed { top: 1.5 },
        Sensor::JumpCommand,
        Sensor::StrideClock { period: 0.5, top: 1.5 },
        Sensor::JumpClock { period: 0.6 },
    ]
}

pub(crate) fn weights(count: usize) -> Vec<f32> {
    (0..count).map(|index| 0.6 * libm::sinf(index as f32 * 1.7 + 0.3)).collect()
}

pub(crate) fn dense(inputs: usize, outputs: usize) -> Network {
    let shape = DenseShape::new(inputs, vec![5], outputs);
    let weights = weights(shape.weight_count());
    DenseNet::new(shape, &weights).expect("as many weights as there are").into()
}

/// Every activation, with cycles.
pub(crate) fn recurrent(inputs: usize, outputs: usize) -> Network {
    let neuron = |index: usize| {
        let all = Activation::ALL;
        let sources = vec![index % inputs, (index * 7 + 3) % inputs, inputs + (index * 5 + 2) % (outputs + 9)];
        let sources = sources.into_iter().fold(Vec::new(), |mut known, source| {
            known.extend((!known.contains(&source)).then_some(source));
            known
        });
        let activation = if index < 9 { all[index] } else { Activation::Tanh };
        GraphNeuron { activation, bias: index.is_multiple_of(2), sources }
    };
    let neurons: Vec<_> = (0..outputs + 9).map(neuron).collect();
    let nodes = (0..outputs).map(|output| inputs + 9 + output).collect();
    let shape = GraphShape { inputs, recurrent: true, neurons, outputs: nodes };
    let weights = weights(shape.weight_count());
    GraphNet::new(shape, &weights).expect("sound").into()
}

/// A champion that was never trained.
pub(crate) fn champion(
    creature: &str,
    terrain: &str,
    actuation: Actuation,
    sensors: Vec<Sensor>,
    net: fn(usize, usize) -> Network,
) -> Result<Champion, Box<dyn Error>> {
    let terrain = TERRAINS.iter().find(|entry| entry.name == terrain);
    let registry = Registry::default();
    let RunConfig { creature, physics, movement, .. } =
        registry.config("default", creatures::find(creature)?, "playing")?;
    let blueprint = creatures::Blueprint::new(creature.clone())?;
    let senses = creatures::Senses::new(&blueprint, &sensors, 3.0)?;
    let motors = creatures::Motors::with_actuation(&blueprint, actuation);
    let change = |time, speed, jump| CommandChange { time, speed, jump };
    let commands =
        vec![change(0.0, 0.0, false), change(0.4, 1.2, false), change(0.8, 1.2, true), change(1.0, -0.5, false)];
    Ok(Champion {
        creature,
        movement,
        sensors,
        input_range: 3.0,
        actuation,
        inputs: senses.channels().iter().map(Into::into).collect(),
        outputs: motors.channels().iter().map(Into::into).collect(),
        network: net(senses.len(), motors.len()),
        trials: Default::default(),
        variation: Default::default(),
        physics,
        terrain: terrain.map_or(Terrain::default(), TerrainEntry::terrain),
        commands: Some(Commands::Given(commands)),
        engine: Engine::current(),
        seed: Seed::of_run(1),
        generation: 1,
        strategy: "none".into(),
        fitness: Fitness::new(0.0)?,
        trajectory: Default::default(),
        trained: None,
    })
}

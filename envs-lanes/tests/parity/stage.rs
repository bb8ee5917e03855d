//! The same creature in both engines.

use creatures::{Blueprint, Sensor};
use envs_core::{CreatureEnvironment, Engine, EnvironmentError, PhysicsSettings, Variation};
use envs_lanes::{LaneEnvironment, LaneEpisode};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Failure, Phenotype, Purpose, Seed, Task};
use ne_net::{DenseNet, DenseShape};
use rand::RngExt;
use tasks::{Commands, Energy, Environment, Episode, RandomCommands, Running, Snapshot, Sum, Trials};

pub(crate) const SHIPPED: [&str; 7] =
    ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];

pub(crate) fn shipped(name: &str) -> Blueprint {
    Blueprint::new(creatures::find(name).expect("shipped")).expect("valid")
}

/// Every sensor there is that the creature can have.
pub(crate) fn all_sensors(blueprint: &Blueprint) -> Vec<Sensor> {
    let mut sensors = vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::JointSpeeds,
        Sensor::TorsoVelocity,
        Sensor::TorsoSpin,
        Sensor::TorsoHeight,
        Sensor::Rangefinder { angles: vec![-90.0, -80.0, -45.0, -10.0, 0.0, 30.0, -135.0, 180.0], length: 2.0 },
        Sensor::Clock { period: 0.7 },
        Sensor::LandingClock { period: 0.9 },
        Sensor::HeightAboveGround,
        Sensor::NextGap { length: 3.0 },
        Sensor::CommandedSpeed { top: 1.2 },
        Sensor::JumpCommand,
        Sensor::StrideClock { period: 0.6, top: 1.2 },
        Sensor::JumpClock { period: 0.5 },
    ];
    if !blueprint.feet().is_empty() {
        sensors.extend([Sensor::FootContacts, Sensor::FootSlip]);
    }
    sensors
}

type Both = (Result<RapierEnvironment, EnvironmentError>, Result<LaneEnvironment, EnvironmentError>);

/// What both engines say to a creature.
pub(crate) fn try_both(
    blueprint: &Blueprint,
    sensors: &[Sensor],
    settings: PhysicsSettings,
    variation: Variation,
) -> Both {
    let rapier = RapierEnvironment::new(blueprint.clone(), sensors, 3.0, settings, variation);
    let lanes = LaneEnvironment::new(blueprint.clone(), sensors, 3.0, settings, variation);
    (rapier, lanes)
}

pub(crate) fn both(
    blueprint: &Blueprint,
    sensors: &[Sensor],
    settings: PhysicsSettings,
    variation: Variation,
) -> (RapierEnvironment, LaneEnvironment) {
    let (rapier, lanes) = try_both(blueprint, sensors, settings, variation);
    (rapier.expect("rapier takes it"), lanes.expect("lanes take it"))
}

/// Both, told what to do: a speed or a jump within every second.
pub(crate) fn told(rapier: RapierEnvironment, lanes: LaneEnvironment) -> (RapierEnvironment, LaneEnvironment) {
    let random =
        RandomCommands { still: 0.2, hold: [0.3, 0.6], jumps: 0.5, backwards: 0.3, ..RandomCommands::default() };
    let commands = || Some(Commands::Random(random));
    let (rapier, lanes) = (rapier.with_commands(commands(), false), lanes.with_commands(commands(), false));
    (rapier.expect("in range"), lanes.expect("in range"))
}

/// Drives both with the same random outputs, each held for `hold` steps, and compares to the bit after each step: where
/// every part is, what it senses, what its motors give, and what is wrong if something is. Gives the failure that ended
/// it early, if one did.
pub(crate) fn drive(
    rapier: &mut RapierEnvironment,
    lanes: &mut LaneEnvironment,
    seed: u64,
    steps: u32,
    hold: u32,
) -> Option<Failure> {
    let seed = Seed::of_run(seed);
    let mut stream = seed.stream(Purpose::new("motor program"));
    let motors = rapier.outputs();
    let program = |step: u32, outputs: &mut [f32]| {
        if step.is_multiple_of(hold) {
            outputs.fill_with(|| stream.random::<f32>() * 2.4 - 1.2);
        }
    };
    follow(rapier, lanes, seed, steps, program, vec![0.0; motors], |_| ())
}

/// As [`drive`], with a motor program of one's own; shows rapier's creature, which is that of the lanes, at the start and
/// after each step.
pub(crate) fn follow(
    rapier: &mut RapierEnvironment,
    lanes: &mut LaneEnvironment,
    seed: Seed,
    steps: u32,
    mut program: impl FnMut(u32, &mut [f32]),
    mut outputs: Vec<f32>,
    mut look: impl FnMut(&RapierEnvironment),
) -> Option<Failure> {
    let name = rapier.blueprint().name().to_owned();
    let begun = rapier.reset(seed);
    assert_eq!(begun, lanes.reset(seed), "{name}, {seed:?}: reset");
    if let Err(failure) = begun {
        return Some(failure);
    }
    assert_same(rapier, lanes, &|| format!("{name}, {seed:?}: start"));
    look(rapier);
    for step in 0..steps {
        program(step, &mut outputs);
        rapier.act(&outputs);
        lanes.act(&outputs);
        let stepped = rapier.step();
        assert_eq!(stepped, lanes.step(), "{name}, {seed:?}: step {step}");
        if let Err(failure) = stepped {
            return Some(failure);
        }
        assert_same(rapier, lanes, &|| format!("{name}, {seed:?}: after step {step}"));
        look(rapier);
    }
    None
}

/// Nets of ten hidden neurons with random weights.
pub(crate) fn nets(inputs: usize, outputs: usize, count: usize) -> Vec<DenseNet> {
    let shape = DenseShape::new(inputs, vec![10], outputs);
    let mut stream = Seed::of_run(5).stream(Purpose::new("weights"));
    let weights = |_| {
        let weights: Vec<f32> = (0..shape.weight_count()).map(|_| stream.random::<f32>() * 4.0 - 2.0).collect();
        DenseNet::new(shape.clone(), &weights).expect("valid")
    };
    (0..count).map(weights).collect()
}

/// Evaluates the same nets in both, in lanes as one batch: lanes then sense, think and act for many at once.
pub(crate) fn assert_same_evaluations(rapier: RapierEnvironment, lanes: LaneEnvironment, seed: u64, steps: u32) {
    let name = rapier.blueprint().name().to_owned();
    let movement = || Box::new(Sum::of(Running::default()).plus(-1e-4, Energy::default()));
    let rapier = Episode::new(rapier, movement(), steps, Trials::default()).expect("valid");
    let lanes = LaneEpisode::new(lanes, movement(), steps, Trials::default()).expect("valid");
    let (seed, mut nets) = (Seed::of_run(seed), nets(rapier.inputs(), rapier.outputs(), 3));
    let wanted: Vec<Evaluation> = nets.iter_mut().map(|net| rapier.evaluate(net, seed)).collect();
    let mut batch: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    assert_eq!(lanes.evaluate_batch(&mut batch, seed), wanted, "{name}, {seed:?}");
}

/// The numbers of one moment of a creature, told apart by their bits: −0 is not 0.
#[derive(Debug, PartialEq)]
struct Bits {
    parts: Vec<[u32; 7]>,
    touching: Vec<bool>,
    time: u32,
    motor_work: u64,
    push_work: u64,
    command: (u32, bool, u32),
    inputs: Vec<u32>,
    torques: Vec<u32>,
}

fn bits<E: Engine>(environment: &CreatureEnvironment<E>) -> Bits {
    let Snapshot { time, parts, motor_work, push_work, command } = environment.snapshot();
    let mut inputs = vec![0.0; environment.inputs()];
    environment.sense(&mut inputs);
    Bits {
        parts: parts
            .iter()
            .map(|part| [part.x, part.y, part.cos, part.sin, part.vx, part.vy, part.spin].map(f32::to_bits))
            .collect(),
        touching: parts.iter().map(|part| part.touching).collect(),
        time: time.to_bits(),
        motor_work: motor_work.to_bits(),
        push_work: push_work.to_bits(),
        command: (command.speed.to_bits(), command.jump, command.since_press.to_bits()),
        inputs: inputs.into_iter().map(f32::to_bits).collect(),
        torques: environment.motor_torques().map(f32::to_bits).collect(),
    }
}

/// Compares one moment of both, to the bit.
fn assert_same(rapier: &RapierEnvironment, lanes: &LaneEnvironment, place: &dyn Fn() -> String) {
    if bits(rapier) == bits(lanes) {
        return;
    }
    // As numbers first: they are easier to read.
    assert_eq!(rapier.snapshot(), lanes.snapshot(), "{}", place());
    assert_eq!(bits(rapier), bits(lanes), "{}", place());
}

//! What is transferred: nets that grow, in every creature and of every kind of topology, to the bit; champions; jumps made by hand.

use super::*;
use crate::Registry;
use crate::{
    champion::Champion,
    config::{FrozenTopology, GeneRecord, RunConfig, StrategySettings, Transferred},
    run_folder::RunFolder,
    setup::Setup,
    tiers::USABLE,
    training::{TrainOptions, train},
};
use creatures::Sensor;
use ne_core::{Phenotype, StopConditions, StopSignal};
use ne_net::{Activation, GraphNeuron, GraphShape, TopologyMap};
use serde_json::json;
use std::path::Path;

pub(super) fn config(creature: &str) -> RunConfig {
    Registry::default().config("default", creatures::find(creature).expect("shipped"), "running").expect("a preset")
}

fn setup(config: &RunConfig) -> Setup {
    Setup::new(config, &Registry::default()).expect("valid")
}

/// With senses added in front, in the middle and at the end.
fn with_more_senses(config: &RunConfig) -> RunConfig {
    let mut sensors = config.sensors.clone().expect("the preset names them");
    sensors.insert(0, Sensor::Rangefinder { angles: vec![-30.0, -60.0], length: 3.0 });
    sensors.insert(3, Sensor::JointSpeeds);
    sensors.push(Sensor::Clock { period: 0.3 });
    RunConfig { sensors: Some(sensors), ..config.clone() }
}

/// Checks that nets of the old setup do in the new one what they did, whatever the new senses say.
fn assert_same_behaviour(name: &str, old: &Setup, new: &Setup) {
    let growth = TopologyMap::by_name(&old.weight_names, &new.weight_names);
    assert_eq!(growth.lost(), Vec::<usize>::new(), "{name}");
    assert!(growth.gained() > 0, "{name}");
    let genes: Vec<f32> = (0..old.topology.weight_count()).map(|index| libm::sinf(3.7 * index as f32 + 1.0)).collect();
    let mut before = old.topology.network(&genes);
    let mut after = new.topology.network(&growth.transfer(&genes, 0.0));
    for step in 0..30 {
        let value = |name: &str| {
            let sum: usize = name.bytes().map(usize::from).sum();
            libm::sinf((sum * 31 + step * 7) as f32)
        };
        let sense = |setup: &Setup| setup.inputs().iter().map(|channel| value(&channel.name)).collect::<Vec<f32>>();
        let mut answers = [vec![0.0; old.outputs().len()], vec![0.0; new.outputs().len()]];
        before.activate(&sense(old), &mut answers[0]);
        after.activate(&sense(new), &mut answers[1]);
        for (index, channel) in old.outputs().iter().enumerate() {
            let place = new.outputs().iter().position(|other| other.name == channel.name).expect("it is kept");
            assert_eq!(answers[0][index].to_bits(), answers[1][place].to_bits(), "{name}, {} at {step}", channel.name);
        }
    }
}

#[test]
fn every_creature_does_the_same_with_more_senses() {
    for creature in creatures::shipped() {
        let old = config(creature.name);
        let new = with_more_senses(&old);
        assert_same_behaviour(creature.name, &setup(&old), &setup(&new));
        for hidden in [vec![], vec![5], vec![4, 3]] {
            let dense = |config: &RunConfig| {
                let mut config = config.clone();
                (config.controller.modular, config.controller.hidden) = (None, hidden.clone());
                config
            };
            assert_same_behaviour(creature.name, &setup(&dense(&old)), &setup(&dense(&new)));
        }
    }
}

#[test]
fn a_frozen_net_does_the_same_with_more_senses() {
    let old = config("biped-1");
    let bare = setup(&old);
    let names =
        |channels: &[creatures::Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
    let (inputs, outputs) = (names(bare.inputs()), names(bare.outputs()));
    let first = inputs.len();
    let neuron = |sources: Vec<usize>| GraphNeuron { activation: Activation::Tanh, bias: true, sources };
    let mut neurons = vec![neuron(vec![0, 2]), neuron(vec![first, 1])];
    neurons.extend((0..outputs.len()).map(|index| neuron(vec![first + 1, index])));
    let nodes = (first + 2..first + 2 + outputs.len()).collect();
    let net = GraphShape { inputs: first, recurrent: false, neurons, outputs: nodes };
    let frozen = FrozenTopology { inputs, outputs, net: net.into(), genes: Vec::new() };
    let old = RunConfig { topology: Some(frozen.clone()), ..old };
    let more = setup(&RunConfig { topology: None, ..with_more_senses(&old) });
    let grown = frozen.remapped(more.inputs(), more.outputs(), false);
    let new = RunConfig { topology: Some(grown.clone()), ..with_more_senses(&old) };
    assert_same_behaviour("frozen", &setup(&old), &setup(&new));
    // One that says what is held says it of all its weights.
    let gene = |held| GeneRecord { name: "gene".into(), held };
    let refusal = |genes| {
        let topology = Some(FrozenTopology { genes, ..frozen.clone() });
        let refused = Setup::new(&RunConfig { topology, ..old.clone() }, &Registry::default());
        refused.err().map(|error| error.to_string()).unwrap_or_default()
    };
    let searched = frozen.net.weight_count();
    assert_eq!(
        refusal(vec![gene(None), gene(Some(1.0))]),
        format!(
            "topology.genes = 1 genes that are not held: must be {searched} that are not held, as many as the net has weights"
        )
    );
    let infinite = (0..searched).map(|_| gene(None)).chain([gene(Some(f32::INFINITY))]).collect();
    assert!(refusal(infinite).contains(&format!("topology.genes[{searched}].held")));
    // It gives up what it has gained only if it may.
    assert_eq!(grown.remapped(bare.inputs(), bare.outputs(), true), frozen);
    assert_eq!(grown.remapped(bare.inputs(), bare.outputs(), false), grown);
}

/// The champion of a run in this folder, which goes on from what the run `first` has found, if it says how.
fn champion_of(folder: &Path, config: &RunConfig, from: Option<Transferred>, name: &str) -> Champion {
    let options = TrainOptions {
        threads: 1,
        registry: Registry::default(),
        signal: StopSignal::default(),
        on_generation: &mut |_| {},
    };
    let outcome = match from {
        None => train(config, &folder.join(name), options).map_err(ShapingError::from),
        from => train_from(config, &folder.join("first"), from, false, &folder.join(name), options),
    };
    outcome.expect("it runs").champion.expect("a champion")
}

/// Steps so wide that all it samples is worse.
#[test]
fn what_a_search_goes_on_from_is_champion_until_it_finds_something_better() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |config: &RunConfig, from, name: &str| champion_of(folder.path(), config, from, name);
    let mut config = config("apod");
    config.stop = StopConditions { generations: Some(10), ..StopConditions::default() };
    let first = run(&config, None, "first");
    config.strategy = serde_json::from_value(json!({ "cma-es": { "step_size": 50.0 } })).expect("settings");
    config.stop.generations = Some(1);
    for (from, name) in [(Transferred::Champion, "champion"), (Transferred::Population, "population")] {
        let next = run(&config, Some(from), name);
        assert_eq!((next.generation, next.fitness), (0, first.fitness), "{name}");
        assert_eq!(next.network, first.network, "{name}");
    }
    assert_ne!(run(&config, Some(Transferred::Nothing), "nothing").fitness, first.fitness);
}

/// Else a worse candidate would soon take the place of what a run goes on from.
#[test]
fn a_champion_that_is_brought_along_has_the_tier_that_it_earns() {
    let folder = tempfile::tempdir().expect("a folder");
    let tier = |name: &str| {
        let standing = RunFolder::at(&folder.path().join(name)).read_standing().expect("a checkpoint");
        standing.champion.expect("a champion").tier
    };
    let mut config = config("tetrapod-1");
    config.stop = StopConditions { generations: Some(100), tier: Some(USABLE), ..StopConditions::default() };
    champion_of(folder.path(), &config, None, "first");
    assert_eq!(tier("first"), USABLE, "the first that is usable is wanted at once");
    // Until the first re-evaluation.
    config.stop = StopConditions { generations: Some(10), ..StopConditions::default() };
    champion_of(folder.path(), &config, Some(Transferred::Champion), "next");
    assert!(tier("next") > USABLE, "{}", tier("next"));
}

/// Playing, by a search of one generation in episodes of so many steps.
fn one_generation_of_playing(creature: &str, step_size: f64, steps: u32) -> RunConfig {
    let body = creatures::find(creature).expect("shipped");
    let mut config = Registry::default().config("default", body, "playing").expect("a preset");
    config.strategy = strategy_of_steps(step_size);
    config.stop = StopConditions { generations: Some(1), ..StopConditions::default() };
    (config.stages, config.movement.steps) = (Vec::new(), Some(steps));
    config
}

fn strategy_of_steps(step_size: f64) -> StrategySettings {
    let settings = json!({ "cma-es": { "population": 4, "step_size": step_size, "least_deviation": 1e-9 } });
    serde_json::from_value(settings).expect("settings")
}

/// Adds a jump clock. What the net hears a quarter of the clock's turn after a press, when the body crouches.
fn add_jump_clock(config: &mut RunConfig) -> Vec<f32> {
    config.sensors.as_mut().expect("the preset names them").push(Sensor::JumpClock { period: 0.4 });
    let sensors = config.sensors.as_deref().expect("named");
    let blueprint = creatures::Blueprint::new(config.creature.clone()).expect("valid");
    let range = config.controller.input_range;
    let senses = creatures::Senses::new(&blueprint, sensors, range).expect("it has them");
    let heard = |probe: &creatures::Probe| match probe.source {
        creatures::Source::JumpSine { .. } => probe.scale(1.0, range),
        creatures::Source::JumpSwell { .. } => probe.scale(0.5, range),
        _ => 0.0,
    };
    senses.probes().iter().map(heard).collect()
}

/// Each stride is a chance one, and so is the leg that has to go to the front.
#[test]
fn a_jump_begins_mirrored_where_that_is_worth_more() {
    let leads = |seed: u64| {
        let folder = tempfile::tempdir().expect("a folder");
        let run = |config: &RunConfig, from, name: &str| champion_of(folder.path(), config, from, name);
        let press = json!({ "given": [{ "time": 0.1, "jump": true }, { "time": 0.3 }] });
        let mut config = RunConfig { seed, ..one_generation_of_playing("biped-1", 0.5, 100) };
        config.commands = Some(serde_json::from_value(press).expect("commands"));
        run(&config, None, "first");
        config.strategy = strategy_of_steps(1e-6);
        let inputs = add_jump_clock(&mut config);
        let mut outputs = [0.0; 2];
        run(&config, Some(Transferred::Held), "second").network.activate(&inputs, &mut outputs);
        assert!(outputs[0] * outputs[1] < 0.0, "the legs go apart: {outputs:?}");
        outputs[0] > 0.0
    };
    let leads: Vec<bool> = (1..=6).map(leads).collect();
    assert!(leads.contains(&true) && leads.contains(&false), "{leads:?}");
}

/// A search with steps so fine that its champion does what it begins with. Nothing is pressed in 20 steps: the jump is worth as much as its
/// mirror image, and is not mirrored.
#[test]
fn a_jump_that_is_added_begins_as_one_that_is_made_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |config: &RunConfig, from, name: &str| champion_of(folder.path(), config, from, name);
    let mut config = one_generation_of_playing("tetrapod-2", 1e-6, 20);
    run(&config, None, "first");
    let inputs = add_jump_clock(&mut config);
    // About the jump a held search looks with all of its first step; what goes on from a champion keeps near it.
    for (transferred, step) in [(Transferred::Held, 1e-6), (Transferred::Champion, 0.3e-6)] {
        let name = format!("{transferred:?}");
        let mut jumps = run(&config, Some(transferred), &name);
        let log = std::fs::read_to_string(folder.path().join(&name).join("log.jsonl")).expect("a log");
        let generation: serde_json::Value = serde_json::from_str(log.lines().next().expect("a line")).expect("JSON");
        let statistics = generation["strategy"].as_array().expect("statistics").iter();
        let found = statistics.filter(|one| one["name"] == "step_size").find_map(|one| one["value"].as_f64());
        let share = found.expect("a step size") / step;
        assert!((0.6..1.6).contains(&share), "{name}: {share} of {step} after a generation");
        let mut outputs = vec![0.0; 8];
        jumps.network.activate(&inputs, &mut outputs);
        for leg in outputs.chunks(2) {
            // Hips hang a little within the ends of the body, and hind legs are mirror images: all lean to the front. Knees stay
            // as they are.
            let leans = leg[0] / libm::tanhf(1.0);
            assert!((0.75..=1.001).contains(&leans) && leg[1].abs() < 1e-3, "{transferred:?}: {outputs:?}");
        }
    }
}

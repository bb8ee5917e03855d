//! NEAT for a net that a body has several copies of.

use ne_core::{
    Evaluation, Genome, Phenotype, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
};
use ne_neat::{Neat, NeatGenome, NeatSettings, StartTopology};
use ne_net::{Copies, CopySense, NetCopy, TopologyMap};
use serde_json::json;
use std::sync::Arc;

/// Three limbs of one joint each, the last a mirror image. Each senses a clock that all have, its own angle, and its place.
fn limbs(count: usize) -> Arc<Copies> {
    let limb = |limb: usize| {
        let sign = if limb == 2 { -1.0 } else { 1.0 };
        let sense = |constant, input, factor| CopySense { constant, sources: vec![(input, factor)] };
        let place = CopySense { constant: limb as f32 - 1.0, sources: Vec::new() };
        NetCopy { senses: vec![sense(0.0, 0, 1.0), sense(0.0, 1 + limb, sign), place], sign }
    };
    let outputs = (0..count).map(|limb| (limb, 0)).collect();
    Copies { inputs: 1 + count, outputs, copies: (0..count).map(limb).collect() }.into()
}

fn settings() -> NeatSettings {
    let mut settings = NeatSettings { population: 30, ..NeatSettings::default() };
    (settings.mutation.add_connection, settings.mutation.add_node) = (0.5, 0.4);
    settings
}

fn score(population: &[NeatGenome]) -> Vec<Evaluation> {
    let evaluate = |genome: &NeatGenome| {
        let mut net = genome.express();
        let mut answer = vec![0.0; net.shape().outputs.len()];
        net.activate(&vec![0.4; net.shape().inputs], &mut answer);
        Evaluation::new(f64::from(answer[0] - answer[1]))
    };
    population.iter().map(evaluate).collect()
}

fn generation(neat: &mut Neat, number: u64) -> Vec<NeatGenome> {
    let seed = Seed::of_run(1).generation(number);
    let population = neat.ask(seed).to_vec();
    neat.tell(&score(&population), seed);
    population
}

fn evolved() -> Neat {
    let mut neat = Neat::of_copies(settings(), limbs(3)).expect("valid");
    (0..10).for_each(|number| drop(generation(&mut neat, number)));
    neat
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    let new = || Neat::of_copies(settings(), limbs(3)).expect("valid");
    check_strategy(new, &StrategyOptions::default()).expect("keeps its promises");
}

#[test]
fn genomes_are_small_and_their_nets_whole() {
    let mut neat = evolved();
    for genome in generation(&mut neat, 10) {
        assert_eq!((genome.layout().inputs, genome.layout().outputs), (3, 1));
        let net = genome.express();
        assert_eq!((net.shape().inputs, net.shape().outputs.len(), net.shape().validate()), (4, 3, Ok(())));
        let text = serde_json::to_string(&genome).expect("serialises");
        assert_eq!(serde_json::from_str::<NeatGenome>(&text).expect("deserialises"), genome);
    }
    assert!(neat.statistics().iter().any(|it| it.name == "champion_hidden_neurons" && it.value > 0.0));
}

#[test]
fn goes_on_from_a_file_to_the_bit() {
    let mut neat = evolved();
    let text = serde_json::to_string(&neat).expect("serialises");
    let mut loaded: Neat = serde_json::from_str(&text).expect("deserialises");
    assert_eq!(text.matches("\"copies\"").count(), 2, "once, with its own field of that name, and in no genome");
    assert_eq!(generation(&mut loaded, 10), generation(&mut neat, 10));
}

#[test]
fn goes_on_with_a_body_that_has_more_limbs() {
    let mut neat = evolved();
    let same = (TopologyMap::none(3), TopologyMap::none(1));
    let mut grown = neat.clone().remapped(settings(), Some(limbs(5)), &same.0, &same.1).expect("goes on");
    let best = generation(&mut grown, 0)[0].clone();
    assert_eq!(best.express().shape().outputs.len(), 5);
    assert!(neat.ask(Seed::of_run(1)).iter().any(|genome| genome.nodes() == best.nodes()), "the champion is kept");
    let error = evolved().remapped(settings(), None, &same.0, &same.1).expect_err("whole nets").to_string();
    assert_eq!(error, "copies = whole nets: must be copies of a small net, as before");
    let fewer = TopologyMap::new(vec![Some(0), Some(1)], 3).expect("a map");
    let error = evolved().remapped(settings(), Some(limbs(3)), &fewer, &same.1).expect_err("two").to_string();
    assert_eq!(error, "inputs = to 2: must be to as many as the copies have");
}

#[test]
fn what_does_not_fit_is_an_error_that_names_the_field() {
    let start = StartTopology::HiddenLayer { neurons: 4096 };
    let error = Neat::of_copies(NeatSettings { start, ..settings() }, limbs(20)).expect_err("too many").to_string();
    assert_eq!(error, "start = 4097 neurons: must be at most 3276 neurons with 20 copies of the net");
    let none = Copies { copies: Vec::new(), ..Copies::clone(&limbs(3)) };
    let error = Neat::of_copies(settings(), none.into()).expect_err("no copy").to_string();
    assert_eq!(error, "copies.copies = 0 copies: must be from 1 to 4096 copies");
    let mut state = serde_json::to_value(evolved()).expect("serialises");
    state["inputs"] = json!(4);
    let error = serde_json::from_value::<Neat>(state).expect_err("another number").to_string();
    assert_eq!(error, "inputs = 4: must be 3, as the copies have it");
    let genome = evolved().ask(Seed::of_run(1))[0].clone();
    let mut value = serde_json::to_value(&genome).expect("serialises");
    value["copies"]["copies"].as_array_mut().expect("copies").iter_mut().for_each(|copy| {
        copy["senses"].as_array_mut().expect("senses").pop();
    });
    let error = serde_json::from_value::<NeatGenome>(value).expect_err("another number").to_string();
    assert_eq!(error, "copies: of a net of 2 inputs, the layout has 3");
}

//! What NEAT promises.

use ne_core::{
    Evaluation, Failure, Genome, Phenotype, Seed, Strategy,
    conformance::{StrategyOptions, check_strategy},
    digest::Digest,
};
use ne_neat::{
    BiasKind, FitnessBaseline, Neat, NeatGenome, NeatSettings, Noise, PopulationStagnation, SplitChoice, StartTopology,
    TargetSpecies,
};
use ne_net::Activation;
use proptest::prelude::*;
use serde_json::json;
use std::collections::BTreeMap;

/// The more its output grows with the input, the better; every seventh fails.
fn score(population: &[NeatGenome]) -> Vec<Evaluation> {
    let evaluate = |(index, genome): (usize, &NeatGenome)| {
        if index % 7 == 6 {
            return Evaluation::failed(Failure::Unstable { what: "speed".into() });
        }
        let mut net = genome.express();
        let (mut low, mut high) = ([0.0; 2], [0.0; 2]);
        net.activate(&[-0.5, 0.3, 0.1], &mut low);
        net.activate(&[0.5, 0.3, -0.1], &mut high);
        Evaluation::new(f64::from(high[0] - low[0] + high[1] * low[1]) - 0.01 * genome.enabled_count() as f64)
    };
    population.iter().enumerate().map(evaluate).collect()
}

fn generation(neat: &mut Neat, number: u64) -> Vec<NeatGenome> {
    let seed = Seed::of_run(1).generation(number);
    let population = neat.ask(seed).to_vec();
    neat.tell(&score(&population), seed);
    population
}

fn new(settings: NeatSettings) -> Neat {
    Neat::new(settings, 3, 2).expect("valid settings")
}

fn reload(neat: &Neat) -> Neat {
    serde_json::from_str(&to_json(neat)).expect("deserialises")
}

fn to_json(neat: &Neat) -> String {
    serde_json::to_string(neat).expect("serialises")
}

/// The presets, and two with everything else.
fn all_settings() -> [NeatSettings; 6] {
    let mut other = NeatSettings { population: 37, bias: BiasKind::None, ..NeatSettings::default() };
    other.hidden_activations = vec![Activation::Sine, Activation::Gaussian, Activation::Relu];
    other.start = StartTopology::HiddenLayer { neurons: 3 };
    other.new_weights = Noise::Gaussian { deviation: 1.0 };
    other.speciation.threshold = 1.0;
    other.speciation.target = Some(TargetSpecies { species: 5, step: 0.2 });
    other.speciation.baseline = FitnessBaseline::Zero;
    other.speciation.protected = 3;
    other.speciation.stagnation = 2;
    other.speciation.population_stagnation = Some(PopulationStagnation { generations: 3, species: 1 });
    other.reproduction.interspecies = 0.5;
    other.reproduction.champion_above = 0;
    other.crossover.averaging = 0.5;
    let mutation = &mut other.mutation;
    (mutation.enable, mutation.disable, mutation.delete_connection, mutation.delete_node) = (0.3, 0.3, 0.3, 0.2);
    (mutation.activation, mutation.add_connection, mutation.add_node) = (0.3, 0.5, 0.4);
    mutation.split = SplitChoice::Any;
    let mut sparse = NeatSettings { recurrent: true, start: StartTopology::Unconnected, ..other.clone() };
    sparse.bias = BiasKind::InputNode;
    [
        NeatSettings::default(),
        NeatSettings::stanley_2002(),
        NeatSettings { population: 60, ..NeatSettings::stanley_2002_double_pole() },
        NeatSettings { start: StartTopology::PartlyConnected { share: 0.5 }, ..NeatSettings::pole_balancing() },
        other,
        sparse,
    ]
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    for settings in all_settings() {
        let settings = NeatSettings { population: settings.population.min(60), ..settings };
        let options = StrategyOptions { generations: 12, ..Default::default() };
        check_strategy(|| new(settings.clone()), &options).expect("keeps its promises");
    }
}

#[test]
fn state_survives_serialisation_to_the_bit() {
    for settings in all_settings() {
        let mut neat = new(settings);
        for number in 1..12 {
            let seed = Seed::of_run(1).generation(number);
            let mut copy = reload(&neat);
            let population = neat.ask(seed).to_vec();
            assert_eq!(copy.ask(seed), population, "saved before generation {number} was asked");
            // Between ask and tell as well, whether it is asked again or not.
            let mut copy = reload(&neat);
            let mut again = reload(&neat);
            assert_eq!(again.ask(seed), population, "saved and asked again in generation {number}");
            assert_eq!(again.origins(), neat.origins());
            assert_eq!(to_json(&again), to_json(&neat));
            neat.tell(&score(&population), seed);
            copy.tell(&score(&population), seed);
            assert_eq!((copy.statistics(), copy.species()), (neat.statistics(), neat.species()));
            let next = Seed::of_run(1).generation(number + 1);
            assert_eq!(copy.ask(next), neat.clone().ask(next), "saved before generation {number} was told");
        }
    }
}

/// Of a connection that is split, the half into the new neuron has a weight of 1.
#[test]
fn no_weight_is_beyond_the_limit() {
    for start in [StartTopology::FullyConnected, StartTopology::HiddenLayer { neurons: 3 }] {
        let mut settings =
            NeatSettings { start, new_weights: Noise::Gaussian { deviation: 5.0 }, ..NeatSettings::default() };
        (settings.mutation.add_connection, settings.mutation.weights.limit) = (0.5, 2.0);
        let mut neat = new(settings);
        let mut at_limit = 0;
        for number in 1..=10 {
            for genome in generation(&mut neat, number) {
                let biases = genome.nodes().iter().map(|node| node.bias);
                for weight in genome.connections().iter().map(|gene| gene.weight).chain(biases) {
                    assert!(weight.abs() <= 2.0, "{weight} in generation {number}");
                    at_limit += u32::from(weight.abs() == 2.0);
                }
            }
        }
        assert!(at_limit > 0);
    }
}

/// Every genome is one, the population keeps its size, a number stands for the same connection in all genomes ever, and
/// species are of the size they say.
#[test]
fn generations_are_sound() {
    for settings in all_settings() {
        let (population, outputs) = (settings.population, 2);
        let mut neat = new(settings);
        let mut ends = BTreeMap::new();
        for number in 1..=30 {
            let genomes = generation(&mut neat, number);
            assert_eq!(genomes.len(), population);
            for genome in &genomes {
                let genome = NeatGenome::new(*genome.layout(), genome.nodes().to_vec(), genome.connections().to_vec());
                let genome = genome.expect("a genome");
                for gene in genome.connections() {
                    let first = *ends.entry(gene.innovation).or_insert((gene.from, gene.to));
                    assert_eq!(first, (gene.from, gene.to), "innovation {}", gene.innovation);
                }
                for node in &genome.nodes()[outputs..] {
                    assert!(
                        genome.connections().iter().any(|gene| gene.touches(node.id)),
                        "a neuron without connection"
                    );
                }
            }
            let species = neat.species();
            assert_eq!(species.iter().map(|species| species.size).sum::<u64>(), population as u64);
            assert!(species.is_sorted_by(|a, b| a.id < b.id) && species.iter().all(|species| species.size > 0));
            let best = score(&genomes).iter().map(Evaluation::fitness).max().expect("a population");
            assert_eq!(species.iter().map(|species| species.best).max().expect("a species"), best);
        }
    }
}

#[test]
fn the_first_generation_is_what_the_start_says() {
    let shape = |start, bias| {
        let mut neat = new(NeatSettings { start, bias, population: 1000, ..NeatSettings::stanley_2002() });
        let genomes = generation(&mut neat, 1);
        let mean = genomes.iter().map(NeatGenome::enabled_count).sum::<usize>() as f64 / 1000.0;
        (genomes[0].hidden_count(), mean)
    };
    assert_eq!(shape(StartTopology::FullyConnected, BiasKind::InputNode), (0, 8.0));
    assert_eq!(shape(StartTopology::FullyConnected, BiasKind::PerNeuron), (0, 6.0));
    assert_eq!(shape(StartTopology::Unconnected, BiasKind::InputNode), (0, 0.0));
    assert_eq!(shape(StartTopology::HiddenLayer { neurons: 5 }, BiasKind::InputNode), (5, 30.0));
    let (hidden, mean) = shape(StartTopology::PartlyConnected { share: 0.25 }, BiasKind::None);
    assert!(hidden == 0 && (mean - 1.5).abs() < 0.15, "{mean}");
}

#[test]
fn champions_of_large_species_survive_unchanged() {
    let mut settings = NeatSettings::stanley_2002();
    settings.reproduction.champion_above = 5;
    let mut neat = new(settings);
    for number in 1..20 {
        let parents = generation(&mut neat, number);
        let scores = score(&parents);
        let large: Vec<_> = neat.species().into_iter().filter(|species| species.size > 5).collect();
        let stagnates = neat.statistics().iter().any(|s| s.name == "stagnation_generations" && s.value > 0.0);
        let children = neat.ask(Seed::of_run(1).generation(number + 1)).to_vec();
        let best = large.iter().max_by_key(|species| species.best).expect("a large species");
        // The best species is protected, and has children.
        if !stagnates {
            let champions = parents.iter().zip(&scores).filter(|(_, score)| score.fitness() == best.best);
            assert!(champions.clone().any(|(champion, _)| children.contains(champion)), "generation {number}");
        }
    }
}

#[test]
fn the_threshold_moves_towards_the_number_of_species() {
    let mut settings = NeatSettings { population: 200, ..NeatSettings::default() };
    settings.speciation.target = Some(TargetSpecies { species: 8, step: 0.1 });
    let mut neat = new(settings);
    let mut counts = Vec::new();
    for number in 1..=80 {
        generation(&mut neat, number);
        counts.push(neat.species().len());
    }
    let mean = counts[40..].iter().sum::<usize>() as f64 / 40.0;
    assert!((5.0..=11.0).contains(&mean), "{counts:?}");
}

#[test]
fn a_generation_of_failures_is_survived() {
    for settings in all_settings() {
        let mut neat = new(settings);
        for number in 1..6 {
            let seed = Seed::of_run(1).generation(number);
            let failure = Evaluation::failed(Failure::Other { what: "test".into() });
            let evaluations = vec![failure; neat.ask(seed).len()];
            neat.tell(&evaluations, seed);
            assert!(neat.statistics().iter().all(|statistic| statistic.value.is_finite()));
            assert!(neat.species().iter().all(|species| species.best.is_none()));
        }
    }
}

#[test]
fn statistics_have_their_names() {
    let mut neat = new(NeatSettings::stanley_2002());
    generation(&mut neat, 1);
    let names: Vec<_> = neat.statistics().into_iter().map(|statistic| statistic.name).collect();
    let expected = [
        "species",
        "largest_species",
        "compatibility_threshold",
        "mean_hidden_neurons",
        "max_hidden_neurons",
        "mean_enabled_connections",
        "max_enabled_connections",
        "champion_hidden_neurons",
        "champion_enabled_connections",
        "stagnation_generations",
    ];
    assert_eq!((neat.name(), names), ("neat", expected.map(String::from).to_vec()));
}

#[test]
fn wrong_numbers_of_inputs_and_outputs_are_errors() {
    let error = |settings, inputs, outputs| Neat::new(settings, inputs, outputs).expect_err("invalid").to_string();
    assert_eq!(error(NeatSettings::default(), 0, 1), "inputs = 0: must be from 1 to 4096");
    assert_eq!(error(NeatSettings::default(), 1, 4097), "outputs = 4097: must be from 1 to 4096");
    assert_eq!(
        error(NeatSettings { population: 1, ..NeatSettings::default() }, 1, 1),
        "population = 1: must be from 2 to 1000000"
    );
    let start = StartTopology::HiddenLayer { neurons: 4096 };
    assert_eq!(
        error(NeatSettings { start, ..NeatSettings::default() }, 4096, 1),
        "start = 16785408 connections of 4096 inputs and 1 outputs: must be at most 8388608 connections"
    );
}

#[test]
fn damaged_numbers_of_a_generation_that_was_asked_are_errors() {
    let mut neat = new(NeatSettings { population: 60, ..NeatSettings::stanley_2002() });
    (1..4).for_each(|number| drop(generation(&mut neat, number)));
    let between = serde_json::to_value(&neat).expect("serialises");
    neat.ask(Seed::of_run(1).generation(4));
    let asked = serde_json::to_value(&neat).expect("serialises");
    let error = |state: &serde_json::Value, before: serde_json::Value| {
        let mut damaged = state.clone();
        damaged["innovations"]["before_asked"] = before;
        serde_json::from_value::<Neat>(damaged).expect_err("damaged").to_string()
    };
    let next = |name: &str| asked["innovations"][name].as_u64().expect("a number");
    let (node, innovation) = (next("next_node"), next("next_innovation"));
    let wrong = [
        (error(&between, json!([6, 8])), "innovations.before_asked = there: must be absent between generations".into()),
        (
            error(&asked, json!([5, 8])),
            format!("innovations.before_asked = 5: must be from 6 to {node}, the next in `next_node`"),
        ),
        (
            error(&asked, json!([6, innovation + 1])),
            format!(
                "innovations.before_asked = {}: must be from 8 to {innovation}, the next in `next_innovation`",
                innovation + 1
            ),
        ),
        (error(&asked, json!([6, 8])), "parents[".into()),
    ];
    for (error, message) in wrong {
        assert!(error.starts_with(&message), "{error}; expected {message}");
    }
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut neat = new(NeatSettings::stanley_2002());
    (1..4).for_each(|number| drop(generation(&mut neat, number)));
    let state = serde_json::to_value(&neat).expect("serialises");
    type Damage = fn(&mut serde_json::Value);
    let damages: [(Damage, &str); 15] = [
        (|s| s["settings"]["population"] = 1.into(), "population = 1: must be from 2 to 1000000"),
        (|s| s["inputs"] = 0.into(), "inputs = 0: must be from 1 to 4096"),
        (|s| s["settings"]["population"] = 151.into(), "parents: found 150 individuals, the settings say 151"),
        (|s| s["parents"][3]["genes"]["nodes"][1]["id"] = 4.into(), "parents[3].nodes[1]: 4 does not come after 4"),
        (
            |s| s["parents"][3]["genes"]["connections"][2]["weight"] = json!(1e39),
            "parents[3].connections[2].weight = inf: must be finite",
        ),
        (
            |s| s["innovations"]["next_innovation"] = 7.into(),
            "innovations.next_innovation = 7: must be at least 8, the first that is free",
        ),
        (
            |s| s["innovations"]["next_node"] = 5.into(),
            "innovations.next_node = 5: must be at least 6, the first that is free",
        ),
        (|s| s["innovations"]["next_innovation"] = 8.into(), "parents["),
        (
            |s| s["parents"][3]["genes"]["connections"][0]["to"] = 5.into(),
            "parents[3].connections[1]: leads from 0 to 5, as connections[0] does",
        ),
        (
            |s| {
                for (gene, target) in [(0, 5), (1, 4)] {
                    s["parents"][3]["genes"]["connections"][gene]["to"] = target.into();
                }
            },
            "parents[3]: innovation 0 leads from 0 to 5, must lead from 0 to 4",
        ),
        (|s| s["threshold"] = 0.into(), "threshold = 0: must be above 0 and finite"),
        (|s| s["species"][0]["id"] = 99.into(), "species[0].id = 99: must be below "),
        (|s| s["parents"][5]["species"] = 99.into(), "parents[5].species = 99: must be one of the species"),
        (
            |s| {
                s["next_species"] = 1000.into();
                let lonely = json!({"id": 999, "best": null, "stagnation": 0});
                s["species"].as_array_mut().expect("a list").push(lonely);
            },
            "species[",
        ),
        (|s| s["seed"] = 1.into(), "unknown field `seed`"),
    ];
    for (damage, message) in damages {
        let mut damaged = state.clone();
        damage(&mut damaged);
        let error = serde_json::from_value::<Neat>(damaged).expect_err(message).to_string();
        assert!(error.starts_with(message), "{error}; expected {message}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn the_population_keeps_its_size(population in 2..60usize, threshold in 0.1..5.0f64, protected in 1..4usize) {
        let mut settings = NeatSettings { population, ..NeatSettings::stanley_2002() };
        settings.speciation.threshold = threshold;
        settings.speciation.protected = protected.min(population);
        settings.speciation.stagnation = 2;
        let mut neat = new(settings);
        for number in 1..8 {
            prop_assert_eq!(generation(&mut neat, number).len(), population);
        }
    }
}

#[test]
fn a_search_without_progress_begins_anew() {
    let settings = NeatSettings { restart: Some(3), ..NeatSettings::stanley_2002() };
    let mut neat = new(settings.clone());
    for number in 1..=4 {
        let seed = Seed::of_run(1).generation(number);
        let same = vec![Evaluation::new(1.0); neat.ask(seed).len()];
        neat.tell(&same, seed);
    }
    let ids: Vec<u64> = neat.species().iter().map(|species| species.id).collect();
    let seed = Seed::of_run(1).generation(5);
    let mut fresh = new(settings.clone());
    let drawn = fresh.ask(seed);
    assert_eq!(reload(&neat).ask(seed), drawn, "as a first generation is");
    assert_eq!(neat.ask(seed), drawn);
    let mut neat = reload(&neat);
    neat.tell(&vec![Evaluation::new(0.5); settings.population], seed);
    assert!(neat.species().iter().all(|species| !ids.contains(&species.id)), "of new species");
    let next = Seed::of_run(1).generation(6);
    assert_ne!(neat.ask(next), new(settings).ask(next), "and goes on from it");
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let [.., other, sparse] = all_settings();
    let digests = [NeatSettings::stanley_2002(), other, sparse].map(|settings| {
        let mut neat = new(settings);
        let mut digest = Digest::default();
        for number in 1..=20 {
            for genome in generation(&mut neat, number) {
                for gene in genome.connections() {
                    digest.add(&gene.innovation.to_le_bytes());
                    digest.add_f32(gene.weight);
                }
                let mut outputs = [0.0; 2];
                genome.express().activate(&[0.5, -1.0, 2.0], &mut outputs);
                outputs.iter().for_each(|&output| digest.add_f32(output));
            }
        }
        digest.to_string()
    });
    assert_eq!(digests, ["6683af578ae23c03", "6101fa696a1504a1", "aca859b77c80af8f"]);
}

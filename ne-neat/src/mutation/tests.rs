//! What mutations promise, on genomes that a run has brought forth.

use super::*;
use crate::{BiasKind, ConnectionGene, Neat, NeatSettings, Noise, innovation::Innovations};
use ne_core::{Evaluation, Purpose, Seed, Strategy};
use proptest::prelude::*;

const NOTHING: MutationSettings = MutationSettings {
    weights: WeightMutation {
        rate: 0.0,
        share: 1.0,
        replaced: 0.1,
        perturbation: Noise::Uniform { limit: 0.5 },
        limit: 8.0,
    },
    enable: 0.0,
    disable: 0.0,
    delete_connection: 0.0,
    delete_node: 0.0,
    activation: 0.0,
    add_connection: 0.0,
    add_node: 0.0,
    split: SplitChoice::Any,
};

const NEW: NewWeights = NewWeights { noise: Noise::Uniform { limit: 1.0 }, limit: 8.0 };

const CHOICES: [Activation; 2] = [Activation::SteepLogistic, Activation::Sine];

fn stream(seed: u64) -> RandomStream {
    Seed::of_run(seed).stream(Purpose::new("test"))
}

/// Genomes of two inputs and two outputs, with structure.
fn genomes(seed: u64, recurrent: bool) -> Vec<NeatGenome> {
    let mut settings = NeatSettings { population: 8, recurrent, ..NeatSettings::stanley_2002() };
    (settings.mutation.add_connection, settings.mutation.add_node) = (0.6, 0.6);
    let mut neat = Neat::new(settings, 2, 2).expect("valid");
    for generation in 1..10 {
        let place = Seed::of_run(seed).generation(generation);
        neat.ask(place);
        neat.tell(&vec![Evaluation::new(1.0); 8], place);
    }
    neat.ask(Seed::of_run(seed).generation(10)).to_vec()
}

fn mutated(genome: &NeatGenome, settings: MutationSettings, seed: u64) -> NeatGenome {
    let mut child = genome.clone();
    let new = NewWeights { limit: settings.weights.limit as f32, ..NEW };
    let proposal = settings.mutate(&mut child, new, &CHOICES, &mut stream(seed));
    apply(proposal, &mut child, &mut Innovations::new(1000, 1000));
    let checked = NeatGenome::new(*child.layout(), child.nodes().to_vec(), child.connections().to_vec());
    assert_eq!(checked, Ok(child.clone()), "a genome");
    child
}

fn changed_genes(a: &NeatGenome, b: &NeatGenome) -> usize {
    a.connections().iter().zip(b.connections()).filter(|(a, b)| a != b).count()
}

proptest! {
    #[test]
    fn each_kind_does_what_it_says(seed in 0..10_000u64, recurrent in proptest::bool::ANY) {
        for genome in genomes(seed, recurrent) {
            let (enabled, all, hidden) = (genome.enabled_count(), genome.connections().len(), genome.hidden_count());
            prop_assert_eq!(&mutated(&genome, NOTHING, seed), &genome);

            let child = mutated(&genome, MutationSettings { enable: 1.0, ..NOTHING }, seed);
            prop_assert_eq!(child.enabled_count(), all.min(enabled + 1));
            prop_assert_eq!(changed_genes(&genome, &child), usize::from(enabled < all));

            let child = mutated(&genome, MutationSettings { disable: 1.0, ..NOTHING }, seed);
            prop_assert_eq!(child.enabled_count(), enabled.saturating_sub(1));

            let child = mutated(&genome, MutationSettings { delete_connection: 1.0, ..NOTHING }, seed);
            prop_assert_eq!(child.connections().len(), all - 1);

            let child = mutated(&genome, MutationSettings { delete_node: 1.0, ..NOTHING }, seed);
            prop_assert_eq!(child.hidden_count() < hidden, hidden > 0);
            for child in [child, mutated(&genome, MutationSettings { delete_connection: 1.0, ..NOTHING }, seed)] {
                let has_connection = |id| child.connections().iter().any(|gene| gene.touches(id));
                prop_assert!(child.nodes()[2..].iter().all(|node| has_connection(node.id)));
            }

            let child = mutated(&genome, MutationSettings { activation: 1.0, ..NOTHING }, seed);
            let changed = genome.nodes().iter().zip(child.nodes()).filter(|(a, b)| a.activation != b.activation);
            prop_assert_eq!(changed.count(), hidden.min(1));
            prop_assert_eq!(&genome.nodes()[..2], &child.nodes()[..2]);

            let child = mutated(&genome, MutationSettings { add_node: 1.0, ..NOTHING }, seed);
            prop_assert_eq!((child.hidden_count(), child.enabled_count()), (hidden + 1, enabled + 1));
            let [.., to, from] = child.connections() else { panic!("two at least") };
            let is_split = |gene: &&ConnectionGene| (gene.from, gene.to) == (to.from, from.to);
            let split = genome.connections().iter().find(is_split).expect("a connection was split");
            prop_assert_eq!((to.weight, from.weight, to.to), (1.0, split.weight, from.from));
        }
    }

    /// Until there is every connection that there may be.
    #[test]
    fn connections_are_added_as_long_as_there_is_room(seed in 0..10_000u64, recurrent in proptest::bool::ANY) {
        let mut genome = genomes(seed, recurrent).swap_remove(0);
        let neurons = genome.nodes().len();
        // Two inputs and the bias node; in a net without cycles one of each pair of neurons comes first.
        let room = if recurrent { (3 + neurons) * neurons } else { 3 * neurons + neurons * (neurons - 1) / 2 };
        let mut innovations = Innovations::new(1000, 1000);
        let settings = MutationSettings { add_connection: 1.0, ..NOTHING };
        for round in genome.connections().len()..=room {
            prop_assert_eq!(genome.connections().len(), round.min(room));
            let proposal = settings.mutate(&mut genome, NEW, &CHOICES, &mut stream(round as u64));
            apply(proposal, &mut genome, &mut innovations);
        }
        prop_assert_eq!(genome.connections().len(), room);
    }

    #[test]
    fn weights_stay_within_their_limit(seed in 0..10_000u64, limit in 0.01..5.0f64, share in 0.0..1.0f64) {
        let weights = WeightMutation { rate: 1.0, share, limit, ..NOTHING.weights };
        let settings = MutationSettings { weights, ..NOTHING };
        for genome in genomes(seed, true) {
            let child = mutated(&genome, settings, seed);
            for (before, after) in genome.connections().iter().zip(child.connections()) {
                prop_assert!(after.weight == before.weight || f64::from(after.weight.abs()) <= limit * 1.000_001);
            }
        }
    }
}

#[test]
fn shares_of_weights_are_perturbed_and_replaced() {
    let settings = NeatSettings { population: 2, bias: BiasKind::PerNeuron, ..NeatSettings::stanley_2002() };
    let mut neat = Neat::new(settings, 50, 20).expect("valid");
    let mut genome = neat.ask(Seed::of_run(1)).first().expect("two").clone();
    let (nodes, connections) = genome.genes_mut();
    nodes.iter_mut().for_each(|gene| gene.bias = 5.0);
    connections.iter_mut().for_each(|gene| gene.weight = 5.0);
    let weights = WeightMutation { rate: 1.0, share: 0.5, replaced: 0.2, ..NOTHING.weights };
    let child = mutated(&genome, MutationSettings { weights, ..NOTHING }, 1);
    let biases = child.nodes().iter().map(|gene| gene.bias);
    let numbers: Vec<f32> = child.connections().iter().map(|gene| gene.weight).chain(biases.clone()).collect();
    let share = |fits: fn(f32) -> bool| numbers.iter().filter(|&&x| fits(x)).count() as f64 / numbers.len() as f64;
    assert!((share(|x| x == 5.0) - 0.5).abs() < 0.06);
    assert!((share(|x| x < 2.0) - 0.1).abs() < 0.04);
    assert!((share(|x| x != 5.0 && x >= 4.5) - 0.4).abs() < 0.06);
    assert!(biases.clone().any(|bias| bias != 5.0));
}

#[test]
fn old_connections_are_split_first_in_small_genomes() {
    let settings = NeatSettings { population: 2, ..NeatSettings::stanley_2002() };
    let mut neat = Neat::new(settings, 3, 1).expect("valid");
    let genome = neat.ask(Seed::of_run(1)).first().expect("two").clone();
    let shares = |split: SplitChoice| {
        let mut counts = [0.0_f64; 4];
        for seed in 0..2000 {
            let child = mutated(&genome, MutationSettings { add_node: 1.0, split, ..NOTHING }, seed);
            let disabled = child.connections().iter().position(|gene| !gene.enabled).expect("one is split");
            counts[disabled] += 1.0 / 2000.0;
        }
        counts
    };
    // The fourth comes from the bias node.
    let old = SplitChoice::Older { probability: 0.7, below: 5 };
    let left = 0.3 * 0.3 * 0.3 / 3.0;
    for (split, expected) in [
        (SplitChoice::Any, [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0]),
        (old, [0.7 + left, 0.21 + left, 0.063 + left, 0.0]),
        (SplitChoice::Older { probability: 0.7, below: 4 }, [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0]),
    ] {
        let found = shares(split);
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 0.04), "{found:?}");
    }
}

#[test]
fn errors_name_the_field() {
    type Change = fn(&mut MutationSettings);
    let changes: [(Change, &str); 8] = [
        (|s| s.weights.rate = 1.5, "weights.rate = 1.5: must be from 0 to 1"),
        (|s| s.weights.share = -1.0, "weights.share = -1: must be from 0 to 1"),
        (|s| s.weights.replaced = f64::NAN, "weights.replaced = NaN: must be from 0 to 1"),
        (|s| s.weights.limit = 0.0, "weights.limit = 0: must be from 0.001 to 1000"),
        (
            |s| s.weights.perturbation = Noise::Gaussian { deviation: -1.0 },
            "weights.perturbation.gaussian.deviation = -1: must be from 0 to 1000",
        ),
        (|s| s.add_node = 2.0, "add_node = 2: must be from 0 to 1"),
        (|s| s.delete_connection = 2.0, "delete_connection = 2: must be from 0 to 1"),
        (
            |s| s.split = SplitChoice::Older { probability: 2.0, below: 1 },
            "split.older.probability = 2: must be from 0 to 1",
        ),
    ];
    for (change, message) in changes {
        let mut settings = NOTHING;
        change(&mut settings);
        assert_eq!(settings.validate().expect_err("out of range").to_string(), message);
    }
}

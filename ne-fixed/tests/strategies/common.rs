//! What the tests of several strategies need.

use ne_core::{Evaluation, Failure, Genome, Phenotype, Seed, Strategy, digest::Digest};
use ne_fixed::WeightVector;
use ne_net::{Activation, DenseShape, GraphNeuron, GraphShape, Topology};
use serde::de::DeserializeOwned;

/// A small dense net: 26 weights.
pub(crate) fn dense() -> DenseShape {
    DenseShape::new(3, vec![4], 2)
}

/// A recurrent net of three neurons, each connected with all three and with all inputs: 21 weights.
pub(crate) fn recurrent() -> GraphShape {
    fully_recurrent(3, 3, true)
}

/// Neurons each connected with all of them and with all inputs; the last is the output.
pub(crate) fn fully_recurrent(inputs: usize, neurons: usize, bias: bool) -> GraphShape {
    let neuron = GraphNeuron { activation: Activation::Logistic, bias, sources: (0..inputs + neurons).collect() };
    GraphShape { inputs, recurrent: true, neurons: vec![neuron; neurons], outputs: vec![inputs + neurons - 1] }
}

/// One neuron without a bias, connected with all inputs.
pub(crate) fn single_neuron(inputs: usize) -> GraphShape {
    let neuron = GraphNeuron { activation: Activation::Logistic, bias: false, sources: (0..inputs).collect() };
    GraphShape { inputs, recurrent: false, neurons: vec![neuron], outputs: vec![inputs] }
}

/// A topology with this many weights, for functions that look at nothing but the weights.
pub(crate) fn weights(count: usize) -> Topology {
    DenseShape::new(count - 1, vec![], 1).into()
}

/// The closer all weights are to 1, the better; every seventh fails.
pub(crate) fn score(population: &[WeightVector]) -> Vec<Evaluation> {
    let evaluate = |(index, genome): (usize, &WeightVector)| {
        if index % 7 == 6 {
            return Evaluation::failed(Failure::Unstable { what: "speed".into() });
        }
        Evaluation::new(-genome.weights().iter().map(|&weight| f64::from(weight - 1.0).powi(2)).sum::<f64>())
    };
    population.iter().enumerate().map(evaluate).collect()
}

/// Asks and tells one generation.
pub(crate) fn generation<S: Strategy<Genome = WeightVector>>(strategy: &mut S, number: u64) -> Vec<WeightVector> {
    let seed = Seed::of_run(1).generation(number);
    let population = strategy.ask(seed).to_vec();
    strategy.tell(&score(&population), seed);
    population
}

/// Tells one generation that all individuals came to the same.
pub(crate) fn generation_of<S: Strategy<Genome = WeightVector>>(strategy: &mut S, number: u64, result: &Evaluation) {
    let seed = Seed::of_run(1).generation(number);
    let evaluations = vec![result.clone(); strategy.ask(seed).len()];
    strategy.tell(&evaluations, seed);
}

/// Written and read back.
pub(crate) fn reload<S: Strategy + DeserializeOwned>(strategy: &S) -> S {
    let text = serde_json::to_string(strategy).expect("serialises");
    serde_json::from_str(&text).expect("deserialises")
}

/// Checks that a strategy goes on to the bit when it is saved, between generations and in the middle of one.
pub(crate) fn assert_resumes<S: Strategy<Genome = WeightVector> + DeserializeOwned>(mut strategy: S, generations: u64) {
    for number in 1..=generations {
        let seed = Seed::of_run(1).generation(number);
        let mut copy = reload(&strategy);
        let population = strategy.ask(seed).to_vec();
        assert_eq!(copy.ask(seed), population, "saved before generation {number} was asked");
        let mut copy = reload(&strategy);
        let evaluations = score(&population);
        strategy.tell(&evaluations, seed);
        copy.tell(&evaluations, seed);
        assert_eq!(copy.statistics(), strategy.statistics());
        let saved = |strategy: &S| serde_json::to_value(strategy).expect("serialises");
        assert_eq!(saved(&copy), saved(&strategy), "saved before generation {number} was told");
    }
}

/// Checks that reading the state with each damage is an error that says so.
pub(crate) fn assert_damages_are_found<S: Strategy + DeserializeOwned + std::fmt::Debug>(
    strategy: &S,
    damages: &[(Damage, &str)],
) {
    let state = serde_json::to_value(strategy).expect("serialises");
    for (damage, message) in damages {
        let mut damaged = state.clone();
        damage(&mut damaged);
        let error = serde_json::from_value::<S>(damaged).expect_err(message).to_string();
        assert!(error.contains(message), "{error}");
    }
}

pub(crate) type Damage = fn(&mut serde_json::Value);

/// The digest of a short run: all genes, and what the nets answer.
pub(crate) fn digest<S: Strategy<Genome = WeightVector>>(mut strategy: S, generations: u64) -> String {
    let mut digest = Digest::default();
    for number in 1..=generations {
        for genome in generation(&mut strategy, number) {
            genome.weights().iter().for_each(|&weight| digest.add_f32(weight));
            let mut net = genome.express();
            let mut outputs = vec![0.0; net.outputs()];
            net.activate(&[0.5, -1.0, 2.0], &mut outputs);
            outputs.iter().for_each(|&output| digest.add_f32(output));
        }
    }
    digest.to_string()
}

/// The evaluations until `cost` of an individual's weights is at most `target`; none if it takes more than `limit`.
pub(crate) fn evaluations_to<S: Strategy<Genome = WeightVector>>(
    mut strategy: S,
    run: u64,
    cost: impl Fn(&[f64]) -> f64,
    target: f64,
    limit: usize,
) -> Option<usize> {
    let mut count = 0;
    for number in 1.. {
        let seed = Seed::of_run(run).generation(number);
        let mut evaluations = Vec::new();
        for genome in strategy.ask(seed) {
            let weights: Vec<f64> = genome.weights().iter().map(|&weight| weight.into()).collect();
            let cost = cost(&weights);
            count += 1;
            if cost <= target {
                return Some(count);
            }
            evaluations.push(Evaluation::new(-cost));
        }
        if count >= limit {
            break;
        }
        strategy.tell(&evaluations, seed);
    }
    None
}

//! One `activate` of graph nets, and building one: `cargo bench -p ne-net --bench graph`.
//!
//! All have 9 inputs, 4 hidden neurons, 8 outputs and 119 connections: every neuron is connected with all inputs, and
//! eleven with one other neuron. The peer interprets the shape neuron by neuron.

use criterion::{Criterion, criterion_group, criterion_main};
use ne_core::Phenotype;
use ne_net::{Activation, GraphNet, GraphNeuron, GraphShape};
use std::{hint::black_box, sync::Arc};

const INPUTS: usize = 9;
const NEURONS: usize = 12;

/// `extra` says which other node a neuron is connected with; both are counted from the first neuron.
fn shape(recurrent: bool, extra: impl Fn(usize) -> Option<usize>) -> Arc<GraphShape> {
    let neuron = |index| {
        let sources = (0..INPUTS).chain(extra(index).map(|source| INPUTS + source)).collect();
        GraphNeuron { activation: Activation::Tanh, bias: true, sources }
    };
    let neurons = (0..NEURONS).map(neuron).collect();
    let shape = GraphShape { inputs: INPUTS, recurrent, neurons, outputs: (INPUTS + 4..INPUTS + NEURONS).collect() };
    assert_eq!((shape.validate(), shape.connection_count()), (Ok(()), 119));
    Arc::new(shape)
}

fn graph(criterion: &mut Criterion) {
    let shapes = [
        // Three of the hidden neurons hang on the first one, all outputs on a hidden neuron.
        ("three layers", shape(false, |index| index.checked_sub(1).map(|index| if index < 3 { 0 } else { index % 4 }))),
        // The slowest of all: every neuron waits for the one before it.
        ("a chain", shape(false, |index| index.checked_sub(1))),
        ("recurrent", shape(true, |index| (index > 0).then_some(index))),
    ];
    let weights: Vec<f32> = (0..119 + NEURONS).map(|index| ((index * 37 % 101) as f32 - 50.0) * 0.02).collect();
    let inputs: Vec<f32> = (0..INPUTS).map(|index| (index as f32 - 4.0) * 0.5).collect();
    let mut outputs = [0.0; 8];
    let mut group = criterion.benchmark_group("graph with 119 connections, activate");
    for (name, shape) in &shapes {
        let mut net = GraphNet::from_checked(Arc::clone(shape), &weights);
        group.bench_function(*name, |bencher| {
            bencher.iter(|| net.activate(black_box(&inputs), black_box(&mut outputs)));
        });
        let mut values = [0.0; INPUTS + NEURONS];
        group.bench_function(format!("{name}, peer"), |bencher| {
            bencher.iter(|| interpret(shape, &weights, &mut values, black_box(&inputs), black_box(&mut outputs)));
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("graph with 119 connections, build");
    for (name, shape) in &shapes {
        group.bench_function(format!("{name}, checked before"), |bencher| {
            bencher.iter(|| GraphNet::from_checked(Arc::clone(shape), black_box(&weights)));
        });
        group.bench_function(format!("{name}, with all checks"), |bencher| {
            bencher.iter(|| GraphNet::new(Arc::clone(shape), black_box(&weights)).expect("a net"));
        });
    }
    group.finish();
}

fn interpret(shape: &GraphShape, weights: &[f32], values: &mut [f32], inputs: &[f32], outputs: &mut [f32]) {
    values[..shape.inputs].copy_from_slice(inputs);
    let mut weights = weights.iter();
    for (index, neuron) in shape.neurons.iter().enumerate() {
        let mut sum = if neuron.bias { weights.next().copied().unwrap_or(0.0) } else { 0.0 };
        for (&source, weight) in neuron.sources.iter().zip(weights.by_ref()) {
            sum += weight * values[source];
        }
        values[shape.inputs + index] = neuron.activation.apply(sum);
    }
    for (output, &node) in outputs.iter_mut().zip(&shape.outputs) {
        *output = values[node];
    }
}

criterion_group!(benches, graph);
criterion_main!(benches);

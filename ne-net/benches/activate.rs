//! One `activate` of the thesis' tetrapod net, 9-10-8: `cargo bench -p ne-net`.
//!
//! The peer is the same net written as plain loops with the tanh of libm.

use criterion::{Criterion, criterion_group, criterion_main};
use ne_core::Phenotype;
use ne_net::{Activation, DenseNet, DenseShape};
use std::hint::black_box;

fn activate(criterion: &mut Criterion) {
    let inputs: Vec<f32> = (0..9).map(|index| (index as f32 - 4.0) * 0.5).collect();
    let weights: Vec<f32> = (0..188).map(|index| ((index * 37 % 101) as f32 - 50.0) * 0.02).collect();
    let mut outputs = [0.0; 8];
    let mut group = criterion.benchmark_group("dense 9-10-8 activate");
    for activation in Activation::ALL {
        let shape = DenseShape {
            hidden_activation: activation,
            output_activation: activation,
            ..DenseShape::new(9, vec![10], 8)
        };
        let mut net = DenseNet::new(shape, &weights).expect("188 weights");
        group.bench_function(activation.name(), |bencher| {
            bencher.iter(|| net.activate(black_box(&inputs), black_box(&mut outputs)));
        });
    }
    group.bench_function("peer: plain loops, libm tanh", |bencher| {
        let mut hidden = [0.0; 10];
        bencher.iter(|| {
            let (first, second) = weights.split_at(100);
            layer(first, black_box(&inputs), &mut hidden);
            hidden.iter_mut().for_each(|value| *value *= 3.0);
            layer(second, &hidden, black_box(&mut outputs));
        });
    });
    group.finish();
}

fn layer(weights: &[f32], sources: &[f32], targets: &mut [f32]) {
    for (target, weights) in targets.iter_mut().zip(weights.chunks_exact(sources.len() + 1)) {
        let sum: f32 = weights.iter().zip(sources).map(|(weight, source)| weight * source).sum();
        *target = libm::tanhf(sum + weights[sources.len()]);
    }
}

criterion_group!(benches, activate);
criterion_main!(benches);

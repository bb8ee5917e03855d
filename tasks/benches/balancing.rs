//! Pole balancing: one decision (0.02 s of simulated time) without a net, and a whole evaluation of 1,000 decisions by a
//! controller that costs next to nothing: `cargo bench -p gambol-tasks`.

use criterion::{Criterion, criterion_group, criterion_main};
use ne_core::{Phenotype, Seed, Task};
use std::hint::black_box;
use tasks::{
    DoublePole, DoublePoleSettings, OutputRange,
    classic::{Dynamics, State},
};

/// Feedback of the whole state, which holds the poles for ever.
struct Feedback;

impl Phenotype for Feedback {
    fn inputs(&self) -> usize {
        6
    }
    fn outputs(&self) -> usize {
        1
    }
    fn reset(&mut self) {}
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        let gains = [-1.03, -0.69, -2.96, -3.01, 2.15, 0.69];
        outputs[0] = inputs.iter().zip(gains).map(|(input, gain)| input * gain).sum();
    }
}

fn decision(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("decision");
    group.bench_function("one pole", |bencher| {
        let state = State { position: 0.3, velocity: 0.5, angles: [0.1], angular_velocities: [-0.2] };
        bencher.iter(|| Dynamics::ONE_POLE.decision(black_box(&state), black_box(3.0)));
    });
    group.bench_function("two poles", |bencher| {
        let state = State { position: 0.3, velocity: 0.5, angles: [0.1, -0.3], angular_velocities: [-0.2, 0.7] };
        bencher.iter(|| Dynamics::TWO_POLES.decision(black_box(&state), black_box(3.0)));
    });
    group.finish();
}

fn evaluation(criterion: &mut Criterion) {
    let settings = DoublePoleSettings {
        velocities: true,
        output_range: OutputRange::MinusOneToOne,
        ..DoublePoleSettings::without_velocities()
    };
    let task = DoublePole::new(settings).expect("settings in range");
    assert_eq!(task.evaluate(&mut Feedback, Seed::of_run(1)).steps, 1000);
    criterion.bench_function("two poles, 1000 decisions", |bencher| {
        bencher.iter(|| task.evaluate(black_box(&mut Feedback), Seed::of_run(1)));
    });
}

criterion_group!(benches, decision, evaluation);
criterion_main!(benches);

//! One generation, `ask` and `tell` without evaluation, of genomes with 188 weights: `cargo bench -p ne-fixed`.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use ne_core::{Evaluation, Seed, Strategy};
use ne_fixed::{ConventionalNe, ConventionalNeSettings, MutationChoice, SelfAdaptiveMutation};
use ne_net::DenseShape;

fn generation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generation of 188 weights");
    let adaptive = ConventionalNeSettings {
        mutation: MutationChoice::SelfAdaptive(SelfAdaptiveMutation::default()),
        ..Default::default()
    };
    let presets = [
        ("default", ConventionalNeSettings::default()),
        ("thesis", ConventionalNeSettings::thesis()),
        ("self-adaptive", adaptive),
    ];
    for (name, settings) in presets {
        for population in [50, 1000] {
            let settings = ConventionalNeSettings { population, ..settings.clone() };
            let mut strategy = ConventionalNe::new(settings, DenseShape::new(9, vec![10], 8)).expect("valid settings");
            let evaluations: Vec<_> =
                (0..population).map(|index| Evaluation::new((index * 7919 % 1009) as f64)).collect();
            let mut number = 0;
            group.bench_function(format!("{name}, population {population}"), |bencher| {
                bencher.iter_batched(
                    || {
                        number += 1;
                        Seed::of_run(1).generation(number)
                    },
                    |seed| {
                        strategy.ask(seed);
                        strategy.tell(&evaluations, seed);
                    },
                    BatchSize::SmallInput,
                );
            });
        }
    }
    group.finish();
}

criterion_group!(benches, generation);
criterion_main!(benches);

//! One generation, `ask` and `tell` without evaluation, of genomes with 188 weights: `cargo bench -p ne-fixed`.

use criterion::{BatchSize, BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime};
use ne_core::{Evaluation, Seed, Strategy};
use ne_fixed::{
    CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings, CovarianceModel,
    MutationChoice, OpenEs, OpenEsSettings, SelfAdaptiveMutation,
};
use ne_net::DenseShape;

fn generation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generation of 188 weights");
    let shape = || DenseShape::new(9, vec![10], 8);
    let adaptive = ConventionalNeSettings {
        mutation: MutationChoice::SelfAdaptive(SelfAdaptiveMutation::default()),
        ..Default::default()
    };
    let presets = [
        ("default", ConventionalNeSettings::default()),
        ("thesis", ConventionalNeSettings::thesis()),
        ("self-adaptive", adaptive),
    ];
    for population in [50, 1000] {
        for (name, settings) in &presets {
            let settings = ConventionalNeSettings { population, ..settings.clone() };
            let strategy = ConventionalNe::new(settings, shape()).expect("valid settings");
            measure(&mut group, &format!("{name}, population {population}"), strategy);
        }
        for (name, covariance) in [("full", CovarianceModel::Full), ("separable", CovarianceModel::Separable)] {
            let settings = CmaEsSettings { population: Some(population), covariance, ..Default::default() };
            let strategy = CmaEs::new(settings, shape()).expect("valid settings");
            measure(&mut group, &format!("CMA-ES {name}, population {population}"), strategy);
        }
        let settings = OpenEsSettings { population, ..Default::default() };
        let strategy = OpenEs::new(settings, shape()).expect("valid settings");
        measure(&mut group, &format!("OpenAI-ES, population {population}"), strategy);
        let settings = CosyneSettings { population, ..Default::default() };
        let strategy = Cosyne::new(settings, shape()).expect("valid settings");
        measure(&mut group, &format!("CoSyNE, population {population}"), strategy);
    }
    group.finish();
}

fn measure(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, mut strategy: impl Strategy) {
    let mut number = 0;
    let asked = strategy.ask(Seed::of_run(1).generation(number)).len();
    let evaluations: Vec<_> = (0..asked).map(|index| Evaluation::new((index * 7919 % 1009) as f64)).collect();
    strategy.tell(&evaluations, Seed::of_run(1).generation(number));
    group.bench_function(name, |bencher| {
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

criterion_group!(benches, generation);
criterion_main!(benches);

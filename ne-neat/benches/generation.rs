//! One generation, `ask` and `tell` without evaluation, of genomes with about 26 connections: `cargo bench -p ne-neat`.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use ne_core::{Evaluation, Genome, Seed, Strategy};
use ne_neat::{Neat, NeatSettings};
use std::hint::black_box;

/// A search whose genomes have got a few hidden neurons.
fn grown(population: usize, settings: NeatSettings) -> (Neat, Vec<Evaluation>, u64) {
    let mut neat = Neat::new(NeatSettings { population, ..settings }, 7, 3).expect("valid settings");
    let evaluations: Vec<_> = (0..population).map(|index| Evaluation::new((index * 7919 % 1009) as f64)).collect();
    for number in 1..=8 {
        let seed = Seed::of_run(1).generation(number);
        neat.ask(seed);
        neat.tell(&evaluations, seed);
    }
    (neat, evaluations, 8)
}

fn generation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generation");
    // So near that there are several species, as in a run.
    let mut default = NeatSettings::default();
    default.speciation.threshold = 1.0;
    for (name, settings) in [("default", default), ("paper", NeatSettings::stanley_2002())] {
        for population in [150, 1000, 10_000] {
            let (neat, evaluations, number) = grown(population, settings.clone());
            let mean = neat.statistics()[5].value;
            let species = neat.statistics()[0].value;
            let name = format!("{name}, population {population}, {mean:.0} connections, {species} species");
            group.bench_function(name, |bencher| {
                bencher.iter_batched_ref(
                    || neat.clone(),
                    |neat| {
                        let seed = Seed::of_run(1).generation(number + 1);
                        neat.ask(seed);
                        neat.tell(&evaluations, seed);
                    },
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

fn express(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("express 150 genomes");
    for recurrent in [false, true] {
        let settings = NeatSettings { recurrent, ..NeatSettings::default() };
        let (mut neat, ..) = grown(150, settings);
        let genomes = neat.ask(Seed::of_run(1).generation(9)).to_vec();
        let name = if recurrent { "recurrent" } else { "feed-forward" };
        group.bench_function(name, |bencher| {
            bencher.iter(|| genomes.iter().for_each(|genome| drop(black_box(genome.express()))));
        });
    }
    group.finish();
}

criterion_group!(benches, generation, express);
criterion_main!(benches);
